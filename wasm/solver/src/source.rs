//! What a solve is about, kept as it was given, so that it can be resampled and
//! searched for occlusions again.

use serde::Deserialize;
use serde_wasm_bindgen::{from_value, preserve};
use wasm_bindgen::prelude::*;

use super::settings::Settings;
use developable::Input;
use developable::Occlusions;
use developable::checks::check_confidence;
use developable::checks::try_filled;
use developable::{HeightImage, Heightfield};
use developable_wasm::fields::{ImageInput, LatticeInput, bytes, values};
use developable_wasm::{Failure, Result};

/// What may be known besides the heights: the rest of `HeightImage` and
/// `Heightfield` of `types.d.ts`.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Known {
    #[serde(default, with = "preserve")]
    confidence: JsValue,
    #[serde(default, with = "preserve")]
    constraints: JsValue,
    #[serde(default, with = "preserve")]
    occlusions: JsValue,
    #[serde(default, with = "preserve")]
    broken_edges: JsValue,
}

pub enum Source {
    Image(Image),
    Lattice(Parts),
}

/// All at the pixels of one image.
pub struct Image {
    /// Of a design: its outline.
    heights: HeightImage,
    design: bool,
    confidence: Option<HeightImage>,
    constraints: Option<HeightImage>,
    occlusions: Option<Vec<u8>>,
}

/// All at the vertices of one lattice.
#[derive(Clone)]
pub struct Parts {
    /// Of a design: its outline.
    heights: Heightfield,
    design: bool,
    confidence: Option<Vec<f64>>,
    constraints: Option<Heightfield>,
    occlusions: Option<Occlusions>,
}

impl Source {
    pub fn image(value: JsValue) -> Result<Source> {
        let known: Known = from_value(value.clone())?;
        let input: ImageInput = from_value(value)?;
        let design = input.data.is_undefined();
        let heights = match design {
            true => {
                let blank = try_filled("height image", input.width * input.height, 0.0)?;
                input.image("height image", blank)?
            }
            false => input.heights("height image", &input.data)?,
        };
        let constraints = given(&known.constraints)
            .map(|value| input.heights("constraints", value))
            .transpose()?;
        let shape = (input.height, input.width);
        let confidence = given(&known.confidence)
            .map(|value| input.image("confidence", confidence(value, shape, heights.values())?))
            .transpose()?;
        Ok(Source::Image(Image {
            heights,
            design,
            confidence,
            constraints,
            occlusions: bytes(&known.occlusions),
        }))
    }

    pub fn lattice(value: JsValue) -> Result<Source> {
        let known: Known = from_value(value.clone())?;
        let input: LatticeInput = from_value(value)?;
        let (rows, cols) = (input.rows, input.cols);
        let design = input.heights.is_undefined();
        let heights = match design {
            true => input.field("heightfield", try_filled("heightfield", rows * cols, 0.0)?)?,
            false => input.heights("heightfield", &input.heights)?,
        };
        let lattice = *heights.lattice();
        let constraints = given(&known.constraints)
            .map(|value| input.heights("constraints", value))
            .transpose()?;
        let confidence = given(&known.confidence)
            .map(|value| confidence(value, (rows, cols), heights.heights()))
            .transpose()?;
        let vertices = bytes(&known.occlusions)
            .map(|flags| Occlusions::from_vertices(&lattice, &flags))
            .transpose()?;
        let edges = bytes(&known.broken_edges)
            .map(|bits| Occlusions::from_edges(&lattice, &bits))
            .transpose()?;
        Ok(Source::Lattice(Parts {
            heights,
            design,
            confidence,
            constraints,
            occlusions: union(vertices, edges)?,
        }))
    }

    /// The image to bring a surface back to.
    pub fn pixels(&self) -> Option<&HeightImage> {
        match self {
            Source::Image(image) => Some(&image.heights),
            Source::Lattice(_) => None,
        }
    }

    /// The input of a solve.
    pub fn input(&self, settings: &Settings) -> Result<Input> {
        self.parts(settings.spacing)?.into_input(settings)
    }

    /// The heights on the lattice.
    pub fn heights(&self, settings: &Settings) -> Result<Heightfield> {
        Ok(self.parts(settings.spacing)?.heights)
    }

    fn parts(&self, spacing: Option<f64>) -> Result<Parts> {
        match self {
            Source::Image(image) => image.resampled(spacing),
            Source::Lattice(_) if spacing.is_some() => Err(Failure::option(
                "option `spacing` is for images; a lattice has the spacing of its input",
            )),
            Source::Lattice(parts) => Ok(parts.clone()),
        }
    }
}

impl Image {
    fn resampled(&self, spacing: Option<f64>) -> Result<Parts> {
        let heights = self.heights.to_lattice(spacing)?;
        let lattice = *heights.lattice();
        let confidence = match &self.confidence {
            Some(image) => Some(image.sampled_on(&lattice)?.into_heights()),
            None => None,
        };
        let constraints = match &self.constraints {
            Some(image) => Some(image.constraints_on(&heights)?),
            None => None,
        };
        let occlusions = match &self.occlusions {
            Some(flags) => {
                let flags = self.heights.flags_on(&lattice, flags)?;
                Some(Occlusions::from_vertices(&lattice, &flags)?)
            }
            None => None,
        };
        Ok(Parts {
            heights,
            design: self.design,
            confidence,
            constraints,
            occlusions,
        })
    }
}

impl Parts {
    fn into_input(self, settings: &Settings) -> Result<Input> {
        // In the heights that were given: a design has none, and constraints are no measurements.
        let detected = match settings.occlusion_threshold.filter(|_| !self.design) {
            Some(threshold) => {
                let normalization = settings.normalization;
                Some(Occlusions::detect(&self.heights, threshold, normalization)?)
            }
            None => None,
        };
        let mut input = match (self.constraints, self.design) {
            (Some(constraints), true) => {
                let shape: Vec<u8> = (self.heights.heights().iter())
                    .map(|z| u8::from(!z.is_nan()))
                    .collect();
                Input::design(constraints, Some(&shape))?
            }
            (Some(constraints), false) => {
                Input::new(self.heights).with_constraints(constraints.into_heights())?
            }
            (None, _) => Input::new(self.heights),
        };
        if let Some(confidence) = self.confidence {
            input = input.with_confidence(confidence)?;
        }
        if let Some(occlusions) = union(self.occlusions, detected)? {
            input = input.with_occlusions(occlusions)?;
        }
        Ok(input)
    }
}

/// What is there at all.
fn given(value: &JsValue) -> Option<&JsValue> {
    Some(value).filter(|value| !value.is_undefined())
}

/// One for each height; NaN where there is none, so that it does not count in between.
fn confidence(value: &JsValue, (rows, cols): (usize, usize), heights: &[f64]) -> Result<Vec<f64>> {
    let mut confidence = values("confidence", rows, cols, value, None)?;
    check_confidence(&confidence, heights, cols)?;
    for (weight, height) in confidence.iter_mut().zip(heights) {
        if height.is_nan() {
            *weight = f64::NAN;
        }
    }
    Ok(confidence)
}

fn union(a: Option<Occlusions>, b: Option<Occlusions>) -> Result<Option<Occlusions>> {
    Ok(match (a, b) {
        (Some(a), Some(b)) => Some(a.union(&b)?),
        (a, b) => a.or(b),
    })
}

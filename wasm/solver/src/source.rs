//! Input of a solve as JavaScript gave it, kept so that it can be resampled and searched for occlusions again.

use serde::Deserialize;
use serde_wasm_bindgen::{from_value, preserve};
use wasm_bindgen::prelude::*;

use super::settings::Settings;
use developable::checks::check_confidence;
use developable::checks::try_filled;
use developable::{Bridging, HeightImage, Heightfield, Input, Occlusions};
use developable_wasm::Result;
use developable_wasm::fields::{ImageInput, LatticeInput, bytes, values};
use developable_wasm::scene::{check_spacing, is_image};

/// Optional fields of JavaScript's `HeightImage` and `Heightfield` objects besides the heights.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct ConditionsInput {
    #[serde(default, with = "preserve")]
    confidence: JsValue,
    #[serde(default, with = "preserve")]
    constraints: JsValue,
    #[serde(default, with = "preserve")]
    occlusions: JsValue,
    #[serde(default, with = "preserve")]
    broken_edges: JsValue,
    /// Camera that has measured the heights; its numbers do not matter here.
    #[serde(default, with = "preserve")]
    camera: JsValue,
}

pub enum Source {
    Image(ImageSource),
    Lattice(LatticeSource),
}

/// Input of a solve that is given at the pixels of an image.
pub struct ImageSource {
    /// Input heights at the pixels; for a design (a solve from constraints alone) 0 inside of its outline and NaN
    /// outside.
    heights: HeightImage,
    design: bool,
    mask: Option<Vec<u8>>,
    confidence: Option<HeightImage>,
    constraints: Option<HeightImage>,
    occlusions: Option<Vec<u8>>,
}

/// Input of a solve that is given at the vertices of a lattice.
#[derive(Clone)]
pub struct LatticeSource {
    /// Input heights at the vertices; for a design (a solve from constraints alone) 0 inside of its outline and NaN
    /// outside.
    heights: Heightfield,
    design: bool,
    mask: Option<Vec<u8>>,
    confidence: Option<Vec<f64>>,
    constraints: Option<Heightfield>,
    occlusions: Option<Occlusions>,
    is_measured: bool,
}

impl Source {
    pub fn new(value: JsValue) -> Result<Source> {
        match is_image(&value)? {
            true => Source::image(value),
            false => Source::lattice(value),
        }
    }

    fn image(value: JsValue) -> Result<Source> {
        let known: ConditionsInput = from_value(value.clone())?;
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
        Ok(Source::Image(ImageSource {
            heights,
            design,
            mask: bytes(&input.mask),
            confidence,
            constraints,
            occlusions: bytes(&known.occlusions),
        }))
    }

    pub fn lattice(value: JsValue) -> Result<Source> {
        let known: ConditionsInput = from_value(value.clone())?;
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
        Ok(Source::Lattice(LatticeSource {
            heights,
            design,
            mask: bytes(&input.mask),
            confidence,
            constraints,
            occlusions: union(vertices, edges)?,
            is_measured: given(&known.camera).is_some(),
        }))
    }

    /// The height image of the input, if it is given as an image.
    pub fn pixels(&self) -> Option<&HeightImage> {
        match self {
            Source::Image(image) => Some(&image.heights),
            Source::Lattice(_) => None,
        }
    }

    /// The measured heights of the input, if it is given as an image of them.
    pub fn measured_pixels(&self) -> Option<&HeightImage> {
        match self {
            Source::Image(image) if !image.design => Some(&image.heights),
            _ => None,
        }
    }

    /// Makes the input of a solve, and the image that its surface is resampled to; no image for an input on a lattice.
    pub fn input(&self, settings: &Settings) -> Result<(Input, Option<HeightImage>)> {
        match self {
            Source::Image(image) => {
                let (input, pixels) = image.input(settings)?;
                Ok((input, Some(pixels)))
            }
            Source::Lattice(parts) => {
                check_spacing(settings.spacing, false)?;
                Ok((parts.clone().into_input(settings)?, None))
            }
        }
    }

    /// Returns the input heights on the lattice, resampled from an image if necessary, without bridged holes.
    pub fn heights(&self, settings: &Settings) -> Result<Heightfield> {
        match self {
            Source::Image(image) => Ok(image.heights.to_lattice(settings.spacing)?),
            Source::Lattice(parts) => {
                check_spacing(settings.spacing, false)?;
                Ok(parts.heights.clone())
            }
        }
    }
}

impl ImageSource {
    fn input(&self, settings: &Settings) -> Result<(Input, HeightImage)> {
        let bridging = match self.design {
            true => Bridging::Off,
            false => settings.bridging,
        };
        // Faults of the sensor are found where λ is, and stay where the caller says what is to be trusted.
        let is_repaired = settings.options.chooses_lambda()
            && bridging != Bridging::Off
            && self.confidence.is_none()
            && self.constraints.is_none();
        let repaired = is_repaired.then(|| self.heights.repaired()).transpose()?;
        let bridged = repaired.as_ref().unwrap_or(&self.heights).bridged_where(
            bridging,
            self.confidence.as_ref(),
            self.mask.as_deref(),
            self.occlusions.as_deref(),
        )?;
        let input = Input::from_bridged(&bridged, settings.spacing)?;
        let lattice = *input.field().lattice();
        let constraints = match &self.constraints {
            Some(image) => Some(image.constraints_on(input.field())?),
            None => None,
        };
        let occlusions = match &self.occlusions {
            Some(flags) => {
                let flags = self.heights.flags_on(&lattice, flags)?;
                Some(Occlusions::from_vertices(&lattice, &flags)?)
            }
            None => None,
        };
        let input = with_known(input, self.design, constraints, occlusions, settings)?;
        Ok((input, bridged.into_image()))
    }
}

impl LatticeSource {
    fn into_input(self, settings: &Settings) -> Result<Input> {
        let mut input = Input::new(self.heights).with_bridging(settings.bridging)?;
        if self.is_measured {
            input = input.measured_by_camera();
        }
        if let Some(mask) = self.mask {
            input = input.masked(&mask)?;
        }
        if let Some(confidence) = self.confidence {
            input = input.with_confidence(confidence)?;
        }
        with_known(
            input,
            self.design,
            self.constraints,
            self.occlusions,
            settings,
        )
    }
}

/// Adds to an input the constraints and occlusions that are given, and the occlusions that are detected if a threshold
/// is set; makes it a design if `design` is true.
fn with_known(
    mut input: Input,
    design: bool,
    constraints: Option<Heightfield>,
    occlusions: Option<Occlusions>,
    settings: &Settings,
) -> Result<Input> {
    // Occlusions are detected in measured heights only: a design has none, and constraints are no measurements.
    let detected = match settings.occlusion_threshold.filter(|_| !design) {
        Some(threshold) => {
            let normalization = settings.normalization;
            Some(Occlusions::detect(input.field(), threshold, normalization)?)
        }
        None => None,
    };
    input = match (constraints, design) {
        (Some(constraints), true) => {
            let heights = input.field().heights().iter();
            let shape: Vec<u8> = heights.map(|z| u8::from(!z.is_nan())).collect();
            Input::design(constraints, Some(&shape))?
        }
        (Some(constraints), false) => input.with_constraints(constraints.into_heights())?,
        (None, _) => input,
    };
    match union(occlusions, detected)? {
        Some(occlusions) => Ok(input.with_occlusions(occlusions)?),
        None => Ok(input),
    }
}

/// Returns the value, or `None` if it is `undefined` in JavaScript.
fn given(value: &JsValue) -> Option<&JsValue> {
    Some(value).filter(|value| !value.is_undefined())
}

/// Reads the confidence of each height; NaN where there is no height, so that interpolation ignores it.
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

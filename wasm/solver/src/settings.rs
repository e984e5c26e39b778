//! What may be chosen about a solve, and about how it is resampled.

use serde::Deserialize;
use serde_wasm_bindgen::preserve;
use wasm_bindgen::prelude::*;

use developable::checks::positive;
use developable::{Bridging, Normalization, Options};
use developable_wasm::Result;
use developable_wasm::options::{Given, option};

/// `SolverOptions` of the types.
#[derive(Clone, Copy, Default)]
pub struct Settings {
    pub options: Options,
    /// As in the options: what occlusions are searched for in.
    pub normalization: Normalization,
    pub spacing: Option<f64>,
    pub occlusion_threshold: Option<f64>,
    pub bridging: Bridging,
}

/// Those of the options that are about the input.
#[derive(Default, Deserialize)]
#[serde(default, rename_all = "camelCase")]
struct InputOptions {
    paper: bool,
    normalize: Normalization,
    spacing: Option<f64>,
    occlusion_threshold: Option<f64>,
    #[serde(with = "preserve")]
    bridge: JsValue,
}

impl Settings {
    pub fn new(options: &JsValue) -> Result<Settings> {
        let mut given = Given::new(options)?;
        let (options, input): (Options, InputOptions) = (given.read()?, given.read()?);
        given.finish()?;
        Ok(Settings {
            options: match input.paper {
                true => options.or_paper(),
                false => options,
            },
            normalization: input.normalize,
            spacing: input.spacing,
            occlusion_threshold: input.occlusion_threshold,
            bridging: bridging(input.bridge)?,
        })
    }

    /// Whether they are right, as far as that does not depend on the input.
    fn check(&self) -> Result<()> {
        self.options.validate()?;
        self.bridging.width()?;
        if let Some(spacing) = self.spacing {
            positive("spacing", spacing)?;
        }
        if let Some(threshold) = self.occlusion_threshold {
            positive("occlusion_threshold", threshold)?;
        }
        Ok(())
    }

    /// Whether what is solved stays the same with these in the place of others.
    pub fn leave_input(&self, other: &Settings) -> bool {
        self.spacing == other.spacing
            && self.occlusion_threshold == other.occlusion_threshold
            && self.bridging == other.bridging
            && (self.occlusion_threshold.is_none() || self.normalization == other.normalization)
    }
}

/// Refuses options that no solve would take: before arrays are handed over to one.
#[wasm_bindgen(js_name = checkOptions)]
pub fn check_options(options: JsValue) -> Result<()> {
    Settings::new(&options)?.check()
}

/// A width; `true` for the default one, `false` for none.
fn bridging(value: JsValue) -> Result<Bridging> {
    if value.is_undefined() {
        return Ok(Bridging::default());
    }
    let requirement = "must be a width from 1 to 16 vertices or pixels, or none";
    Ok(match value.as_bool() {
        Some(true) => Bridging::default(),
        Some(false) => Bridging::Off,
        None => Bridging::UpTo(option("bridge", value, requirement)?),
    })
}

//! Options of a solve, and of resampling its input, read from JavaScript.

use wasm_bindgen::prelude::*;

use developable::checks::positive;
use developable::{Bridging, Normalization, Options};
use developable_wasm::Result;
use developable_wasm::options::{Given, option};

/// Options of a solve and of resampling its input, read from JavaScript's `SolverOptions` object.
#[derive(Clone, Copy, Default)]
pub struct Settings {
    pub options: Options,
    /// Normalisation of the coordinates to the unit square, in which λ and the threshold of occlusions are stated.
    pub normalization: Normalization,
    pub spacing: Option<f64>,
    pub occlusion_threshold: Option<f64>,
    pub bridging: Bridging,
}

impl Settings {
    pub fn new(options: &JsValue) -> Result<Settings> {
        let mut given = Given::new(options)?;
        let options: Options = given.read()?;
        let settings = Settings {
            options: match given.flag("paper") {
                Some(true) => options.or_paper(),
                _ => options,
            },
            normalization: (given.flag("normalize"))
                .map_or_else(Normalization::default, Normalization::from),
            spacing: given.number("spacing"),
            occlusion_threshold: given.number("occlusionThreshold"),
            bridging: bridging(given.value("bridge"))?,
        };
        given.finish()?;
        Ok(settings)
    }

    /// Returns an error if the value of an option is out of its range, as far as that does not depend on the input.
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

    /// Whether the resampled input of the solve stays unchanged if these options replace `other`.
    pub fn leave_input(&self, other: &Settings) -> bool {
        self.spacing == other.spacing
            && self.occlusion_threshold == other.occlusion_threshold
            && self.bridging == other.bridging
            && (self.occlusion_threshold.is_none() || self.normalization == other.normalization)
    }
}

/// Returns an error for options that every solve would refuse; called before arrays are transferred to the worker.
#[wasm_bindgen(js_name = checkOptions)]
pub fn check_options(options: JsValue) -> Result<()> {
    Settings::new(&options)?.check()
}

/// Reads the option `bridge`: the maximum width of holes that are bridged, `true` for the default width, `false` for
/// none.
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

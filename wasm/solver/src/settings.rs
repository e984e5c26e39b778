//! Options of a solve, and of resampling its input, read from JavaScript.

use serde::Deserialize;
use wasm_bindgen::prelude::*;

use developable::checks::positive;
use developable::{Bridging, Normalization, Options};
use developable_wasm::Result;
use developable_wasm::options::OptionReader;

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

/// Options of a solve besides those of the library's [`Options`].
#[derive(Default, Deserialize)]
#[serde(default, rename_all = "camelCase")]
struct InputOptions {
    paper: bool,
    normalize: Normalization,
    spacing: Option<f64>,
    occlusion_threshold: Option<f64>,
    bridge: Bridge,
}

/// Whether holes are bridged, or the maximum width of those that are.
#[derive(Deserialize)]
#[serde(
    untagged,
    expecting = "expected a width from 1 to 16 vertices or pixels, or none"
)]
enum Bridge {
    Wanted(bool),
    Width(usize),
}

impl Default for Bridge {
    fn default() -> Self {
        Bridge::Wanted(true)
    }
}

impl Settings {
    pub fn new(options: &JsValue) -> Result<Settings> {
        let mut reader = OptionReader::new(options)?;
        let options: Options = reader.read()?;
        let input: InputOptions = reader.read()?;
        reader.finish()?;
        Ok(Settings {
            options: match input.paper {
                true => options.or_paper(),
                false => options,
            },
            normalization: input.normalize,
            spacing: input.spacing,
            occlusion_threshold: input.occlusion_threshold,
            bridging: match input.bridge {
                Bridge::Wanted(true) => Bridging::default(),
                Bridge::Wanted(false) => Bridging::Off,
                Bridge::Width(width) => Bridging::UpTo(width),
            },
        })
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

//! What may be chosen about a solve, and about how it is resampled.

use wasm_bindgen::prelude::*;

use super::Result;
use super::options::{entries, option, unknown};
use crate::{Energy, Lambda, Normalization, Options, Schedule};

/// `SolverOptions` of `types.d.ts`; the last two are none of the solver's.
#[derive(Clone, Copy)]
pub(super) struct Settings {
    pub(super) options: Options,
    pub(super) spacing: Option<f64>,
    pub(super) occlusion_threshold: Option<f64>,
}

impl Settings {
    pub(super) fn new(options: &JsValue) -> Result<Settings> {
        let mut out = Options::default();
        let mut spacing = None;
        let mut occlusion_threshold = None;
        for (name, value) in entries(options)? {
            match name.as_str() {
                "lambda" => {
                    let lambda: Lambda = option(
                        "lambda",
                        value,
                        "must be small, medium, big or a number above zero",
                    )?;
                    out = out.lambda(lambda);
                }
                "schedule" => {
                    let schedule: Schedule = option("schedule", value, "must be default or paper")?;
                    out = out.schedule(schedule);
                }
                "gap" => out = out.gap(number("gap", value)?),
                "maxIterations" => {
                    let most = option("maxIterations", value, "must be a whole number")?;
                    out = out.max_iterations(most);
                }
                "normalize" => out = out.normalization(normalization(value)?),
                "energy" => {
                    let energy: Energy = option(
                        "energy",
                        value,
                        "must be nuclear, frobenius, squaredNuclear, secondFormOfInput or \
                         secondForm",
                    )?;
                    out = out.energy(energy);
                }
                "reweighting" => {
                    let passes = option("reweighting", value, "must be a whole number")?;
                    out = out.reweighting(passes);
                }
                "tieBreak" => out = out.tie_break(number("tieBreak", value)?),
                "spacing" => spacing = Some(number("spacing", value)?),
                "occlusionThreshold" => {
                    occlusion_threshold = Some(number("occlusionThreshold", value)?);
                }
                _ => {
                    return Err(unknown(
                        &name,
                        "lambda, schedule, gap, maxIterations, normalize, energy, reweighting, \
                         tieBreak, spacing and occlusionThreshold",
                    ));
                }
            }
        }
        Ok(Settings {
            options: out,
            spacing,
            occlusion_threshold,
        })
    }

    /// `OcclusionOptions` of `types.d.ts`.
    pub(super) fn of_detection(options: &JsValue) -> Result<Settings> {
        let mut out = Settings::new(&JsValue::UNDEFINED)?;
        for (name, value) in entries(options)? {
            match name.as_str() {
                "threshold" => out.occlusion_threshold = Some(number("threshold", value)?),
                "spacing" => out.spacing = Some(number("spacing", value)?),
                "normalize" => out.options = out.options.normalization(normalization(value)?),
                _ => return Err(unknown(&name, "threshold, spacing and normalize")),
            }
        }
        Ok(out)
    }

    /// Whether what is solved stays the same with these in the place of others.
    pub(super) fn leave_input(&self, other: &Settings) -> bool {
        self.spacing == other.spacing
            && self.occlusion_threshold == other.occlusion_threshold
            && (self.occlusion_threshold.is_none()
                || self.options.normalization == other.options.normalization)
    }
}

fn number(name: &'static str, value: JsValue) -> Result<f64> {
    option(name, value, "must be a number")
}

fn normalization(value: JsValue) -> Result<Normalization> {
    Ok(match option("normalize", value, "must be true or false")? {
        true => Normalization::UnitSquare,
        false => Normalization::Off,
    })
}

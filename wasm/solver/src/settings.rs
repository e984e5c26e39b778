//! What may be chosen about a solve, and about how it is resampled.

use wasm_bindgen::prelude::*;

use developable::checks::positive;
use developable::{Bridging, Energy, Normalization, Options, Schedule};
use developable_wasm::Result;
use developable_wasm::options::{entries, lambda, option, unknown};

/// `SolverOptions` of `types.d.ts`.
#[derive(Clone, Copy)]
pub struct Settings {
    pub options: Options,
    /// As in the options: what occlusions are searched for in.
    pub normalization: Normalization,
    pub spacing: Option<f64>,
    pub occlusion_threshold: Option<f64>,
    pub bridging: Bridging,
}

impl Settings {
    pub fn new(options: &JsValue) -> Result<Settings> {
        let entries = entries(options)?;
        let mut out = match paper(&entries)? {
            true => Options::paper(),
            false => Options::default(),
        };
        let mut scale = Normalization::default();
        let mut spacing = None;
        let mut occlusion_threshold = None;
        let mut bridge = Bridging::default();
        for (name, value) in entries {
            match name.as_str() {
                "paper" => {}
                "lambda" => out = out.lambda(lambda(value)?),
                "schedule" => {
                    let name: String = option("schedule", value, "must be default or paper")?;
                    out = out.schedule(name.parse::<Schedule>()?);
                }
                "gap" => out = out.gap(number("gap", value)?),
                "maxIterations" => {
                    let most = option("maxIterations", value, "must be a whole number")?;
                    out = out.max_iterations(most);
                }
                "normalize" => scale = normalization(value)?,
                "energy" => {
                    let name: String = option("energy", value, "must be the name of an energy")?;
                    out = out.energy(name.parse::<Energy>()?);
                }
                "reweighting" => {
                    let passes = option("reweighting", value, "must be a whole number")?;
                    out = out.reweighting(passes);
                }
                "bendRadius" => out = out.bend_radius(number("bendRadius", value)?),
                "flatness" => out = out.flatness(number("flatness", value)?),
                "creaseRadius" => out = out.crease_radius(number("creaseRadius", value)?),
                "creasePasses" => {
                    let passes = option("creasePasses", value, "must be a whole number")?;
                    out = out.crease_passes(passes);
                }
                "tieBreak" => out = out.tie_break(number("tieBreak", value)?),
                "spacing" => spacing = Some(number("spacing", value)?),
                "occlusionThreshold" => {
                    occlusion_threshold = Some(number("occlusionThreshold", value)?);
                }
                "bridge" => bridge = bridging(value)?,
                _ => {
                    return Err(unknown(
                        &name,
                        "paper, lambda, schedule, gap, maxIterations, normalize, energy, reweighting, \
                         bendRadius, flatness, creaseRadius, creasePasses, tieBreak, spacing, occlusionThreshold and bridge",
                    ));
                }
            }
        }
        Ok(Settings {
            options: out.normalization(scale),
            normalization: scale,
            spacing,
            occlusion_threshold,
            bridging: bridge,
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

    /// `OcclusionOptions` of `types.d.ts`.
    pub fn of_detection(options: &JsValue) -> Result<Settings> {
        let mut out = Settings::new(&JsValue::UNDEFINED)?;
        for (name, value) in entries(options)? {
            match name.as_str() {
                "threshold" => out.occlusion_threshold = Some(number("threshold", value)?),
                "spacing" => out.spacing = Some(number("spacing", value)?),
                "normalize" => out.normalization = normalization(value)?,
                _ => return Err(unknown(&name, "threshold, spacing and normalize")),
            }
        }
        Ok(out)
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

/// Whether the options start from the paper's setting, which the others then change.
fn paper(entries: &[(String, JsValue)]) -> Result<bool> {
    match entries.iter().find(|(name, _)| name == "paper") {
        Some((_, value)) => option("paper", value.clone(), "must be true or false"),
        None => Ok(false),
    }
}

fn number(name: &'static str, value: JsValue) -> Result<f64> {
    option(name, value, "must be a number")
}

/// A width; `true` for the default one, `false` for none.
fn bridging(value: JsValue) -> Result<Bridging> {
    let requirement = "must be a width from 1 to 16 vertices or pixels, or none";
    Ok(match value.as_bool() {
        Some(true) => Bridging::default(),
        Some(false) => Bridging::Off,
        None => Bridging::UpTo(option("bridge", value, requirement)?),
    })
}

fn normalization(value: JsValue) -> Result<Normalization> {
    Ok(match option("normalize", value, "must be true or false")? {
        true => Normalization::UnitSquare,
        false => Normalization::Off,
    })
}

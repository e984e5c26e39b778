//! The library itself.

use std::error::Error;

use developable::{Bridging, Heightfield, Input, Normalization, Options, Report, fit};

use crate::task::{Outcome, Schedule, Settings};

pub fn options(settings: &Settings) -> Options {
    let options = Options::paper()
        .lambda(settings.lambda)
        .max_iterations(settings.max_iterations)
        .normalization(if settings.normalize {
            Normalization::UnitSquare
        } else {
            Normalization::Off
        });
    match settings.schedule {
        Schedule::Default => options.gap(settings.gap),
        // It stops on its residuals.
        Schedule::Paper => options.schedule(developable::Schedule::Paper),
    }
}

/// The input's own vertices: other programs fill no holes.
pub fn input(field: &Heightfield) -> developable::Result<Input> {
    Input::new(field.clone()).with_bridging(Bridging::Off)
}

pub fn solve(field: &Heightfield, settings: &Settings) -> Result<Outcome, Box<dyn Error>> {
    outcome(fit(input(field)?, &options(settings))?.report())
}

pub fn outcome(report: &Report) -> Result<Outcome, Box<dyn Error>> {
    Ok(Outcome {
        vertices: report.interior + report.boundary + report.omitted,
        seconds: report.seconds.total,
        objective: report.objective,
        dual_bound: Some(report.dual_bound),
        iterations: report.iterations,
        finest: report.levels.last().map_or(0, |level| level.iterations),
        stop: serde_json::to_value(report.stop_reason)?
            .as_str()
            .unwrap_or_default()
            .to_owned(),
    })
}

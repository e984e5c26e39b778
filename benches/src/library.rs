//! The library itself.

use std::error::Error;

use developable::{Heightfield, Normalization, Options, Report, fit};

use crate::task::{Outcome, Schedule, Settings};

pub fn options(settings: &Settings) -> Options {
    Options::paper()
        .lambda(settings.lambda)
        .schedule(match settings.schedule {
            Schedule::Default => developable::Schedule::Default,
            Schedule::Paper => developable::Schedule::Paper,
        })
        .gap(settings.gap)
        .max_iterations(settings.max_iterations)
        .normalization(if settings.normalize {
            Normalization::UnitSquare
        } else {
            Normalization::Off
        })
}

pub fn solve(field: &Heightfield, settings: &Settings) -> Result<Outcome, Box<dyn Error>> {
    outcome(fit(field, &options(settings))?.report())
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

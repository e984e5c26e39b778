//! Heights that are trusted enough for noise to be measured from them.

use crate::fit::input::Input;
use crate::heights::bridging::BRIDGE_CONFIDENCE;

/// Largest confidence of a height that is not constrained.
pub(super) fn largest_trust(input: &Input) -> f64 {
    match input.confidence.is_empty() {
        true => 1.0,
        false => (0..input.field.lattice().len())
            .filter(|v| !input.is_constrained(*v) && !input.field.heights()[*v].is_nan())
            .map(|v| input.weight(v))
            .fold(0.0, f64::max),
    }
}

/// Least confidence of a height that noise is measured from: bridged vertices, but for those beside a height, have less.
pub(super) fn least_trust(input: &Input) -> f64 {
    BRIDGE_CONFIDENCE * largest_trust(input)
}

/// Height of a vertex; NaN where its confidence is below `least` or 0, or the vertex is constrained.
pub(super) fn sample(input: &Input, vertex: usize, least: f64) -> f64 {
    let weight = input.weight(vertex);
    if input.is_constrained(vertex) || weight < least || weight == 0.0 {
        return f64::NAN;
    }
    input.field.heights()[vertex]
}

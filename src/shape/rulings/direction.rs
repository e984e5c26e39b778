//! Computes the direction in which a surface bends least, and the confidence of that direction.

use crate::math::sym2::Sym2;

/// Number of passes in which the squared Hessian `H²` at each vertex is averaged with those of its neighbours. More
/// passes would mix ruling directions across narrow patches.
pub(super) const SMOOTHING_PASSES: usize = 3;

/// Bend angle, in radians from one vertex to the next, at which the confidence of a ruling is one half: limits how
/// plane a surface with rulings may be. Not tuned by measurements.
const HALF_CONFIDENCE_BEND: f64 = 5e-4;

/// Computes the confidence of a ruling's direction, from 0 to 1, from the eigenvalues of `Σ H²`, the sum of squared
/// Hessians around a vertex, the larger eigenvalue first.
pub(super) fn direction_confidence(squares: [f64; 2], spacing: f64) -> f64 {
    let [large, small] = squares.map(|v| v.max(0.0).sqrt());
    let bend = large * spacing;
    let share = if large > 0.0 {
        1.0 - small / large
    } else {
        0.0
    };
    share * bend / (bend + HALF_CONFIDENCE_BEND)
}

/// Computes the unit eigenvector of the smaller eigenvalue of a symmetric 2×2 matrix, with `x ≥ 0`.
pub(super) fn minor_axis(matrix: Sym2) -> [f64; 2] {
    let angle = 0.5 * matrix.off.atan2(matrix.diff) + std::f64::consts::FRAC_PI_2;
    let (sin, cos) = angle.sin_cos();
    if cos < 0.0 { [-cos, -sin] } else { [cos, sin] }
}

//! The direction in which a surface bends least, and how far it is to be trusted.

use crate::math::sym2::Sym2;

/// Passes of averaging `H²` with the neighbours'.
pub(super) const PASSES: usize = 3;

/// Angle, in radians from one vertex to the next, by which a surface bends that is as near to a
/// plane as to be trusted by half.
const FAINT: f64 = 5e-4;

/// How far a direction is to be trusted, by the eigenvalues of `Σ H²`, the larger one first.
pub(super) fn trusted(squares: [f64; 2], spacing: f64) -> f64 {
    let [large, small] = squares.map(|v| v.max(0.0).sqrt());
    let bend = large * spacing;
    let share = if large > 0.0 {
        1.0 - small / large
    } else {
        0.0
    };
    share * bend / (bend + FAINT)
}

/// The eigenvector of the smaller eigenvalue.
pub(super) fn least(matrix: Sym2) -> [f64; 2] {
    let angle = 0.5 * matrix.off.atan2(matrix.diff) + std::f64::consts::FRAC_PI_2;
    let (sin, cos) = angle.sin_cos();
    if cos < 0.0 { [-cos, -sin] } else { [cos, sin] }
}

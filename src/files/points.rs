//! Lengths as PDF has them.

/// Points in a millimetre.
pub(super) const POINTS: f64 = 72.0 / 25.4;

/// Largest side of a page, in points.
pub(super) const LARGEST: f64 = 14_400.0;

pub(super) fn points(millimetres: f64) -> f32 {
    (millimetres * POINTS) as f32
}

//! Lengths in points, PDF's unit of length.

/// Number of points, PDF's unit of length, in a millimetre.
pub(super) const POINTS_PER_MM: f64 = 72.0 / 25.4;

/// Maximum length of a PDF page's side, in points (72 to an inch).
pub(super) const MAX_PAGE_SIDE_POINTS: f64 = 14_400.0;

pub(super) fn points(millimetres: f64) -> f32 {
    (millimetres * POINTS_PER_MM) as f32
}

//! Lengths in PDF's unit, the point.

/// Number of PDF's points in a millimetre.
pub(super) const POINTS_PER_MM: f64 = 72.0 / 25.4;

/// Maximum length of a page's side in PDF, in points.
pub(super) const MAX_PAGE_SIDE_POINTS: f64 = 14_400.0;

pub(super) fn points(millimetres: f64) -> f32 {
    (millimetres * POINTS_PER_MM) as f32
}

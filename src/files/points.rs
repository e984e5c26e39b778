//! Lengths in points, PDF's unit of length.

use super::failure::unsupported;
use crate::error::Result;

/// Number of points, of which 72 are in an inch, in a millimetre.
const POINTS_PER_MM: f64 = 72.0 / 25.4;

/// Maximum length of a PDF page's side, in points (72 to an inch), which is the format's limit.
const MAX_PAGE_SIDE_POINTS: f64 = 14_400.0;

/// Minimum length of a PDF page's side, in points: below it programs that show PDF may fail.
const MIN_PAGE_SIDE_POINTS: f64 = 2.0 * POINTS_PER_MM;

pub(super) fn points(millimetres: f64) -> f32 {
    (millimetres * POINTS_PER_MM) as f32
}

/// Checks that a page's sides, in millimetres, are within the limits of PDF.
pub(super) fn check_page(sides: [f64; 2]) -> Result<()> {
    let limits = MIN_PAGE_SIDE_POINTS..=MAX_PAGE_SIDE_POINTS;
    if sides
        .iter()
        .all(|side| limits.contains(&(side * POINTS_PER_MM)))
    {
        return Ok(());
    }
    let [width, height] = sides;
    let reason = format!(
        "a page of {width:.3} × {height:.3} mm cannot be; pages have sides from 2 mm to 5.08 metres. Choose a smaller scale or a \
         paper, or is the unit of the lengths another one?"
    );
    Err(unsupported("PDF", reason))
}

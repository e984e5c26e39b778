//! Prior knowledge about a page and its camera, as residuals of the least-squares fit.

use super::cylinder::Cylinder;

/// Prior knowledge about a page and its camera: expected values with their standard deviations.
#[derive(Debug, Clone, Copy)]
pub(super) struct Prior {
    /// Expected logarithm of the focal length in pixels, and its standard deviation.
    pub focal: Option<[f64; 2]>,
    /// Expected logarithm of the page's length along its rulings over its width, and its standard deviation.
    pub ratio: Option<[f64; 2]>,
    /// Standard deviation of a traced point from the page's edge, in pixels.
    pub accuracy: f64,
}

/// Prior standard deviation of the first-degree Legendre coefficient of the curve's direction, in radians; that of
/// degree `k` is `1/k` of it. Keeps curves smooth between traced points.
const CURVE_COEFFICIENT_DEVIATION: f64 = 1.0;

/// Prior standard deviation of the angle by which print is rotated on its page, in radians (half a degree).
const PRINT_SKEW_DEVIATION: f64 = 0.0087;

/// Residuals of the prior knowledge at a cylinder, in standard deviations, each with its derivatives as pairs of a
/// parameter's number and the derivative by it.
pub(super) fn prior_rows(cylinder: &Cylinder, prior: &Prior) -> Vec<(f64, Vec<(usize, f64)>)> {
    let mut rows = Vec::new();
    if let Some([value, deviation]) = prior.focal {
        rows.push((
            (cylinder.focal.ln() - value) / deviation,
            vec![(0, 1.0 / deviation)],
        ));
    }
    if let Some([value, deviation]) = prior.ratio {
        let mut at = 8 + cylinder.degree();
        // All pages of a spread are alike.
        for page in &cylinder.pages[1..] {
            rows.push((page.width.ln() / deviation, vec![(at, 1.0 / deviation)]));
            at += page.turns.len() + 1;
        }
        let off = (cylinder.length.ln() - value) / deviation;
        rows.push((off, vec![(7, 1.0 / deviation)]));
    }
    let mut at = 8;
    for (number, page) in cylinder.pages.iter().enumerate() {
        // All but the first have a width and a mean.
        at += if number > 0 { 2 } else { 0 };
        for (k, turn) in page.turns.iter().enumerate().skip(1) {
            let scale = k as f64 / CURVE_COEFFICIENT_DEVIATION;
            rows.push((turn * scale, vec![(at, scale)]));
            at += 1;
        }
    }
    for skew in &cylinder.skews {
        rows.push((
            skew / PRINT_SKEW_DEVIATION,
            vec![(at, 1.0 / PRINT_SKEW_DEVIATION)],
        ));
        at += 1;
    }
    rows
}

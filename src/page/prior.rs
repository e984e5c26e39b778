//! What is known of a page besides its traces.

use super::cylinder::Cylinder;

/// What is known besides the traces, each as a value and its standard deviation.
#[derive(Debug, Clone, Copy)]
pub(super) struct Prior {
    /// Logarithm of the focal length.
    pub focal: Option<[f64; 2]>,
    /// Logarithm of length over width.
    pub ratio: Option<[f64; 2]>,
    /// Standard deviation of a traced point, in pixels.
    pub accuracy: f64,
}

/// Standard deviation of a coefficient of the curve's direction, over its degree, in radians.
const TURN: f64 = 1.0;

/// That of the angle by which print is turned on its page.
const SKEW: f64 = 0.0087;

/// What is known besides the traces: how far off it is, over its standard deviation, and the
/// derivatives of that.
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
            let scale = k as f64 / TURN;
            rows.push((turn * scale, vec![(at, scale)]));
            at += 1;
        }
    }
    for skew in &cylinder.skews {
        rows.push((skew / SKEW, vec![(at, 1.0 / SKEW)]));
        at += 1;
    }
    rows
}

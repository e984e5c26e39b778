//! Noise of an image's pixels, measured before they are sampled on a lattice, which smooths it; and heights that are rounded
//! to multiples of a step.

use rustc_hash::FxHashSet;

use super::heightfield::HeightImage;
use crate::math::statistics::{MAD_TO_SIGMA, median};

/// Largest share of different heights among all at which steps of quantisation are looked for.
const MAX_DISTINCT_HEIGHTS: f64 = 0.25;

/// Minimum number of different heights at which their common step is one of quantisation. With fewer the steps are the
/// shape: terraces, or a block on a table.
const MIN_QUANTISED_HEIGHTS: usize = 12;

/// Maximum relative deviation of a difference between heights from a multiple of the quantisation step.
const EQUAL_HEIGHT_TOLERANCE: f64 = 1e-3;

/// Finds the quantisation step of heights, of which NaN are missing: the smallest difference between two of them, if all
/// other differences are multiples of it. `None` if too few heights are equal or there is no such step.
pub(crate) fn quantisation_step(heights: &[f64]) -> Option<f64> {
    let finite = || heights.iter().copied().filter(|z| z.is_finite());
    let size = finite().fold(0.0f64, |size, z| size.max(z.abs()));
    let rounding = 16.0 * f64::EPSILON * size;
    let most = MAX_DISTINCT_HEIGHTS * finite().count() as f64;
    let mut distinct = FxHashSet::default();
    for z in finite() {
        if distinct.insert((z / rounding).round() as i64) && distinct.len() as f64 > most {
            return None;
        }
    }
    let mut distinct: Vec<i64> = distinct.into_iter().collect();
    distinct.sort_unstable();
    // Heights that are equal but for rounding can be in two neighbouring classes.
    distinct.dedup_by(|a, b| *a - *b <= 1);
    if distinct.len() < MIN_QUANTISED_HEIGHTS {
        return None;
    }
    let gaps = (distinct.windows(2)).map(|pair| (pair[1] - pair[0]) as f64 * rounding);
    let step = gaps.clone().fold(f64::INFINITY, f64::min);
    let multiple =
        |gap: f64| (gap / step - (gap / step).round()).abs() <= EQUAL_HEIGHT_TOLERANCE * gap / step;
    gaps.into_iter().all(multiple).then_some(step)
}

/// Noise of the pixels of an image.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct PixelNoise {
    /// Standard deviation of the noise that is independent from pixel to pixel, in the unit of the heights.
    pub sigma: f64,
    /// Side of a pixel, in the unit of lengths.
    pub pixel_size: f64,
    /// Step that the heights are rounded to, if they are.
    pub step: Option<f64>,
}

impl HeightImage {
    /// Measures the noise of the pixels by their second differences along rows and columns at once, which are 0 for every
    /// quadratic. The median over all pixels discards creases. σ is 0 where no pixel has eight neighbours. Linear cost.
    pub(crate) fn pixel_noise(&self) -> PixelNoise {
        let (width, values) = (self.width(), self.values());
        let across = |pixel: usize| values[pixel - 1] - 2.0 * values[pixel] + values[pixel + 1];
        let difference =
            |pixel: usize| across(pixel - width) - 2.0 * across(pixel) + across(pixel + width);
        let inner = (1..self.height().saturating_sub(1))
            .flat_map(|row| (1..width.saturating_sub(1)).map(move |col| row * width + col));
        let differences = inner.map(|pixel| difference(pixel).abs());
        let mut differences: Vec<f64> = differences.filter(|d| d.is_finite()).collect();
        // The squares of the nine coefficients sum up to 36.
        PixelNoise {
            sigma: MAD_TO_SIGMA * median(&mut differences).unwrap_or(0.0) / 6.0,
            pixel_size: self.pixel_size(),
            step: quantisation_step(values),
        }
    }
}

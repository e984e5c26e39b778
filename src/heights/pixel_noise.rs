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
    if rounding == 0.0 {
        return None;
    }
    // Heights that are equal but for rounding can be in two neighbouring classes.
    let (mut classes, mut distinct) = (FxHashSet::default(), Vec::new());
    for z in finite() {
        if classes.insert((z / rounding).round() as i64) {
            distinct.push(z);
            if distinct.len() as f64 > 2.0 * most {
                return None;
            }
        }
    }
    distinct.sort_unstable_by(f64::total_cmp);
    distinct.dedup_by(|a, b| *a - *b <= rounding);
    if distinct.len() < MIN_QUANTISED_HEIGHTS || distinct.len() as f64 > most {
        return None;
    }
    let gaps = distinct.windows(2).map(|pair| pair[1] - pair[0]);
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
    /// Whether the rows, and the columns, of the image had offsets, of which a part was taken out.
    pub offset_lines: [bool; 2],
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
            offset_lines: self.offset_lines(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// As many heights as are needed for steps to be looked for, each several times.
    fn repeated(values: impl Iterator<Item = f64> + Clone) -> Vec<f64> {
        (0..6).flat_map(|_| values.clone()).collect()
    }

    #[test]
    fn steps_are_found_as_they_are() {
        for step in [1.0, 16.0, 0.25] {
            let heights = repeated((500..900).map(|k| step * f64::from(k)));
            assert_eq!(quantisation_step(&heights), Some(step));
        }
        let tenths = repeated((0..40).map(|k| 0.1 * f64::from(k) - 2.0));
        let step = quantisation_step(&tenths).unwrap();
        assert!((step - 0.1).abs() < 1e-12, "{step}");
    }

    #[test]
    fn heights_without_steps_have_none() {
        assert_eq!(quantisation_step(&[]), None);
        assert_eq!(quantisation_step(&[f64::NAN; 40]), None);
        assert_eq!(quantisation_step(&[3.0; 40]), None);
        let tiny = repeated([-1e-310, 0.0, 1e-310, 2e-310].into_iter());
        assert_eq!(quantisation_step(&tiny), None);
        let uneven = repeated((0..40).map(|k| f64::from(k).sqrt()));
        assert_eq!(quantisation_step(&uneven), None);
        let different: Vec<f64> = (0..400).map(f64::from).collect();
        assert_eq!(quantisation_step(&different), None);
    }
}

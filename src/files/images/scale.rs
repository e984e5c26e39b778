//! The height of levels and the size of pixels, where a file does not say them.

use crate::files::Assumption;
use crate::files::assumption::rounded;

/// Relief that is assumed for heights of unknown scale, as a share of the image's longer side.
pub(super) const SUGGESTED_RELIEF_SHARE: f64 = 0.25;

/// Minimum relief of heights whose unit is likely that of pixels 1 wide, as a share of the longer side: less is a slab.
const MIN_LIKELY_RELIEF_SHARE: f64 = 0.01;

/// Maximum relief of heights whose unit is likely that of pixels 1 wide, as a share of the longer side: a slope of 76° all the
/// way across. More is a needle.
const MAX_LIKELY_RELIEF_SHARE: f64 = 4.0;

/// Maximum relief that needs no word, as a share of the longer side: a slope of 45° all the way across.
const MAX_USUAL_RELIEF_SHARE: f64 = 1.0;

/// Minimum share of the pixels with a number in measured data; fewer are the pins of a design.
const MIN_MEASURED_SHARE: f64 = 0.2;

/// Share of the heights that are left out at each end of their range, where outliers are.
const OUTLIER_SHARE: f64 = 0.02;

/// Maximum number of heights of which the relief is estimated.
const MAX_RELIEF_SAMPLES: usize = 100_000;

/// The assumption that a picture's levels have the suggested scale.
pub(super) fn assumed_levels() -> Assumption {
    let words = "from black to white is a quarter of the longer side";
    Assumption::new("heightScale", words, "heightScale")
}

/// Chooses the size of pixels in the unit of the heights, where the file does not say it and 1 needs a word: `heights` times
/// `scale` are the heights, `side` is the number of pixels along the longer side. `None` for heights that pixels 1 wide suit,
/// and for planes.
pub(super) fn assumed_pixel_size(
    heights: &[f64],
    scale: f64,
    side: f64,
) -> Option<(f64, Assumption)> {
    let relief = scale.abs() * relief(heights)?;
    let share = relief / side;
    let told =
        |size: f64, words: String| Some((size, Assumption::new("pixelSize", words, "pixelSize")));
    let short = rounded(relief, 2);
    let question = "(are these depths of a camera?)";
    if (MIN_LIKELY_RELIEF_SHARE..=MAX_LIKELY_RELIEF_SHARE).contains(&share) {
        let words = format!(
            "pixels are 1 wide, so that the relief of {short} over {side} pixels is steep {question}"
        );
        return (share > MAX_USUAL_RELIEF_SHARE)
            .then(|| told(1.0, words))
            .flatten();
    }
    let size = rounded(share / SUGGESTED_RELIEF_SHARE, 1);
    let kind = if share > 1.0 { "steep" } else { "flat" };
    told(
        size,
        format!(
            "pixels are {size} wide: were they 1 wide, the relief of {short} over {side} pixels would be too {kind} {question}"
        ),
    )
}

/// Whether the values that a file stores, NaN included, were measured, and are no pins of a design.
pub(super) fn are_measured(stored: &[f64]) -> bool {
    let known = stored.iter().filter(|value| !value.is_nan()).count();
    known as f64 >= MIN_MEASURED_SHARE * stored.len() as f64
}

/// Whether heights are a needle over an image of a given longer side.
#[cfg(feature = "images")]
pub(super) fn is_needle(heights: &[f64], side: f64) -> bool {
    relief(heights).is_some_and(|relief| relief > MAX_LIKELY_RELIEF_SHARE * side)
}

/// Difference between the highest and the lowest of the heights without outliers; `None` if it is 0 or there are none.
fn relief(heights: &[f64]) -> Option<f64> {
    let step = heights.len().div_ceil(MAX_RELIEF_SAMPLES).max(1);
    let sampled = heights.iter().step_by(step).copied();
    let mut known: Vec<f64> = sampled.filter(|height| height.is_finite()).collect();
    known.sort_by(f64::total_cmp);
    let last = known.len().checked_sub(1)? as f64;
    let low = known[(OUTLIER_SHARE * last).ceil() as usize];
    let high = known[((1.0 - OUTLIER_SHARE) * last) as usize];
    Some(high - low).filter(|relief| *relief > 0.0 && relief.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A ridge across an image of 60 × 40 pixels, this high.
    fn ridge(height: f64) -> Vec<f64> {
        (0..2400)
            .map(|i| height * (1.0 - f64::from((i % 60_i32 - 30).abs()) / 30.0))
            .collect()
    }

    fn assumed(height: f64) -> Option<(f64, String)> {
        assumed_pixel_size(&ridge(height), 1.0, 60.0).map(|(size, told)| (size, told.words))
    }

    #[test]
    fn pixels_are_one_wide_where_that_is_likely() {
        assert_eq!(assumed(15.0), None);
        assert_eq!(assumed(2.0), None);
        let (size, words) = assumed(120.0).unwrap();
        assert_eq!(size, 1.0);
        assert!(words.contains("is steep"), "{words}");
    }

    #[test]
    fn slabs_and_needles_get_pixels_by_which_the_relief_is_a_quarter() {
        // Heights from 0 to 1, as pictures of floats have them, and metres on pixels of tens of metres.
        for (height, word) in [(0.2, "flat"), (4000.0, "steep")] {
            let (size, words) = assumed(height).unwrap();
            let share = height / (60.0 * size);
            assert!((share / SUGGESTED_RELIEF_SHARE).ln().abs() < 0.5, "{share}");
            assert!(
                words.contains(word) && words.contains(&format!("{size} wide")),
                "{words}"
            );
        }
    }

    #[test]
    fn planes_outliers_and_designs_say_nothing_of_the_scale() {
        assert!(assumed(0.0).is_none());
        let mut spiky = ridge(15.0);
        spiky[7] = 1e7;
        assert!(assumed_pixel_size(&spiky, 1.0, 60.0).is_none());
        let mut few = vec![f64::NAN; 2400];
        (few[3], few[900]) = (0.0, 1e5);
        assert!(!are_measured(&few) && are_measured(&spiky));
    }
}

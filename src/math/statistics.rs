//! Medians, and the standard deviation that they estimate.

/// Ratio of the standard deviation of a normal distribution to the median of its absolute values.
pub(crate) const MAD_TO_SIGMA: f64 = 1.4826;

/// Median of numbers, the upper one of the two in the middle of an even number; `None` for an empty slice. Reorders the
/// slice; linear cost.
pub(crate) fn median(values: &mut [f64]) -> Option<f64> {
    if values.is_empty() {
        return None;
    }
    let middle = values.len() / 2;
    Some(*values.select_nth_unstable_by(middle, f64::total_cmp).1)
}

/// Weighted median of pairs of a value and its weight: the smallest value with at least half of the total weight at or
/// below it; `None` for an empty slice. Sorts the slice.
pub(crate) fn weighted_median(values: &mut [(f64, f64)]) -> Option<f64> {
    values.sort_by(|a, b| a.0.total_cmp(&b.0));
    let half = 0.5 * values.iter().map(|(_, weight)| weight).sum::<f64>();
    let mut sum = 0.0;
    let median = values.iter().find(|(_, weight)| {
        sum += weight;
        sum >= half
    });
    median.map(|(value, _)| *value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn medians_of_odd_even_and_no_numbers() {
        assert_eq!(median(&mut [3.0, 1.0, 2.0]), Some(2.0));
        assert_eq!(median(&mut [4.0, 3.0, 1.0, 2.0]), Some(3.0));
        assert_eq!(median(&mut []), None);
    }

    #[test]
    fn a_weighted_median_is_that_of_repeated_numbers() {
        let mut repeated = [1.0, 5.0, 5.0, 5.0, 2.0, 2.0, 7.0];
        let mut weighted = [(1.0, 1.0), (7.0, 1.0), (5.0, 3.0), (2.0, 2.0)];
        assert_eq!(weighted_median(&mut weighted), median(&mut repeated));
        assert_eq!(weighted_median(&mut []), None);
    }

    #[test]
    fn the_median_of_normal_noise_tells_its_standard_deviation() {
        // Sums of twelve uniform numbers are normal to a few per cent.
        let mut random = oorandom::Rand64::new(7);
        let mut normal = || (0..12).map(|_| random.rand_float()).sum::<f64>() - 6.0;
        let mut values: Vec<f64> = (0..20_000).map(|_| (3.0 * normal()).abs()).collect();
        let sigma = MAD_TO_SIGMA * median(&mut values).unwrap();
        assert!((sigma - 3.0).abs() < 0.1, "{sigma}");
    }
}

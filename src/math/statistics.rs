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
    fn the_median_of_normal_noise_tells_its_standard_deviation() {
        // Sums of twelve uniform numbers are normal to a few per cent.
        let mut random = oorandom::Rand64::new(7);
        let mut normal = || (0..12).map(|_| random.rand_float()).sum::<f64>() - 6.0;
        let mut values: Vec<f64> = (0..20_000).map(|_| (3.0 * normal()).abs()).collect();
        let sigma = MAD_TO_SIGMA * median(&mut values).unwrap();
        assert!((sigma - 3.0).abs() < 0.1, "{sigma}");
    }
}

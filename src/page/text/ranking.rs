//! The order of values.

/// The numbers of values from the smallest to the largest. One sort for all, for each kind of sort is some
/// kilobytes of wasm.
pub(super) fn ranked(values: &[f64]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.sort_by(|i, j| values[*i].total_cmp(&values[*j]));
    order
}

//! Ranking of values: their indices in ascending order.

/// Returns the indices of the values in ascending order of the values. One function for all callers, because each kind
/// of sort takes some kilobytes of wasm.
pub(in crate::page) fn ranked(values: &[f64]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.sort_by(|i, j| values[*i].total_cmp(&values[*j]));
    order
}

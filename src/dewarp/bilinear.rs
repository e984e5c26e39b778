//! Bilinear interpolation between the nodes of a grid.

use super::raster::ROUNDING_TOLERANCE;

/// Finds the nodes around `[x, y]`, in nodes from the first one, of a grid of `columns` by `rows` nodes, row by row, with their
/// weights in a bilinear interpolation; None outside of the grid.
fn nodes_around([x, y]: [f64; 2], [columns, rows]: [usize; 2]) -> Option<[(usize, f64); 4]> {
    let [right, bottom] = [columns, rows].map(|n| (n - 1) as f64);
    if !((-ROUNDING_TOLERANCE..=right + ROUNDING_TOLERANCE).contains(&x)
        && (-ROUNDING_TOLERANCE..=bottom + ROUNDING_TOLERANCE).contains(&y))
    {
        return None;
    }
    let cell = |v: f64, n: usize| (v.max(0.0) as usize).min(n.saturating_sub(2));
    let (col, row) = (cell(x, columns), cell(y, rows));
    let (fx, fy) = (x - col as f64, y - row as f64);
    let first = row * columns + col;
    Some([
        (first, (1.0 - fx) * (1.0 - fy)),
        (first + 1, fx * (1.0 - fy)),
        (first + columns, (1.0 - fx) * fy),
        (first + columns + 1, fx * fy),
    ])
}

/// Interpolates the values at the nodes of a grid of `size` (columns and rows), row by row, bilinearly at `place`, in nodes from
/// the first one; None outside of the grid, and where the first number of a value with a weight is NaN.
pub(crate) fn bilinear<const N: usize>(
    place: [f64; 2],
    size: [usize; 2],
    value: impl Fn(usize) -> [f64; N],
) -> Option<[f64; N]> {
    let mut sum = [0.0; N];
    for (node, weight) in nodes_around(place, size)? {
        // Values without weight may be missing.
        if weight.abs() > ROUNDING_TOLERANCE {
            let found = value(node);
            (0..N).for_each(|k| sum[k] += weight * found[k]);
        }
    }
    (!sum[0].is_nan()).then_some(sum)
}

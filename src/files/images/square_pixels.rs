//! Images of pixels that are not square, resampled to square ones.

use crate::error::{MAX_CELLS, Result, checked_cells, try_filled};

/// Maximum difference between a pixel's width and height, as a share of the larger one, at which their mean is taken:
/// roundings of what programs write.
const MAX_MEAN_SIDE_DIFFERENCE: f64 = 0.005;

/// Maximum difference between a pixel's width and height, as a share of the larger one, that nobody needs to be told.
pub(super) const NEGLIGIBLE_SIDE_DIFFERENCE: f64 = 1e-6;

/// An image on square pixels.
pub(super) struct SquarePixels {
    pub(super) values: Vec<f64>,
    /// Columns and rows.
    pub(super) size: (usize, usize),
    /// Side length of a pixel, in the unit of the sides that were given.
    pub(super) side: f64,
}

/// Makes pixels square. Sides that differ by less than 0.5 % become their mean; else the direction with the coarser pixels is
/// interpolated at the finer spacing, to the whole number of pixels that covers the same extent: none of the input is lost.
/// Where that would be too many pixels, the coarser spacing is taken.
///
/// # Errors
/// [`Error::OutOfMemory`](crate::error::Error::OutOfMemory).
pub(super) fn square_pixels(
    values: Vec<f64>,
    size: (usize, usize),
    [x, y]: [f64; 2],
) -> Result<SquarePixels> {
    let (fine, coarse) = (x.min(y), x.max(y));
    if coarse - fine <= MAX_MEAN_SIDE_DIFFERENCE * coarse {
        return Ok(SquarePixels {
            values,
            size,
            side: 0.5 * (x + y),
        });
    }
    let covering = |side: f64| {
        let count = |n: usize, own: f64| ((n as f64 * own / side).round() as usize).max(1);
        (count(size.0, x), count(size.1, y))
    };
    let is_possible = |(width, height): (usize, usize)| width.saturating_mul(height) <= MAX_CELLS;
    let side = match is_possible(covering(fine)) {
        true => fine,
        false => coarse,
    };
    Ok(SquarePixels {
        values: resampled(&values, size, covering(side))?,
        size: covering(side),
        side,
    })
}

/// Interpolates an image linearly on `wanted` columns and rows that cover the same extent, one of which are as many as before. A
/// pixel has a height if the nearest one has; at the border the slope goes on.
///
/// # Errors
/// [`Error::OutOfMemory`](crate::error::Error::OutOfMemory).
pub(super) fn resampled(
    values: &[f64],
    (cols, rows): (usize, usize),
    (width, height): (usize, usize),
) -> Result<Vec<f64>> {
    let len = checked_cells("resampled image", height, width)?;
    let mut out = try_filled("resampled image", len, 0.0)?;
    let blend = |a: f64, b: f64, share: f64| match a.is_nan() || b.is_nan() {
        true if share < 0.5 => a,
        true => b,
        false => a + share * (b - a),
    };
    for (i, out) in out.iter_mut().enumerate() {
        let [(left, u), (top, v)] =
            [(i % width, width, cols), (i / width, height, rows)].map(place);
        let [right, below] = [(left + 1).min(cols - 1), (top + 1).min(rows - 1)];
        let along = |row: usize| blend(values[row * cols + left], values[row * cols + right], u);
        *out = blend(along(top), along(below), v);
    }
    Ok(out)
}

/// The pixel before the middle of one of `wanted` pixels that cover the extent of `count`, and how far the middle is behind that pixel's
/// own.
fn place((index, wanted, count): (usize, usize, usize)) -> (usize, f64) {
    let at = (index as f64 + 0.5) * count as f64 / wanted as f64 - 0.5;
    let before = (at.max(0.0) as usize).min(count.saturating_sub(2));
    (before, at - before as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Pixels 1 wide and 2.5 high, or 2.4 and 1: every pixel of the input is covered, also in the last row and column.
    #[test]
    fn a_slope_stays_a_slope_over_the_whole_extent() {
        for ([x, y], expected) in [([1.0, 2.5], (40, 33)), ([2.4, 1.0], (96, 13))] {
            let size = (40, 13);
            let slope = |(cols, rows): (usize, usize)| -> Vec<f64> {
                let [dx, dy] = [40.0 * x / cols as f64, 13.0 * y / rows as f64];
                let at = |i: usize| dx * ((i % cols) as f64 + 0.5) + dy * ((i / cols) as f64 + 0.5);
                (0..cols * rows).map(at).collect()
            };
            let square = square_pixels(slope(size), size, [x, y]).unwrap();
            assert_eq!((square.side, square.size), (1.0, expected));
            let back = resampled(&square.values, square.size, size).unwrap();
            for (found, known) in [(&square.values, slope(expected)), (&back, slope(size))] {
                let misses = found.iter().zip(&known).map(|(a, b)| (a - b).abs());
                assert!(misses.fold(0.0, f64::max) < 1e-9);
            }
        }
    }

    #[test]
    fn the_pixels_that_have_no_height_come_back() {
        let has_none = |i: usize| i.is_multiple_of(7) || i % 20 > 15;
        let values: Vec<f64> = (0..200)
            .map(|i| if has_none(i) { f64::NAN } else { 1.0 })
            .collect();
        let square = square_pixels(values, (20, 10), [2.0, 3.3]).unwrap();
        let back = resampled(&square.values, square.size, (20, 10)).unwrap();
        assert!((0..200).all(|i| back[i].is_nan() == has_none(i)));
    }
}

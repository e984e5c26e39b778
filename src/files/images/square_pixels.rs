//! Images of pixels that are not square, resampled to square ones.

use crate::error::{Result, checked_cells, try_filled};

/// Maximum difference between a pixel's width and height, as a share of the larger one, at which their mean is taken:
/// roundings of what programs write.
const MAX_MEAN_SIDE_DIFFERENCE: f64 = 0.005;

/// Maximum difference between a pixel's width and height, as a share of the larger one, that nobody needs to be told.
pub(super) const NEGLIGIBLE_SIDE_DIFFERENCE: f64 = 1e-6;

/// An image on square pixels.
pub(super) struct SquarePixels {
    pub(super) values: Vec<f64>,
    pub(super) size: (usize, usize),
    /// Side length of a pixel, in the unit of the sides that were given.
    pub(super) side: f64,
    /// By which factor pixels have become wider and higher.
    pub(super) stretch: [f64; 2],
}

/// Makes pixels square. Sides that differ by less than 0.5 % become their mean; else the direction with the finer pixels is
/// interpolated linearly at the coarser spacing, so that no detail is made up.
///
/// # Errors
/// [`Error::OutOfMemory`](crate::error::Error::OutOfMemory).
pub(super) fn square_pixels(
    values: Vec<f64>,
    size: (usize, usize),
    [x, y]: [f64; 2],
) -> Result<SquarePixels> {
    let side = x.max(y);
    if (x - y).abs() <= MAX_MEAN_SIDE_DIFFERENCE * side {
        return Ok(SquarePixels {
            values,
            size,
            side: 0.5 * (x + y),
            stretch: [1.0, 1.0],
        });
    }
    let stretch = [side / x, side / y];
    let count = |n: usize, factor: f64| ((n as f64 / factor + 1e-9) as usize).max(1);
    let (width, height) = (count(size.0, stretch[0]), count(size.1, stretch[1]));
    let mut square = try_filled(
        "resampled image",
        checked_cells("resampled image", height, width)?,
        0.0,
    )?;
    for (i, out) in square.iter_mut().enumerate() {
        let [(left, u), (top, v)] = [
            place(i % width, stretch[0], size.0),
            place(i / width, stretch[1], size.1),
        ];
        // One of the directions is not resampled, and a weight of 0 must not spread what is missing.
        let at = |col: usize, row: usize| values[row * size.0 + col];
        let blend = |a: f64, b: f64, share: f64| if share == 0.0 { a } else { a + share * (b - a) };
        let [right, below] = [(left + 1).min(size.0 - 1), (top + 1).min(size.1 - 1)];
        *out = blend(
            blend(at(left, top), at(right, top), u),
            blend(
                at(left, below),
                at(right, below),
                if v == 0.0 { 0.0 } else { u },
            ),
            v,
        );
    }
    Ok(SquarePixels {
        values: square,
        size: (width, height),
        side,
        stretch,
    })
}

/// The pixel before a place, and how far the place is behind it. Pixels are counted at their upper left corners, as a
/// georeference counts them, and interpolated between their middles, which moves the image by less than half a pixel.
fn place(index: usize, factor: f64, count: usize) -> (usize, f64) {
    let at = ((index as f64 + 0.5) * factor - 0.5).clamp(0.0, count as f64 - 1.0);
    (at as usize, at.fract())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slope_stays_a_slope() {
        // Heights that rise by 1 for each unit of length, on pixels 1 wide and 2.5 high.
        let (width, height) = (40, 12);
        let values: Vec<f64> = (0..width * height)
            .map(|i| (i % width) as f64 + 0.5 + 2.5 * ((i / width) as f64 + 0.5))
            .collect();
        let square = square_pixels(values, (width, height), [1.0, 2.5]).unwrap();
        assert_eq!((square.side, square.size.1), (2.5, height));
        let cols = square.size.0;
        assert_eq!(cols, 16);
        for (i, value) in square.values.iter().enumerate() {
            let expected = 2.5 * ((i % cols) as f64 + 0.5) + 2.5 * ((i / cols) as f64 + 0.5);
            assert!((value - expected).abs() < 1e-12, "{i}: {value} {expected}");
        }
    }
}

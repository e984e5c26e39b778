//! Pixel grid of a page's flat image: its size, resolution and corner, and its warp map some rows at a time.

use std::ops::Range;

use crate::dewarp::{DewarpOptions, WarpMap};
use crate::error::{Result, checked_cells, positive, try_filled};

/// Pixel grid of a page's flat image: its size, resolution and corner.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct PixelGrid {
    /// Number of columns.
    pub width: usize,
    /// Number of rows.
    pub height: usize,
    /// Pixels per unit of the flat page's length.
    pub resolution: f64,
    /// Position of the upper left corner on the flat page, in its unit of length, with y upwards.
    pub corner: [f64; 2],
}

impl PixelGrid {
    /// Makes the pixel grid of a page of the given size. The resolution is that of `options`, or by default the one that
    /// gives the image as many pixels as the page covers in the photo, `seen_area`.
    ///
    /// # Errors
    /// [`Error::Option`](crate::Error::Option) for a resolution that is not positive and finite,
    /// [`Error::TooLarge`](crate::Error::TooLarge).
    pub(super) fn new(
        size: [f64; 2],
        options: &DewarpOptions,
        seen_area: impl Fn() -> f64,
    ) -> Result<Self> {
        let resolution = match options.dots {
            Some(dots) => positive("dots", dots)?,
            None => (seen_area() / (size[0] * size[1])).sqrt(),
        };
        let [width, height] = size.map(|side| (side * resolution).round().max(1.0) as usize);
        checked_cells("flat image", height, width)?;
        Ok(PixelGrid {
            width,
            height,
            resolution,
            corner: [0.0, size[1]],
        })
    }

    /// Makes the warp map of some rows. `place` gives the place in the photo of a pixel, by its column and row and by the
    /// shares of the page's width and height at its centre.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub(super) fn warp_rows(
        &self,
        rows: Range<usize>,
        place: impl Fn([usize; 2], [f64; 2]) -> [f32; 2],
    ) -> Result<WarpMap> {
        let size = [self.width, rows.len()];
        let corner = [
            self.corner[0],
            self.corner[1] - rows.start as f64 / self.resolution,
        ];
        let mut places = try_filled("flat image", self.width * rows.len(), [f32::NAN; 2])?;
        for (line, row) in places.chunks_exact_mut(self.width).zip(rows) {
            let down = (row as f64 + 0.5) / self.height as f64;
            for (col, found) in line.iter_mut().enumerate() {
                *found = place([col, row], [(col as f64 + 0.5) / self.width as f64, down]);
            }
        }
        Ok(WarpMap::from_places(size, self.resolution, corner, places))
    }
}

//! Pixel grid of a page's flat image: its size, resolution and corner.

use crate::dewarp::DewarpOptions;
use crate::error::{Result, checked_cells, positive};

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
}

//! The result of decoding an image: the stored pixel values, and how they become heights.

use super::format::Format;
use crate::error::{Error, Result};
use crate::files::{Assumption, Unit};
use crate::heights::heightfield::HeightImage;

/// A decoded image file: its stored values, and the scale that converts these to heights.
///
/// `height = values · height_scale`, in the unit of `pixel_size`.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Decoded {
    /// Format of the image file.
    pub format: Format,
    /// Number of pixel columns of the image.
    pub width: usize,
    /// Number of pixel rows of the image.
    pub height: usize,
    /// The pixel values as stored in the file (grey levels, numbers), row by row, top row first; NaN where there is no
    /// data. A PNG's recorded offset is contained, as `offset / height_scale`. Integers beyond 2⁵³ are rounded.
    pub values: Vec<f64>,
    /// Side length of a pixel in `unit`, or in an unknown unit: as recorded by [`write_png`](super::write_png) and the
    /// like, or by a TIFF's resolution or GeoTIFF scale; else 1.
    pub pixel_size: f64,
    /// The unit of `pixel_size`, where the file says it: millimetres if a TIFF
    /// has a resolution, metres if a GeoTIFF says so.
    pub unit: Option<Unit>,
    /// Factor from the stored values to heights: `height = values · height_scale`. For NPY, NPZ and floats it is 1, or
    /// the scale that a PFM states; for PNG as recorded by [`write_png`](super::write_png). For the integers of other
    /// pictures it is a suggestion: the one that makes their full range (from black to white) a quarter of the image's
    /// longer side.
    pub height_scale: f64,
    /// Type of number that the file stores for each pixel: `"u8"`, `"u16"`, `"f32"`, `"f64"`, …
    pub data_type: &'static str,
    /// What the reader assumed because the file does not say it.
    pub assumptions: Vec<Assumption>,
}

impl Decoded {
    /// Converts the stored values to heights by `height_scale`, and returns them as a height image.
    ///
    /// # Errors
    /// As [`HeightImage::new`], so [`Error::NotFinite`] if a value is infinite.
    pub fn into_image(self) -> Result<HeightImage> {
        HeightImage::new(self.width, self.height, self.values)?
            .with_pixel_size(self.pixel_size)?
            .scaled(self.height_scale)
    }
}

/// Height difference between black and white that is suggested where a file records no height scale, as a share of the
/// image's longer side.
const SUGGESTED_RELIEF: f64 = 0.25;

/// Suggests a factor from grey values of a given range to heights, where the file records none.
pub(super) fn suggested_scale(width: usize, height: usize, range: f64) -> f64 {
    SUGGESTED_RELIEF * width.max(height) as f64 / range
}

/// Creates the error for a picture with colours, which cannot be read as heights; it names the first coloured
/// pixel.
pub(super) fn coloured(format: &'static str, pixel: usize, width: usize) -> Error {
    Error::Unsupported {
        format,
        reason: format!(
            "the pixel at row {}, column {} has a colour, from which no height follows; \
             grey images are read (grey, or RGB and palettes with grey pixels only)",
            pixel / width,
            pixel % width
        ),
    }
}

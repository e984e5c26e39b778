//! The result of decoding an image: values, and how they become heights.

use super::format::Format;
use crate::error::{Error, Result};
use crate::heights::heightfield::HeightImage;

/// A unit of length.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Unit {
    /// 10⁻³ m.
    Millimetre,
    /// 1 m.
    Metre,
}

impl Unit {
    /// The symbol `"mm"` or `"m"`.
    pub fn symbol(self) -> &'static str {
        match self {
            Unit::Millimetre => "mm",
            Unit::Metre => "m",
        }
    }
}

/// A decoded image file: its values, and how they become heights.
///
/// `height = values · height_scale`, in the unit of `pixel_size`.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Decoded {
    /// Format of the file.
    pub format: Format,
    /// Number of columns.
    pub width: usize,
    /// Number of rows.
    pub height: usize,
    /// The values as stored (grey levels, numbers), row by row, top row first;
    /// NaN where there is no data. A PNG's recorded offset is contained, as
    /// `offset / height_scale`. Integers beyond 2⁵³ are rounded.
    pub values: Vec<f64>,
    /// Side length of a pixel: as recorded by [`write_png`](super::write_png) and the like, or
    /// by a TIFF's resolution or GeoTIFF scale; else 1.
    pub pixel_size: f64,
    /// The unit of `pixel_size`, where the file says it: millimetres if a TIFF
    /// has a resolution, metres if a GeoTIFF says so.
    pub unit: Option<Unit>,
    /// Height of one step of the values. For NPY, NPZ and floats it is 1, or the scale that a PFM states; for
    /// PNG as recorded by [`write_png`](super::write_png). For the integers of other pictures it is a
    /// suggestion: the one that makes their full range (from black to white) a quarter of the image's longer
    /// side.
    pub height_scale: f64,
    /// The type the file stores: `"u8"`, `"u16"`, `"f32"`, `"f64"`, …
    pub data_type: &'static str,
}

impl Decoded {
    /// The heights as an image.
    ///
    /// # Errors
    /// As [`HeightImage::new`], so [`Error::NotFinite`] if a value is infinite.
    pub fn into_image(self) -> Result<HeightImage> {
        HeightImage::new(self.width, self.height, self.values)?
            .with_pixel_size(self.pixel_size)?
            .scaled(self.height_scale)
    }
}

/// Share of the longer side that black to white spans where no scale is recorded.
const SUGGESTED_RELIEF: f64 = 0.25;

/// Suggested height scale for values of the given range.
pub(super) fn suggested_scale(width: usize, height: usize, range: f64) -> f64 {
    SUGGESTED_RELIEF * width.max(height) as f64 / range
}

/// The error of a picture with colours, found at the given pixel.
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

//! A decoded photo: its pixels, and what the file says about the camera.

use ::png::{ColorType, Transformations};

use super::format::Format;
use super::png::Pixels;
use crate::error::{Error, Result, try_filled};
use crate::files::Assumption;

/// A decoded photo: its pixels in colour, and what its metadata say about the camera.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct PhotoFile {
    /// Number of pixel columns of the photo.
    pub width: usize,
    /// Number of pixel rows of the photo.
    pub height: usize,
    /// Red, green, blue and alpha of each pixel, row by row, top row first.
    pub rgba: Vec<u8>,
    /// Focal length of the camera, in millimetres for a film of 36 by 24 mm, from the file's Exif data. `None` if
    /// they have none, or if the photo's proportions differ from theirs, as after cropping.
    pub film35: Option<f64>,
    /// Orientation that the file's Exif data state, from 1 (upright) to 8; the pixels are upright already.
    pub orientation: u16,
    /// What the reader assumed because the file does not say it.
    pub assumptions: Vec<Assumption>,
}

impl PhotoFile {
    #[cfg(feature = "images")]
    pub(super) fn new((width, height): (usize, usize), rgba: Vec<[u8; 4]>) -> Self {
        PhotoFile {
            width,
            height,
            rgba: rgba.into_flattened(),
            film35: None,
            orientation: 1,
            assumptions: Vec::new(),
        }
    }
}

/// Decodes the photo in a PNG file to RGBA bytes, and links the decoder of PNG only.
///
/// # Errors
/// As [`decode_photo`](super::decode_photo).
pub fn decode_photo_basic(bytes: &[u8], format: Format) -> Result<PhotoFile> {
    match format {
        Format::Png => decode_png(bytes),
        other => Err(Error::Unsupported {
            format: other.title(),
            reason: "only PNG photos are read here; the cargo feature `images` adds JPEG and WebP"
                .into(),
        }),
    }
}

fn decode_png(bytes: &[u8]) -> Result<PhotoFile> {
    let transformations = Transformations::normalize_to_color8() | Transformations::ALPHA;
    let Pixels {
        reader,
        samples,
        width,
        height,
    } = Pixels::decode(bytes, transformations)?;
    let rgba = match reader.output_color_type().0 {
        ColorType::GrayscaleAlpha => {
            let mut rgba = try_filled("PNG image", 4 * width * height, 0)?;
            for (out, pixel) in rgba.chunks_exact_mut(4).zip(samples.chunks_exact(2)) {
                out.copy_from_slice(&[pixel[0], pixel[0], pixel[0], pixel[1]]);
            }
            rgba
        }
        // After the transformations only these two colour types remain.
        _ => samples,
    };
    Ok(PhotoFile {
        width,
        height,
        rgba,
        film35: None,
        orientation: 1,
        assumptions: Vec::new(),
    })
}

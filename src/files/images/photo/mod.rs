//! Decoded photos: their pixels upright, and what the files say about the camera.

#[cfg(feature = "images")]
mod bmp;
mod exif;
#[cfg(feature = "images")]
mod gif;
mod kind;
mod pixels;
mod png;
#[cfg(feature = "images")]
mod tiff;

pub(super) use self::exif::PhotoTags;
use self::kind::photo_format;
pub use self::pixels::PhotoFile;
pub(super) use self::pixels::PhotoPixels;
use super::format::Format;
use super::jpeg;
use crate::error::{Error, Result};

/// Decodes a photo in a JPEG or PNG file to RGBA bytes, 16 bits cut to 8, the way up that its Exif data state; with the cargo
/// feature `images` also in a WebP, GIF (its first picture), BMP or TIFF file.
///
/// A photo of more than 26 megapixels is halved until it has fewer, which [`PhotoFile::assumptions`] says.
///
/// # Errors
/// [`Error::Unsupported`] for other files, with what to do about them, and for photos of more than a quarter of a gigapixel,
/// [`Error::Format`] for a damaged file, [`Error::Empty`] for a photo without pixels, [`Error::OutOfMemory`].
pub fn decode_photo(bytes: &[u8]) -> Result<PhotoFile> {
    match photo_format(bytes)? {
        #[cfg(feature = "images")]
        Format::WebP => super::extended::webp::decode_photo(bytes),
        #[cfg(feature = "images")]
        Format::Gif => gif::decode(bytes),
        #[cfg(feature = "images")]
        Format::Bmp => bmp::decode(bytes),
        #[cfg(feature = "images")]
        Format::Tiff => tiff::decode(bytes),
        Format::Png => png::decode(bytes),
        Format::Jpeg => jpeg::decode_photo(bytes),
        other => Err(Error::Unsupported {
            format: other.title(),
            reason: "the cargo feature `images` adds it".into(),
        }),
    }
}

/// Decodes a photo in a JPEG or PNG file, and links the decoders of these two formats only.
///
/// # Errors
/// As [`decode_photo`].
pub fn decode_photo_basic(bytes: &[u8]) -> Result<PhotoFile> {
    match photo_format(bytes)? {
        Format::Png => png::decode(bytes),
        Format::Jpeg => jpeg::decode_photo(bytes),
        other => Err(Error::Unsupported {
            format: other.title(),
            reason: "only PNG and JPEG photos are read here".into(),
        }),
    }
}

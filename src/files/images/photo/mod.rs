//! Decoded photos: their pixels upright, and what the files say about the camera.

#[cfg(feature = "images")]
mod bmp;
mod exif;
#[cfg(feature = "images")]
mod gif;
mod pixels;
mod png;
#[cfg(feature = "images")]
mod tiff;

pub(super) use self::exif::PhotoTags;
pub use self::pixels::PhotoFile;
pub(super) use self::pixels::PhotoPixels;
use super::jpeg;
use crate::error::Result;
use crate::files::failure::{in_format, unsupported};
use crate::files::image_format::Format;
#[cfg(feature = "images")]
use crate::files::kind::{Purpose, refused};

/// Decodes a photo in a JPEG or PNG file to RGBA bytes, 16 bits cut to 8, the way up that its Exif data state; with the cargo
/// feature `images` also in a WebP, GIF (its first picture), BMP or TIFF file.
///
/// A photo of more than 26 megapixels is read at half, a third or a quarter of its resolution, which [`PhotoFile::assumptions`] says.
///
/// # Errors
/// [`Error::Unsupported`](crate::Error::Unsupported) for other files, with what to do about them, and for photos of more than a quarter of a gigapixel,
/// [`Error::Format`](crate::Error::Format) for a damaged file, [`Error::Empty`](crate::Error::Empty) for a photo without pixels, [`Error::OutOfMemory`](crate::Error::OutOfMemory).
pub fn decode_photo(bytes: &[u8]) -> Result<PhotoFile> {
    match Format::detect(bytes) {
        #[cfg(feature = "images")]
        Some(Format::Png) => png::decode(bytes).map_err(in_format(Format::Png)),
        #[cfg(feature = "images")]
        _ => decode_other_photo(bytes),
        #[cfg(not(feature = "images"))]
        _ => decode_photo_basic(bytes),
    }
}

/// Reader of a photo from the bytes of a file.
#[cfg(feature = "images")]
type Decode = fn(&[u8]) -> Result<PhotoFile>;

/// Decodes a photo in a file of any format but PNG, whose decoder is not linked.
///
/// # Errors
/// As [`decode_photo`].
#[cfg(feature = "images")]
pub fn decode_other_photo(bytes: &[u8]) -> Result<PhotoFile> {
    let (format, decode): (_, Decode) = match Format::detect(bytes) {
        Some(format @ Format::Jpeg) => (format, jpeg::decode_photo),
        Some(format @ Format::WebP) => (format, super::extended::webp::decode_photo),
        Some(format @ Format::Gif) => (format, gif::decode),
        Some(format @ Format::Bmp) => (format, bmp::decode),
        Some(format @ Format::Tiff) => (format, tiff::decode),
        _ => return Err(refused(bytes, Purpose::Photo)),
    };
    decode(bytes).map_err(in_format(format))
}

/// Decodes a photo in a JPEG or PNG file, and links the decoders of these two formats only.
///
/// # Errors
/// As [`decode_photo`].
pub fn decode_photo_basic(bytes: &[u8]) -> Result<PhotoFile> {
    match Format::detect(bytes) {
        Some(Format::Png) => png::decode(bytes).map_err(in_format(Format::Png)),
        Some(Format::Jpeg) => jpeg::decode_photo(bytes).map_err(in_format(Format::Jpeg)),
        _ => Err(unsupported(
            "a file of another format",
            "only PNG and JPEG photos are read here",
        )),
    }
}

//! Height images and photos from and to files held in memory.
//!
//! Reads PNG and NPY ([`decode`]) and photos as PNG and JPEG ([`decode_photo`]); writes NPY,
//! 16-bit PNG, and photos as PNG, JPEG and PDF. With the cargo feature `images` also reads TIFF,
//! EXR, PFM, PGM, NPZ, JPEG and WebP, photos as WebP, GIF, BMP and TIFF, too, and writes TIFF and EXR. Nothing here touches a
//! file system, so that all of it works in a browser too.
//!
//! Damaged files are errors, never panics, and no more memory is asked for than
//! the bytes that are there can fill. (WebP is the exception: a few bytes may
//! stand for a large even area, up to [`MAX_CELLS`](crate::MAX_CELLS) pixels.)

mod decode_options;
mod decoded;
mod depths;
#[cfg(feature = "images")]
pub mod extended;
mod georeference;
mod grey;
mod jpeg;
mod no_data;
mod npy;
mod orientation;
mod page_words;
mod photo;
mod photo_pdf;
mod picture_data;
mod png;
mod print;
mod raw_pixels;
mod scale;
mod square_pixels;

use crate::error::Result;
use crate::files::failure::{in_format, not_read, unsupported};
use crate::heights::heightfield::HeightImage;
use georeference::on_own_pixels;

pub use super::image_format::{FORMAT_NAMES, Format};
pub use super::kind::{announced, format_name};
pub use decode_options::DecodeOptions;
pub use decoded::Decoded;
pub use depths::DepthEvidence;
#[cfg(feature = "images")]
pub use extended::{NpzArray, npz_arrays};
pub use georeference::Georeference;
pub use npy::write_npy;
pub use page_words::BookWord;
#[cfg(feature = "images")]
pub use photo::decode_other_photo;
pub use photo::{PhotoFile, decode_photo, decode_photo_basic};
pub use photo_pdf::{BookPage, write_book, write_photo_pdf};
pub use print::{PhotoOptions, PhotoRows, write_photo, write_photo_jpeg};

/// Decodes the heights in an image file of the given format (`None`: the format that the file's first bytes announce).
///
/// - **PNG**: grey of 1 to 16 bits, interlaced or not, also when stored as RGB
///   or with a palette, as long as every pixel is grey. Fewer than 8 bits are
///   stretched to the range 0 to 255. Pixels that are wholly transparent (an
///   alpha of 0, or the colour declared transparent) have no data. Real colours
///   are refused, because no height follows from them.
/// - **NPY**: two-dimensional arrays (a third axis of length 1 is allowed) of
///   booleans, integers and floats of 16 to 64 bits, either byte order, C or
///   Fortran order. Row 0 is the top row.
///
/// With the cargo feature `images`:
///
/// - **TIFF**: one grey channel (or grey RGB) of integers of 8 to 64 bits or
///   floats of 16 to 64, in strips or tiles, plain or compressed by Deflate, Zstandard,
///   LZW or PackBits; the first image of a file of several. The orientation is
///   honoured. No data is an alpha of 0 and what the tag `GDAL_NODATA` names.
/// - **EXR**: of the first layer that has it, the channel `Z`, `depth` or `height`, else
///   `Y`, else `R`, `G`, `B` where all are equal, or the only one there is;
///   [`decode_with`] chooses one by name.
/// - **PFM**, **PGM**: grey, either byte order; PGM as bytes or text.
/// - **NPZ**: the only array that may be an image; [`decode_with`] chooses one by name.
/// - **Text**: a grid of ESRI or Surfer, points on a grid (XYZ) in any order, or a
///   matrix, with blanks, tabs, semicolons or commas between its numbers.
/// - **SRTM** (`.hgt`): a square of one degree, at the latitude that the file's name says.
/// - **COLMAP**: depth maps (`.bin`), whose zeros have no data.
/// - **JPEG**, **WebP**, **GIF**, **BMP**: grey pictures, and RGB as long as every pixel is grey.
///   The orientation that a JPEG's Exif data state is honoured.
///
/// What a file does not say is assumed, and [`Decoded::assumptions`] says it: values that nobody would measure, such as -9999
/// or 1e10 standing alone far from the rest, are no data; pixels are square; heights have the unit of pixels 1 wide unless
/// that makes a slab or a needle of them. Costs `O(pixels)`.
///
/// # Errors
/// [`Error::Unsupported`](crate::Error::Unsupported) for other formats and contents, [`Error::Format`](crate::Error::Format) for
/// a damaged file, [`Error::TooLarge`](crate::Error::TooLarge) above [`MAX_CELLS`](crate::MAX_CELLS)
/// pixels (before anything of that size is allocated), [`Error::Empty`](crate::Error::Empty) for an
/// array without elements.
pub fn decode(bytes: &[u8], format: Option<Format>) -> Result<Decoded> {
    decode_with(bytes, format, &DecodeOptions::default())
}

/// Decodes the heights in an image file as [`decode`] does, with options.
///
/// # Errors
/// As [`decode`], and [`Error::Unsupported`](crate::Error::Unsupported) for an array that is not there; the message lists those that are.
pub fn decode_with(
    bytes: &[u8],
    format: Option<Format>,
    options: &DecodeOptions,
) -> Result<Decoded> {
    match announced(bytes, format)? {
        #[cfg(feature = "images")]
        other if !other.is_basic() => extended::decode(bytes, other, options),
        basic => decode_basic(bytes, Some(basic), options),
    }
}

/// Decodes the heights in a PNG or NPY file, and links the decoders of these two formats only.
///
/// # Errors
/// As [`decode_with`].
pub fn decode_basic(
    bytes: &[u8],
    format: Option<Format>,
    options: &DecodeOptions,
) -> Result<Decoded> {
    let reason = "only PNG and NPY are read here";
    let found = Format::detect(bytes);
    let found = match format {
        Some(stated) => stated.checked(found)?,
        None => found.ok_or_else(|| unsupported("a file of another format", reason))?,
    };
    let stored = match found {
        Format::Png => png::decode(bytes),
        Format::Npy => npy::decode(bytes),
        _ => Err(not_read(reason)),
    };
    let stored = stored.map_err(in_format(found))?;
    options.check(found)?;
    stored.finish(found, options)
}

/// Writes heights to a file of the given format; NaN is no data. [`decode`] gives the pixel size back, but from NPY.
///
/// - **NPY**: 64-bit floats, exact, at the pixels of the map that was read, if there is one.
/// - **PNG**: 16-bit grey. Text chunks record scale, offset, pixel size and the level of no data, so that [`decode`] gives
///   back every height to 1/131068 of their range.
///
/// With the cargo feature `images`:
///
/// - **TIFF**: heights rounded to 32-bit floats, uncompressed, with the georeference if there is one.
/// - **EXR**: heights rounded to 32-bit floats in one channel `Z`, compressed without loss.
///
/// # Errors
/// [`Error::Unsupported`](crate::Error::Unsupported) for other formats, [`Error::NotFinite`](crate::Error::NotFinite) for heights
/// that 32-bit floats cannot hold, [`Error::OutOfMemory`](crate::Error::OutOfMemory).
pub fn write_image(
    image: &HeightImage,
    format: Format,
    map: Option<&Georeference>,
) -> Result<Vec<u8>> {
    match format {
        #[cfg(feature = "images")]
        other if !other.is_basic() => extended::write(image, other, map),
        basic => write_basic(image, basic, map),
    }
}

/// Writes heights to a PNG or NPY file, and links the writers of these two formats only.
///
/// # Errors
/// As [`write_image`].
pub fn write_basic(
    image: &HeightImage,
    format: Format,
    map: Option<&Georeference>,
) -> Result<Vec<u8>> {
    match format {
        Format::Png => png::write_png(image),
        Format::Npy => {
            let own = on_own_pixels(map, image)?;
            let image = own.as_ref().unwrap_or(image);
            write_npy(image.height(), image.width(), image.values())
        }
        _ => Err(unsupported(format, "it is not written here")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn other_files_are_named_in_the_error() {
        let message = |bytes: &[u8], format| decode(bytes, format).unwrap_err().to_string();
        assert!(message(b"Lerc2 ....", None).contains("gdal_translate"));
        assert!(message(b"PK\x03\x04....", Some(Format::Png)).contains("another format"));
        assert!(message(b"\x93NUMPY....", Some(Format::Png)).contains("begins like NPY"));
        assert!(message(b"", None).contains("empty"));
        assert_eq!(decode(b"hello", None).unwrap_err().code(), "UNSUPPORTED");
        assert_eq!(decode(b"", None).unwrap_err().code(), "FORMAT");
    }
}

//! Height images and photos from and to files held in memory.
//!
//! Reads PNG and NPY ([`decode`]) and photos ([`decode_photo`]); writes NPY,
//! 16-bit PNG, and photos as PNG, JPEG and PDF. With the cargo feature `images` also reads TIFF,
//! EXR, PFM, NPZ, JPEG and WebP (these two as photos, too), and writes TIFF and EXR. Nothing here touches a
//! file system, so that all of it works in a browser too.
//!
//! Damaged files are errors, never panics, and no more memory is asked for than
//! the bytes that are there can fill. (WebP is the exception: a few bytes may
//! stand for a large even area, up to [`MAX_CELLS`](crate::MAX_CELLS) pixels.)

#[cfg(feature = "images")]
pub mod extended;
mod npy;
mod photo;
mod png;
mod print;

use std::str::FromStr;

use super::buffer::Buffer;
use crate::error::{Error, Result};
use crate::heights::heightfield::HeightImage;

#[cfg(feature = "images")]
pub use extended::{NpzArray, decode_npz, npz_arrays, write_exr, write_tiff};
pub use npy::write_npy;
pub use photo::{PhotoFile, decode_photo_basic};
pub use png::write_png;
pub use print::{PhotoOptions, PhotoRows, write_photo, write_photo_jpeg, write_photo_pdf};

/// A file format that can be read. All but the first two need the cargo feature
/// `images`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Format {
    /// Portable Network Graphics, grey, 1 to 16 bits.
    Png,
    /// NumPy's array file.
    Npy,
    /// Tagged Image File Format, also BigTIFF and GeoTIFF.
    Tiff,
    /// OpenEXR.
    Exr,
    /// Portable float map.
    Pfm,
    /// NumPy's archive of arrays.
    Npz,
    /// JPEG, grey.
    Jpeg,
    /// WebP, grey.
    WebP,
}

/// Formats with their names in options and their titles in messages.
const FORMAT_TITLES: [(Format, &str, &str); 8] = [
    (Format::Png, "png", "PNG"),
    (Format::Npy, "npy", "NPY"),
    (Format::Tiff, "tiff", "TIFF"),
    (Format::Exr, "exr", "EXR"),
    (Format::Pfm, "pfm", "PFM"),
    (Format::Npz, "npz", "NPZ"),
    (Format::Jpeg, "jpeg", "JPEG"),
    (Format::WebP, "webp", "WebP"),
];

/// First bytes of the files of each format; a `?` stands for any byte.
const MAGIC_BYTES: [(&[u8], Format); 13] = [
    (b"\x89PNG\r\n\x1a\n", Format::Png),
    (b"\x93NUMPY", Format::Npy),
    (b"II*\0", Format::Tiff),
    (b"MM\0*", Format::Tiff),
    (b"II+\0", Format::Tiff),
    (b"MM\0+", Format::Tiff),
    (b"\x76\x2f\x31\x01", Format::Exr),
    (b"Pf\n", Format::Pfm),
    (b"PF\n", Format::Pfm),
    (b"PK\x03\x04", Format::Npz),
    (b"PK\x05\x06", Format::Npz),
    (b"\xff\xd8\xff", Format::Jpeg),
    (b"RIFF????WEBP", Format::WebP),
];

impl Format {
    /// Whether it is read without the cargo feature `images`.
    #[cfg(feature = "images")]
    fn is_basic(self) -> bool {
        matches!(self, Format::Png | Format::Npy)
    }

    /// The name in lower case: `"png"`, `"npy"`, `"tiff"`, `"exr"`, `"pfm"`,
    /// `"npz"`, `"jpeg"` or `"webp"`.
    pub fn name(self) -> &'static str {
        self.entry().1
    }

    /// The format that a file's first bytes announce.
    pub fn detect(bytes: &[u8]) -> Option<Format> {
        let announces = |magic: &[u8]| {
            bytes.len() >= magic.len() && magic.iter().zip(bytes).all(|(m, b)| *m == b'?' || m == b)
        };
        MAGIC_BYTES
            .into_iter()
            .find_map(|(magic, format)| announces(magic).then_some(format))
    }

    fn title(self) -> &'static str {
        self.entry().2
    }

    fn entry(self) -> (Format, &'static str, &'static str) {
        FORMAT_TITLES[self as usize]
    }
}

impl FromStr for Format {
    type Err = Error;

    /// From [`Format::name`].
    fn from_str(name: &str) -> Result<Self> {
        FORMAT_TITLES
            .into_iter()
            .find_map(|(format, known, _)| (name == known).then_some(format))
            .ok_or_else(|| Error::option("format", name, FORMAT_NAMES))
    }
}

/// What the option `format` must be.
/// What `format` may be, as a requirement of the option.
pub const FORMAT_NAMES: &str =
    "must be `png`, `npy`, `tiff`, `exr`, `pfm`, `npz`, `jpeg` or `webp`";

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
    /// `"mm"` or `"m"`.
    pub fn symbol(self) -> &'static str {
        match self {
            Unit::Millimetre => "mm",
            Unit::Metre => "m",
        }
    }
}

/// What a file holds: values and what turns them into heights.
///
/// `height = values · height_scale`, in the unit of `pixel_size`.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Decoded {
    /// The format the file had.
    pub format: Format,
    /// Number of columns.
    pub width: usize,
    /// Number of rows.
    pub height: usize,
    /// The values as stored (grey levels, numbers), row by row, top row first;
    /// NaN where there is no data. A PNG's recorded offset is contained, as
    /// `offset / height_scale`. Integers beyond 2⁵³ are rounded.
    pub values: Vec<f64>,
    /// Side length of a pixel: as recorded by [`write_png`] and the like, or
    /// by a TIFF's resolution or GeoTIFF scale; else 1.
    pub pixel_size: f64,
    /// The unit of `pixel_size`, where the file says it: millimetres if a TIFF
    /// has a resolution, metres if a GeoTIFF says so.
    pub unit: Option<Unit>,
    /// Height of one step of the values. 1 for NPY, NPZ and floats, but for the
    /// scale that a PFM states; for PNG as recorded by [`write_png`]. For the
    /// integers of a picture else a suggestion: the one that makes their full
    /// range (from black to white) a quarter of the image's longer side.
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

/// Decodes a file of the given format (`None`: the one its first bytes announce).
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
///   floats of 16 to 64, in strips or tiles, plain or compressed by Deflate,
///   LZW or PackBits; the first image of a file of several. The orientation is
///   honoured. No data is an alpha of 0 and what the tag `GDAL_NODATA` names.
/// - **EXR**: of the first layer that has it, the channel `Z` or `depth`, else
///   `Y`, else `R`, `G`, `B` where all are equal, or the only one there is.
/// - **PFM**: grey, either byte order.
/// - **NPZ**: the only array; [`decode_npz`] chooses one by name.
/// - **JPEG**, **WebP**: grey pictures, and RGB as long as every pixel is grey.
///   The orientation that a JPEG's Exif data state is honoured.
///
/// Costs `O(pixels)`.
///
/// # Errors
/// [`Error::Unsupported`] for other formats and contents, [`Error::Format`] for
/// a damaged file, [`Error::TooLarge`] above [`MAX_CELLS`](crate::MAX_CELLS)
/// pixels (before anything of that size is allocated), [`Error::Empty`] for an
/// array without elements.
pub fn decode(bytes: &[u8], format: Option<Format>) -> Result<Decoded> {
    match announced(bytes, format)? {
        #[cfg(feature = "images")]
        other if !other.is_basic() => extended::decode(bytes, other),
        basic => decode_basic(bytes, basic),
    }
}

/// Decodes a PNG or NPY file, and links the decoders of these two only.
///
/// # Errors
/// As [`decode`].
pub fn decode_basic(bytes: &[u8], format: Format) -> Result<Decoded> {
    match format {
        Format::Png => png::decode(bytes),
        Format::Npy => npy::decode(bytes),
        other => Err(Error::Unsupported {
            format: other.title(),
            reason: "only PNG and NPY are read here; the cargo feature `images` adds it".into(),
        }),
    }
}

/// Decodes a PNG file of any kind to RGBA bytes, 16 bits cut to 8; with the cargo feature `images`
/// also JPEG (the way up that its Exif data state) and WebP files.
///
/// # Errors
/// [`Error::Unsupported`] for other files,
/// [`Error::Format`], [`Error::TooLarge`],
/// [`Error::OutOfMemory`].
pub fn decode_photo(bytes: &[u8]) -> Result<PhotoFile> {
    match announced(bytes, None)? {
        #[cfg(feature = "images")]
        other if other != Format::Png => extended::decode_photo(bytes, other),
        format => decode_photo_basic(bytes, format),
    }
}

/// The format that the bytes announce, if it is the stated one.
///
/// # Errors
/// [`Error::Format`] for an empty file and one of another format than stated,
/// [`Error::Unsupported`] for a file of no known format.
pub fn announced(bytes: &[u8], stated: Option<Format>) -> Result<Format> {
    if bytes.is_empty() {
        return Err(Error::Format {
            format: stated.map_or("an image", Format::title),
            reason: "the file is empty".into(),
        });
    }
    match (stated, Format::detect(bytes)) {
        (None, Some(found)) => Ok(found),
        (Some(stated), Some(found)) if stated == found => Ok(found),
        (None, None) => Err(Error::Unsupported {
            format: "this file",
            reason: format!(
                "{} cannot be read; PNG, NPY, TIFF, EXR, PFM, NPZ, JPEG and WebP can",
                guess(bytes)
            ),
        }),
        (Some(stated), _) => Err(Error::Format {
            format: stated.title(),
            reason: format!("it begins like {}", guess(bytes)),
        }),
    }
}

/// Share of the longer side that black to white spans where no scale is recorded.
const SUGGESTED_RELIEF: f64 = 0.25;

/// A height scale for values of the given range.
fn suggested_scale(width: usize, height: usize, range: f64) -> f64 {
    SUGGESTED_RELIEF * width.max(height) as f64 / range
}

/// A picture of real colours, found at the given pixel.
fn coloured(format: &'static str, pixel: usize, width: usize) -> Error {
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

/// What a file seems to be, for messages only.
fn guess(bytes: &[u8]) -> &'static str {
    let known: [(&[u8], &str); 6] = [
        (b"\x89PNG", "a PNG file damaged in transfer"),
        (b"Pf", "a PFM file whose header is damaged"),
        (b"GIF8", "a GIF file"),
        (b"RIFF", "a RIFF file that is no WebP"),
        (b"%PDF", "a PDF file"),
        (b"BM", "a BMP file"),
    ];
    match Format::detect(bytes) {
        Some(Format::Png) => "a PNG file",
        Some(Format::Npy) => "an NPY file",
        Some(Format::Tiff) => "a TIFF file",
        Some(Format::Exr) => "an OpenEXR file",
        Some(Format::Pfm) => "a PFM file",
        Some(Format::Npz) => "a zip archive (perhaps NPZ)",
        Some(Format::Jpeg) => "a JPEG file",
        Some(Format::WebP) => "a WebP file",
        None => known
            .iter()
            .find(|(magic, _)| bytes.starts_with(magic))
            .map_or("a file of unknown format", |(_, name)| name),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_and_first_bytes_name_the_format() {
        for (i, (format, name, _)) in FORMAT_TITLES.into_iter().enumerate() {
            assert_eq!((format as usize, format.name()), (i, name));
            assert_eq!(format.name().parse(), Ok(format));
            assert!(FORMAT_NAMES.contains(&format!("`{name}`")));
        }
        assert_eq!("PNG".parse::<Format>().unwrap_err().code(), "OPTION");
        assert_eq!(Format::detect(b"\x93NUMPY\x01\0"), Some(Format::Npy));
        assert_eq!(Format::detect(b"\x89PNG\n\x1a\n\0"), None);
    }

    #[test]
    fn other_files_are_named_in_the_error() {
        let message = |bytes: &[u8], format| decode(bytes, format).unwrap_err().to_string();
        assert!(message(b"GIF89a....", None).contains("GIF"));
        assert!(message(b"PK\x03\x04....", Some(Format::Png)).contains("NPZ"));
        assert!(message(b"\x93NUMPY....", Some(Format::Png)).contains("begins like an NPY"));
        assert!(message(b"", None).contains("empty"));
        assert_eq!(decode(b"hello", None).unwrap_err().code(), "UNSUPPORTED");
        assert_eq!(decode(b"", None).unwrap_err().code(), "FORMAT");
    }
}

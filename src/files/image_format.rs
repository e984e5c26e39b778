//! The image formats: their names, and how the first bytes of a file tell which one it has.

use std::str::FromStr;

#[cfg(feature = "formats")]
use super::failure::{damaged, in_format};
use super::signature::begins;
use super::text::{decoded, number};
use crate::error::{Error, Result};

/// An image file format that can be read.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(rename_all = "lowercase")
)]
#[non_exhaustive]
pub enum Format {
    /// Portable Network Graphics, grey, 1 to 16 bits.
    Png,
    /// NumPy's file of one array (NPY).
    Npy,
    /// Tagged Image File Format, also BigTIFF and GeoTIFF.
    Tiff,
    /// OpenEXR, a format of pictures with several channels.
    Exr,
    /// Portable float map (PFM), grey.
    Pfm,
    /// NumPy's archive of several arrays (NPZ).
    Npz,
    /// JPEG, only grey pictures.
    Jpeg,
    /// WebP, only grey pictures.
    WebP,
    /// Text: a grid of ESRI or Surfer, points on a grid (XYZ), or a matrix.
    Text,
    /// Depth map of COLMAP.
    Colmap,
    /// GIF, only grey pictures.
    Gif,
    /// Windows bitmap (BMP), only grey pictures.
    Bmp,
    /// Portable grey map (PGM), binary or text.
    Pgm,
    /// Heights of the Shuttle Radar Topography Mission (SRTM): a square of one degree, without a header.
    Hgt,
}

/// Image formats with their names in options, their titles in messages, and the first bytes of their files, of which a `?` stands
/// for any; none where these do not tell the format.
#[rustfmt::skip]
const IMAGE_FORMATS: [(Format, &str, &str, &[&[u8]]); 14] = [
    (Format::Png, "png", "PNG", &[b"\x89PNG\r\n\x1a\n"]),
    (Format::Npy, "npy", "NPY", &[b"\x93NUMPY"]),
    (Format::Tiff, "tiff", "TIFF", &[b"II*\0", b"MM\0*", b"II+\0", b"MM\0+"]),
    (Format::Exr, "exr", "EXR", &[b"\x76\x2f\x31\x01"]),
    (Format::Pfm, "pfm", "PFM", &[b"Pf\n", b"PF\n", b"Pf\r", b"PF\r", b"Pf ", b"PF "]),
    (Format::Npz, "npz", "NPZ", &[]),
    (Format::Jpeg, "jpeg", "JPEG", &[b"\xff\xd8\xff"]),
    (Format::WebP, "webp", "WebP", &[b"RIFF????WEBP"]),
    (Format::Text, "text", "text", &[]),
    (Format::Colmap, "colmap", "COLMAP depths", &[]),
    (Format::Gif, "gif", "GIF", &[b"GIF8"]),
    // The size of the file, four bytes for the program that wrote it, where the pixels begin, and the size of the header
    // that follows, which is below 256.
    (Format::Bmp, "bmp", "BMP", &[b"BM?????????????\0\0\0"]),
    (Format::Pgm, "pgm", "PGM", &[b"P2\n", b"P2 ", b"P2\r", b"P5\n", b"P5 ", b"P5\r", b"P5\t"]),
    (Format::Hgt, "hgt", "SRTM heights", &[]),
];

impl Format {
    /// Returns whether the format can be read without the cargo feature `images`.
    #[cfg(feature = "images")]
    pub(super) fn is_basic(self) -> bool {
        matches!(self, Format::Png | Format::Npy)
    }

    /// Returns the format's name in lower case: `"png"`, `"npy"`, `"tiff"`, `"exr"`, `"pfm"`, `"npz"`, `"jpeg"`,
    /// `"webp"`, `"text"`, `"colmap"`, `"gif"`, `"bmp"`, `"pgm"` or `"hgt"`.
    pub fn name(self) -> &'static str {
        IMAGE_FORMATS[self as usize].1
    }

    /// Detects the format of an image file from the file's first bytes.
    pub fn detect(bytes: &[u8]) -> Option<Format> {
        (IMAGE_FORMATS.into_iter())
            .find(|(.., signatures)| signatures.iter().any(|magic| begins(bytes, magic)))
            .map(|(format, ..)| format)
            .or_else(|| is_array_archive(bytes).then_some(Format::Npz))
            .or_else(|| is_text_grid(bytes).then_some(Format::Text))
            .or_else(|| colmap_head(bytes).map(|_| Format::Colmap))
            .or_else(|| hgt_side(bytes).map(|_| Format::Hgt))
    }

    /// Returns the format that is stated for a file, if it was found there.
    #[cfg(feature = "formats")]
    pub(super) fn checked(self, found: Option<Format>) -> Result<Format> {
        if found == Some(self) {
            return Ok(self);
        }
        let name = found.map_or("a file of another format", Format::title);
        Err(in_format(self)(damaged(format!("it begins like {name}"))))
    }

    pub(super) fn title(self) -> &'static str {
        IMAGE_FORMATS[self as usize].2
    }
}

impl From<Format> for &'static str {
    /// Returns the title of the format in messages.
    fn from(format: Format) -> Self {
        format.title()
    }
}

impl FromStr for Format {
    type Err = Error;

    /// Parses the name of an image format, as [`Format::name`] returns it.
    fn from_str(name: &str) -> Result<Self> {
        IMAGE_FORMATS
            .into_iter()
            .find_map(|(format, known, ..)| (name == known).then_some(format))
            .ok_or_else(|| Error::option("format", name, FORMAT_NAMES))
    }
}

/// Permitted values of the option `format`, as they are listed in the error about a wrong value.
pub const FORMAT_NAMES: &str = "must be `png`, `npy`, `tiff`, `exr`, `pfm`, `npz`, `jpeg`, `webp`, `text`, `colmap`, `gif`, `bmp`, `pgm` or `hgt`";

/// Number of bytes before the name of the first file in a ZIP archive.
const ZIP_NAME_OFFSET: usize = 30;

/// Whether a file is a ZIP archive whose first file is an array of NumPy (`.npy`), or that has none.
fn is_array_archive(bytes: &[u8]) -> bool {
    let length = bytes
        .get(26..28)
        .map_or(0, |b| usize::from(u16::from_le_bytes([b[0], b[1]])));
    let name = bytes.get(ZIP_NAME_OFFSET..ZIP_NAME_OFFSET + length);
    bytes.starts_with(b"PK\x03\x04") && name.is_some_and(|name| name.ends_with(b".npy"))
        || bytes.starts_with(b"PK\x05\x06")
}

/// Width, height and number of channels in the head of a depth map of COLMAP, and the length of the head in bytes.
pub(super) fn colmap_head(bytes: &[u8]) -> Option<([usize; 3], usize)> {
    let mut numbers = [0; 3];
    let mut start = 0;
    for number in &mut numbers {
        let length = bytes[start..]
            .iter()
            .take(10)
            .position(|byte| *byte == b'&')?;
        let digits = std::str::from_utf8(&bytes[start..start + length]).ok()?;
        *number = digits.parse().ok()?;
        start += length + 1;
    }
    Some((numbers, start))
}

/// Numbers of pixels along a degree in the format of SRTM heights: every third second of arc, or every second.
const HGT_SIDES: [usize; 2] = [1201, 3601];

/// Number of pixels along the sides of SRTM heights, whose file has no header: by its length.
pub(super) fn hgt_side(bytes: &[u8]) -> Option<usize> {
    HGT_SIDES
        .into_iter()
        .find(|side| bytes.len() == 2 * side * side)
}

/// Number of bytes at the start of a file by which it is recognised as a grid of numbers in text.
const TEXT_GRID_HEAD_BYTES: usize = 1024;

/// Whether a file begins like a grid of numbers: with the head of an ESRI ASCII grid, or a line of two or more numbers
/// within its first lines, and no letters but those of a first line of names.
pub(super) fn is_text_grid(bytes: &[u8]) -> bool {
    // Up to the last number that is whole.
    let divides = |byte: &u8| byte.is_ascii_whitespace() || matches!(byte, b',' | b';');
    let head = match bytes.get(..TEXT_GRID_HEAD_BYTES) {
        Some(head) => &head[..head.iter().rposition(divides).unwrap_or(head.len())],
        None => bytes,
    };
    let head = decoded(head).replace('"', "");
    if head.contains(|letter: char| letter.is_control() && !"\t\r\n".contains(letter)) {
        return false;
    }
    let head = head.trim_start();
    if head.get(..5).is_some_and(|word| {
        word.eq_ignore_ascii_case("ncols") || word.eq_ignore_ascii_case("nrows")
    }) {
        return true;
    }
    let lines = head
        .lines()
        .filter(|line| !line.trim().is_empty() && !line.starts_with('#'));
    let is_number = |word: &str| number(&word.replace(',', ".")).is_some();
    let divides = |letter: char| letter.is_whitespace() || letter == ';';
    // A comma may divide numbers, or be a decimal one.
    lines.take(2).any(|line| {
        let words = || line.split(divides).filter(|word| !word.is_empty());
        words().count() > 1 && words().all(is_number)
            || line.contains(',')
                && line.contains(|letter: char| letter.is_ascii_digit())
                && (line.split(',').map(str::trim)).all(|word| word.is_empty() || is_number(word))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_and_first_bytes_name_the_format() {
        for (i, (format, name, ..)) in IMAGE_FORMATS.into_iter().enumerate() {
            assert_eq!((format as usize, format.name()), (i, name));
            assert_eq!(format.name().parse(), Ok(format));
            assert!(FORMAT_NAMES.contains(&format!("`{name}`")));
        }
        assert_eq!("PNG".parse::<Format>().unwrap_err().code(), "OPTION");
        assert_eq!(Format::detect(b"\x93NUMPY\x01\0"), Some(Format::Npy));
        assert_eq!(Format::detect(b"\x89PNG\n\x1a\n\0"), None);
    }
}

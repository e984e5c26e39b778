//! Height images and surfaces from and to files held in memory.
//!
//! Reads PNG and NPY ([`decode`]) and photos ([`decode_photo`]); writes NPY, 16-bit PNG, photos and
//! OBJ. Nothing here
//! touches a file system, so that all of it works in a browser too.
//!
//! Damaged files are errors, never panics, and no more memory is asked for than
//! the bytes that are there can fill.

mod npy;
mod obj;
mod photo;
mod png;

use std::io::{self, Write};
use std::str::FromStr;

use crate::error::{Error, Result};
use crate::heightfield::HeightImage;

pub use npy::write_npy;
pub use obj::{write_obj, write_obj_in};
pub use photo::{PhotoFile, decode_photo, write_photo};
pub use png::write_png;

/// A file format that can be read.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Format {
    /// Portable Network Graphics, grey, 1 to 16 bits.
    Png,
    /// NumPy's array file.
    Npy,
}

impl Format {
    /// `"png"` or `"npy"`.
    pub fn name(self) -> &'static str {
        match self {
            Format::Png => "png",
            Format::Npy => "npy",
        }
    }

    /// The format that a file's first bytes announce.
    pub fn detect(bytes: &[u8]) -> Option<Format> {
        [
            (&b"\x89PNG\r\n\x1a\n"[..], Format::Png),
            (b"\x93NUMPY", Format::Npy),
        ]
        .into_iter()
        .find_map(|(magic, format)| bytes.starts_with(magic).then_some(format))
    }

    fn title(self) -> &'static str {
        match self {
            Format::Png => "PNG",
            Format::Npy => "NPY",
        }
    }
}

impl FromStr for Format {
    type Err = Error;

    /// From [`Format::name`].
    fn from_str(name: &str) -> Result<Self> {
        match name {
            "png" => Ok(Format::Png),
            "npy" => Ok(Format::Npy),
            _ => Err(Error::option("format", name, "must be `png` or `npy`")),
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
    /// Side length of a pixel: recorded by [`write_png`], else 1.
    pub pixel_size: f64,
    /// Height of one step of the values. 1 for NPY; for PNG as recorded by
    /// [`write_png`], else a suggestion: the one that makes the full range from
    /// black to white a quarter of the image's longer side.
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
/// Costs `O(pixels)`.
///
/// # Errors
/// [`Error::Unsupported`] for other formats and contents, [`Error::Format`] for
/// a damaged file, [`Error::TooLarge`] above [`MAX_CELLS`](crate::MAX_CELLS)
/// pixels (before anything of that size is allocated), [`Error::Empty`] for an
/// array without elements.
pub fn decode(bytes: &[u8], format: Option<Format>) -> Result<Decoded> {
    if bytes.is_empty() {
        return Err(Error::Format {
            format: format.map_or("an image", Format::title),
            reason: "the file is empty".into(),
        });
    }
    match (format, Format::detect(bytes)) {
        (None | Some(Format::Png), Some(Format::Png)) => png::decode(bytes),
        (None | Some(Format::Npy), Some(Format::Npy)) => npy::decode(bytes),
        (None, None) => Err(Error::Unsupported {
            format: "this file",
            reason: format!("{} cannot be read, only PNG and NPY can", guess(bytes)),
        }),
        (Some(stated), _) => Err(Error::Format {
            format: stated.title(),
            reason: format!("it begins like {}", guess(bytes)),
        }),
    }
}

/// What a file seems to be, for messages only.
fn guess(bytes: &[u8]) -> &'static str {
    let known: [(&[u8], &str); 12] = [
        (b"\x89PNG\r\n\x1a\n", "a PNG file"),
        (b"\x93NUMPY", "an NPY file"),
        (b"\x89PNG", "a PNG file damaged in transfer"),
        (b"\xff\xd8\xff", "a JPEG file"),
        (b"II*\0", "a TIFF file"),
        (b"MM\0*", "a TIFF file"),
        (b"\x76\x2f\x31\x01", "an OpenEXR file"),
        (b"PK\x03\x04", "a zip archive (perhaps NPZ)"),
        (b"GIF8", "a GIF file"),
        (b"RIFF", "a RIFF file (perhaps WebP)"),
        (b"%PDF", "a PDF file"),
        (b"BM", "a BMP file"),
    ];
    known
        .iter()
        .find(|(magic, _)| bytes.starts_with(magic))
        .map_or("a file of unknown format", |(_, name)| name)
}

/// A growing file in memory, whose lack of memory is an error instead of an abort.
#[derive(Default)]
struct Buffer(Vec<u8>);

impl Write for Buffer {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0
            .try_reserve(bytes.len())
            .map_err(|_| io::ErrorKind::OutOfMemory)?;
        self.0.extend_from_slice(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

impl Buffer {
    /// The finished file. Writing into memory can fail for lack of memory only.
    fn finish(self, what: &'static str, written: io::Result<()>) -> Result<Vec<u8>> {
        match written {
            Ok(()) => Ok(self.0),
            Err(_) => Err(Error::OutOfMemory {
                what,
                bytes: self.0.len(),
            }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_and_first_bytes_name_the_format() {
        for format in [Format::Png, Format::Npy] {
            assert_eq!(format.name().parse(), Ok(format));
        }
        assert_eq!("PNG".parse::<Format>().unwrap_err().code(), "OPTION");
        assert_eq!(Format::detect(b"\x93NUMPY\x01\0"), Some(Format::Npy));
        assert_eq!(Format::detect(b"\x89PNG\n\x1a\n\0"), None);
    }

    #[test]
    fn other_files_are_named_in_the_error() {
        let message = |bytes: &[u8], format| decode(bytes, format).unwrap_err().to_string();
        assert!(message(b"\xff\xd8\xff\xe0....", None).contains("JPEG"));
        assert!(message(b"PK\x03\x04....", None).contains("NPZ"));
        assert!(message(b"\x93NUMPY....", Some(Format::Png)).contains("begins like an NPY"));
        assert!(message(b"", None).contains("empty"));
        assert_eq!(decode(b"hello", None).unwrap_err().code(), "UNSUPPORTED");
        assert_eq!(decode(b"", None).unwrap_err().code(), "FORMAT");
    }
}

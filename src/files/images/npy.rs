//! Reads and writes NumPy's file of one array (NPY): a line of text about the array, then its numbers.

use std::io::{self, Write};

use super::decoded::StoredImage;
use super::orientation::{TRANSPOSED_ORIENTATION, oriented};
use super::raw_pixels::raw_pixels;
use crate::error::{Error, Result, check_shape};
use crate::files::buffer::Buffer;
use crate::files::failure::{damaged, not_read};
use crate::files::number_type::NumberType;
use crate::files::table::{MAX_POINT_NUMBERS, MIN_CLOUD_LINES_PER_COLUMN};

/// Maximum length of the header of an NPY file, in bytes; NumPy has the same limit.
const MAX_HEADER_BYTES: usize = 10_000;

/// Number of bytes at a multiple of which the numbers begin, so that NumPy can map the file into memory.
const ALIGNMENT: usize = 64;

pub(super) fn decode(bytes: &[u8]) -> Result<StoredImage> {
    let (header, stored) = Header::read(bytes)?;
    let (height, width) = rows_and_columns(&header.shape).ok_or_else(|| {
        not_read(format!(
            "an array of shape {:?}; only two-dimensional arrays (rows, columns) are read",
            header.shape
        ))
    })?;
    if (3..=MAX_POINT_NUMBERS).contains(&width) && height >= MIN_CLOUD_LINES_PER_COLUMN * width {
        return Err(not_read(format!(
            "an array of {height} × {width}, which are points and no image; `numpy.savetxt('points.xyz', array)` writes a file that is \
             read"
        )));
    }
    let descr = header.descr;
    if descr.starts_with('[') {
        return Err(not_read(
            "an array of records; only arrays of plain numbers are read",
        ));
    }
    let number_type = header.number_type().ok_or_else(|| {
        not_read(format!(
            "values of type {descr}; booleans, integers and floats of 16, 32 or 64 bits are read"
        ))
    })?;
    // Of an array that is stored column by column, these are the rows.
    let size = if header.by_columns {
        (height, width)
    } else {
        (width, height)
    };
    let mut values = raw_pixels(size, stored, number_type, descr.starts_with('>'))?;
    if header.by_columns {
        (values, _) = oriented(values, size, TRANSPOSED_ORIENTATION)?;
    }
    Ok(StoredImage {
        height_scale: Some(1.0),
        ..StoredImage::new((width, height), values, number_type)
    })
}

/// Reads shape and number type of an NPY file's array; the file may end after the header.
#[cfg(feature = "images")]
pub(super) fn describe(bytes: &[u8]) -> Result<(Vec<u64>, String)> {
    use crate::files::image_format::Format;
    if Format::detect(bytes) != Some(Format::Npy) {
        return Err(damaged("it does not begin like an NPY file"));
    }
    let (header, _) = Header::read(bytes)?;
    let data_type = header
        .number_type()
        .map_or(header.descr, |known| known.name());
    Ok((header.shape.clone(), data_type.into()))
}

/// What the header of an NPY file says, a literal of Python: `{'descr': '<f8', 'fortran_order': False, 'shape': (3, 4), }`.
struct Header<'a> {
    /// Byte order, kind and size of the numbers; for records a list.
    descr: &'a str,
    /// Whether the numbers are stored column by column.
    by_columns: bool,
    shape: Vec<u64>,
}

impl<'a> Header<'a> {
    /// Reads the header at the start of a file. Returns it and the bytes after it.
    fn read(bytes: &'a [u8]) -> Result<(Self, &'a [u8])> {
        let cut = || damaged("it is cut short within its header");
        let at = |i: usize| bytes.get(i).copied().map(usize::from).ok_or_else(cut);
        let (begin, length) = match at(6)? {
            1 => (10, at(8)? | at(9)? << 8),
            2 | 3 => (12, at(8)? | at(9)? << 8 | at(10)? << 16 | at(11)? << 24),
            other => {
                return Err(not_read(format!(
                    "version {other} of the format; versions 1 to 3 are read"
                )));
            }
        };
        if length > MAX_HEADER_BYTES {
            return Err(damaged(format!(
                "its header claims {length} bytes, where {MAX_HEADER_BYTES} are the most"
            )));
        }
        let text = bytes.get(begin..begin + length).ok_or_else(cut)?;
        let text = str::from_utf8(text).map_err(|_| damaged("its header is no text"))?;
        let entry = |key: &str| {
            let (_, value) = text.split_once(&format!("'{key}':"))?;
            Some(value.trim_start())
        };
        let missing = |key: &str| damaged(format!("its header has no valid `{key}`"));

        let descr = entry("descr").and_then(|value| match value.strip_prefix('\'') {
            Some(quoted) => quoted.split('\'').next(),
            // A list of the fields of a record, which ends where the next entry begins.
            None => value.starts_with('[').then(|| {
                let end = value.find("'fortran_order'").unwrap_or(value.len());
                value[..end].trim_end_matches([' ', ','])
            }),
        });
        let order = entry("fortran_order").and_then(|value| {
            let word = value.split([',', '}']).next()?;
            word.trim().to_ascii_lowercase().parse().ok()
        });
        let listed = entry("shape")
            .and_then(|value| value.strip_prefix('(')?.split_once(')'))
            .ok_or_else(|| missing("shape"))?
            .0;
        let shape = listed.split(',').map(str::trim).filter(|n| !n.is_empty());
        Ok((
            Header {
                descr: descr.ok_or_else(|| missing("descr"))?,
                by_columns: order.ok_or_else(|| missing("fortran_order"))?,
                shape: shape.map(extent).collect::<Result<_>>()?,
            },
            &bytes[begin + length..],
        ))
    }

    /// Type of the numbers, if they are read.
    fn number_type(&self) -> Option<NumberType> {
        let plain = self.descr.trim_start_matches(['<', '>', '=', '|']);
        let [kind, digit] = *plain.as_bytes() else {
            return None;
        };
        NumberType::from_numpy(kind, usize::from(digit.wrapping_sub(b'0')))
    }
}

/// Numbers of rows and columns of an array, without axes of length 1 before and after those two.
pub(super) fn rows_and_columns(shape: &[u64]) -> Option<(usize, usize)> {
    let mut axes = shape;
    while axes.len() > 2 {
        axes = match axes {
            [rest @ .., 1] | [1, rest @ ..] => rest,
            _ => return None,
        };
    }
    let [rows, cols] = *axes else { return None };
    let bounded = |n: u64| usize::try_from(n).unwrap_or(usize::MAX);
    Some((bounded(rows), bounded(cols)))
}

/// Parses one extent of a shape; Python 2 wrote an `L` after it.
fn extent(number: &str) -> Result<u64> {
    let digits = number.trim_end_matches('L');
    if digits.is_empty() || !digits.bytes().all(|b| b.is_ascii_digit()) {
        return Err(damaged(format!("its shape has the extent `{number}`")));
    }
    digits.parse().map_err(|_| Error::TooLarge {
        what: "NPY array",
        requested: usize::MAX,
        limit: crate::MAX_CELLS,
    })
}

/// Writes `rows` rows of `cols` values as an NPY file of 64-bit floats in C order: heights of an image or of a lattice,
/// NaN where there is no height. Exact.
///
/// # Errors
/// [`Error::Empty`] without rows or columns, [`Error::Shape`] if there are not
/// `rows · cols` values, [`Error::OutOfMemory`].
pub fn write_npy(rows: usize, cols: usize, values: &[f64]) -> Result<Vec<u8>> {
    let what = "NPY array";
    if rows == 0 || cols == 0 {
        return Err(Error::Empty { what });
    }
    check_shape(what, rows, cols, values.len())?;
    let mut file = Buffer::default();
    let written = write(&mut file, rows, cols, values);
    file.finish("NPY file", written)
}

fn write(file: &mut Buffer, rows: usize, cols: usize, values: &[f64]) -> io::Result<()> {
    let header = format!("{{'descr': '<f8', 'fortran_order': False, 'shape': ({rows}, {cols}), }}");
    let before = b"\x93NUMPY\x01\0".len() + 2;
    let length = (before + header.len() + 1).next_multiple_of(ALIGNMENT) - before;
    file.write_all(b"\x93NUMPY\x01\0")?;
    file.write_all(&(length as u16).to_le_bytes())?;
    writeln!(file, "{header:<0$}", length - 1)?;
    for value in values {
        file.write_all(&value.to_le_bytes())?;
    }
    Ok(())
}

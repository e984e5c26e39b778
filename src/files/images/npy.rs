//! Reads and writes NumPy's file of one array (NPY) by the `npyz` crate.

use std::io;

use npyz::{DType, Deserialize, NpyFile, NpyHeader, Order, TypeChar, WriteOptions, WriterBuilder};

use super::decoded::Decoded;
use super::format::Format;
use crate::error::{Error, Result, check_shape, checked_cells, try_filled};
use crate::files::buffer::Buffer;

/// Maximum length of the header of an NPY file, in bytes; NumPy has the same limit.
const MAX_HEADER_BYTES: usize = 10_000;

/// Maximum number of brackets in the header of an NPY file: a plain array has 2, `{` and `(`. The parser recurses
/// on brackets, so that this also bounds the parser's use of the stack.
const MAX_HEADER_BRACKETS: usize = 8;

/// Maximum number of digits in the header of an NPY file, so that no product of the sizes in the header overflows
/// 64 bits.
const MAX_HEADER_DIGITS: usize = 19;

pub(super) fn decode(bytes: &[u8]) -> Result<Decoded> {
    let start = check_header(bytes)?;
    let header = NpyHeader::from_reader(&bytes[..start]).map_err(|e| damaged(e.to_string()))?;

    let (height, width) = match *header.shape() {
        [rows, cols] | [rows, cols, 1] => (rows, cols),
        _ => {
            return Err(unsupported(format!(
                "an array of shape {:?}; only two-dimensional arrays (rows, columns) are read",
                header.shape()
            )));
        }
    };
    let bounded = |n: u64| usize::try_from(n).unwrap_or(usize::MAX);
    let (height, width) = (bounded(height), bounded(width));
    let len = checked_cells("NPY array", height, width)?;
    if len == 0 {
        return Err(Error::Empty { what: "NPY array" });
    }

    let descr = header.dtype().descr();
    let plain = match header.dtype() {
        DType::Plain(plain) => (plain.type_char(), plain.size_field()),
        _ => {
            return Err(unsupported(
                "an array of records; only arrays of plain numbers are read".into(),
            ));
        }
    };
    let needed = len.saturating_mul(bounded(plain.1));
    let present = bytes.len() - start;
    if !matches!(plain.0, TypeChar::Object | TypeChar::UnicodeStr) && present < needed {
        return Err(damaged(format!(
            "it is cut short: {height} × {width} values of type {descr} take {needed} bytes, \
             {present} are there"
        )));
    }

    let order = header.order();
    let file = NpyFile::with_header(header, &bytes[start..]);
    let (data_type, stored) = match plain {
        (TypeChar::Bool, 1) => ("bool", read(file, |v: bool| f64::from(u8::from(v)))),
        (TypeChar::Int, 1) => ("i8", read(file, |v: i8| v.into())),
        (TypeChar::Int, 2) => ("i16", read(file, |v: i16| v.into())),
        (TypeChar::Int, 4) => ("i32", read(file, |v: i32| v.into())),
        (TypeChar::Int, 8) => ("i64", read(file, |v: i64| v as f64)),
        (TypeChar::Uint, 1) => ("u8", read(file, |v: u8| v.into())),
        (TypeChar::Uint, 2) => ("u16", read(file, |v: u16| v.into())),
        (TypeChar::Uint, 4) => ("u32", read(file, |v: u32| v.into())),
        (TypeChar::Uint, 8) => ("u64", read(file, |v: u64| v as f64)),
        (TypeChar::Float, 2) => ("f16", read(file, |v: npyz::half::f16| v.into())),
        (TypeChar::Float, 4) => ("f32", read(file, |v: f32| v.into())),
        (TypeChar::Float, 8) => ("f64", read(file, |v: f64| v)),
        _ => return Err(unsupported_type(&descr)),
    };
    let mut values = stored?;
    if order == Order::Fortran {
        let mut rows = try_filled("NPY array", len, 0.0)?;
        for (i, z) in rows.iter_mut().enumerate() {
            *z = values[(i % width) * height + i / width];
        }
        values = rows;
    }
    Ok(Decoded {
        format: Format::Npy,
        width,
        height,
        values,
        pixel_size: 1.0,
        unit: None,
        height_scale: 1.0,
        data_type,
        georeference: None,
        assumptions: Vec::new(),
    })
}

/// Reads shape and number type of an NPY file's array; the file may end after the header.
#[cfg(feature = "images")]
pub(super) fn describe(bytes: &[u8]) -> Result<(Vec<u64>, String)> {
    if Format::detect(bytes) != Some(Format::Npy) {
        return Err(damaged("it does not begin like an NPY file".into()));
    }
    let start = check_header(bytes)?;
    let header = NpyHeader::from_reader(&bytes[..start]).map_err(|e| damaged(e.to_string()))?;
    let data_type = match header.dtype() {
        DType::Plain(plain) => {
            let bits = plain.size_field().saturating_mul(8);
            match plain.type_char() {
                TypeChar::Bool => "bool".into(),
                TypeChar::Int => format!("i{bits}"),
                TypeChar::Uint => format!("u{bits}"),
                TypeChar::Float => format!("f{bits}"),
                _ => header.dtype().descr().trim_matches('\'').into(),
            }
        }
        other => other.descr(),
    };
    Ok((header.shape().to_vec(), data_type))
}

/// Checks that the header of an NPY file is safe to parse. Returns the offset of the data.
///
/// The parser allocates as much as the header states, multiplies sizes unchecked and recurses on brackets; crafted
/// files must not exploit that.
fn check_header(bytes: &[u8]) -> Result<usize> {
    let cut = || damaged("it is cut short within its header".into());
    let at = |i: usize| bytes.get(i).copied().map(usize::from).ok_or_else(cut);
    let (begin, length) = match at(6)? {
        1 => (10, at(8)? | at(9)? << 8),
        2 | 3 => (12, at(8)? | at(9)? << 8 | at(10)? << 16 | at(11)? << 24),
        other => {
            return Err(unsupported(format!(
                "version {other} of the format; versions 1 to 3 are read"
            )));
        }
    };
    if length > MAX_HEADER_BYTES {
        return Err(damaged(format!(
            "its header claims {length} bytes, where {MAX_HEADER_BYTES} are the most"
        )));
    }
    let header = bytes.get(begin..begin + length).ok_or_else(cut)?;
    let count = |of: &dyn Fn(u8) -> bool| header.iter().filter(|b| of(**b)).count();
    if count(&|b| b"([{".contains(&b)) > MAX_HEADER_BRACKETS {
        return Err(unsupported(
            "an array of structures; only arrays of plain numbers are read".into(),
        ));
    }
    if count(&|b| b.is_ascii_digit()) > MAX_HEADER_DIGITS {
        return Err(Error::TooLarge {
            what: "NPY array",
            requested: usize::MAX,
            limit: crate::MAX_CELLS,
        });
    }
    Ok(begin + length)
}

/// Reads all values of an NPY file in their stored order.
fn read<T: Deserialize>(file: NpyFile<&[u8]>, convert: impl Fn(T) -> f64) -> Result<Vec<f64>> {
    let mut values = try_filled("NPY array", file.len() as usize, 0.0)?;
    let stored = file.data::<T>().map_err(|e| damaged(e.to_string()))?;
    for (z, v) in values.iter_mut().zip(stored) {
        *z = convert(v.map_err(|e| damaged(e.to_string()))?);
    }
    Ok(values)
}

fn damaged(reason: String) -> Error {
    Error::Format {
        format: "NPY",
        reason,
    }
}

fn unsupported(reason: String) -> Error {
    Error::Unsupported {
        format: "NPY",
        reason,
    }
}

fn unsupported_type(descr: &str) -> Error {
    unsupported(format!(
        "values of type {descr}; booleans, integers and floats of 16, 32 or 64 bits are read"
    ))
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
    let mut writer = WriteOptions::new()
        .default_dtype()
        .shape(&[rows as u64, cols as u64])
        .writer(file)
        .begin_nd()?;
    writer.extend(values.iter().copied())?;
    writer.finish()
}

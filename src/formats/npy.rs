//! NumPy's array file: its types and its writing by the `npyz` crate, its header
//! by hand. The crate reads headers with a grammar of all Python literals, which
//! would be half of the whole wasm file, and trusts the sizes in them.

use std::io;

use npyz::{DType, Deserialize, TypeChar, TypeRead, TypeStr, WriteOptions, WriterBuilder};

use super::{Buffer, Decoded, Format};
use crate::error::{Error, Result, checked_cells, try_filled};

pub(super) fn decode(bytes: &[u8]) -> Result<Decoded> {
    let (text, data) = split(bytes)?;
    let header = Header::parse(text)?;

    let (height, width) = match *header.shape {
        [rows, cols] | [rows, cols, 1] => (rows, cols),
        _ => {
            return Err(unsupported(format!(
                "an array of shape {:?}; only two-dimensional arrays (rows, columns) are read",
                header.shape
            )));
        }
    };
    let len = checked_cells("NPY array", height, width)?;
    if len == 0 {
        return Err(Error::Empty { what: "NPY array" });
    }

    let array = Array {
        header: &header,
        data,
        len,
    };
    let (data_type, stored) = match (header.plain.type_char(), header.plain.size_field()) {
        (TypeChar::Bool, 1) => ("bool", array.read(|v: bool| f64::from(u8::from(v)))),
        (TypeChar::Int, 1) => ("i8", array.read(|v: i8| v.into())),
        (TypeChar::Int, 2) => ("i16", array.read(|v: i16| v.into())),
        (TypeChar::Int, 4) => ("i32", array.read(|v: i32| v.into())),
        (TypeChar::Int, 8) => ("i64", array.read(|v: i64| v as f64)),
        (TypeChar::Uint, 1) => ("u8", array.read(|v: u8| v.into())),
        (TypeChar::Uint, 2) => ("u16", array.read(|v: u16| v.into())),
        (TypeChar::Uint, 4) => ("u32", array.read(|v: u32| v.into())),
        (TypeChar::Uint, 8) => ("u64", array.read(|v: u64| v as f64)),
        (TypeChar::Float, 2) => ("f16", array.read(|v: npyz::half::f16| v.into())),
        (TypeChar::Float, 4) => ("f32", array.read(|v: f32| v.into())),
        (TypeChar::Float, 8) => ("f64", array.read(|v: f64| v)),
        _ => return Err(unsupported_type(&header.plain.to_string())),
    };
    let mut values = stored?;
    if header.fortran_order {
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
        height_scale: 1.0,
        data_type,
    })
}

/// The header's text and the data behind it.
fn split(bytes: &[u8]) -> Result<(&str, &[u8])> {
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
    let (header, data) = bytes[begin..].split_at_checked(length).ok_or_else(cut)?;
    let text = str::from_utf8(header).map_err(|_| damaged("its header is no text".into()))?;
    Ok((text, data))
}

/// `{'descr': '<f8', 'fortran_order': False, 'shape': (3, 4), }`, its entries in any order.
#[derive(Debug)]
struct Header {
    plain: TypeStr,
    fortran_order: bool,
    shape: Vec<usize>,
}

impl Header {
    fn parse(text: &str) -> Result<Self> {
        let (mut plain, mut fortran_order, mut shape) = (None, None, None);
        let mut rest = Cursor(text);
        let bad = |rest: &Cursor| {
            let start: String = rest.0.trim_start().chars().take(20).collect();
            damaged(format!("its header is unreadable from `{start}` on"))
        };
        if !rest.eat("{") {
            return Err(bad(&rest));
        }
        while !rest.eat("}") {
            let key = rest.quoted().filter(|_| rest.eat(":"));
            let value = match key {
                Some("descr") if rest.eat("[") => {
                    return Err(unsupported(
                        "an array of records; only arrays of plain numbers are read".into(),
                    ));
                }
                Some("descr") => rest.quoted().map(|descr| plain = Some(descr)),
                Some("fortran_order") => rest.boolean().map(|v| fortran_order = Some(v)),
                Some("shape") => rest.tuple().map(|v| shape = Some(v)),
                _ => None,
            };
            if value.is_none() || !(rest.eat(",") || rest.0.trim_start().starts_with('}')) {
                return Err(bad(&rest));
            }
        }
        match (plain, fortran_order, shape) {
            (Some(descr), Some(fortran_order), Some(shape)) => Ok(Header {
                plain: descr.parse().map_err(|_| unsupported_type(descr))?,
                fortran_order,
                shape,
            }),
            _ => Err(damaged(
                "its header lacks one of `descr`, `fortran_order` and `shape`".into(),
            )),
        }
    }
}

/// What is left of the header's text.
struct Cursor<'a>(&'a str);

impl<'a> Cursor<'a> {
    /// Takes `token`, and white space before it, if it comes next.
    fn eat(&mut self, token: &str) -> bool {
        let rest = self.0.trim_start().strip_prefix(token);
        self.0 = rest.unwrap_or(self.0);
        rest.is_some()
    }

    fn quoted(&mut self) -> Option<&'a str> {
        let quote = ["'", "\""].into_iter().find(|quote| self.eat(quote))?;
        let (text, rest) = self.0.split_once(quote)?;
        self.0 = rest;
        Some(text)
    }

    fn boolean(&mut self) -> Option<bool> {
        (self.eat("True").then_some(true)).or_else(|| self.eat("False").then_some(false))
    }

    /// `()`, `(3,)`, `(3, 4)`; numbers too large for memory become the largest one.
    fn tuple(&mut self) -> Option<Vec<usize>> {
        let mut numbers = Vec::new();
        let mut open = self.eat("(");
        while open && !self.eat(")") {
            let rest = self.0.trim_start();
            let end = rest.find(|c: char| !c.is_ascii_digit())?;
            let (digits, rest) = rest.split_at(end);
            (!digits.is_empty()).then_some(())?;
            numbers.push(digits.parse().unwrap_or(usize::MAX));
            self.0 = rest;
            self.eat("L"); // Python 2's long integers
            open = self.eat(",") || self.0.trim_start().starts_with(')');
        }
        open.then_some(numbers)
    }
}

/// An array's elements, not decoded yet.
struct Array<'a> {
    header: &'a Header,
    data: &'a [u8],
    len: usize,
}

impl Array<'_> {
    /// All values in their stored order.
    fn read<T: Deserialize>(&self, convert: impl Fn(T) -> f64) -> Result<Vec<f64>> {
        let needed = self.len.saturating_mul(size_of::<T>());
        let (mut data, present) = (self.data, self.data.len());
        if present < needed {
            return Err(damaged(format!(
                "it is cut short: {} values of type {} take {needed} bytes, {present} are there",
                self.len, self.header.plain
            )));
        }
        let reader = T::reader(&DType::Plain(self.header.plain.clone()))
            .map_err(|e| damaged(e.to_string()))?;
        let mut values = try_filled("NPY array", self.len, 0.0)?;
        for z in &mut values {
            *z = convert(
                reader
                    .read_one(&mut data)
                    .map_err(|e| damaged(e.to_string()))?,
            );
        }
        Ok(values)
    }
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

/// An NPY file of 64-bit floats in C order from `rows` rows of `cols` values:
/// heights of an image or of a lattice, NaN where there is none. Exact.
///
/// # Errors
/// [`Error::Empty`] without rows or columns, [`Error::Shape`] if there are not
/// `rows · cols` values, [`Error::OutOfMemory`].
pub fn write_npy(rows: usize, cols: usize, values: &[f64]) -> Result<Vec<u8>> {
    let what = "NPY array";
    if rows == 0 || cols == 0 {
        return Err(Error::Empty { what });
    }
    let expected = checked_cells(what, rows, cols)?;
    if values.len() != expected {
        return Err(Error::Shape {
            what,
            rows,
            cols,
            expected,
            found: values.len(),
        });
    }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn headers_of_any_layout_are_read() {
        for text in [
            "{'descr': '<f8', 'fortran_order': False, 'shape': (3, 4), }   \n",
            "{\"shape\":(3L,4L),\"descr\":\"<f8\",\"fortran_order\":False}",
            " { 'fortran_order' : False , 'descr' : '<f8' , 'shape' : ( 3 , 4 , ) } ",
        ] {
            let header = Header::parse(text).unwrap();
            assert_eq!(header.shape, [3, 4]);
            assert_eq!(header.plain.to_string(), "<f8");
            assert!(!header.fortran_order);
        }
    }

    #[test]
    fn broken_headers_are_errors() {
        for text in [
            "",
            "{",
            "{}",
            "{'descr'",
            "{'descr': '<f8', 'fortran_order': False, 'shape': (3, 4)",
            "{'descr': '<f8', 'fortran_order': False, 'shape': (3, 4}",
            "{'descr': '<f8', 'fortran_order': False, 'shape': (3 4)}",
            "{'descr': '<f8', 'fortran_order': False, 'shape': (,)}",
            "{'descr': '<f8', 'fortran_order': False, 'shape': (3, -4)}",
            "{'descr': '<f8', 'fortran_order': 0, 'shape': (3, 4)}",
            "{'descr': '<f8' 'fortran_order': False, 'shape': (3, 4)}",
            "{'descr': '<f8', 'fortran_order': False, 'other': (3, 4)}",
            "{'descr': '<f8', 'fortran_order': False}",
        ] {
            assert_eq!(Header::parse(text).unwrap_err().code(), "FORMAT", "{text}");
        }
        let strange = "{'descr': 'é8', 'fortran_order': False, 'shape': (3, 4)}";
        assert_eq!(Header::parse(strange).unwrap_err().code(), "UNSUPPORTED");
    }
}

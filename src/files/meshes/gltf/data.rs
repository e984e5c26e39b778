//! Reads the numbers and the embedded bytes that a glTF file refers to.

use std::borrow::Cow;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;

use super::json::{Accessor, Root};
use crate::error::{MAX_CELLS, Result, try_filled};
use crate::files::meshes::builder::{damaged, unsupported};

/// Name of the glTF format in error messages.
pub(super) const FORMAT_NAME: &str = "glTF";

/// Decodes the bytes that a `data:` address in a glTF file contains; `None` for another kind of address.
pub(super) fn embedded(uri: &str) -> Result<Option<Vec<u8>>> {
    let Some(data) = uri.strip_prefix("data:") else {
        return Ok(None);
    };
    let Some((_, data)) = data.split_once(";base64,") else {
        return Err(damaged(FORMAT_NAME, "embedded data are not in base64"));
    };
    let bytes = STANDARD
        .decode(data)
        .map_err(|error| damaged(FORMAT_NAME, error))?;
    Ok(Some(bytes))
}

/// Decodes percent-encoded characters, such as blanks, in the name of a file that a glTF file refers to.
pub(super) fn plain(uri: &str) -> String {
    let mut bytes = Vec::with_capacity(uri.len());
    let mut rest = uri.as_bytes();
    while let [first, tail @ ..] = rest {
        let code = tail.get(..2).filter(|_| *first == b'%');
        let code = code.and_then(|digits| std::str::from_utf8(digits).ok());
        match code.and_then(|digits| u8::from_str_radix(digits, 16).ok()) {
            Some(byte) => {
                bytes.push(byte);
                rest = &tail[2..];
            }
            None => {
                bytes.push(*first);
                rest = tail;
            }
        }
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

/// The numbers and bytes that a glTF file refers to: its text part, and the bytes of its buffers.
pub(super) struct Data<'a> {
    pub(super) root: &'a Root,
    pub(super) buffers: &'a [Cow<'a, [u8]>],
}

/// Bytes of an array's elements, and from each one to the next.
struct Elements<'a> {
    bytes: &'a [u8],
    stride: usize,
}

impl Data<'_> {
    /// Reads the first `N` components of each element of an accessor (a typed array) as floats; normalised integers
    /// become shares of their type's maximum. What the accessor states apart (sparse) is put in its place.
    pub(super) fn floats<const N: usize>(&self, number: usize) -> Result<Vec<[f64; N]>> {
        let accessor = self.accessor(number)?;
        let kind = accessor.component_type;
        let components = components(&accessor.dimensions).unwrap_or(0);
        if components < N {
            return Err(damaged(FORMAT_NAME, "an attribute has too few components"));
        }
        let width = width(kind)?;
        let element = |bytes: &[u8]| -> [f64; N] {
            std::array::from_fn(|k| component(kind, accessor.normalized, &bytes[k * width..]))
        };
        let size = width * components;
        let mut values = match accessor.buffer_view {
            Some(view) => {
                let found =
                    self.elements(view, accessor.byte_offset, accessor.count, size, true)?;
                found.bytes.chunks(found.stride).map(element).collect()
            }
            None if accessor.count <= MAX_CELLS => try_filled("mesh", accessor.count, [0.0; N])?,
            None => return Err(damaged(FORMAT_NAME, "an accessor has too many elements")),
        };
        if let Some(sparse) = &accessor.sparse {
            let (at, new) = (&sparse.indices, &sparse.values);
            let wide = self::width(at.component_type)?;
            let places =
                self.elements(at.buffer_view, at.byte_offset, sparse.count, wide, false)?;
            let news =
                self.elements(new.buffer_view, new.byte_offset, sparse.count, size, false)?;
            let places = places.bytes.chunks(wide);
            for (place, bytes) in places.zip(news.bytes.chunks(size)) {
                let place = component(at.component_type, false, place) as usize;
                *(values.get_mut(place))
                    .ok_or_else(|| damaged(FORMAT_NAME, "a sparse accessor has a wrong index"))? =
                    element(bytes);
            }
        }
        Ok(values)
    }

    /// Reads the indices that an accessor has.
    pub(super) fn whole(&self, number: usize) -> Result<Vec<u32>> {
        let accessor = self.accessor(number)?;
        let whole = matches!(
            accessor.component_type,
            UNSIGNED_BYTE | UNSIGNED_SHORT | UNSIGNED_INT
        );
        if !whole || components(&accessor.dimensions) != Some(1) {
            return Err(damaged(FORMAT_NAME, "indices are not single whole numbers"));
        }
        let values = self.floats::<1>(number)?;
        Ok(values.iter().map(|[value]| *value as u32).collect())
    }

    fn accessor(&self, number: usize) -> Result<&Accessor> {
        let missing = || damaged(FORMAT_NAME, "an accessor that it names is not there");
        self.root.accessors.get(number).ok_or_else(missing)
    }

    /// Returns the bytes of a buffer view.
    pub(super) fn view(&self, number: usize) -> Option<&[u8]> {
        let view = self.root.buffer_views.get(number)?;
        let end = view.byte_offset.checked_add(view.byte_length)?;
        self.buffers.get(view.buffer)?.get(view.byte_offset..end)
    }

    /// Finds so many elements of a size in bytes in a buffer view; the view states how far they are from each other
    /// where `strided`.
    fn elements(
        &self,
        number: usize,
        offset: usize,
        count: usize,
        size: usize,
        strided: bool,
    ) -> Result<Elements<'_>> {
        let stride = || self.root.buffer_views.get(number)?.byte_stride;
        let stride = stride().filter(|_| strided).unwrap_or(size);
        let whole = || {
            let bytes = self.view(number)?.get(offset..)?;
            let last = count.checked_sub(1)?;
            let needed = last.checked_mul(stride)?.checked_add(size)?;
            (stride >= size).then_some(bytes.get(..needed)?)
        };
        let bytes = whole().ok_or_else(|| {
            damaged(
                FORMAT_NAME,
                "an accessor reaches beyond its buffer, which may have been cut short",
            )
        })?;
        Ok(Elements { bytes, stride })
    }
}

/// Codes of the types of components, as glTF has them.
const BYTE: u32 = 5120;
const UNSIGNED_BYTE: u32 = 5121;
const SHORT: u32 = 5122;
const UNSIGNED_SHORT: u32 = 5123;
const UNSIGNED_INT: u32 = 5125;
const FLOAT: u32 = 5126;

/// Returns the number of bytes of a component of a given type.
fn width(kind: u32) -> Result<usize> {
    match kind {
        BYTE | UNSIGNED_BYTE => Ok(1),
        SHORT | UNSIGNED_SHORT => Ok(2),
        UNSIGNED_INT | FLOAT => Ok(4),
        _ => Err(unsupported(FORMAT_NAME, "an attribute has an unusual type")),
    }
}

/// Reads a component from the beginning of some bytes, which must be long enough for its type; 0 where they are not.
fn component(kind: u32, normalized: bool, bytes: &[u8]) -> f64 {
    let (value, most) = match (kind, bytes) {
        (BYTE, [a, ..]) => (f64::from(i8::from_le_bytes([*a])), i8::MAX.into()),
        (UNSIGNED_BYTE, [a, ..]) => (f64::from(*a), u8::MAX.into()),
        (SHORT, [a, b, ..]) => (f64::from(i16::from_le_bytes([*a, *b])), i16::MAX.into()),
        (UNSIGNED_SHORT, [a, b, ..]) => (f64::from(u16::from_le_bytes([*a, *b])), u16::MAX.into()),
        (UNSIGNED_INT, [a, b, c, d, ..]) => (
            f64::from(u32::from_le_bytes([*a, *b, *c, *d])),
            u32::MAX.into(),
        ),
        (FLOAT, [a, b, c, d, ..]) => (f64::from(f32::from_le_bytes([*a, *b, *c, *d])), 1.0),
        _ => (0.0, 1.0),
    };
    match normalized {
        true => (value / most).max(-1.0), // the lowest integer lies below the range
        false => value,
    }
}

/// Returns the number of components of each element of a typed array.
fn components(dimensions: &str) -> Option<usize> {
    Some(match dimensions {
        "SCALAR" => 1,
        "VEC2" => 2,
        "VEC3" => 3,
        "VEC4" | "MAT2" => 4,
        "MAT3" => 9,
        "MAT4" => 16,
        _ => return None,
    })
}

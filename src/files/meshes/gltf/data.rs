//! Reads the numbers and the embedded bytes that a glTF file refers to.

use std::borrow::Cow;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use gltf::Accessor;
use gltf::accessor::{DataType, Dimensions};

use crate::error::Result;
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

/// Reads the first `N` components of each element of a glTF accessor (a typed array) as floats; integers become shares
/// of their type's maximum.
pub(super) fn floats<const N: usize>(
    accessor: &Accessor,
    buffers: &[Cow<[u8]>],
) -> Result<Vec<[f64; N]>> {
    let kind = accessor.data_type();
    let (width, components) = (kind.size(), count(accessor.dimensions()));
    if components < N {
        return Err(damaged(FORMAT_NAME, "an attribute has too few components"));
    }
    let component = |bytes: &[u8]| match (kind, bytes) {
        (DataType::F32, [a, b, c, d]) => Some(f64::from(f32::from_le_bytes([*a, *b, *c, *d]))),
        (DataType::U8, [a]) => Some(f64::from(*a) / f64::from(u8::MAX)),
        (DataType::U16, [a, b]) => {
            Some(f64::from(u16::from_le_bytes([*a, *b])) / f64::from(u16::MAX))
        }
        _ => None,
    };
    elements(accessor, buffers)?
        .map(|element| {
            let mut out = [0.0; N];
            for (out, bytes) in out.iter_mut().zip(element.chunks_exact(width)) {
                *out = component(bytes)
                    .ok_or_else(|| unsupported(FORMAT_NAME, "an attribute has an unusual type"))?;
            }
            Ok(out)
        })
        .collect()
}

pub(super) fn whole(accessor: &Accessor, buffers: &[Cow<[u8]>]) -> Result<Vec<u32>> {
    elements(accessor, buffers)?
        .map(|element| match (accessor.data_type(), element) {
            (DataType::U8, [a]) => Ok(u32::from(*a)),
            (DataType::U16, [a, b]) => Ok(u32::from(u16::from_le_bytes([*a, *b]))),
            (DataType::U32, [a, b, c, d]) => Ok(u32::from_le_bytes([*a, *b, *c, *d])),
            _ => Err(damaged(FORMAT_NAME, "indices are not single whole numbers")),
        })
        .collect()
}

fn count(dimensions: Dimensions) -> usize {
    match dimensions {
        Dimensions::Scalar => 1,
        Dimensions::Vec2 => 2,
        Dimensions::Vec3 => 3,
        Dimensions::Vec4 | Dimensions::Mat2 => 4,
        Dimensions::Mat3 => 9,
        Dimensions::Mat4 => 16,
    }
}

/// Returns the bytes of each element of a glTF accessor (a typed array).
fn elements<'a>(
    accessor: &Accessor,
    buffers: &'a [Cow<'a, [u8]>],
) -> Result<impl Iterator<Item = &'a [u8]>> {
    if accessor.sparse().is_some() {
        return Err(unsupported(FORMAT_NAME, "sparse accessors are not read"));
    }
    let Some(view) = accessor.view() else {
        return Err(unsupported(FORMAT_NAME, "an accessor has no buffer view"));
    };
    let size = accessor.data_type().size() * count(accessor.dimensions());
    let stride = view.stride().unwrap_or(size);
    let whole = || {
        let buffer = buffers.get(view.buffer().index())?;
        let view = buffer.get(view.offset()..view.offset().checked_add(view.length())?)?;
        let bytes = view.get(accessor.offset()..)?;
        let last = accessor.count().checked_sub(1)?;
        let needed = last.checked_mul(stride)?.checked_add(size)?;
        (stride >= size).then_some(bytes.get(..needed)?)
    };
    let bytes = whole().ok_or_else(|| {
        damaged(
            FORMAT_NAME,
            "an accessor reaches beyond its buffer, which may have been cut short",
        )
    })?;
    // The last one may be shorter than the stride.
    Ok(bytes.chunks(stride).map(move |element| &element[..size]))
}

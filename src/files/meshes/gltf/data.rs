//! Reads the numbers and the embedded bytes that a glTF file refers to.

use std::borrow::Cow;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde_json::Value;

use crate::error::{MAX_CELLS, Result, try_filled};
use crate::files::failure::{damaged, not_read, undecodable};
use crate::files::number_type::NumberType;

/// Decodes the bytes that a `data:` address in a glTF file contains; `None` for another kind of address.
pub(super) fn embedded(uri: &str) -> Result<Option<Vec<u8>>> {
    let Some(data) = uri.strip_prefix("data:") else {
        return Ok(None);
    };
    let Some((_, data)) = data.split_once(";base64,") else {
        return Err(damaged("embedded data are not in base64"));
    };
    let bytes = STANDARD.decode(data).map_err(undecodable)?;
    Ok(Some(bytes))
}

/// Returns a whole number of an object; `None` where it has none of this name.
pub(super) fn whole(object: &Value, name: &str) -> Option<usize> {
    usize::try_from(object[name].as_u64()?).ok()
}

/// Returns the elements of a list; none of what is no list.
pub(super) fn list(value: &Value) -> &[Value] {
    value.as_array().map_or(&[], Vec::as_slice)
}

/// Returns the first `N` numbers of a list; `None` where there are fewer.
pub(super) fn numbers<const N: usize>(value: &Value) -> Option<[f64; N]> {
    let mut found = [0.0; N];
    for (k, number) in found.iter_mut().enumerate() {
        *number = value.get(k)?.as_f64()?;
    }
    Some(found)
}

/// The numbers and bytes that a glTF file refers to: its text part, and the bytes of its buffers.
pub(super) struct Data<'a> {
    pub(super) root: &'a Value,
    pub(super) buffers: &'a [Cow<'a, [u8]>],
}

impl Data<'_> {
    /// Returns an element of a list of the text part.
    ///
    /// # Errors
    /// [`Error::Format`](crate::Error::Format) if it is not there.
    pub(super) fn element(&self, kind: &str, number: usize) -> Result<&Value> {
        let missing = || damaged(format!("number {number} of its {kind} is not there"));
        self.root[kind].get(number).ok_or_else(missing)
    }

    /// Reads the first `N` components of each element of an accessor (a typed array) as floats; normalised integers
    /// become shares of their type's maximum. What the accessor states apart (sparse) is put in its place.
    pub(super) fn floats<const N: usize>(&self, number: usize) -> Result<Vec<[f64; N]>> {
        let accessor = self.element("accessors", number)?;
        let kind = number_type(accessor)?;
        let components = components(accessor).unwrap_or(0);
        if components < N {
            return Err(damaged("an attribute has too few components"));
        }
        let is_normalized = accessor["normalized"] == true;
        let width = kind.bytes();
        let element = |bytes: &[u8]| -> [f64; N] {
            std::array::from_fn(|k| match kind.value(&bytes[k * width..], false) {
                // The lowest integer lies below the range.
                value if is_normalized => (value / kind.one()).max(-1.0),
                value => value,
            })
        };
        let size = width * components;
        let count = whole(accessor, "count").unwrap_or(0);
        let mut values = match whole(accessor, "bufferView") {
            Some(_) => {
                let (bytes, stride) = self.elements(accessor, count, size, true)?;
                bytes.chunks(stride).map(element).collect()
            }
            None if count <= MAX_CELLS => try_filled("mesh", count, [0.0; N])?,
            None => return Err(damaged("an accessor has too many elements")),
        };
        if let Some(sparse) = accessor.get("sparse") {
            let count = whole(sparse, "count").unwrap_or(0);
            let place_type = number_type(&sparse["indices"])?;
            let (places, wide) =
                self.elements(&sparse["indices"], count, place_type.bytes(), false)?;
            let (news, _) = self.elements(&sparse["values"], count, size, false)?;
            for (place, bytes) in places.chunks(wide).zip(news.chunks(size)) {
                let place = place_type.value(place, false) as usize;
                *(values.get_mut(place))
                    .ok_or_else(|| damaged("a sparse accessor has a wrong index"))? =
                    element(bytes);
            }
        }
        Ok(values)
    }

    /// Reads the indices that an accessor has.
    pub(super) fn indices(&self, number: usize) -> Result<Vec<u32>> {
        let accessor = self.element("accessors", number)?;
        let is_whole = matches!(
            number_type(accessor)?,
            NumberType::U8 | NumberType::U16 | NumberType::U32
        );
        if !is_whole || components(accessor) != Some(1) {
            return Err(damaged("indices are not single whole numbers"));
        }
        let values = self.floats::<1>(number)?;
        Ok(values.iter().map(|[value]| *value as u32).collect())
    }

    /// Returns the bytes of a buffer view.
    pub(super) fn view(&self, number: usize) -> Option<&[u8]> {
        let view = self.root["bufferViews"].get(number)?;
        let start = whole(view, "byteOffset").unwrap_or(0);
        let end = start.checked_add(whole(view, "byteLength")?)?;
        self.buffers.get(whole(view, "buffer")?)?.get(start..end)
    }

    /// Finds so many elements of a size in bytes in the buffer view that an array names; the view states how far they are from
    /// each other where `strided`. Returns their bytes, and the distance from each one to the next.
    fn elements(
        &self,
        array: &Value,
        count: usize,
        size: usize,
        strided: bool,
    ) -> Result<(&[u8], usize)> {
        let found = || {
            let number = whole(array, "bufferView")?;
            let stride = whole(self.root["bufferViews"].get(number)?, "byteStride");
            let stride = stride.filter(|_| strided).unwrap_or(size);
            let offset = whole(array, "byteOffset").unwrap_or(0);
            let bytes = self.view(number)?.get(offset..)?;
            let needed = count
                .checked_sub(1)?
                .checked_mul(stride)?
                .checked_add(size)?;
            (stride >= size).then_some((bytes.get(..needed)?, stride))
        };
        let reason = "an accessor reaches beyond its buffer, which may have been cut short";
        found().ok_or_else(|| damaged(reason))
    }
}

/// Returns the type of an array's components, which glTF gives as OpenGL's number.
fn number_type(array: &Value) -> Result<NumberType> {
    Ok(match whole(array, "componentType").unwrap_or(0) {
        5120 => NumberType::I8,
        5121 => NumberType::U8,
        5122 => NumberType::I16,
        5123 => NumberType::U16,
        5125 => NumberType::U32,
        5126 => NumberType::F32,
        _ => return Err(not_read("an attribute has an unusual type")),
    })
}

/// Returns the number of components of each element of a typed array.
fn components(accessor: &Value) -> Option<usize> {
    Some(match accessor["type"].as_str()? {
        "SCALAR" => 1,
        "VEC2" => 2,
        "VEC3" => 3,
        "VEC4" | "MAT2" => 4,
        "MAT3" => 9,
        "MAT4" => 16,
        _ => return None,
    })
}

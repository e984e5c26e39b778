//! Typed arrays of groups of numbers, in and out.

use js_sys::Float32Array;
use wasm_bindgen::prelude::*;

use super::Result;
use developable::Error;
use developable::checks::try_filled;

/// Groups of `N` numbers; nothing for what is no array.
pub fn groups<const N: usize>(values: &JsValue) -> Result<Option<Vec<[f32; N]>>> {
    let Some(values) = values.dyn_ref::<Float32Array>() else {
        return Ok(None);
    };
    let mut list = filled(values.length(), 0.0)?;
    values.copy_to(list.as_flattened_mut());
    Ok(Some(list))
}

/// Room for `length` numbers in groups, of which all have to be whole.
pub fn filled<T: Copy, const N: usize>(length: u32, value: T) -> Result<Vec<[T; N]>> {
    let length = length as usize;
    if !length.is_multiple_of(N) {
        return Err(Error::Shape {
            what: "positions or triangles of the mesh",
            rows: length / N,
            cols: N,
            expected: length - length % N,
            found: length,
        }
        .into());
    }
    Ok(try_filled("mesh", length / N, [value; N])?)
}

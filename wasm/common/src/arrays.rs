//! Conversion of JavaScript's typed arrays to lists of groups of numbers, such as the coordinates of points.

use js_sys::Float32Array;
use wasm_bindgen::prelude::*;

use super::Result;
use developable::Error;
use developable::checks::try_filled;

/// Reads a `Float32Array` as groups of `N` numbers; `None` if the value is not a `Float32Array`.
pub fn groups<const N: usize>(values: &JsValue) -> Result<Option<Vec<[f32; N]>>> {
    let Some(values) = values.dyn_ref::<Float32Array>() else {
        return Ok(None);
    };
    let mut list = filled(values.length(), 0.0)?;
    values.copy_to(list.as_flattened_mut());
    Ok(Some(list))
}

/// Makes a list of groups of `N` numbers, `length` numbers in all and each of them `value`, to copy a typed array into.
/// It is an error if `length` is not a multiple of `N`.
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

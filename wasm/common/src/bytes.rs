//! Copies of JavaScript's byte arrays, such as files and photos, in the wasm module's memory.

use js_sys::Uint8Array;

use super::Result;
use developable::checks::try_filled;

/// Copies the bytes of a JavaScript array to the wasm module's memory.
pub fn copied(bytes: &Uint8Array) -> Result<Vec<u8>> {
    let mut own = try_filled("input", bytes.length() as usize, 0)?;
    bytes.copy_to(&mut own);
    Ok(own)
}

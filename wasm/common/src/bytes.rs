//! The bytes of a file or a photo, in.

use js_sys::Uint8Array;

use super::Result;
use developable::checks::try_filled;

/// Copies bytes to the wasm module's memory.
pub fn copied(bytes: &Uint8Array) -> Result<Vec<u8>> {
    let mut own = try_filled("input", bytes.length() as usize, 0)?;
    bytes.copy_to(&mut own);
    Ok(own)
}

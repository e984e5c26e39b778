//! The bytes of a file, in.

use js_sys::Uint8Array;

use super::Result;
use crate::error::try_filled;

/// The bytes in the wasm's own memory.
pub(super) fn copied(bytes: &Uint8Array) -> Result<Vec<u8>> {
    let mut file = try_filled("file", bytes.length() as usize, 0)?;
    bytes.copy_to(&mut file);
    Ok(file)
}

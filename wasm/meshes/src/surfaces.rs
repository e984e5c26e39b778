//! Writing of heightfields and meshes to PLY, STL and GLB files.

use js_sys::Uint8Array;
use serde::Deserialize;
use serde_wasm_bindgen::preserve;
use wasm_bindgen::prelude::*;

use developable::files::meshes::{write_glb, write_ply, write_stl};
use developable_wasm::Result;
use developable_wasm::bytes::copied;
use developable_wasm::options::read;
use developable_wasm::triangulation::mesh_of;

/// Writes a heightfield or mesh to a PLY file, in the axes of its frame.
#[wasm_bindgen(js_name = writePly)]
pub fn write_ply_file(field: JsValue) -> Result<Uint8Array> {
    Ok(write_ply(&mesh_of(field)?)?.as_slice().into())
}

/// Writes a heightfield or mesh to an STL file, in the axes of its frame.
#[wasm_bindgen(js_name = writeStl)]
pub fn write_stl_file(field: JsValue) -> Result<Uint8Array> {
    Ok(write_stl(&mesh_of(field)?)?.as_slice().into())
}

/// Options of writing a GLB file: JavaScript's `WriteGlbOptions` object.
#[derive(Default, Deserialize)]
#[serde(default)]
struct GlbInput {
    /// Bytes of a PNG or JPEG file as a `Uint8Array`, as `asBytes` in `pkg/` has checked; `undefined` for none.
    #[serde(with = "preserve")]
    texture: JsValue,
}

/// Writes a heightfield or mesh to a GLB file, in the axes of its frame, with the image of the option `texture` if it
/// is given.
#[wasm_bindgen(js_name = writeGlb)]
pub fn write_glb_file(field: JsValue, options: JsValue) -> Result<Uint8Array> {
    let GlbInput { texture } = read(&options)?;
    let texture = texture.dyn_ref().map(copied).transpose()?;
    let file = write_glb(&mesh_of(field)?, texture.as_deref())?;
    Ok(file.as_slice().into())
}

//! Writing of heightfields and meshes to PLY, STL and GLB files.

use js_sys::Uint8Array;
use wasm_bindgen::prelude::*;

use developable::Error;
use developable::files::meshes::{write_glb, write_ply, write_stl};
use developable_wasm::Result;
use developable_wasm::bytes::copied;
use developable_wasm::options::{entries, unknown};
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

/// Writes a heightfield or mesh to a GLB file, in the axes of its frame, with the image of the option `texture` if it
/// is given.
#[wasm_bindgen(js_name = writeGlb)]
pub fn write_glb_file(field: JsValue, options: JsValue) -> Result<Uint8Array> {
    let mut texture = None;
    for (name, value) in entries(&options)? {
        match name.as_str() {
            "texture" => match value.dyn_ref::<Uint8Array>() {
                Some(bytes) => texture = Some(copied(bytes)?),
                None => {
                    let requirement = "must be the bytes of a PNG or JPEG file, as a Uint8Array";
                    return Err(Error::option("texture", "something else", requirement).into());
                }
            },
            _ => return Err(unknown(&name, "texture")),
        }
    }
    let file = write_glb(&mesh_of(field)?, texture.as_deref())?;
    Ok(file.as_slice().into())
}

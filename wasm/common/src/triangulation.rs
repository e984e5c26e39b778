//! Meshes of heightfields from JavaScript, for writing them to mesh files.

use js_sys::Reflect;
use serde::Deserialize;
use serde_wasm_bindgen::{from_value, preserve};
use wasm_bindgen::prelude::*;

use super::Result;
use super::arrays::groups;
use super::fields::LatticeInput;
use super::frame::FrameFields;
use super::mesh::MeshInput;
use developable::Mesh;
use developable::Triangulation;

/// Optional fields of JavaScript's `Heightfield` object that its mesh takes over: frame, colours and texture
/// coordinates.
#[derive(Deserialize)]
struct Extras {
    frame: Option<FrameFields>,
    #[serde(default, with = "preserve")]
    colors: JsValue,
    #[serde(default, with = "preserve")]
    uvs: JsValue,
}

/// Makes the mesh to be written: triangulates JavaScript's `Heightfield` object, in the axes of its frame, or reads a
/// `Mesh` object as it is.
pub fn mesh_of(field: JsValue) -> Result<Mesh> {
    if Reflect::has(&field, &"positions".into()).unwrap_or(false) {
        return from_value::<MeshInput>(field)?.into_mesh();
    }
    let extras = from_value::<Extras>(field.clone())?;
    let field = from_value::<LatticeInput>(field)?.into_heightfield()?;
    let frame = extras.frame.map(Into::into).unwrap_or_default();
    let mut triangulation = Triangulation::new(&field, &frame)?;
    if let Some(colors) = groups(&extras.colors)? {
        triangulation = triangulation.with_colors(&colors)?;
    }
    if let Some(uvs) = groups(&extras.uvs)? {
        triangulation = triangulation.with_uvs(&uvs)?;
    }
    Ok(triangulation.into_mesh())
}

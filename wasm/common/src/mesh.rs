//! Meshes read from JavaScript objects with typed arrays.

use js_sys::{Float64Array, Int32Array, Uint32Array};
use serde::Deserialize;
use serde_wasm_bindgen::preserve;
use wasm_bindgen::prelude::*;

use super::Result;
use super::arrays::{filled, groups};
use developable::Mesh;
use developable::checks::try_filled;

/// A mesh, read from JavaScript's `Mesh` object; `input.js` has checked that its arrays have these types.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct MeshInput {
    #[serde(with = "preserve")]
    positions: Float64Array,
    #[serde(with = "preserve")]
    triangles: Uint32Array,
    #[serde(default, with = "preserve")]
    colors: JsValue,
    #[serde(default, with = "preserve")]
    uvs: JsValue,
    #[serde(default, with = "preserve")]
    texture_of: JsValue,
    /// Confidence of each vertex as a `Float32Array`, or `undefined` if all are 1.
    #[serde(default, with = "preserve")]
    pub confidence: JsValue,
}

impl MeshInput {
    /// Copies the mesh's arrays from JavaScript to a [`Mesh`].
    pub fn into_mesh(self) -> Result<Mesh> {
        let mut positions = filled(self.positions.length(), 0.0)?;
        self.positions.copy_to(positions.as_flattened_mut());
        let mut triangles = filled(self.triangles.length(), 0)?;
        self.triangles.copy_to(triangles.as_flattened_mut());
        let mut mesh = if triangles.is_empty() {
            Mesh::cloud(positions)?
        } else {
            Mesh::new(positions, triangles)?
        };
        if let Some(colors) = groups(&self.colors)? {
            mesh = mesh.with_colors(colors)?;
        }
        if let Some(uvs) = groups(&self.uvs)? {
            mesh = mesh.with_uvs(uvs)?;
        }
        if let Some(numbers) = self.texture_of.dyn_ref::<Int32Array>() {
            let mut own = try_filled("mesh", numbers.length() as usize, 0)?;
            numbers.copy_to(&mut own);
            mesh = mesh.with_textures(own)?;
        }
        Ok(mesh)
    }
}

//! Meshes from files, and what is seen of them.

use js_sys::{Float32Array, Float64Array, Uint8Array, Uint32Array};
use serde::{Deserialize, Serialize};
use serde_wasm_bindgen::{from_value, preserve, to_value};
use wasm_bindgen::prelude::*;

use super::Result;
use super::arrays::{filled, groups};
use super::bytes::copied;
use super::frame::FrameFields;
use super::options::{entries, option, unknown};
use crate::error::Error;
use crate::mesh::Mesh;
use crate::meshes::{MeshFormat, read_mesh};
use crate::sampling::{Resolution, sample};
use crate::view::View;

/// `Mesh` of `types.d.ts`, on its way in; checked by `input.js` to have arrays of these types.
#[derive(Deserialize)]
struct MeshInput {
    #[serde(with = "preserve")]
    positions: Float64Array,
    #[serde(with = "preserve")]
    triangles: Uint32Array,
    #[serde(default, with = "preserve")]
    colors: JsValue,
    #[serde(default, with = "preserve")]
    uvs: JsValue,
}

/// `Mesh` of `types.d.ts`, on its way out.
#[derive(Serialize)]
struct MeshOutput {
    #[serde(with = "preserve")]
    positions: Float64Array,
    #[serde(with = "preserve")]
    triangles: Uint32Array,
    #[serde(with = "preserve")]
    colors: JsValue,
    #[serde(with = "preserve")]
    uvs: JsValue,
}

/// `SampledMesh` of `types.d.ts`.
#[derive(Serialize)]
struct SampledOutput {
    rows: usize,
    cols: usize,
    spacing: f64,
    origin: [f64; 2],
    #[serde(with = "preserve")]
    heights: Float64Array,
    frame: FrameFields,
    #[serde(with = "preserve")]
    colors: JsValue,
    #[serde(with = "preserve")]
    uvs: JsValue,
}

/// Decodes a mesh file.
#[wasm_bindgen(js_name = readMesh)]
pub fn read_mesh_file(bytes: &Uint8Array, options: JsValue) -> Result<JsValue> {
    let mut format = None;
    for (name, value) in entries(&options)? {
        match name.as_str() {
            "format" => {
                let requirement = "must be `obj`, `ply`, `stl`, `gltf` or `glb`";
                let name: String = option("format", value, requirement)?;
                format = Some(name.parse::<MeshFormat>()?);
            }
            _ => return Err(unknown(&name, "format")),
        }
    }
    mesh_output(&read_mesh(&copied(bytes)?, format)?)
}

pub(super) fn mesh_output(mesh: &Mesh) -> Result<JsValue> {
    Ok(to_value(&MeshOutput {
        positions: mesh.positions().as_flattened().into(),
        triangles: mesh.triangles().as_flattened().into(),
        colors: floats(mesh.colors()),
        uvs: floats(mesh.uvs()),
    })?)
}

/// What is seen of a mesh.
#[wasm_bindgen(js_name = sampleMesh)]
pub fn sample_mesh(mesh: JsValue, options: JsValue) -> Result<JsValue> {
    let mesh = from_value::<MeshInput>(mesh)?.into_mesh()?;
    let (mut view, mut across, mut spacing) = (None, None, None);
    for (name, value) in entries(&options)? {
        match name.as_str() {
            "view" => view = Some(view_from(value)?),
            "resolution" => {
                across = Some(option(
                    "resolution",
                    value,
                    "must be a whole number, at least 2",
                )?);
            }
            "spacing" => {
                spacing = Some(option(
                    "spacing",
                    value,
                    "must be a finite number above zero",
                )?);
            }
            _ => return Err(unknown(&name, "view, resolution and spacing")),
        }
    }
    let resolution = match (across, spacing) {
        (Some(_), Some(spacing)) => {
            let requirement = "must be left out where there is a resolution";
            return Err(Error::option("spacing", spacing, requirement).into());
        }
        (None, Some(spacing)) => Resolution::Spacing(spacing),
        (Some(across), None) => Resolution::Across(across),
        (None, None) => Resolution::Auto,
    };
    let view = view.unwrap_or(View::Along([0.0, 0.0, -1.0]));
    let samples = sample(&mesh, view, resolution)?;
    let colors = mesh
        .colors()
        .map(|colors| samples.carry(&mesh, colors))
        .transpose()?;
    let uvs = mesh
        .uvs()
        .map(|uvs| samples.carry(&mesh, uvs))
        .transpose()?;
    let lattice = samples.heightfield().lattice();
    Ok(to_value(&SampledOutput {
        rows: lattice.rows(),
        cols: lattice.cols(),
        spacing: lattice.spacing(),
        origin: lattice.origin(),
        heights: samples.heightfield().heights().into(),
        frame: (*samples.frame()).into(),
        colors: floats(colors.as_deref()),
        uvs: floats(uvs.as_deref()),
    })?)
}

fn view_from(value: JsValue) -> Result<View> {
    match value.as_string() {
        Some(name) => Ok(name.parse()?),
        None => {
            let requirement = "must be one of the names or a vector of three numbers";
            Ok(View::Along(option("view", value, requirement)?))
        }
    }
}

fn floats<const N: usize>(values: Option<&[[f32; N]]>) -> JsValue {
    values.map_or(JsValue::UNDEFINED, |values| {
        Float32Array::from(values.as_flattened()).into()
    })
}

impl MeshInput {
    fn into_mesh(self) -> Result<Mesh> {
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
        Ok(mesh)
    }
}

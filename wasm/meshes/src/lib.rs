//! Reading of mesh files, sampling of meshes from a view, and back-projection of depth images, for JavaScript.

mod camera;
mod surfaces;

use js_sys::{Array, Float32Array, Float64Array, Int32Array, Uint8Array, Uint32Array};
use serde::{Deserialize, Serialize};
use serde_wasm_bindgen::{from_value, preserve, to_value};
use wasm_bindgen::prelude::*;

use developable::Error;
use developable::Mesh;
use developable::View;
use developable::checks::check_count;
use developable::files::meshes::{FileUnit, read_mesh_beside};
use developable::files::{Assumption, Unit};
use developable::{Resolution, sample};
use developable_wasm::Result;
use developable_wasm::arrays::groups;
use developable_wasm::bytes::copied;
use developable_wasm::frame::FrameFields;
use developable_wasm::mesh::MeshInput;
use developable_wasm::options::read;

/// A mesh, written as JavaScript's `Mesh` object.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct MeshOutput {
    #[serde(with = "preserve")]
    positions: Float64Array,
    #[serde(with = "preserve")]
    triangles: Uint32Array,
    #[serde(with = "preserve")]
    colors: JsValue,
    #[serde(with = "preserve")]
    uvs: JsValue,
    #[serde(with = "preserve")]
    texture_of: JsValue,
    #[serde(with = "preserve")]
    textures: JsValue,
    #[serde(with = "preserve")]
    confidence: JsValue,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    missing: Vec<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    unit: Option<&'static str>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    assumptions: Vec<Assumption>,
}

/// Minimum share of a mesh's area behind its heights that is reported: less is a rough outline.
const MIN_REPORTED_HIDDEN_SHARE: f64 = 0.1;

/// A mesh sampled from a view, written as JavaScript's `SampledMesh` object, with the number of the texture at each
/// vertex, by which `direct.js` colours it.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct SampledOutput {
    rows: usize,
    cols: usize,
    spacing: f64,
    origin: [f64; 2],
    #[serde(with = "preserve")]
    heights: Float64Array,
    frame: FrameFields,
    #[serde(skip_serializing_if = "Option::is_none")]
    hidden: Option<f64>,
    no_noise: bool,
    #[serde(with = "preserve")]
    colors: JsValue,
    #[serde(with = "preserve")]
    uvs: JsValue,
    #[serde(with = "preserve")]
    texture_of: Int32Array,
    #[serde(with = "preserve")]
    confidence: JsValue,
}

/// Options of reading a mesh file: JavaScript's `ReadMeshOptions` object without the files beside it.
#[derive(Default, Deserialize)]
#[serde(default)]
struct ReadInput {
    format: Option<String>,
    unit: Option<String>,
}

/// Decodes a mesh file; returns JavaScript's `Mesh` object. `files` are pairs of name and bytes of further files that
/// it refers to.
#[wasm_bindgen(js_name = readMesh)]
pub fn read_mesh_file(bytes: &Uint8Array, files: &Array, options: JsValue) -> Result<JsValue> {
    let ReadInput { format, unit } = read(&options)?;
    let format = format.map(|name| name.parse()).transpose()?;
    let unit = unit.map(|name| FileUnit::new(&name)).transpose()?;
    let mut beside = Vec::new();
    for file in files.iter().map(|file| Array::from(&file)) {
        let name = file.get(0).as_string().unwrap_or_default();
        beside.push((name, copied(&file.get(1).unchecked_into())?));
    }
    let beside: Vec<_> = (beside.iter())
        .map(|(name, bytes)| (name.as_str(), bytes.as_slice()))
        .collect();
    let mut file = read_mesh_beside(&copied(bytes)?, format, &beside)?;
    if let Some(unit) = unit {
        file = file.in_unit(unit)?;
    }
    let textures: Array = (file.textures.iter())
        .map(|texture| Uint8Array::from(texture.bytes.as_slice()))
        .collect();
    Ok(to_value(&MeshOutput {
        textures: if textures.length() > 0 {
            textures.into()
        } else {
            JsValue::UNDEFINED
        },
        missing: file.missing,
        unit: file.unit.map(Unit::symbol),
        assumptions: file.assumptions,
        ..MeshOutput::new(&file.mesh)
    })?)
}

impl MeshOutput {
    fn new(mesh: &Mesh) -> Self {
        MeshOutput {
            positions: mesh.positions().as_flattened().into(),
            triangles: mesh.triangles().as_flattened().into(),
            colors: floats(mesh.colors()),
            uvs: floats(mesh.uvs()),
            texture_of: (mesh.textures()).map_or(JsValue::UNDEFINED, |numbers| {
                Int32Array::from(numbers).into()
            }),
            textures: JsValue::UNDEFINED,
            confidence: JsValue::UNDEFINED,
            missing: Vec::new(),
            unit: None,
            assumptions: Vec::new(),
        }
    }
}

/// Options of sampling a mesh: JavaScript's `SampleMeshOptions` object.
#[derive(Default, Deserialize)]
#[serde(default)]
struct SampleInput {
    view: Option<ViewInput>,
    resolution: Option<usize>,
    spacing: Option<f64>,
}

/// Direction of a view, by name or as a vector.
#[derive(Deserialize)]
#[serde(
    untagged,
    expecting = "expected one of the names or a vector of three numbers"
)]
enum ViewInput {
    Named(String),
    Along([f64; 3]),
}

/// Samples a mesh from a view: computes heights, colours and texture coordinates at the vertices of a lattice; returns
/// JavaScript's `SampledMesh` object.
#[wasm_bindgen(js_name = sampleMesh)]
pub fn sample_mesh(mesh: JsValue, options: JsValue) -> Result<JsValue> {
    let mesh = from_value::<MeshInput>(mesh)?;
    let confidence: Option<Vec<[f32; 1]>> = groups(&mesh.confidence)?;
    let mesh = mesh.into_mesh()?;
    if let Some(confidence) = &confidence {
        check_count(
            "confidence of the mesh",
            mesh.positions().len(),
            1,
            confidence.len(),
        )?;
    }
    let SampleInput {
        view,
        resolution,
        spacing,
    } = read(&options)?;
    let view = match view {
        None => View::Along([0.0, 0.0, -1.0]),
        Some(ViewInput::Named(name)) => name.parse()?,
        Some(ViewInput::Along(direction)) => View::Along(direction),
    };
    let resolution = match (resolution, spacing) {
        (Some(_), Some(spacing)) => {
            let requirement = "must be left out where there is a resolution";
            return Err(Error::option("spacing", spacing, requirement).into());
        }
        (None, Some(spacing)) => Resolution::Spacing(spacing),
        (Some(across), None) => Resolution::Across(across),
        (None, None) => Resolution::Auto,
    };
    let samples = sample(&mesh, view, resolution)?;
    let colors = mesh
        .colors()
        .map(|colors| samples.carry(&mesh, colors))
        .transpose()?;
    let uvs = mesh
        .uvs()
        .map(|uvs| samples.carry(&mesh, uvs))
        .transpose()?;
    let confidence = confidence
        .map(|confidence| samples.carry(&mesh, &confidence))
        .transpose()?;
    let lattice = samples.heightfield().lattice();
    Ok(to_value(&SampledOutput {
        rows: lattice.rows(),
        cols: lattice.cols(),
        spacing: lattice.spacing(),
        origin: lattice.origin(),
        heights: samples.heightfield().heights().into(),
        frame: (*samples.frame()).into(),
        hidden: Some(samples.hidden_share(&mesh))
            .filter(|share| *share >= MIN_REPORTED_HIDDEN_SHARE),
        no_noise: mesh.is_exact(),
        colors: floats(colors.as_deref()),
        uvs: floats(uvs.as_deref()),
        confidence: floats(confidence.as_deref()),
        texture_of: samples.textures(&mesh)?.as_slice().into(),
    })?)
}

fn floats<const N: usize>(values: Option<&[[f32; N]]>) -> JsValue {
    values.map_or(JsValue::UNDEFINED, |values| {
        Float32Array::from(values.as_flattened()).into()
    })
}

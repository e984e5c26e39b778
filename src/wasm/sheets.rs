//! Surfaces measured, laid flat, and photos of them made flat.

use js_sys::{Float32Array, Float64Array, Uint8Array, Uint8ClampedArray, Uint32Array};
use serde::{Deserialize, Serialize};
use serde_wasm_bindgen::{from_value, preserve, to_value};
use wasm_bindgen::prelude::*;

use super::Result;
use super::fields::{ImageInput, LatticeInput};
use super::options::{entries, option, unknown};
use crate::analysis::{Curvatures, Deviation, Summary, THRESHOLD};
use crate::dewarp::{DewarpOptions, Extent, Photo, Verdict, WarpMap};
use crate::error::{Error, try_filled};
use crate::heightfield::Heightfield;
use crate::unroll::{UnrollOptions, UnrollReport, Unrolling, unroll};

/// Heights to be looked at, and what a photo of them shows.
struct Scene {
    surface: Heightfield,
    extent: Extent,
}

/// An image or heights on the lattice, as `input.js` marks them.
#[derive(Deserialize)]
struct Kind {
    kind: String,
}

impl Scene {
    fn new(field: JsValue, spacing: Option<f64>) -> Result<Self> {
        let Kind { kind } = from_value(field.clone())?;
        if kind == "image" {
            let input: ImageInput = from_value(field)?;
            let image = input.heights("height image", &input.data)?;
            return Ok(Scene {
                surface: image.to_lattice(spacing)?,
                extent: Extent::of(&image),
            });
        }
        let input: LatticeInput = from_value(field)?;
        let surface = input.heights("heightfield", &input.heights)?;
        if let Some(spacing) = spacing {
            let requirement = "is for images: a lattice has the spacing of its input";
            return Err(Error::option("spacing", spacing, requirement).into());
        }
        Ok(Scene {
            extent: Extent::of_lattice(&surface),
            surface,
        })
    }
}

/// `Analysis` of `types.d.ts`.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct AnalysisOutput {
    rows: usize,
    cols: usize,
    spacing: f64,
    origin: [f64; 2],
    #[serde(with = "preserve")]
    gaussian: Float64Array,
    #[serde(with = "preserve")]
    kappa1: Float64Array,
    #[serde(with = "preserve")]
    kappa2: Float64Array,
    #[serde(with = "preserve")]
    nuclear_norm: Float64Array,
    summary: Summary,
    #[serde(skip_serializing_if = "Option::is_none")]
    deviation: Option<Deviation>,
}

/// Curvatures of a surface, what they come to, and how far it is from another one.
#[wasm_bindgen]
pub fn analyze(field: JsValue, reference: JsValue, options: JsValue) -> Result<JsValue> {
    let (mut threshold, mut spacing) = (THRESHOLD, None);
    for (name, value) in entries(&options)? {
        match name.as_str() {
            "threshold" => threshold = option("threshold", value, "must be a number")?,
            "spacing" => spacing = Some(option("spacing", value, "must be a number")?),
            _ => return Err(unknown(&name, "threshold, reference and spacing")),
        }
    }
    let Scene { surface, .. } = Scene::new(field, spacing)?;
    let deviation = if reference.is_undefined() {
        None
    } else {
        let reference = Scene::new(reference, spacing)?.surface;
        Some(Deviation::between(&surface, &reference)?)
    };
    let curvatures = Curvatures::new(&surface)?;
    let lattice = surface.lattice();
    Ok(to_value(&AnalysisOutput {
        rows: lattice.rows(),
        cols: lattice.cols(),
        spacing: lattice.spacing(),
        origin: lattice.origin(),
        gaussian: curvatures.gaussian.as_slice().into(),
        kappa1: curvatures.kappa1.as_slice().into(),
        kappa2: curvatures.kappa2.as_slice().into(),
        nuclear_norm: curvatures.nuclear_norm.as_slice().into(),
        summary: Summary::new(&surface, &curvatures, threshold)?,
        deviation,
    })?)
}

/// `Unrolling` of `types.d.ts`.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct UnrollingOutput {
    rows: usize,
    cols: usize,
    spacing: f64,
    origin: [f64; 2],
    #[serde(with = "preserve")]
    vertices: Uint32Array,
    #[serde(with = "preserve")]
    positions: Float64Array,
    #[serde(with = "preserve")]
    triangles: Uint32Array,
    #[serde(with = "preserve")]
    places: Float64Array,
    #[serde(with = "preserve")]
    parts: Uint32Array,
    #[serde(with = "preserve")]
    stretches: Float64Array,
    #[serde(with = "preserve")]
    overlaps: Uint32Array,
    verdict: Verdict,
    report: UnrollReport,
}

/// A surface laid flat.
#[wasm_bindgen(js_name = unroll)]
pub fn unroll_surface(field: JsValue, options: JsValue) -> Result<JsValue> {
    let mut settings = Settings::default();
    for (name, value) in entries(&options)? {
        if !settings.take(&name, &value)? {
            return Err(unknown(&name, "tolerance, maxIterations and spacing"));
        }
    }
    let Scene { surface, .. } = Scene::new(field, settings.spacing)?;
    let sheet = unroll(&surface, &settings.unrolling)?;
    let (mesh, lattice) = (sheet.mesh(), surface.lattice());
    Ok(to_value(&UnrollingOutput {
        rows: lattice.rows(),
        cols: lattice.cols(),
        spacing: lattice.spacing(),
        origin: lattice.origin(),
        vertices: mesh.vertices().into(),
        positions: mesh.positions().as_flattened().into(),
        triangles: mesh.triangles().as_flattened().into(),
        places: sheet.places().as_flattened().into(),
        parts: sheet.parts().into(),
        stretches: sheet.stretches().as_flattened().into(),
        overlaps: sheet.overlaps().as_flattened().as_flattened().into(),
        verdict: Verdict::of(sheet.report()),
        report: *sheet.report(),
    })?)
}

/// `Photo` of `types.d.ts`.
#[derive(Deserialize)]
struct PhotoInput {
    width: usize,
    height: usize,
    #[serde(with = "preserve")]
    data: Uint8Array,
}

/// `Dewarped` of `types.d.ts`.
#[derive(Serialize)]
struct DewarpedOutput {
    width: usize,
    height: usize,
    resolution: f64,
    corner: [f64; 2],
    #[serde(with = "preserve")]
    data: Uint8ClampedArray,
    #[serde(with = "preserve")]
    map: Float32Array,
    verdict: Verdict,
    report: UnrollReport,
}

/// A photo of a surface, made flat.
#[wasm_bindgen]
pub fn dewarp(field: JsValue, photo: JsValue, options: JsValue) -> Result<JsValue> {
    let mut settings = Settings::default();
    let mut wanted = DewarpOptions::default();
    let mut extent = None;
    for (name, value) in entries(&options)? {
        match name.as_str() {
            "resolution" => {
                let resolution = option("resolution", value, "must be a number")?;
                wanted = wanted.resolution(resolution);
            }
            "trim" => wanted = wanted.trim(option("trim", value, "must be true or false")?),
            "extent" => {
                let [left, bottom, right, top] = option(
                    "extent",
                    value,
                    "must be four numbers: left, bottom, right, top",
                )?;
                extent = Some(Extent {
                    min: [left, bottom],
                    max: [right, top],
                });
            }
            _ if settings.take(&name, &value)? => {}
            _ => {
                let known = "resolution, trim, extent, tolerance, maxIterations and spacing";
                return Err(unknown(&name, known));
            }
        }
    }
    let scene = Scene::new(field, settings.spacing)?;
    let PhotoInput {
        width,
        height,
        data,
    } = from_value(photo)?;
    let mut rgba = try_filled("photo", data.length() as usize, 0)?;
    data.copy_to(&mut rgba);
    let photo = Photo::new(width, height, &rgba)?;
    let sheet: Unrolling = unroll(&scene.surface, &settings.unrolling)?;
    let extent = extent.unwrap_or(scene.extent);
    let map = WarpMap::new(&sheet, extent, [width, height], &wanted)?;
    let flat = map.image(&photo)?;
    Ok(to_value(&DewarpedOutput {
        width: map.width(),
        height: map.height(),
        resolution: map.resolution(),
        corner: map.corner(),
        data: flat.as_slice().into(),
        map: map.places().as_flattened().into(),
        verdict: Verdict::of(sheet.report()),
        report: *sheet.report(),
    })?)
}

/// `UnrollOptions` of `types.d.ts`.
#[derive(Default)]
struct Settings {
    unrolling: UnrollOptions,
    spacing: Option<f64>,
}

impl Settings {
    /// Whether an option is one of these; its value is taken then.
    fn take(&mut self, name: &str, value: &JsValue) -> Result<bool> {
        let value = value.clone();
        match name {
            "tolerance" => {
                let tolerance = option("tolerance", value, "must be a number")?;
                self.unrolling = self.unrolling.tolerance(tolerance);
            }
            "maxIterations" => {
                let most = option("maxIterations", value, "must be a whole number")?;
                self.unrolling = self.unrolling.max_iterations(most);
            }
            "spacing" => self.spacing = Some(option("spacing", value, "must be a number")?),
            _ => return Ok(false),
        }
        Ok(true)
    }
}

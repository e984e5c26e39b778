//! Surfaces measured, drawn, laid flat, and photos of them made flat.

mod page;
mod picture;

use js_sys::{Float32Array, Float64Array, Int32Array, Uint8ClampedArray, Uint32Array};
use serde::Serialize;
use serde_wasm_bindgen::{from_value, preserve, to_value};
use wasm_bindgen::prelude::*;

use developable::Frame;
use developable::analysis::{Curvatures, DEFAULT_GAUSSIAN_THRESHOLD, Deviation, Summary};
use developable::checks::try_filled;
use developable::dewarp::{DewarpOptions, Registration, Verdict, WarpMap};
use developable::patches::{Crease, Patch, PatchOptions, Patches};
use developable::rulings::{Ruling, Rulings, TraceOptions};
use developable::unroll::{UnrollReport, Unrolling, unroll};
use developable_wasm::Result;
use developable_wasm::arrays::groups;
use developable_wasm::camera::photo_camera;
use developable_wasm::flat::{GridOutput, MapOptions, flat_image};
use developable_wasm::frame::FrameFields;
use developable_wasm::options::{entries, option, unknown};
use developable_wasm::photo::{Pixels, extent_from};
use developable_wasm::scene::{Scene, Settings, check_spacing, is_image};
use developable_wasm::tracing::{TRACING, take_tracing};

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
    let (mut threshold, mut spacing) = (DEFAULT_GAUSSIAN_THRESHOLD, None);
    for (name, value) in entries(&options)? {
        match name.as_str() {
            "threshold" => threshold = option("threshold", value, "must be a number")?,
            "spacing" => spacing = Some(option("spacing", value, "must be a number")?),
            _ => return Err(unknown(&name, "threshold, reference and spacing")),
        }
    }
    check_spacing(spacing, is_image(&field)? || is_image(&reference)?)?;
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
    check_spacing(settings.spacing, is_image(&field)?)?;
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
        verdict: Verdict::from_report(sheet.report()),
        report: *sheet.report(),
    })?)
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
    #[serde(skip_serializing_if = "Option::is_none")]
    grid: Option<GridOutput>,
    verdict: Verdict,
    report: UnrollReport,
}

/// A photo of a surface, made flat.
#[wasm_bindgen]
pub fn dewarp(field: JsValue, photo: JsValue, options: JsValue) -> Result<JsValue> {
    let mut settings = Settings::default();
    let mut wanted = DewarpOptions::default();
    let (mut extent, mut camera, mut uvs) = (None, None, JsValue::UNDEFINED);
    let mut frame = Frame::default();
    let (mut crop, mut deskew, mut trim) = (None, false, false);
    let mut maps = MapOptions::default();
    for (name, value) in entries(&options)? {
        match name.as_str() {
            "camera" => camera = Some(photo_camera(&value)?),
            "frame" => frame = from_value::<FrameFields>(value)?.into(),
            "uvs" => uvs = value,
            "crop" => {
                crop = Some(option::<Vec<[f64; 2]>>(
                    "crop",
                    value,
                    "must be a list of corners [x, y]",
                )?)
            }
            "dots" => wanted = wanted.dots(option("dots", value, "must be a number")?),
            "deskew" => deskew = option("deskew", value, "must be true or false")?,
            "trim" => trim = option("trim", value, "must be true or false")?,
            "extent" => extent = Some(extent_from(value)?),
            _ if settings.take(&name, &value)? || maps.take(&name, &value)? => {}
            _ => {
                let known = "dots, trim, deskew, crop, camera, extent, map, grid, tolerance, maxIterations and spacing";
                return Err(unknown(&name, known));
            }
        }
    }
    check_spacing(settings.spacing, is_image(&field)?)?;
    let scene = Scene::new(field, settings.spacing)?;
    let pixels = Pixels::new(photo)?;
    let photo = pixels.photo()?;
    let sheet: Unrolling = unroll(&scene.surface, &settings.unrolling)?;
    let uvs: Option<Vec<[f32; 2]>> = groups(&uvs)?;
    let registration = match (camera, &uvs) {
        (Some(camera), _) => Registration::Camera(camera, frame),
        (None, Some(uvs)) => Registration::Uvs(uvs),
        (None, None) => extent.unwrap_or(scene.extent).into(),
    };
    let map = WarpMap::new(
        &sheet,
        registration,
        [photo.width(), photo.height()],
        &wanted,
    )?;
    let map = map.cut(crop.as_deref(), deskew, trim)?;
    Ok(to_value(&DewarpedOutput {
        width: map.width(),
        height: map.height(),
        resolution: map.resolution(),
        corner: map.corner(),
        data: flat_image(&map, &photo)?,
        map: maps.places(&map),
        grid: maps.grid(&map)?,
        verdict: map.verdict(sheet.report()),
        report: *sheet.report(),
    })?)
}

/// `PatchMap` of `types.d.ts`.
#[derive(Serialize)]
struct PatchesOutput<'a> {
    rows: usize,
    cols: usize,
    spacing: f64,
    origin: [f64; 2],
    #[serde(with = "preserve")]
    labels: Int32Array,
    patches: &'a [Patch],
    creases: &'a [Crease],
    bend: f64,
}

/// The patches of a surface, and the creases between them.
#[wasm_bindgen]
pub fn patches(field: JsValue, options: JsValue) -> Result<JsValue> {
    let (mut wanted, mut spacing) = (PatchOptions::default(), None);
    for (name, value) in entries(&options)? {
        match name.as_str() {
            "bend" => wanted = wanted.bend(option("bend", value, "must be a number")?),
            "fold" => wanted = wanted.fold(option("fold", value, "must be a number")?),
            "smallest" => wanted = wanted.smallest(option("smallest", value, "must be a number")?),
            "spacing" => spacing = Some(option("spacing", value, "must be a number")?),
            _ => return Err(unknown(&name, "bend, fold, smallest and spacing")),
        }
    }
    check_spacing(spacing, is_image(&field)?)?;
    let Scene { surface, .. } = Scene::new(field, spacing)?;
    let found = Patches::new(&surface, &wanted)?;
    // No patch is −1 there.
    let mut labels = try_filled("patches", found.labels().len(), -1)?;
    for (out, label) in labels.iter_mut().zip(found.labels()) {
        *out = *label as i32;
    }
    let lattice = surface.lattice();
    Ok(to_value(&PatchesOutput {
        rows: lattice.rows(),
        cols: lattice.cols(),
        spacing: lattice.spacing(),
        origin: lattice.origin(),
        labels: labels.as_slice().into(),
        patches: found.patches(),
        creases: found.creases(),
        bend: found.bend(),
    })?)
}

/// `RulingField` of `types.d.ts`.
#[derive(Serialize)]
struct RulingsOutput<'a> {
    rows: usize,
    cols: usize,
    spacing: f64,
    origin: [f64; 2],
    #[serde(with = "preserve")]
    directions: Float64Array,
    #[serde(with = "preserve")]
    confidence: Float64Array,
    lines: &'a [Ruling],
}

/// The rulings of a surface, as directions and as lines.
#[wasm_bindgen]
pub fn rulings(field: JsValue, options: JsValue) -> Result<JsValue> {
    let (mut wanted, mut spacing) = (TraceOptions::default(), None);
    for (name, value) in entries(&options)? {
        match name.as_str() {
            "spacing" => spacing = Some(option("spacing", value, "must be a number")?),
            _ if take_tracing(&mut wanted, &name, &value)? => {}
            _ => return Err(unknown(&name, &format!("{TRACING} and spacing"))),
        }
    }
    check_spacing(spacing, is_image(&field)?)?;
    let Scene { surface, .. } = Scene::new(field, spacing)?;
    let found = Rulings::new(&surface)?;
    let lines = found.trace(&wanted)?;
    let lattice = surface.lattice();
    Ok(to_value(&RulingsOutput {
        rows: lattice.rows(),
        cols: lattice.cols(),
        spacing: lattice.spacing(),
        origin: lattice.origin(),
        directions: found.directions().as_flattened().into(),
        confidence: found.confidence().into(),
        lines: &lines,
    })?)
}

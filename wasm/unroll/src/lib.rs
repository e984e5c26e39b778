//! Surfaces analysed, drawn and laid flat, and photos made flat by them, for JavaScript.

mod page;
mod picture;

use js_sys::{Float32Array, Float64Array, Int32Array, Uint8ClampedArray, Uint32Array};
use serde::{Deserialize, Serialize};
use serde_wasm_bindgen::{preserve, to_value};
use wasm_bindgen::prelude::*;

use developable::analysis::{Curvatures, DEFAULT_GAUSSIAN_THRESHOLD, Deviation, Summary};
use developable::checks::try_filled;
use developable::dewarp::{DewarpOptions, Photo, Registration, Verdict, WarpMap};
use developable::page::cleaning::Light;
use developable::page::{OutlineVerdict, find_outline};
use developable::patches::{Crease, Patch, PatchOptions, Patches};
use developable::rulings::{Ruling, Rulings, TraceOptions};
use developable::unroll::{UnrollOptions, UnrollReport, Unrolling, unroll};
use developable::{Frame, Heightfield, Triangulation};
use developable_wasm::Result;
use developable_wasm::arrays::groups;
use developable_wasm::camera::photo_camera;
use developable_wasm::flat::{CleaningInput, GridOutput, MapOptions, flat_image};
use developable_wasm::frame::FrameFields;
use developable_wasm::options::OptionReader;
use developable_wasm::photo::{Pixels, extent_from};
use developable_wasm::scene::{Scene, SpacingInput, check_spacing, is_image};

/// Curvatures of a surface at the vertices of its hexagonal lattice (as in `Heightfield`), row by row and NaN where there are none, with their statistics.
#[derive(Serialize)]
#[serde(rename = "Analysis", rename_all = "camelCase")]
struct AnalysisOutput {
    /// Number of rows of the lattice.
    rows: usize,
    /// Number of columns of the lattice.
    cols: usize,
    /// Distance between neighbouring vertices of a row, in the surface's unit of length; rows are √3/2 of it apart.
    spacing: f64,
    /// Position `[x, y]` of the vertex in row 0, column 0, the upper left one; `y` points up. Odd rows are shifted to the left by half a `spacing`.
    origin: [f64; 2],
    /// Gaussian curvature at each vertex: angle deficit divided by the vertex's share of the area, in the surface's unit of length to the power −2.
    #[serde(with = "preserve")]
    gaussian: Float64Array,
    /// Principal curvature of larger magnitude at each vertex, in the inverse of the surface's unit of length; positive in a hollow seen from above, negative on a hill (of a mesh it is the other way round).
    #[serde(with = "preserve")]
    kappa1: Float64Array,
    /// Principal curvature of smaller magnitude at each vertex; 0 on a developable surface.
    #[serde(with = "preserve")]
    kappa2: Float64Array,
    /// Density of the energy at each vertex, `|kappa1| + |kappa2|`.
    #[serde(with = "preserve")]
    nuclear_norm: Float64Array,
    /// Statistics of the curvatures.
    summary: Summary,
    /// Deviation of the surface from the option `reference`, if that is given.
    #[serde(skip_serializing_if = "Option::is_none")]
    deviation: Option<Deviation>,
}

/// Takes the option `spacing`, the only one that is left to read; another one left is an error.
fn spacing_of(mut reader: OptionReader) -> Result<Option<f64>> {
    let SpacingInput { spacing } = reader.read()?;
    reader.finish()?;
    Ok(spacing)
}

/// Reads a surface; a height image is resampled to the lattice with the option `spacing`, the only option left to read.
fn surface_of(field: JsValue, reader: OptionReader) -> Result<Heightfield> {
    let spacing = spacing_of(reader)?;
    check_spacing(spacing, is_image(&field)?)?;
    Ok(Scene::new(field, spacing)?.surface)
}

/// Option of an analysis: JavaScript's `AnalyzeOptions` object without the reference and the spacing.
#[derive(Default, Deserialize)]
#[serde(default)]
struct ThresholdInput {
    threshold: Option<f64>,
}

/// Computes curvatures of a surface, their statistics, and the surface's deviation from a reference surface if there is
/// one; returns JavaScript's `Analysis` object.
#[wasm_bindgen]
pub fn analyze(field: JsValue, reference: JsValue, options: JsValue) -> Result<JsValue> {
    let mut reader = OptionReader::new(&options)?;
    let ThresholdInput { threshold } = reader.read()?;
    let spacing = spacing_of(reader)?;
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
        summary: Summary::new(
            &surface,
            &curvatures,
            threshold.unwrap_or(DEFAULT_GAUSSIAN_THRESHOLD),
        )?,
        deviation,
    })?)
}

/// A surface laid flat: its triangles, and the positions of their corners in the plane.
#[derive(Serialize)]
#[serde(rename = "Unrolling", rename_all = "camelCase")]
struct UnrollingOutput {
    /// Number of rows of the lattice.
    rows: usize,
    /// Number of columns of the lattice.
    cols: usize,
    /// Distance between neighbouring vertices of a row, in the surface's unit of length; rows are √3/2 of it apart.
    spacing: f64,
    /// Position `[x, y]` of the vertex in row 0, column 0, the upper left one; `y` points up. Odd rows are shifted to the left by half a `spacing`.
    origin: [f64; 2],
    /// Row-major index in the lattice of each vertex of the triangles, ascending.
    #[serde(with = "preserve")]
    vertices: Uint32Array,
    /// Coordinates x, y, z of each vertex on the surface.
    #[serde(with = "preserve")]
    positions: Float64Array,
    /// Three vertices of each triangle, counted from 0, counter-clockwise seen from above.
    #[serde(with = "preserve")]
    triangles: Uint32Array,
    /// Coordinates x, y of each vertex in the plane. Each connected component lies as near to its place in the view from above as it can.
    #[serde(with = "preserve")]
    places: Float64Array,
    /// Number of the connected component of each vertex; 0 is the largest one.
    #[serde(with = "preserve")]
    parts: Uint32Array,
    /// The two singular values of each triangle's map to the plane, the larger one first; the smaller one is negative where the triangle is flipped.
    #[serde(with = "preserve")]
    stretches: Float64Array,
    /// Four vertices for each pair of border edges that cross in the plane: the ends of both edges.
    #[serde(with = "preserve")]
    overlaps: Uint32Array,
    /// Whether the flat layout can be trusted.
    verdict: Verdict,
    /// Report on the layout: iterations, strain and overlaps.
    report: UnrollReport,
}

/// Lays a surface flat without cuts; returns JavaScript's `Unrolling` object.
#[wasm_bindgen(js_name = unroll)]
pub fn unroll_surface(field: JsValue, options: JsValue) -> Result<JsValue> {
    let mut reader = OptionReader::new(&options)?;
    let wanted: UnrollOptions = reader.read()?;
    let surface = surface_of(field, reader)?;
    let sheet = unroll(&surface, &wanted)?;
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

/// Flat image of a photo of a surface, with its warp map, verdict and report.
#[derive(Serialize)]
#[serde(rename = "DewarpedImage")]
struct DewarpedOutput {
    /// Number of pixels in a row of the flat image.
    width: usize,
    /// Number of rows of the flat image.
    height: usize,
    /// Number of pixels of the flat image per unit of length.
    resolution: f64,
    /// Position `[x, y]` of the image's upper left corner in the plane of `Unrolling.places`, x to the right and y up, in the surface's unit of length; with the option `deskew` in axes that are turned with the image about the origin.
    corner: [f64; 2],
    /// RGBA bytes of the flat image, row by row, transparent where there is no sheet; `new ImageData(data, width)` shows it.
    #[serde(with = "preserve")]
    data: Uint8ClampedArray,
    /// Warp map: for each pixel of the flat image its place x, y in the photo, in pixels from the centre of the upper left one; NaN where there is no sheet. Empty if the option `map` is false.
    #[serde(with = "preserve")]
    map: Float32Array,
    /// The warp map on a grid, if the option `grid` asks for it.
    #[serde(skip_serializing_if = "Option::is_none")]
    grid: Option<GridOutput>,
    /// Share of the sheet that the option `trim` left out; for a `crop` with four corners, share of the page between them that the flat image does not show; else 0.
    loss: f64,
    /// Distance by which a `crop` with four corners reaches beyond the page that was found in the photo, as a share of the page's side: above 0.02 the verdict is `'doubtful'`. 0 where no page is found without doubt.
    overreach: f64,
    /// What happened to the light: `'keep'` also where it was to be evened but the image is not mostly paper.
    light: Light,
    /// Whether the flat image can be trusted.
    verdict: Verdict,
    /// Report on laying the surface flat.
    report: UnrollReport,
}

/// Options of dewarping, read from JavaScript's `DewarpOptions` object, with the frame and the texture coordinates that
/// tell where in the photo the surface lies.
#[derive(Default, Deserialize)]
#[serde(default)]
struct DewarpInput {
    dots: Option<f64>,
    trim: bool,
    deskew: bool,
    crop: Option<Vec<[f64; 2]>>,
    extent: Option<[f64; 4]>,
    #[serde(with = "preserve")]
    camera: JsValue,
    frame: Option<FrameFields>,
    #[serde(with = "preserve")]
    uvs: JsValue,
}

/// Makes a photo of a surface flat, by unrolling the surface; returns JavaScript's `Dewarped` object.
#[wasm_bindgen]
pub fn dewarp(field: JsValue, photo: JsValue, options: JsValue) -> Result<JsValue> {
    let mut reader = OptionReader::new(&options)?;
    let unrolling: UnrollOptions = reader.read()?;
    let maps: MapOptions = reader.read()?;
    // A surface need not be a document: its shades may mean something.
    let cleaning = reader.read::<CleaningInput>()?.options(Light::Keep);
    let DewarpInput {
        dots,
        trim,
        deskew,
        crop,
        extent,
        camera,
        frame,
        uvs,
    } = reader.read()?;
    let spacing = spacing_of(reader)?;
    check_spacing(spacing, is_image(&field)?)?;
    let camera = match camera.is_undefined() {
        true => None,
        false => Some(photo_camera(&camera)?),
    };
    let extent = extent.map(extent_from).transpose()?;
    let frame = frame.map_or_else(Frame::default, Frame::from);
    let wanted = dots.map_or_else(DewarpOptions::default, |dots| {
        DewarpOptions::default().dots(dots)
    });
    let scene = Scene::new(field, spacing)?;
    let pixels = Pixels::new(photo)?;
    let photo = pixels.photo()?;
    let sheet: Unrolling = unroll(&scene.surface, &unrolling)?;
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
    let overreach = overreach(&photo, crop.as_deref());
    let (data, light) = flat_image(
        [map.width(), map.height()],
        |rows, rgba| {
            map.image_rows(&photo, rows, rgba);
            Ok(())
        },
        &cleaning,
    )?;
    Ok(to_value(&DewarpedOutput {
        width: map.width(),
        height: map.height(),
        resolution: map.resolution(),
        corner: map.corner(),
        data,
        map: maps.places(Some(&map)),
        grid: maps.grid(Some(&map))?,
        loss: map.loss(),
        overreach,
        light,
        verdict: map.verdict(sheet.report()).with_overreach(overreach),
        report: *sheet.report(),
    })?)
}

/// Distance by which four corners of a page reach beyond the one page that the photo shows, as a share of the page's side. 0
/// where no page is found without doubt.
fn overreach(photo: &Photo, crop: Option<&[[f64; 2]]>) -> f64 {
    let Some(corners) = crop.filter(|crop| crop.len() == 4) else {
        return 0.0;
    };
    let found = find_outline(photo);
    match (found.verdict, found.pages.first()) {
        (OutlineVerdict::Found, Some(page)) => page.overreach(corners),
        _ => 0.0,
    }
}

/// Patches of a surface (regions without a crease inside), that with the largest area first, and the creases between them.
#[derive(Serialize)]
#[serde(rename = "PatchMap")]
struct PatchesOutput<'a> {
    /// Number of rows of the lattice.
    rows: usize,
    /// Number of columns of the lattice.
    cols: usize,
    /// Distance between neighbouring vertices of a row, in the surface's unit of length; rows are √3/2 of it apart.
    spacing: f64,
    /// Position `[x, y]` of the vertex in row 0, column 0, the upper left one; `y` points up. Odd rows are shifted to the left by half a `spacing`.
    origin: [f64; 2],
    /// Number of the patch of each vertex, row by row; −1 where there is none.
    #[serde(with = "preserve")]
    labels: Int32Array,
    /// The patches, in the order of their numbers.
    patches: &'a [Patch],
    /// The creases between the patches.
    creases: &'a [Crease],
    /// Angle, in radians, above which the bend from one vertex to the next counted as a crease.
    bend: f64,
}

/// Segments a surface into patches and finds the creases between them; returns JavaScript's `PatchMap` object.
#[wasm_bindgen]
pub fn patches(field: JsValue, options: JsValue) -> Result<JsValue> {
    let mut reader = OptionReader::new(&options)?;
    let wanted: PatchOptions = reader.read()?;
    let surface = surface_of(field, reader)?;
    let found = Patches::new(&surface, &wanted)?;
    // In JavaScript the label of no patch is −1.
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

/// Rulings of a surface: the directions in which it does not bend, and lines along them.
#[derive(Serialize)]
#[serde(rename = "RulingField")]
struct RulingsOutput<'a> {
    /// Number of rows of the lattice.
    rows: usize,
    /// Number of columns of the lattice.
    cols: usize,
    /// Distance between neighbouring vertices of a row, in the surface's unit of length; rows are √3/2 of it apart.
    spacing: f64,
    /// Position `[x, y]` of the vertex in row 0, column 0, the upper left one; `y` points up. Odd rows are shifted to the left by half a `spacing`.
    origin: [f64; 2],
    /// Unit vector x, y along the ruling at each vertex, seen from above and up to its sign; NaN where there is none.
    #[serde(with = "preserve")]
    directions: Float64Array,
    /// Confidence in the direction at each vertex, from 0 to 1.
    #[serde(with = "preserve")]
    confidence: Float64Array,
    /// Traced rulings.
    lines: &'a [Ruling],
}

/// Computes the rulings (straight lines in the surface): a direction at each vertex, and traced lines; returns
/// JavaScript's `RulingField` object.
#[wasm_bindgen]
pub fn rulings(field: JsValue, options: JsValue) -> Result<JsValue> {
    let mut reader = OptionReader::new(&options)?;
    let wanted: TraceOptions = reader.read()?;
    let surface = surface_of(field, reader)?;
    let mesh = Triangulation::new(&surface, &Frame::default())?;
    let found = Rulings::new(mesh.mesh())?;
    let lines = found.trace(&wanted)?;
    let (directions, confidence) = found.on_lattice(&mesh)?;
    let lattice = surface.lattice();
    Ok(to_value(&RulingsOutput {
        rows: lattice.rows(),
        cols: lattice.cols(),
        spacing: lattice.spacing(),
        origin: lattice.origin(),
        directions: directions.as_flattened().into(),
        confidence: confidence.as_slice().into(),
        lines: &lines,
    })?)
}

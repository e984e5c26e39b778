//! Photos of pages made flat by the pages' edges, for JavaScript.

use std::ops::Range;

use js_sys::{Float32Array, Float64Array, Uint8ClampedArray, Uint32Array};
use serde::{Deserialize, Serialize};
use serde_wasm_bindgen::{from_value, preserve, to_value};
use wasm_bindgen::prelude::*;

use developable::dewarp::DewarpOptions;
use developable::page::cleaning::Light;
use developable::page::{
    Edges, FocalLength, Format, OutlineReason, OutlineReport, OutlineVerdict, PageOptions,
    PageOutline, PageReport, PageSurface, PageVerdict, PageWarp, Ruler, Trace, find_outline,
    trace_edges,
};
use developable::progress;
use developable_wasm::flat::{CleaningInput, GridOutput, MapOptions, flat_image};
use developable_wasm::options::{OptionReader, read, renamed};
use developable_wasm::photo::Pixels;
use developable_wasm::{Failure, Result};

/// Traced edges and lines of text of one page, as the function `asEdges` in `pkg/` passes them.
#[derive(Deserialize)]
struct EdgesInput {
    /// Whether the two edges that are given are the left and the right one.
    sideways: bool,
    /// Traced edges: two, or the upper, lower, left and right one; after them the lines of text. `edges` is the number
    /// of the former.
    traces: Vec<TraceInput>,
    edges: usize,
    /// Whether lines of text were not given, so that they are searched for in the photo.
    open: bool,
}

#[derive(Deserialize)]
struct TraceInput {
    beziers: bool,
    #[serde(with = "preserve")]
    points: Float64Array,
}

impl TraceInput {
    fn into_trace(self) -> Trace {
        let points = self.points.to_vec().as_chunks().0.to_vec();
        if self.beziers {
            Trace::Beziers(points)
        } else {
            Trace::Points(points)
        }
    }
}

impl EdgesInput {
    fn into_edges(self) -> Result<(Edges, Vec<Trace>)> {
        let mut traces: Vec<Trace> = Vec::new();
        for trace in self.traces {
            traces.push(trace.into_trace());
        }
        let lines = traces.split_off(self.edges.min(traces.len()));
        let missing = || Failure::option("edges come in pairs that face each other");
        let mut next = traces.into_iter();
        let mut trace = || next.next().ok_or_else(missing);
        let (first, second) = (trace()?, trace()?);
        let edges = match (self.edges, self.sideways) {
            (2, false) => Edges::TopBottom {
                top: first,
                bottom: second,
            },
            (2, true) => Edges::LeftRight {
                left: first,
                right: second,
            },
            _ => Edges::All {
                top: first,
                bottom: second,
                left: trace()?,
                right: trace()?,
            },
        };
        Ok((edges, lines))
    }
}

/// What is known about a page besides its edges, read from JavaScript's `DewarpPageOptions` object.
#[derive(Default, Deserialize)]
#[serde(default, rename_all = "camelCase")]
struct KnownPage {
    focal_length: Option<f64>,
    field_of_view: Option<f64>,
    film35: Option<f64>,
    page: Option<Format>,
    ruler: Option<Ruler>,
    centre: Option<[f64; 2]>,
    find_lines: Option<bool>,
    trace_edges: Option<bool>,
    doubtful_outline: bool,
}

impl KnownPage {
    fn options(&self) -> Result<PageOptions> {
        let focal = [
            self.focal_length.map(FocalLength::Pixels),
            self.field_of_view.map(FocalLength::FieldOfView),
            self.film35.map(FocalLength::Film35),
        ];
        let mut focal = focal.into_iter().flatten();
        let mut known = PageOptions::default();
        known.focal_length = focal.next().unwrap_or_default();
        if focal.next().is_some() {
            return Err(Failure::option(
                "options `focalLength`, `fieldOfView` and `film35` say the same: give one of them",
            ));
        }
        known.format = self.page.unwrap_or_default();
        known.ruler = self.ruler;
        known.centre = self.centre;
        Ok(known)
    }
}

/// A page that was found in a photo, with its warp map by shares, mesh and report: what JavaScript's `DewarpedPage` object has
/// besides the flat image.
#[derive(Serialize)]
struct PageOutput {
    size: [f64; 2],
    unit: Unit,
    warp: WarpOutput,
    mesh: MeshOutput,
    /// Lines of text that were detected in the photo, a list for each page, as points in the photo's pixels.
    lines: Vec<Vec<Vec<[f64; 2]>>>,
    /// Edges of each page by which it was found.
    edges: Vec<TracedEdges>,
    verdict: PageVerdict,
    report: PageReport,
    /// Outlines of pages that were found in the photo, if no edges were given.
    #[serde(skip_serializing_if = "Option::is_none")]
    outline: Option<OutlinesOutput>,
}

/// Edges of a page by which it was found: those that were given, or that were traced in the photo.
#[derive(Default, Serialize)]
struct TracedEdges {
    #[serde(skip_serializing_if = "Option::is_none")]
    top: Option<TraceOutput>,
    #[serde(skip_serializing_if = "Option::is_none")]
    bottom: Option<TraceOutput>,
    #[serde(skip_serializing_if = "Option::is_none")]
    left: Option<TraceOutput>,
    #[serde(skip_serializing_if = "Option::is_none")]
    right: Option<TraceOutput>,
}

#[derive(Serialize)]
#[serde(untagged)]
enum TraceOutput {
    Points(Vec<[f64; 2]>),
    Beziers { beziers: Vec<[f64; 2]> },
}

impl From<&Trace> for TraceOutput {
    fn from(trace: &Trace) -> Self {
        match trace {
            Trace::Beziers(points) => TraceOutput::Beziers {
                beziers: points.clone(),
            },
            trace => TraceOutput::Points(points(trace)),
        }
    }
}

impl From<&Edges> for TracedEdges {
    fn from(edges: &Edges) -> Self {
        let mut traces = edges.traces().into_iter().map(TraceOutput::from);
        let is_sideways = matches!(edges, Edges::LeftRight { .. });
        let mut upright = || (!is_sideways).then(|| traces.next()).flatten();
        let (top, bottom) = (upright(), upright());
        TracedEdges {
            top,
            bottom,
            left: traces.next(),
            right: traces.next(),
        }
    }
}

/// The unit of a flat page's lengths: millimetres or the width of a page.
#[derive(Serialize, Deserialize, PartialEq)]
enum Unit {
    #[serde(rename = "mm")]
    Millimetre,
    #[serde(rename = "page")]
    Page,
}

/// Warp map of a page by shares of its sides, which holds for any resolution of the photo and of the flat page.
#[derive(Serialize, Deserialize)]
#[serde(rename = "PageWarp")]
struct WarpOutput {
    /// Number of nodes of the grid in each row: the first one at the page's left edge, the last one at its right edge.
    columns: usize,
    /// Number of rows of the grid, from the page's upper edge to its lower one.
    rows: usize,
    /// Place of each node in the photo, row by row: shares of the photo's width from the left and of its height from the top. It is bilinear in between; NaN where the photo cannot show the node.
    #[serde(with = "preserve")]
    places: Float32Array,
}

/// What is read of a page that was found in a photo: the same in JavaScript's `DewarpedPage` object.
#[derive(Deserialize)]
struct PageInput {
    size: [f64; 2],
    unit: Unit,
    warp: WarpOutput,
}

/// Flat image of a page, with its warp map.
#[derive(Serialize)]
#[serde(rename = "FlatImage")]
struct FlatOutput {
    /// Number of pixels in a row of the flat image.
    width: usize,
    /// Number of rows of the flat image.
    height: usize,
    /// Number of pixels of the flat image per unit of length.
    resolution: f64,
    /// Position `[x, y]` of the image's upper left corner on the page laid flat, x to the right and y up, in the unit of lengths.
    corner: [f64; 2],
    /// RGBA bytes of the flat image, row by row, transparent where there is no sheet; `new ImageData(data, width)` shows it.
    #[serde(with = "preserve")]
    data: Uint8ClampedArray,
    /// Warp map of `2 * width * height` numbers: for each pixel of the flat image its place x, y in the photo, in pixels from the centre of the upper left one; NaN where there is no sheet. Empty if the option `map` is false.
    #[serde(with = "preserve")]
    map: Float32Array,
    /// The warp map on a grid, if the option `grid` asks for it.
    #[serde(skip_serializing_if = "Option::is_none")]
    grid: Option<GridOutput>,
    /// What happened to the light: `'keep'` also where it was to be evened but the page is dark or not mostly paper.
    light: Light,
}

#[derive(Serialize)]
struct MeshOutput {
    #[serde(with = "preserve")]
    positions: Float64Array,
    #[serde(with = "preserve")]
    triangles: Uint32Array,
    #[serde(with = "preserve")]
    uvs: Float32Array,
}

/// Outlines of the pages that were found in a photo.
#[derive(Serialize)]
#[serde(rename = "PageOutlines")]
struct OutlinesOutput {
    /// Whether one page was found, one that is doubtful, several, or none.
    verdict: OutlineVerdict,
    /// Reasons why the verdict is not `'found'`.
    reasons: Vec<OutlineReason>,
    /// The outlines, the best one first: several if the verdict is `'several'`; for `'notFound'` the best guess, if there is one.
    pages: Vec<OutlineOutput>,
}

/// Outline of one page in a photo.
#[derive(Serialize)]
#[serde(rename = "PageOutline")]
struct OutlineOutput {
    /// Upper left, upper right, lower right and lower left corner of the page, in pixels of the photo; a corner may be outside of the photo.
    corners: [[f64; 2]; 4],
    /// The four edges, which `dewarpPage` takes.
    edges: EdgesOutput,
    /// Confidence that this is the outline of a page, from 0 to 1.
    score: f64,
    /// Reasons why the outline is doubtful.
    reasons: Vec<OutlineReason>,
}

/// Edges of a page in a photo, as points from corner to corner in the photo's pixels.
#[derive(Serialize)]
#[serde(rename = "OutlineEdges")]
struct EdgesOutput {
    /// Upper edge, from left to right.
    top: Vec<[f64; 2]>,
    /// Lower edge, from left to right.
    bottom: Vec<[f64; 2]>,
    /// Left edge, from top to bottom.
    left: Vec<[f64; 2]>,
    /// Right edge, from top to bottom.
    right: Vec<[f64; 2]>,
}

impl From<&PageOutline> for OutlineOutput {
    fn from(outline: &PageOutline) -> Self {
        let [top, right, bottom, left] = &outline.edges;
        let reversed = |edge: &[[f64; 2]]| edge.iter().rev().copied().collect();
        OutlineOutput {
            corners: outline.corners,
            edges: EdgesOutput {
                top: top.clone(),
                bottom: reversed(bottom),
                left: reversed(left),
                right: right.clone(),
            },
            score: outline.score,
            reasons: outline.reasons.clone(),
        }
    }
}

impl From<&OutlineReport> for OutlinesOutput {
    fn from(report: &OutlineReport) -> Self {
        OutlinesOutput {
            verdict: report.verdict,
            reasons: report.reasons.clone(),
            pages: report.pages.iter().map(OutlineOutput::from).collect(),
        }
    }
}

/// Finds the outline of the page in a photo; returns JavaScript's `PageOutlines` object.
#[wasm_bindgen(js_name = findPage)]
pub fn find_page(photo: JsValue) -> Result<JsValue> {
    let pixels = Pixels::new(photo)?;
    let report = find_outline(&pixels.photo()?);
    Ok(to_value(&OutlinesOutput::from(&report))?)
}

/// Finds the surface of a page, or of a spread, by the page's traced edges, or if none are given by those found in the
/// photo; returns what JavaScript's `DewarpedPage` object has besides the flat image.
#[wasm_bindgen(js_name = pageSurface)]
pub fn page_surface(photo: JsValue, edges: JsValue, options: JsValue) -> Result<JsValue> {
    let input: KnownPage = read(&options)?;
    let known = input.options()?;
    let pixels = Pixels::new(photo)?;
    let photo = pixels.photo()?;
    let (mut pages, mut lines, mut find) = (Vec::new(), Vec::new(), true);
    let mut is_doubtful = input.doubtful_outline;
    let outline = if edges.is_undefined() {
        let found = progress::part(0.3, || find_outline(&photo));
        if let Ok(page) = found.page() {
            pages.push(page.to_edges());
            lines.push(Vec::new());
        }
        is_doubtful |= found.verdict == OutlineVerdict::Doubtful;
        Some(OutlinesOutput::from(&found))
    } else {
        let edges: Vec<EdgesInput> = from_value(edges)?;
        find = edges.iter().all(|page| page.open);
        for page in edges {
            let (edges, own) = page.into_edges()?;
            pages.push(edges);
            lines.push(own);
        }
        if input.trace_edges.unwrap_or(true) {
            pages = progress::part(0.1, || trace_edges(&photo, &pages));
            is_doubtful |= pages
                .iter()
                .flat_map(Edges::traces)
                .any(Trace::has_ends_alone);
        }
        None
    };
    let find = input.find_lines.unwrap_or(find);
    let page = if pages.is_empty() && outline.is_some() {
        PageSurface::by_print(&photo, &known)
    } else if find {
        PageSurface::in_photo(&pages, &lines, &photo, &known)
    } else {
        PageSurface::new(&pages, &lines, [photo.width(), photo.height()], &known)
    }
    .map_err(|error| renamed(error, "format", "page"))?;
    let (warp, mesh) = (page.warp()?, page.mesh()?);
    let report = match is_doubtful {
        true => page.report().with_doubtful_outline(),
        false => *page.report(),
    };
    let [columns, rows] = warp.nodes();
    Ok(to_value(&PageOutput {
        size: page.flat_size(),
        unit: match page.is_millimetres() {
            true => Unit::Millimetre,
            false => Unit::Page,
        },
        warp: WarpOutput {
            columns,
            rows,
            places: warp.places().as_flattened().into(),
        },
        mesh: MeshOutput {
            positions: mesh.positions().as_flattened().into(),
            triangles: mesh.triangles().as_flattened().into(),
            uvs: mesh.uvs().unwrap_or_default().as_flattened().into(),
        },
        lines: (page.text().iter())
            .map(|lines| lines.iter().map(points).collect())
            .collect(),
        edges: pages.iter().map(TracedEdges::from).collect(),
        verdict: report.verdict,
        report,
        outline,
    })?)
}

/// The option that sets the resolution of the flat image.
#[derive(Default, Deserialize)]
#[serde(default)]
struct DotsInput {
    dots: Option<f64>,
}

/// Makes a photo of any resolution flat by a page that was found in the same picture; returns JavaScript's `FlatPage` object
/// without size and unit.
#[wasm_bindgen(js_name = flattenPhoto)]
pub fn flatten_photo(photo: JsValue, page: JsValue, options: JsValue) -> Result<JsValue> {
    let mut reader = OptionReader::new(&options)?;
    let maps: MapOptions = reader.read()?;
    let cleaning = reader.read::<CleaningInput>()?.options(Light::default());
    let DotsInput { dots } = reader.read()?;
    reader.finish()?;
    let mut wanted = DewarpOptions::default();
    wanted.dots = dots;
    let PageInput { size, unit, warp } = from_value(page)?;
    let places = warp.places.to_vec().as_chunks().0.to_vec();
    let nodes = [warp.columns, warp.rows];
    let warp = PageWarp::new(size, unit == Unit::Millimetre, nodes, places)?;
    let pixels = Pixels::new(photo)?;
    let photo = pixels.photo()?;
    let photo_size = [photo.width(), photo.height()];
    let flat = warp.pixel_grid(photo_size, &wanted)?;
    let image_rows =
        |rows: Range<usize>, rgba: &mut [u8]| Ok(warp.image_rows(&flat, &photo, rows, rgba)?);
    let (data, light) = flat_image([flat.width, flat.height], image_rows, &cleaning)?;
    let map = (maps.any())
        .then(|| warp.warp_map(photo_size, &wanted))
        .transpose()?;
    Ok(to_value(&FlatOutput {
        width: flat.width,
        height: flat.height,
        resolution: flat.resolution,
        corner: flat.corner,
        data,
        map: maps.places(map.as_ref()),
        grid: maps.grid(map.as_ref())?,
        light,
    })?)
}

fn points(line: &Trace) -> Vec<[f64; 2]> {
    match line {
        Trace::Points(points) => points.clone(),
        _ => Vec::new(),
    }
}

//! A picture of the assembled surface from above: each sheet in its colour with its number, folds dashed, seams
//! with their letters.

use std::collections::HashMap;
use std::fmt::Write as _;

use ::svg::Document;
use ::svg::node::element::{Group, Path, Polyline, Text, Title};

use super::colour;
use crate::assembly::{Built, faces_up};
use crate::drawing::letters;
use crate::error::{Error, Result};
use crate::files::failure::unsupported;
use crate::pattern::{Faces, Sheet};

/// Length of the longer side of the assembly picture, in units of the SVG file.
const PICTURE_SIZE: f64 = 1000.0;

/// Width of the margin around the assembly picture, in units of the SVG file.
const PICTURE_MARGIN: f64 = 20.0;

/// Font size of the numbers of assembly steps in the assembly picture, in units of the SVG file.
const NUMBER_FONT_SIZE: f64 = 28.0;

/// Font size of seam letters in the assembly picture, in units of the SVG file.
const LETTER_FONT_SIZE: f64 = 16.0;

/// Writes an SVG file of the assembled surface, seen from above; its upper left corner is at the origin. Numbers of patches and letters of seams are those of
/// the drawing; folds are dashed. Triangles that face away from the viewer are left out.
///
/// # Errors
/// [`Error::Empty`] without a sheet, [`Error::Unsupported`] for vertices that are not finite.
pub fn write_assembly_svg(sheets: &[Sheet]) -> Result<Vec<u8>> {
    let points = || sheets.iter().flat_map(|sheet| &sheet.faces.built);
    if points().next().is_none() {
        return Err(Error::Empty { what: "pattern" });
    }
    let limit =
        |k: usize, start: f64, f: fn(f64, f64) -> f64| points().map(|p| p[k]).fold(start, f);
    let low = [0, 1].map(|k| limit(k, f64::INFINITY, f64::min));
    let high = [0, 1].map(|k| limit(k, f64::NEG_INFINITY, f64::max));
    let wide = (high[0] - low[0]).max(high[1] - low[1]);
    if !(wide > 0.0 && wide.is_finite()) {
        return Err(unsupported(
            "pattern",
            "its vertices must be finite, and not all at one place",
        ));
    }
    let scale = PICTURE_SIZE / wide;
    let place = |p: [f64; 2]| [scale * (p[0] - low[0]), scale * (high[1] - p[1])];
    let [width, height] = [0, 1].map(|k| scale * (high[k] - low[k]) + 2.0 * PICTURE_MARGIN);
    let mut areas = Group::new()
        .set("id", "sheets")
        .set("stroke", "#333333")
        .set("stroke-linejoin", "round")
        .set("fill-rule", "nonzero");
    let lines = |id: &str| {
        let group = Group::new().set("id", id).set("fill", "none");
        group.set("stroke", "#333333")
    };
    let mut cuts = lines("cuts").set("stroke-width", 2);
    let mut folds = lines("folds").set("stroke-dasharray", "6 5");
    let mut texts = Group::new()
        .set("id", "numbers")
        .set("font-family", "Helvetica, Arial, sans-serif")
        .set("text-anchor", "middle")
        .set("fill", "#000000");
    let mut add = |text: String, at: [f64; 2], size: f64, kind: &str| {
        texts = std::mem::take(&mut texts).add(
            Text::new(text)
                .set("class", kind)
                .set("x", format!("{:.1}", at[0]))
                .set("y", format!("{:.1}", at[1]))
                .set("dy", format!("{:.1}", 0.35 * size))
                .set("font-size", size),
        );
    };
    let names = letters(sheets);
    for number in from_below(sheets) {
        let sheet = &sheets[number];
        let [r, g, b] = colour(number);
        let built = Built::new(&sheet.faces);
        // Writing into a string cannot fail.
        let mut data = String::new();
        let mut ring = |points: &mut dyn Iterator<Item = [f64; 2]>| {
            for (i, [x, y]) in points.enumerate() {
                let _ = write!(data, "{}{x:.1} {y:.1}", if i == 0 { 'M' } else { 'L' });
            }
            data.push('Z');
        };
        let drawn = |flat: &[[f64; 2]]| {
            let lines = seen(&built, flat).into_iter();
            lines.map(|line| {
                let points = line.into_iter().map(place);
                let points: Vec<String> = points.map(|[x, y]| format!("{x:.1},{y:.1}")).collect();
                Polyline::new().set("points", points.join(" "))
            })
        };
        let whole = upper(&sheet.faces).len() == sheet.faces.triangles.len();
        if whole {
            for outline in &sheet.outlines {
                let lines = outline.iter().flat_map(|run| seen(&built, &run.points));
                ring(&mut lines.flatten().map(place));
            }
        } else {
            for border in borders(&sheet.faces) {
                let points = border
                    .iter()
                    .map(|vertex| sheet.faces.built[*vertex as usize]);
                ring(&mut points.map(|[x, y, _]| place([x, y])));
            }
            for run in sheet.outlines.iter().flatten() {
                cuts = drawn(&run.points).fold(cuts, Group::add);
            }
        }
        for fold in sheet.folds.iter().filter(|fold| fold.is_made()) {
            folds = drawn(&fold.points).fold(folds, Group::add);
        }
        let title = Title::new(format!("Sheet {}", number + 1));
        areas = areas.add(
            Path::new()
                .set("d", data)
                .set("fill", format!("#{r:02x}{g:02x}{b:02x}"))
                .set("stroke-width", if whole { 2 } else { 0 })
                .set("data-sheet", number + 1)
                .add(title),
        );
        for spot in &sheet.spots {
            if let Some(at) = seen(&built, &[spot.place]).concat().first() {
                add(
                    (spot.patch + 1).to_string(),
                    place(*at),
                    NUMBER_FONT_SIZE,
                    "patch",
                );
            }
        }
        for run in sheet.outlines.iter().flatten() {
            let Some(name) = run.seam.and_then(|seam| names.get(&seam.crease)) else {
                continue;
            };
            // On one of the two sides.
            let own = run
                .seam
                .is_some_and(|seam| run.patch == Some(seam.patches[0]));
            let middle = run.points[run.points.len() / 2];
            if let Some(at) = seen(&built, &[middle]).concat().first().filter(|_| own) {
                add(name.clone(), place(*at), LETTER_FONT_SIZE, "seam");
            }
        }
    }
    let document = Document::new()
        .set(
            "viewBox",
            format!("{0:.1} {0:.1} {width:.1} {height:.1}", -PICTURE_MARGIN),
        )
        .set("width", format!("{width:.1}"))
        .set("height", format!("{height:.1}"))
        .add(Title::new("Assembly"))
        .add(areas)
        .add(cuts)
        .add(folds)
        .add(texts);
    Ok(document.to_string().into_bytes())
}

/// Sorts the sheets for a picture from above, so that a sheet that hides another is drawn later. Returns the sheets'
/// numbers.
fn from_below(sheets: &[Sheet]) -> Vec<usize> {
    let height = |number: &usize| {
        let faces = &sheets[*number].faces;
        let upper = upper(faces);
        let corners = upper.as_flattened().iter();
        let sum: f64 = corners.map(|v| faces.built[*v as usize][2]).sum();
        sum / (3 * upper.len()).max(1) as f64
    };
    let mut order: Vec<usize> = (0..sheets.len()).collect();
    let heights: Vec<f64> = order.iter().map(height).collect();
    order.sort_by(|a, b| heights[*a].total_cmp(&heights[*b]));
    order
}

/// Returns those triangles of a sheet that face up where the sheet is in its place on the surface.
fn upper(faces: &Faces) -> Vec<[u32; 3]> {
    let up = |corners: &&[u32; 3]| faces_up(corners.map(|v| faces.built[v as usize]));
    faces.triangles.iter().filter(up).copied().collect()
}

/// Computes the visible parts, seen from above, of a line given on a flat sheet, in the plane of the picture.
fn seen(built: &Built, flat: &[[f64; 2]]) -> Vec<Vec<[f64; 2]>> {
    let spots: Vec<_> = flat.iter().filter_map(|place| built.at(*place)).collect();
    let parts = spots
        .chunk_by(|a, b| a.up == b.up)
        .filter(|part| part[0].up);
    let plan = parts.map(|part| part.iter().map(|spot| [spot.at[0], spot.at[1]]).collect());
    plan.collect()
}

/// Finds the borders, as closed lines of vertices, of a sheet's triangles that face up. Vertices of different patches
/// at one position of the surface count as one.
fn borders(faces: &Faces) -> Vec<Vec<u32>> {
    let mut first: HashMap<[u64; 3], u32> = HashMap::new();
    let one: Vec<u32> = (faces.built.iter().enumerate())
        .map(|(i, p)| *first.entry(p.map(f64::to_bits)).or_insert(i as u32))
        .collect();
    let mut edges: HashMap<(u32, u32), i32> = HashMap::new();
    for corners in upper(faces) {
        for k in 0..3 {
            let [from, to] = [k, (k + 1) % 3].map(|k| one[corners[k] as usize]);
            *edges.entry((from, to)).or_default() += 1;
            *edges.entry((to, from)).or_default() -= 1;
        }
    }
    // Sorted, so that files are the same each time.
    let mut left: Vec<(u32, u32)> = edges.into_iter().filter(|e| e.1 > 0).map(|e| e.0).collect();
    left.sort_unstable();
    let mut next: HashMap<u32, Vec<u32>> = HashMap::new();
    for (from, to) in left.iter().rev() {
        next.entry(*from).or_default().push(*to);
    }
    let mut rings = Vec::new();
    for (start, _) in left {
        let mut ring = Vec::new();
        let mut at = start;
        while let Some(to) = next.get_mut(&at).and_then(Vec::pop) {
            ring.push(at);
            at = to;
            if at == start {
                break;
            }
        }
        if ring.len() > 2 {
            rings.push(ring);
        }
    }
    rings
}

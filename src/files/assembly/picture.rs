//! The surface from above, each sheet in its colour with its number, seams with their letters.

use std::collections::HashMap;
use std::fmt::Write as _;

use ::svg::Document;
use ::svg::node::element::{Group, Path, Text, Title};

use super::colour;
use crate::error::{Error, Result};
use crate::flat::drawing::{letters, smooth};
use crate::flat::pattern::{Faces, Sheet};

/// Longer side of the picture, and the room around it, in its units.
const SIZE: f64 = 1000.0;
const ROOM: f64 = 20.0;

/// Sizes of numbers and letters.
const NUMBER: f64 = 28.0;
const LETTER: f64 = 16.0;

/// An SVG file of the surface that sheets make, seen from above: the patches' numbers and the seams' letters are
/// those of the drawing.
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
        return Err(Error::Unsupported {
            format: "pattern",
            reason: "its vertices must be finite, and not all at one place".into(),
        });
    }
    let scale = SIZE / wide;
    let place = |p: [f64; 3]| {
        [
            ROOM + scale * (p[0] - low[0]),
            ROOM + scale * (high[1] - p[1]),
        ]
    };
    let [width, height] = [0, 1].map(|k| scale * (high[k] - low[k]) + 2.0 * ROOM);
    let mut areas = Group::new()
        .set("id", "sheets")
        .set("stroke", "#333333")
        .set("stroke-width", 2)
        .set("stroke-linejoin", "round")
        .set("fill-rule", "evenodd");
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
    for (number, sheet) in sheets.iter().enumerate() {
        let [r, g, b] = colour(number);
        let mut data = String::new();
        for ring in borders(&sheet.faces) {
            // The lattice's zigzag is within a cell.
            let closed = ring.iter().chain(ring.first());
            let points: Vec<[f64; 2]> = closed
                .map(|vertex| {
                    let [x, y, _] = sheet.faces.built[*vertex as usize];
                    [x, y]
                })
                .collect();
            let line = smooth(&points, sheet.spacing, sheet.spacing).points(0.1 / scale);
            for (i, [x, y]) in line.into_iter().enumerate() {
                let [x, y] = place([x, y, 0.0]);
                // Writing into a string cannot fail.
                let _ = write!(data, "{}{x:.1} {y:.1}", if i == 0 { 'M' } else { 'L' });
            }
            data.push('Z');
        }
        let title = Title::new(format!("Sheet {}", number + 1));
        areas = areas.add(
            Path::new()
                .set("d", data)
                .set("fill", format!("#{r:02x}{g:02x}{b:02x}"))
                .set("data-sheet", number + 1)
                .add(title),
        );
        for spot in &sheet.spots {
            if let Some(at) = nearest(&sheet.faces, spot.place) {
                add((spot.patch + 1).to_string(), place(at), NUMBER, "patch");
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
            if let Some(at) = nearest(&sheet.faces, middle).filter(|_| own) {
                add(name.clone(), place(at), LETTER, "seam");
            }
        }
    }
    let document = Document::new()
        .set("viewBox", format!("0 0 {width:.1} {height:.1}"))
        .set("width", format!("{width:.1}"))
        .set("height", format!("{height:.1}"))
        .add(Title::new("Assembly"))
        .add(areas)
        .add(texts);
    Ok(document.to_string().into_bytes())
}

/// Where the vertex is built that lies nearest to a place on the flat sheet.
fn nearest(faces: &Faces, place: [f64; 2]) -> Option<[f64; 3]> {
    let away = |i: &usize| {
        let [x, y] = faces.flat[*i];
        (x - place[0]).hypot(y - place[1])
    };
    let all = 0..faces.flat.len();
    let found = all.min_by(|a, b| away(a).total_cmp(&away(b)));
    found.map(|i| faces.built[i])
}

/// The closed lines of edges that belong to one triangle only. Vertices of different patches at one place of the
/// surface are one here.
fn borders(faces: &Faces) -> Vec<Vec<u32>> {
    let mut first: HashMap<[u64; 3], u32> = HashMap::new();
    let one: Vec<u32> = (faces.built.iter().enumerate())
        .map(|(i, p)| *first.entry(p.map(f64::to_bits)).or_insert(i as u32))
        .collect();
    let mut edges: HashMap<(u32, u32), i32> = HashMap::new();
    for corners in &faces.triangles {
        for k in 0..3 {
            let [from, to] = [k, (k + 1) % 3].map(|k| one[corners[k] as usize]);
            *edges.entry((from, to)).or_default() += 1;
            *edges.entry((to, from)).or_default() -= 1;
        }
    }
    // In an order of their own, so that files are the same each time.
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

//! The surface from above, each sheet in its colour with its number, its folds dashed, seams with their letters.

use std::fmt::Write as _;

use ::svg::Document;
use ::svg::node::element::{Group, Path, Polyline, Text, Title};

use super::colour;
use crate::error::{Error, Result};
use crate::flat::assembly::Built;
use crate::flat::drawing::{letters, smooth};
use crate::flat::pattern::Sheet;

/// Longer side of the picture, and the room around it, in its units.
const SIZE: f64 = 1000.0;
const ROOM: f64 = 20.0;

/// How far lines may be from those that were found, in spacings.
const TOLERANCE: f64 = 0.5;

/// Sizes of numbers and letters.
const NUMBER: f64 = 28.0;
const LETTER: f64 = 16.0;

/// An SVG file of the surface that sheets make, seen from above: the patches' numbers and the seams' letters are
/// those of the drawing, folds are dashed.
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
    let place = |p: [f64; 2]| {
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
    let mut folds = Group::new()
        .set("id", "folds")
        .set("stroke", "#333333")
        .set("stroke-dasharray", "6 5")
        .set("fill", "none");
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
        let built = Built::new(&sheet.faces);
        let seen = |flat: &[[f64; 2]]| -> Vec<[f64; 2]> {
            let points = flat.iter().filter_map(|place| built.at(*place));
            let plan: Vec<[f64; 2]> = points.map(|[x, y, _]| [x, y]).collect();
            let line = smooth(&plan, TOLERANCE * sheet.spacing, sheet.spacing);
            let line = line.points(0.1 / scale).into_iter();
            line.map(place).collect()
        };
        let mut data = String::new();
        for outline in &sheet.outlines {
            let mut step = 'M';
            for [x, y] in outline.iter().flat_map(|run| seen(&run.points)) {
                // Writing into a string cannot fail.
                let _ = write!(data, "{step}{x:.1} {y:.1}");
                step = 'L';
            }
            data.push('Z');
        }
        for fold in &sheet.folds {
            let points = seen(&fold.points).into_iter();
            let points: Vec<String> = points.map(|[x, y]| format!("{x:.1},{y:.1}")).collect();
            folds = folds.add(Polyline::new().set("points", points.join(" ")));
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
            if let Some([x, y, _]) = built.at(spot.place) {
                add((spot.patch + 1).to_string(), place([x, y]), NUMBER, "patch");
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
            if let Some([x, y, _]) = built.at(middle).filter(|_| own) {
                add(name.clone(), place([x, y]), LETTER, "seam");
            }
        }
    }
    let document = Document::new()
        .set("viewBox", format!("0 0 {width:.1} {height:.1}"))
        .set("width", format!("{width:.1}"))
        .set("height", format!("{height:.1}"))
        .add(Title::new("Assembly"))
        .add(areas)
        .add(folds)
        .add(texts);
    Ok(document.to_string().into_bytes())
}

//! Draws single sheets in millimetres, with tabs and labels, before they are placed in the drawing.

use std::collections::{BTreeMap, BTreeSet};

use super::curve::Curve;
use super::label::Label;
use super::leader::place_leader;
use super::line::{FLATTENING_TOLERANCE_MM, Line, Wall, walls_of};
use super::lines::Lines;
use super::marks::seam_marks;
use super::offset::offset_outwards;
use super::options::DrawingOptions;
use super::pack::Place;
use super::sheet::{DrawnSheet, PrintedTriangle};
use super::tabs::{SeamSides, add_tabs};
use crate::pattern::{Seam, Sheet};

/// Assigns letters to the creases that are cut, by which both sides of a seam are labelled; returns the letters by the
/// creases' numbers.
pub(crate) fn letters(sheets: &[Sheet]) -> BTreeMap<usize, String> {
    let runs = sheets.iter().flat_map(|s| s.outlines.iter().flatten());
    let mut creases: Vec<usize> = runs.filter_map(|run| run.seam.map(|s| s.crease)).collect();
    creases.sort_unstable();
    creases.dedup();
    let name = |mut n: usize| {
        let mut name = String::new();
        loop {
            name.insert(0, char::from(b'a' + (n % 26) as u8));
            match n / 26 {
                0 => return name,
                more => n = more - 1,
            }
        }
    };
    let names = creases.into_iter().enumerate();
    names.map(|(n, crease)| (crease, name(n))).collect()
}

/// Annotations of seams that all sheets of a drawing share: the letter of each seam, and the number of marks (short
/// lines across the seam for alignment) on each.
pub(super) struct SeamAnnotations {
    pub letters: BTreeMap<usize, String>,
    pub marks: BTreeMap<usize, usize>,
    /// Creases whose tabs are on the side of the patch with the higher number.
    pub swapped: BTreeSet<usize>,
    pub sides: SeamSides,
}

impl DrawnSheet {
    /// Draws a sheet, and returns the letters that one of its sides lacks, for want of room.
    pub(super) fn new<'a>(
        number: usize,
        sheet: &Sheet,
        lines: &Lines<'_>,
        options: &DrawingOptions,
        SeamAnnotations {
            letters,
            marks,
            swapped,
            sides,
        }: &'a SeamAnnotations,
    ) -> (Self, Vec<&'a str>) {
        let scale = options.scale;
        let (plain, flaps) = add_tabs(&lines.outlines, options.tabs, swapped, sides);
        let out = options.allowance + 0.5 * options.kerf;
        let name = format!("Sheet {}", number + 1);
        let curves = match out > 0.0 {
            true => offset_outwards(&plain, out, sheet.exact),
            false => plain.clone(),
        };
        let walls: Vec<Wall> = (curves.iter())
            .flat_map(|curve| walls_of(&curve.points(FLATTENING_TOLERANCE_MM)))
            .collect();
        let (mut labels, mut leaders): (Vec<Vec<Label>>, Vec<Curve>) = Default::default();
        let mut outer: Vec<Label> = Vec::new();
        for spot in &sheet.spots {
            // Of a model of many small faces only the larger ones have numbers.
            if sheet.exact && Label::is_cramped(scale * spot.room) {
                continue;
            }
            let (place, room) = (spot.place.map(|v| scale * v), scale * spot.room);
            let label = Label::patch(spot.patch, place, room);
            let outside = match Label::is_cramped(room) {
                true => place_leader(&label, &walls, &outer),
                false => None,
            };
            match outside {
                Some((label, line)) => {
                    leaders.push(line);
                    outer.push(label);
                }
                None => labels.push(label.in_sizes()),
            }
        }
        // Texts of each side of a cut; both sides of a slit have one patch, and each is a run of the outline.
        let mut sides: BTreeMap<(usize, Option<u32>, usize), Vec<Label>> = BTreeMap::new();
        let mut letter_side = |seam: &Seam, patch: Option<u32>, run: usize, texts: Vec<Label>| {
            let run = if seam.slit { run } else { 0 };
            let side = sides.entry((seam.crease, patch, run)).or_default();
            side.extend(texts.iter().cloned());
            labels.push(texts);
        };
        for (number, (run, curve)) in lines.outlines.iter().flatten().enumerate() {
            if let Some(seam) = &run.seam
                && let Some(letter) = letters.get(&seam.crease)
            {
                let texts = Label::seam(letter, seam, &curve.points(FLATTENING_TOLERANCE_MM));
                letter_side(seam, run.patch, number, texts);
            }
        }
        for tab in &flaps {
            if let Some(letter) = letters.get(&tab.seam.crease) {
                letter_side(&tab.seam, tab.patch, tab.run, Label::tab(letter, tab));
            }
        }
        labels.extend(lines.folds.iter().map(Label::fold));
        let tabs: Vec<Line> = (flaps.into_iter())
            .map(|tab| Line::new(tab.seam, tab.base))
            .collect();
        if options.plain {
            labels.clear();
            sides.clear();
            outer.clear();
            leaders.clear();
        }
        let folds: Vec<Wall> = (lines.folds.iter().chain(&tabs))
            .flat_map(|line| walls_of(&line.points))
            .collect();
        let labels = Label::without_collisions(outer, labels, &walls, &folds);
        let unlettered = (sides.iter())
            .filter(|(_, texts)| !texts.iter().any(|text| labels.contains(text)))
            .map(|((crease, ..), _)| &letters[crease][..])
            .collect();
        let sheet = DrawnSheet {
            name,
            patches: sheet.patches.clone(),
            bounds: [[0.0; 2]; 2],
            cuts: Vec::new(),
            curves,
            printed: match options.printed {
                true => PrintedTriangle::all_of(sheet, scale),
                false => Vec::new(),
            },
            folds: lines.folds.clone(),
            tabs,
            edges: if options.allowance > 0.0 {
                plain
            } else {
                Vec::new()
            },
            marks: (lines.outlines.iter().flatten())
                .flat_map(|(run, curve)| seam_marks(run, curve, marks))
                .collect(),
            leaders,
            labels,
        };
        (sheet.moved(&Place::IDENTITY), unlettered)
    }
}

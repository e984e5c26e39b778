//! Patterns as they are drawn, in millimetres: sheets beside each other, with lines to cut and to
//! fold, tabs and labels. What files are written of ([`patterns`](crate::files::drawings)).
//!
//! ```
//! use developable::drawing::{Drawing, DrawingOptions};
//! use developable::patches::{PatchOptions, Patches};
//! use developable::pattern::{PatternOptions, pattern};
//! use developable::{Heightfield, Lattice};
//! # fn main() -> developable::Result<()> {
//! // A folded card in metres, to be made ten times smaller.
//! let card = Heightfield::from_fn(Lattice::new(40, 40, 0.025)?, |x, _| -0.5 * (x - 0.52).abs())?;
//! let patches = Patches::new(&card, &PatchOptions::default())?;
//! let sheets = pattern(&card, &patches, &PatternOptions::default())?.sheets;
//! let drawing = Drawing::new(&sheets, &DrawingOptions::default().scale(100.0))?;
//! let fold = &drawing.sheets[0].folds[0];
//! assert!((fold.length / (100.0 * 39.0 * card.lattice().row_spacing()) - 1.0).abs() < 0.002);
//! # Ok(())
//! # }
//! ```

mod label;
mod pack;
mod pages;
mod tabs;

use std::collections::BTreeMap;

use super::pattern::{Direction, Seam, Sheet};
use crate::error::{Error, Result, positive};
pub use label::{Label, LabelKind};
use pack::{Place, packed};
pub use pages::{MAX_PAGES, Page, Pages, Paper};
use tabs::{Tab, tabbed};

/// Room around sheets, in millimetres.
pub(crate) const MARGIN: f64 = 10.0;

/// Longest side of a drawing, in millimetres.
pub const MAX_SIZE: f64 = 50_000.0;

/// How a pattern is drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct DrawingOptions {
    /// Millimetres for each unit of the surface. Default 1.
    pub scale: f64,
    /// Depth of tabs along cut creases, in millimetres; they are on the side of the patch with
    /// the lower number. Default: no tabs.
    pub tabs: Option<f64>,
}

impl Default for DrawingOptions {
    fn default() -> Self {
        DrawingOptions {
            scale: 1.0,
            tabs: None,
        }
    }
}

impl DrawingOptions {
    /// These options with another scale.
    pub fn scale(self, scale: f64) -> Self {
        DrawingOptions { scale, ..self }
    }

    /// These options with tabs.
    pub fn tabs(self, depth: f64) -> Self {
        DrawingOptions {
            tabs: Some(depth),
            ..self
        }
    }
}

/// A drawing, its lower left corner at `0, 0`; `x` to the right, `y` up, in millimetres.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Drawing {
    /// Width.
    pub width: f64,
    /// Height.
    pub height: f64,
    /// The sheets, in their order; none lies on another.
    pub sheets: Vec<DrawnSheet>,
    /// What it comes to.
    pub summary: Totals,
}

/// A sheet as it is drawn: turned so that its box is small, if that is worth it, never mirrored.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct DrawnSheet {
    /// `Sheet 1` and so on.
    pub name: String,
    /// Its patches.
    pub patches: Vec<u32>,
    /// Its lower left and upper right corner.
    pub bounds: [[f64; 2]; 2],
    /// Closed lines, the last point joined to the first; around tabs, too.
    pub cuts: Vec<Vec<[f64; 2]>>,
    /// Where it is folded.
    pub folds: Vec<Line>,
    /// Where tabs are folded.
    pub tabs: Vec<Line>,
    /// What is written on it.
    pub labels: Vec<Label>,
}

/// A line to fold along.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Line {
    /// The crease, by its place in [`Patches::creases`](crate::shape::patches::Patches::creases).
    pub crease: usize,
    /// Which way, seen from above.
    pub direction: Direction,
    /// By how much, in degrees: 0 is flat.
    pub angle: f64,
    /// Its length in millimetres.
    pub length: f64,
    /// Its course.
    pub points: Vec<[f64; 2]>,
}

/// What a drawing comes to, lengths in millimetres.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "camelCase")
)]
#[non_exhaustive]
pub struct Totals {
    /// Number of sheets.
    pub sheets: usize,
    /// Creases that are cut, at least in part.
    pub seams: usize,
    /// Cuts through what was one patch, because it cannot be laid flat in one piece.
    pub slits: usize,
    /// Length of the creases that are cut, as far as they are, each counted once.
    pub seam_length: f64,
    /// Length of the slits likewise.
    pub slit_length: f64,
    /// The most that both sides of one of these differ in length, as a share of it; lines shorter than
    /// a tenth of the side of a square as large as all sheets do not count.
    pub mismatch: f64,
    /// Creases that are folds.
    pub folds: usize,
    /// Number of tabs.
    pub tabs: usize,
    /// Length of all cuts.
    pub cut_length: f64,
    /// Length of all mountain folds, without those of tabs.
    pub mountain_length: f64,
    /// Length of all valley folds likewise.
    pub valley_length: f64,
    /// Area of the sheets without tabs, in square millimetres.
    pub area: f64,
    /// Largest strain of a sheet (root of the mean square): 0 for what can be unrolled.
    pub strain: f64,
    /// Most that the two sides of a fold are apart (root of the mean square).
    pub gap: f64,
    /// Pages it takes of A4.
    pub a4: usize,
    /// Pages it takes of Letter.
    pub letter: usize,
}

impl Drawing {
    /// Draws sheets beside each other: in rows, the tallest first, ten millimetres apart.
    ///
    /// Cut creases have letters, the same on both sides; patches their number, counted from 1;
    /// folds an M or a V and their angle.
    ///
    /// Costs `O(points)` without tabs; each tab is compared with its whole sheet.
    ///
    /// # Errors
    /// [`Error::Empty`] without a sheet, [`Error::Option`] for a scale or tabs that are not
    /// positive and finite, or if the drawing is larger than [`MAX_SIZE`].
    pub fn new(sheets: &[Sheet], options: &DrawingOptions) -> Result<Self> {
        let scale = positive("scale", options.scale)?;
        let tabs = options.tabs.map(|t| positive("tabs", t)).transpose()?;
        if sheets.is_empty() {
            return Err(Error::Empty { what: "pattern" });
        }
        let letters = letters(sheets);
        let mut drafts: Vec<Draft> = (sheets.iter().enumerate())
            .map(|(number, sheet)| Draft::new(number, sheet, scale, tabs, &letters))
            .collect();
        let boxes: Vec<Place> = drafts
            .iter()
            .map(|draft| Place::around(&draft.cuts))
            .collect();
        let (places, [width, height]) = packed(&boxes);
        if !(width <= MAX_SIZE && height <= MAX_SIZE) {
            return Err(Error::option(
                "scale",
                scale,
                "must not make the pattern larger than 50 metres",
            ));
        }
        for (draft, place) in drafts.iter_mut().zip(&places) {
            draft.move_to(place);
        }
        let sheets_drawn: Vec<DrawnSheet> = drafts.into_iter().map(Draft::finish).collect();
        let mut drawing = Drawing {
            width,
            height,
            summary: summary(&sheets_drawn, sheets, scale),
            sheets: sheets_drawn,
        };
        drawing.summary.a4 = Pages::count(&drawing, Paper::A4);
        drawing.summary.letter = Pages::count(&drawing, Paper::Letter);
        Ok(drawing)
    }

    /// Whether it is one that can be written: what comes from elsewhere need not be.
    #[cfg(feature = "patterns")]
    pub(crate) fn check(&self) -> Result<()> {
        let size = |value: f64| (0.0..=MAX_SIZE).contains(&value);
        let near = |p: &[f64; 2]| p.iter().all(|v| v.abs() <= 2.0 * MAX_SIZE);
        let lines = |sheet: &DrawnSheet| {
            let folds = sheet.folds.iter().chain(&sheet.tabs);
            let points = sheet.cuts.iter().chain(folds.map(|line| &line.points));
            let places = sheet.labels.iter().map(|label| label.place);
            points.flatten().chain(&sheet.bounds).all(near)
                && sheet
                    .labels
                    .iter()
                    .all(|l| size(l.size) && l.turn.is_finite())
                && places.into_iter().all(|place| near(&place))
        };
        match size(self.width) && size(self.height) && self.sheets.iter().all(lines) {
            true => Ok(()),
            false => Err(Error::Unsupported {
                format: "drawing",
                reason: "its coordinates must be finite, and within 50 metres".into(),
            }),
        }
    }
}

/// Letters for the creases that are cut, in their order.
fn letters(sheets: &[Sheet]) -> BTreeMap<usize, String> {
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

/// A sheet in millimetres that has no place yet.
struct Draft {
    name: String,
    patches: Vec<u32>,
    cuts: Vec<Vec<[f64; 2]>>,
    folds: Vec<Line>,
    tabs: Vec<Line>,
    labels: Vec<Label>,
}

impl Draft {
    fn new(
        number: usize,
        sheet: &Sheet,
        scale: f64,
        tabs: Option<f64>,
        letters: &BTreeMap<usize, String>,
    ) -> Self {
        let scaled = |points: &[[f64; 2]]| -> Vec<[f64; 2]> {
            points.iter().map(|p| p.map(|v| scale * v)).collect()
        };
        let mut labels: Vec<Label> = (sheet.spots.iter())
            .map(|spot| Label::patch(spot.patch, scaled(&[spot.place])[0], scale * spot.room))
            .collect();
        let mut plain = Vec::new();
        for outline in &sheet.outlines {
            for run in outline {
                if let Some(letter) = run.seam.and_then(|seam| letters.get(&seam.crease)) {
                    labels.push(Label::seam(letter, &scaled(&run.points)));
                }
            }
            let runs = outline.iter().map(|run| (run, scaled(&run.points)));
            plain.push(runs.collect::<Vec<_>>());
        }
        let folds: Vec<Line> = (sheet.folds.iter())
            .map(|fold| Line::new(fold.seam, scaled(&fold.points)))
            .collect();
        labels.extend(folds.iter().map(Label::fold));
        let (cuts, flaps) = tabbed(&plain, tabs);
        labels.extend((flaps.iter()).filter_map(|tab: &Tab| {
            let letter = letters.get(&tab.seam.crease)?;
            Some(Label::tab(letter, tab))
        }));
        Draft {
            name: format!("Sheet {}", number + 1),
            patches: sheet.patches.clone(),
            cuts,
            folds,
            tabs: (flaps.into_iter())
                .map(|tab| Line::new(tab.seam, tab.base))
                .collect(),
            labels,
        }
    }

    fn move_to(&mut self, place: &Place) {
        let lines = self.folds.iter_mut().chain(&mut self.tabs);
        let points = self
            .cuts
            .iter_mut()
            .chain(lines.map(|line| &mut line.points));
        for point in points.flatten() {
            *point = place.of(*point);
        }
        for label in &mut self.labels {
            label.place = place.of(label.place);
            label.turn_by(place.degrees());
        }
    }

    fn finish(mut self) -> DrawnSheet {
        let points = || self.cuts.iter().flatten();
        let limit =
            |k: usize, start: f64, f: fn(f64, f64) -> f64| points().map(|p| p[k]).fold(start, f);
        let bounds = [
            [0, 1].map(|k| limit(k, f64::INFINITY, f64::min)),
            [0, 1].map(|k| limit(k, f64::NEG_INFINITY, f64::max)),
        ];
        self.labels.push(Label::sheet(&self.name, bounds));
        DrawnSheet {
            name: self.name,
            patches: self.patches,
            bounds,
            cuts: self.cuts,
            folds: self.folds,
            tabs: self.tabs,
            labels: self.labels,
        }
    }
}

impl Line {
    fn new(seam: Seam, points: Vec<[f64; 2]>) -> Self {
        Line {
            crease: seam.crease,
            direction: seam.direction,
            angle: seam.angle.to_degrees(),
            length: length(&points),
            points,
        }
    }
}

/// A line that is cut: how long it is on either patch, in the surface's units.
struct Joint {
    slit: bool,
    sides: [f64; 2],
}

fn joints(sheets: &[Sheet]) -> Vec<Joint> {
    let mut joints: BTreeMap<usize, Joint> = BTreeMap::new();
    for run in sheets
        .iter()
        .flat_map(|sheet| sheet.outlines.iter().flatten())
    {
        if let (Some(seam), Some(patch)) = (run.seam, run.patch) {
            let joint = joints.entry(seam.crease).or_insert(Joint {
                slit: seam.slit,
                sides: [0.0; 2],
            });
            joint.sides[usize::from(patch == seam.patches[1])] += length(&run.points);
        }
    }
    joints.into_values().collect()
}

fn summary(drawn: &[DrawnSheet], sheets: &[Sheet], scale: f64) -> Totals {
    let joints = joints(sheets);
    let folds = |direction: Direction| -> f64 {
        let lines = drawn.iter().flat_map(|sheet| &sheet.folds);
        let own = lines.filter(|line| line.direction == direction);
        // Not `sum`, which is −0 of nothing.
        own.map(|line| line.length).fold(0.0, |a, b| a + b)
    };
    let around = |cut: &Vec<[f64; 2]>| -> f64 {
        let closing = match (cut.last(), cut.first()) {
            (Some(last), Some(first)) => distance(*last, *first),
            _ => 0.0,
        };
        length(cut) + closing
    };
    let (creases, slits): (Vec<&Joint>, _) = joints.iter().partition(|joint| !joint.slit);
    let long = |joints: &[&Joint]| -> f64 {
        joints
            .iter()
            .map(|j| 0.5 * scale * (j.sides[0] + j.sides[1]))
            .fold(0.0, |a, b| a + b)
    };
    let area = sheets.iter().map(|sheet| sheet.area).sum::<f64>();
    Totals {
        sheets: drawn.len(),
        seams: creases.len(),
        slits: slits.len(),
        seam_length: long(&creases),
        slit_length: long(&slits),
        mismatch: (joints.iter())
            .filter(|joint| joint.sides[0].min(joint.sides[1]) >= 0.1 * area.sqrt())
            .map(|joint| {
                (joint.sides[0] - joint.sides[1]).abs() / joint.sides[0].max(joint.sides[1])
            })
            .fold(0.0, f64::max),
        folds: drawn.iter().map(|sheet| sheet.folds.len()).sum(),
        tabs: drawn.iter().map(|sheet| sheet.tabs.len()).sum(),
        cut_length: drawn.iter().flat_map(|sheet| &sheet.cuts).map(around).sum(),
        mountain_length: folds(Direction::Mountain),
        valley_length: folds(Direction::Valley),
        area: scale * scale * area,
        strain: sheets.iter().map(|sheet| sheet.strain).fold(0.0, f64::max),
        gap: scale * sheets.iter().map(|sheet| sheet.gap).fold(0.0, f64::max),
        a4: 0,
        letter: 0,
    }
}

fn length(points: &[[f64; 2]]) -> f64 {
    let pieces = points.windows(2);
    pieces.map(|p| distance(p[0], p[1])).sum()
}

fn distance([ax, ay]: [f64; 2], [bx, by]: [f64; 2]) -> f64 {
    (bx - ax).hypot(by - ay)
}

//! Draws the sheets of a pattern beside each other or on pages, in millimetres.

use std::collections::BTreeSet;

use super::bend::apply_bend_allowance;
use super::bend_lines::thin_lines;
use super::draft::{SeamAnnotations, letters};
use super::label::{Label, LabelKind};
use super::lines::Lines;
use super::marks::mark_counts;
use super::nest::Shape;
use super::options::{DrawingOptions, MAX_SIZE, MIN_LINE_DISTANCE_MM};
use super::pack::{Place, pack_rows};
use super::pages::{Arranged, MAX_PAGES, Pages, Stock, arrange_on_pages, page_count};
use super::sheet::DrawnSheet;
use super::tabs::{SeamSides, swapped_tabs};
use super::totals::{Totals, summary};
use crate::error::{Error, Result};
use crate::pattern::{Pattern, Sheet};

/// A drawing of sheets beside each other, in millimetres: the lower left corner is `0, 0`, `x` goes to the right
/// and `y` up.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename = "SheetDrawing")
)]
#[non_exhaustive]
pub struct Drawing {
    /// Width of the drawing, in millimetres.
    pub width: f64,
    /// Height of the drawing, in millimetres.
    pub height: f64,
    /// The drawn sheets, in the order of the pattern's sheets; none overlaps another.
    pub sheets: Vec<DrawnSheet>,
    /// The printed pages or plates that the sheets lie on, if there are any ([`Drawing::onto`]).
    pub pages: Option<Pages>,
    /// Summary of the drawing: numbers of sheets, seams, folds and tabs, and their total lengths.
    pub summary: Totals,
}

/// Number of creases that are cut and glued, and have no tab.
fn untabbed(sheets: &[Sheet], drawn: &[DrawnSheet]) -> usize {
    let runs = sheets
        .iter()
        .flat_map(|sheet| sheet.outlines.iter().flatten());
    let glued = runs.filter_map(|run| run.seam.map(|seam| seam.crease));
    let mut creases: BTreeSet<usize> = glued.collect();
    for tab in drawn.iter().flat_map(|sheet| &sheet.tabs) {
        creases.remove(&tab.crease);
    }
    creases.len()
}

impl Drawing {
    /// Draws sheets beside each other: in rows, the tallest first, ten millimetres apart.
    ///
    /// Cut creases are labelled with letters, the same on both sides; patches with their number, counted from 1;
    /// folds with M or V and their angle. [`Totals::mismatch`] is how much the two sides of a joint differ at most.
    ///
    /// Costs `O(points)` without tabs; each tab is compared with its whole sheet.
    ///
    /// # Errors
    /// [`Error::Empty`] without a sheet, [`Error::Option`] for lengths that are negative or not finite, or if the
    /// drawing is larger than [`MAX_SIZE`], [`Error::Unsupported`] for folds that are not straight from edge to edge where metal is
    /// bent.
    pub fn new(sheets: &[Sheet], options: &DrawingOptions) -> Result<Self> {
        options.check()?;
        let (scale, tabs) = (options.scale, options.tabs);
        if sheets.is_empty() {
            return Err(Error::Empty { what: "pattern" });
        }
        if options.printed && sheets.iter().all(|sheet| sheet.faces.textured.is_empty()) {
            return Err(Error::Unsupported {
                format: "pattern",
                reason: "there is no texture to be printed: a mesh needs texture coordinates, and flat faces that are laid \
                         flat as they are; leave out `printed`"
                    .into(),
            });
        }
        let letters = letters(sheets);
        let sheets: &[Sheet] = &(sheets.iter().enumerate())
            .map(|(number, sheet)| {
                let mut sheet = apply_bend_allowance(number, sheet, options)?;
                if options.bending.is_none() {
                    thin_lines(&mut sheet.folds, MIN_LINE_DISTANCE_MM / scale);
                }
                Ok(sheet)
            })
            .collect::<Result<Vec<_>>>()?;
        let lines: Vec<Lines> = sheets.iter().map(|s| Lines::new(s, options)).collect();
        let outlines: Vec<_> = lines.iter().map(|own| &own.outlines[..]).collect();
        let sides = SeamSides::new(&outlines);
        let marks = options.marks.map(|distance| mark_counts(&sides, distance));
        let named = SeamAnnotations {
            letters,
            marks: marks.unwrap_or_default(),
            swapped: swapped_tabs(&outlines, tabs, &sides),
            sides,
        };
        let (mut drawn, unlettered): (Vec<DrawnSheet>, Vec<Vec<&str>>) =
            (sheets.iter().zip(&lines).enumerate())
                .map(|(number, (sheet, own))| DrawnSheet::new(number, sheet, own, options, &named))
                .unzip();
        // A letter on one side names nothing.
        let unlettered: BTreeSet<&str> = unlettered.into_iter().flatten().collect();
        for sheet in &mut drawn {
            let is_kept = |label: &Label| {
                label.kind != LabelKind::Seam || !unlettered.contains(&label.text[..])
            };
            sheet.labels.retain(is_kept);
        }
        let boxes: Vec<Place> = (drawn.iter())
            .map(|sheet| Place::around(&Shape::new(sheet).lines))
            .collect();
        let (places, [width, height]) = pack_rows(&boxes);
        if !(width <= MAX_SIZE && height <= MAX_SIZE) {
            return Err(Error::option(
                "scale",
                scale,
                "must not make the pattern larger than 50 metres",
            ));
        }
        let drawn: Vec<DrawnSheet> = (drawn.into_iter().zip(&places))
            .map(|(sheet, place)| sheet.moved(place))
            .collect();
        let mut summary = summary(&drawn, sheets, &lines, scale);
        if tabs.is_some() {
            summary.untabbed = untabbed(sheets, &drawn);
        }
        summary.unlettered = unlettered.len();
        summary.a4 = page_count(&drawn, Stock::A4);
        summary.letter = page_count(&drawn, Stock::Letter);
        Ok(Drawing {
            width,
            height,
            sheets: drawn,
            pages: None,
            summary,
        })
    }

    /// Draws the sheets of a pattern; the summary also says which part of the surface is on no sheet ([`Pattern::missing`]), and which
    /// faces stand for it ([`Pattern::simplified`]).
    ///
    /// # Errors
    /// The errors of [`Drawing::new`].
    pub fn of(pattern: &Pattern, options: &DrawingOptions) -> Result<Self> {
        let mut drawn = Drawing::new(&pattern.sheets, options)?;
        let (mut missing, mut simplified) = (pattern.missing, pattern.simplified);
        missing.area *= options.scale * options.scale;
        missing.step_area *= options.scale * options.scale;
        (simplified.iter_mut()).for_each(|simplified| simplified.distance *= options.scale);
        drawn.summary.missing = Some(missing);
        drawn.summary.simplified = simplified;
        Ok(drawn)
    }

    /// Arranges the drawing's sheets on pages of a material, on as few as a greedy search finds. A sheet lies whole on
    /// one page, rotated if it fits better; on paper, a sheet that is larger than a page is divided over several pages
    /// to be glued together.
    ///
    /// Sheets are nested by their outlines, not as boxes: the largest first, each on the first page that has room,
    /// three millimetres apart at least.
    ///
    /// # Errors
    /// [`Error::Unsupported`] for more than [`MAX_PAGES`] pages, and for a sheet that does not fit on a plate
    /// or a roll; [`Error::Option`] for sizes that are not positive and finite.
    pub fn onto(self, stock: Stock) -> Result<Drawing> {
        let Arranged {
            places,
            pages,
            size,
        } = arrange_on_pages(&self.sheets, stock)?;
        if pages.pages.len() > MAX_PAGES {
            return Err(Error::Unsupported {
                format: "pattern",
                reason: format!(
                    "it takes {} pages of this size, more than the limit of {MAX_PAGES}; \
                     choose a smaller scale, larger paper or one large page",
                    pages.pages.len()
                ),
            });
        }
        Ok(Drawing {
            width: size[0],
            height: size[1],
            sheets: (self.sheets.into_iter().zip(&places))
                .map(|(sheet, place)| sheet.moved(place))
                .collect(),
            pages: Some(pages),
            summary: self.summary,
        })
    }

    /// Checks that a drawing is consistent, so that it can be written to a file; one that was read from a file may
    /// not be.
    #[cfg(feature = "patterns")]
    pub(crate) fn check(&self) -> Result<()> {
        let size = |value: f64| (0.0..=MAX_SIZE).contains(&value);
        let near = |p: &[f64; 2]| p.iter().all(|v| v.abs() <= 2.0 * MAX_SIZE);
        let lines = |sheet: &DrawnSheet| {
            let folds = sheet.folds.iter().chain(&sheet.tabs);
            let points = sheet.cuts.iter().chain(folds.map(|line| &line.points));
            let places = sheet.labels.iter().map(|label| label.place);
            let others = [&sheet.edges, &sheet.marks, &sheet.leaders];
            let courses = sheet
                .folds
                .iter()
                .chain(&sheet.tabs)
                .map(|line| &line.curve);
            points.flatten().chain(&sheet.bounds).all(near)
                && (sheet.printed.iter()).all(|printed| {
                    printed.corners.iter().all(near)
                        && printed.uvs.as_flattened().iter().all(|uv| uv.is_finite())
                })
                && (sheet
                    .curves
                    .iter()
                    .chain(others.into_iter().flatten())
                    .chain(courses))
                .all(|curve| curve.is_whole() && curve.controls().iter().all(near))
                && sheet
                    .labels
                    .iter()
                    .all(|l| size(l.size) && l.turn.is_finite())
                && places.into_iter().all(|place| near(&place))
        };
        let pages = self.pages.iter().all(|pages| {
            let corners = pages.pages.iter().map(|page| &page.corner);
            let sides = pages.paper.iter().chain(&pages.part);
            pages.pages.len() <= MAX_PAGES
                && corners.chain(&pages.marks).all(near)
                && sides.chain([&pages.blank]).all(|side| size(*side))
        });
        let whole = size(self.width) && size(self.height);
        match whole && pages && self.sheets.iter().all(lines) {
            true => Ok(()),
            false => Err(Error::Unsupported {
                format: "drawing",
                reason: "its coordinates must be finite, and within 50 metres".into(),
            }),
        }
    }
}

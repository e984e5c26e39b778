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

mod angles;
mod bend;
mod curve;
mod draft;
mod joints;
mod label;
mod leader;
mod marks;
mod nest;
mod offset;
mod options;
mod pack;
mod pages;
mod smooth;
mod spline;
mod tabs;
mod totals;

use super::pattern::{Direction, Missing, Seam, Sheet};
use crate::error::{Error, Result, positive};
use crate::math::planar::{distance, polyline_length};
pub use angles::WorstAngle;
pub use bend::Bending;
use bend::bent;
pub use curve::{Curve, Piece};
pub(crate) use draft::letters;
use draft::{Lines, Named};
pub use label::{Label, LabelKind};
use marks::counts;
use nest::Shape;
pub use options::DrawingOptions;
#[cfg(feature = "patterns")]
pub(crate) use pack::beside;
use pack::{Place, packed};
use pages::count;
pub use pages::{MAX_PAGES, Page, Pages, Stock};
#[cfg(feature = "patterns")]
pub(crate) use smooth::smooth;
use totals::summary;
pub use totals::{Totals, WorstJoint};

/// Width of the empty margin around sheets, in millimetres.
pub(crate) const SHEET_MARGIN_MM: f64 = 10.0;

/// Maximum distance between a curve and the polyline that is given for it, in millimetres.
const FLATTENING_TOLERANCE_MM: f64 = 0.02;

/// Maximum side of a drawing, in millimetres.
pub const MAX_SIZE: f64 = 50_000.0;

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
    /// The pages that they lie on, if there are any ([`Drawing::onto`]).
    pub pages: Option<Pages>,
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
    /// Closed lines, the last point joined to the first; around tabs, too. Points within a fiftieth of a
    /// millimetre of [`DrawnSheet::curves`].
    pub cuts: Vec<Vec<[f64; 2]>>,
    /// The same lines as curves.
    pub curves: Vec<Curve>,
    /// Where it is folded.
    pub folds: Vec<Line>,
    /// Where tabs are folded.
    pub tabs: Vec<Line>,
    /// The edges of the surface, where there is an allowance around them: where it is sewn or bent over.
    pub edges: Vec<Curve>,
    /// Short lines along seams, which lie on each other when these are joined.
    pub marks: Vec<Curve>,
    /// From places that are too small to write on to what is written beside the sheet.
    pub leaders: Vec<Curve>,
    /// What is written on it, or beside it.
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
    /// Its course, within a fiftieth of a millimetre of [`Line::curve`].
    pub points: Vec<[f64; 2]>,
    /// Its course.
    pub curve: Curve,
}

impl Drawing {
    /// Draws sheets beside each other: in rows, the tallest first, ten millimetres apart.
    ///
    /// Cut creases have letters, the same on both sides; patches their number, counted from 1;
    /// folds an M or a V and their angle. Both sides of what is cut and joined are drawn equally long: what strain is
    /// left shows along borders, and their lines are moved by as little as it takes, within
    /// [`DrawingOptions::smoothing`] and a hundredth of their length. Where that is not enough or lines would cross,
    /// [`Totals::mismatch`] tells. Metal that is bent, and lines without smoothing, are drawn as they are.
    ///
    /// Costs `O(points)` without tabs; each tab is compared with its whole sheet.
    ///
    /// # Errors
    /// [`Error::Empty`] without a sheet, [`Error::Option`] for lengths that are negative or not finite, or if the
    /// drawing is larger than [`MAX_SIZE`], [`Error::Unsupported`] for a kerf or an allowance at which an outline
    /// would cross itself, or for folds that are not straight from edge to edge where metal is bent.
    pub fn new(sheets: &[Sheet], options: &DrawingOptions) -> Result<Self> {
        let scale = positive("scale", options.scale)?;
        let tabs = options.tabs.map(|t| positive("tabs", t)).transpose()?;
        if sheets.is_empty() {
            return Err(Error::Empty { what: "pattern" });
        }
        options.check()?;
        let letters = letters(sheets);
        let options = DrawingOptions { tabs, ..*options };
        let sheets: &[Sheet] = &(sheets.iter().enumerate())
            .map(|(number, sheet)| bent(number, sheet, &options))
            .collect::<Result<Vec<_>>>()?;
        let lines = Lines::all(sheets, &options);
        let marks = options.marks.map(|distance| counts(&lines, distance));
        let named = Named {
            letters,
            marks: marks.unwrap_or_default(),
        };
        let drawn: Vec<DrawnSheet> = (sheets.iter().zip(&lines).enumerate())
            .map(|(number, (sheet, own))| DrawnSheet::new(number, sheet, own, &options, &named))
            .collect::<Result<_>>()?;
        let boxes: Vec<Place> = (drawn.iter())
            .map(|sheet| Place::around(&Shape::new(sheet).lines))
            .collect();
        let (places, [width, height]) = packed(&boxes);
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
        summary.a4 = count(&drawn, Stock::A4);
        summary.letter = count(&drawn, Stock::Letter);
        Ok(Drawing {
            width,
            height,
            sheets: drawn,
            pages: None,
            summary,
        })
    }

    /// The same with what of the surface is on no sheet
    /// ([`Pattern::missing`](super::pattern::Pattern::missing)), `scale` being that of the drawing.
    pub fn missing(mut self, missing: &Missing, scale: f64) -> Self {
        let mut missing = *missing;
        missing.area *= scale * scale;
        missing.step_area *= scale * scale;
        self.summary.missing = Some(missing);
        self
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
            let others = [&sheet.edges, &sheet.marks, &sheet.leaders];
            let courses = sheet
                .folds
                .iter()
                .chain(&sheet.tabs)
                .map(|line| &line.curve);
            points.flatten().chain(&sheet.bounds).all(near)
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

impl Line {
    fn new(seam: Seam, curve: Curve) -> Self {
        let line = Line {
            crease: seam.crease,
            direction: seam.direction,
            angle: seam.angle.to_degrees(),
            length: 0.0,
            points: Vec::new(),
            curve: Curve::of(Vec::new()),
        };
        line.along(curve)
    }

    /// The same with another course.
    fn along(self, curve: Curve) -> Self {
        let points = curve.points(FLATTENING_TOLERANCE_MM);
        Line {
            length: polyline_length(&points),
            points,
            curve,
            ..self
        }
    }
}

/// The place so far along a line, and where it heads there.
fn place_at(points: &[[f64; 2]], along: f64) -> ([f64; 2], [f64; 2]) {
    let (mut rest, mut place, mut heading) = (along, points[0], [1.0, 0.0]);
    for piece in points.windows(2) {
        let step = distance(piece[0], piece[1]);
        if step > 0.0 {
            heading = [0, 1].map(|k| (piece[1][k] - piece[0][k]) / step);
            place = [0, 1].map(|k| piece[0][k] + heading[k] * rest.min(step));
        }
        if rest <= step {
            break;
        }
        rest -= step;
    }
    (place, heading)
}

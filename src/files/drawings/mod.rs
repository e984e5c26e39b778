//! Patterns in files: SVG, PDF and DXF of a [`Drawing`], in true size. Curves are cubic Bézier curves in SVG
//! and PDF, arcs of circles in DXF.
//!
//! | | cut | mountain fold | valley fold | fold of a tab | edge within an allowance | mark | leader, text |
//! |---|---|---|---|---|---|---|---|
//! | SVG and PDF | black | red, dash-dot | blue, dashed | purple, dashed | orange, dashed | green | grey |
//! | layers of SVG | `cut` | `mountain` | `valley` | `tab` | `edge` | `mark` | `leader`, `label` |
//! | layers of DXF, their colours | `CUT`, 7 | `MOUNTAIN`, 1 | `VALLEY`, 5 | `TAB`, 8 | `EDGE`, 30 | `MARK`, 3 | `LEADER`, `LABEL`, 9 |
//!
//! Parts of a mesh's textures are printed below all lines, in SVG in the layer `picture`.
//!
//! ```
//! use developable::drawing::{Drawing, DrawingOptions};
//! use developable::files::drawings::write_svg;
//! # use developable::patches::{PatchOptions, Patches};
//! # use developable::pattern::{PatternOptions, pattern};
//! # use developable::{Heightfield, Lattice};
//! # fn main() -> developable::Result<()> {
//! # let card = Heightfield::from_fn(Lattice::new(40, 40, 2.5)?, |x, _| -0.5 * (x - 52.0).abs())?;
//! # let patches = Patches::new(&card, &PatchOptions::default())?;
//! # let pattern = pattern(&card, &patches, &PatternOptions::default())?;
//! let drawing = Drawing::new(&pattern.sheets, &DrawingOptions::default())?;
//! let file = write_svg(&drawing, Some("card"), &[])?;
//! assert!(String::from_utf8_lossy(&file).contains("id=\"mountain\""));
//! # Ok(())
//! # }
//! ```

mod arcs;
mod dxf;
mod pdf;
mod printed;
mod svg;

use crate::drawing::{Curve, Drawing, DrawnSheet, Line};
use crate::pattern::Direction;
pub use dxf::write_dxf;
pub use pdf::{PdfOptions, write_pdf};
pub use printed::TextureFile;
pub use svg::write_svg;

/// Title of a document that is given none.
const UNTITLED: &str = "Pattern";

/// The purpose of a line in a drawing (to cut, to fold, a mark …), in the order in which lines are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Mountain,
    Valley,
    Tab,
    Edge,
    Mark,
    Leader,
    Cut,
}

/// Kinds of lines with their names, their colours (red, green and blue, from 0 to 255), and the lengths of their dashes and gaps in
/// millimetres; none for solid lines.
#[rustfmt::skip]
const KINDS: [(Kind, &str, [u8; 3], &[f32]); 7] = [
    (Kind::Mountain, "mountain", [200, 0, 0], &[4.0, 1.2, 0.6, 1.2]),
    (Kind::Valley, "valley", [0, 60, 200], &[2.5, 1.5]),
    (Kind::Tab, "tab", [160, 0, 160], &[1.0, 1.0]),
    (Kind::Edge, "edge", [200, 120, 0], &[2.0, 2.0]),
    (Kind::Mark, "mark", [0, 140, 0], &[]),
    (Kind::Leader, "leader", [TEXT_GREY_LEVEL; 3], &[]),
    (Kind::Cut, "cut", [0, 0, 0], &[]),
];

impl Kind {
    fn all() -> impl Iterator<Item = Kind> {
        KINDS.into_iter().map(|(kind, ..)| kind)
    }

    fn name(self) -> &'static str {
        KINDS[self as usize].1
    }

    fn color(self) -> [u8; 3] {
        KINDS[self as usize].2
    }

    fn dashes(self) -> &'static [f32] {
        KINDS[self as usize].3
    }

    fn of(direction: Direction) -> Kind {
        match direction {
            Direction::Mountain => Kind::Mountain,
            Direction::Valley => Kind::Valley,
        }
    }

    /// Returns the lines of this kind on a sheet, and whether these lines are closed.
    fn lines(self, sheet: &DrawnSheet) -> (Vec<&Curve>, bool) {
        let course = |line: &'_ &Line| Kind::of(line.direction) == self;
        match self {
            Kind::Cut => (sheet.curves.iter().collect(), true),
            Kind::Edge => (sheet.edges.iter().collect(), true),
            Kind::Mark => (sheet.marks.iter().collect(), false),
            Kind::Leader => (sheet.leaders.iter().collect(), false),
            Kind::Tab => (sheet.tabs.iter().map(|l| &l.curve).collect(), false),
            _ => {
                let own = sheet.folds.iter().filter(course);
                (own.map(|line| &line.curve).collect(), false)
            }
        }
    }
}

/// Width of all lines in a written drawing, in millimetres.
const LINE_WIDTH_MM: f64 = 0.2;

/// Grey level of all text in a written drawing, from 0 (black) to 255 (white).
const TEXT_GREY_LEVEL: u8 = 90;

/// Distance from the middle of a line of text down to its baseline, in font sizes.
const BASELINE_DROP: f64 = 0.35;

/// A line of a drawing, and whether the line is closed.
type Drawn<'a> = (&'a Curve, bool);

/// Iterates over the kinds of lines: yields each kind with the lines of this kind on all sheets of a drawing.
fn layers(drawing: &Drawing) -> impl Iterator<Item = (Kind, Vec<Drawn<'_>>)> {
    Kind::all().map(|kind| {
        let lines = drawing.sheets.iter().flat_map(move |sheet| {
            let (lines, closed) = kind.lines(sheet);
            lines.into_iter().map(move |curve| (curve, closed))
        });
        (kind, lines.collect())
    })
}

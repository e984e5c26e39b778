//! Patterns as they are drawn, in millimetres: sheets beside each other, with lines to cut and to
//! fold, tabs and labels. [`files::drawings`](crate::files::drawings) writes them to files.
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

mod bend;
mod bend_lines;
mod bending;
mod circle;
mod curve;
mod draft;
mod draw;
mod flap;
mod label;
mod leader;
mod line;
mod lines;
mod marks;
mod nest;
mod offset;
mod options;
mod pack;
mod pages;
mod sheet;
mod smooth;
mod tabs;
mod totals;

pub use bending::Bending;
pub use curve::{Curve, Piece};
pub(crate) use draft::letters;
pub use draw::Drawing;
pub use label::{Label, LabelKind};
pub use line::{Line, LineBend};
pub use options::{DrawingOptions, MAX_SIZE};
#[cfg(feature = "patterns")]
pub(crate) use pack::beside;
pub use pages::{MAX_PAGES, Page, Pages, Stock};
pub use sheet::{DrawnSheet, PrintedTriangle};
pub use totals::{Totals, WorstAngle, WorstJoint};

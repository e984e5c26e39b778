//! Patterns: a surface cut along its creases into sheets that lie flat, with as few cuts as
//! possible.
//!
//! Each patch is laid flat by itself, up to the line where its neighbours' continuations meet its
//! own ([`Sheet::outlines`] says what that line is worth). Patches are then laid beside each other
//! where their sides of a crease fit and nothing comes to lie on anything else, the longest creases
//! first; such a crease is a fold, every other one a cut. Around a vertex where the angles make up
//! a full turn, all creases are folds. What cannot be laid flat without strain is cut until it can.
//!
//! ```
//! use developable::patches::{PatchOptions, Patches};
//! use developable::pattern::{Direction, PatternOptions, pattern};
//! use developable::{Heightfield, Lattice};
//! # fn main() -> developable::Result<()> {
//! // A folded card: two patches, one sheet.
//! let card = Heightfield::from_fn(Lattice::new(40, 40, 0.025)?, |x, _| -0.5 * (x - 0.52).abs())?;
//! let patches = Patches::new(&card, &PatchOptions::default())?;
//! let sheets = pattern(&card, &patches, &PatternOptions::default())?.sheets;
//! assert_eq!(sheets.len(), 1);
//! assert_eq!(sheets[0].patches, [0, 1]);
//! let fold = &sheets[0].folds[0];
//! assert_eq!((fold.seam.crease, fold.seam.direction), (0, Direction::Mountain));
//! # Ok(())
//! # }
//! ```

mod assembly;
mod check;
mod coarse;
mod crumbs;
mod cut;
mod exact;
mod faces;
mod fault;
mod fine;
mod flat_mesh;
mod flat_patch;
mod heightfield;
mod junction;
mod label_spot;
mod labels;
mod layout;
mod line;
mod mesh;
mod motion;
mod options;
mod outline;
mod outline_loops;
mod parts;
mod refold;
mod seam_graph;
mod sew;
mod sheet_lines;
mod sheets;
mod transfer;
mod trim;
mod window;

pub use exact::{
    FoundFaces, MeshKind, NetOptions, SheetMetal, noisy_faces, pattern_exact, rolled_faces,
    sheet_metal,
};
pub use faces::Faces;
pub use heightfield::pattern;
pub use junction::Junction;
pub(crate) use line::simplify_polyline;
pub use mesh::{MeshPattern, pattern_mesh};
pub use options::PatternOptions;
pub(crate) use outline_loops::remove_loops;
pub use sheets::{Bend, Direction, Fold, Missing, Pattern, Refolding, Run, Seam, Sheet, Spot};

//! Patterns: a surface cut along its creases into sheets that lie flat, with as few cuts as
//! possible.
//!
//! A surface is one mesh whose creases are edges; a heightfield is made such a mesh first. What cannot be laid flat without strain
//! is cut until it can. Then parts are laid beside each other where their sides fit and nothing comes to lie on anything else, the
//! longest seams first; such a seam is a fold if it is a crease, every other one a cut. Around a vertex where the angles make up
//! a full turn, all creases are folds.
//!
//! That is what [`pattern`] does with heights and [`pattern_mesh`] with a mesh; [`pattern_exact`] lays flat faces flat as they are.
//! [`lay_flat`] takes any surface, and the way that suits it.
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

mod crumbs;
mod cutting;
mod exact;
mod faces;
mod flat_mesh;
mod label_spot;
mod lay_flat;
mod options;
mod sheets;
mod smooth_creases;
mod surface;
mod surface_mesh;

pub use crate::scene::exactness::MAX_FEW_FACES;
pub use exact::{
    FoundFaces, MeshKind, NetOptions, RecognizedMesh, SheetMetal, pattern_exact, sheet_metal,
};
pub use faces::Faces;
pub use lay_flat::{FlatOptions, Shape, lay_flat};
pub use options::PatternOptions;
pub use sheets::{
    Bend, Direction, Fold, Junction, Missing, Pattern, Refolding, Run, Seam, Sheet, Simplified,
    Spot,
};
pub use surface::{pattern, pattern_mesh};

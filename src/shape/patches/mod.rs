//! Where a surface creases, and the smooth patches between the creases
//! ([paper](crate#references), Sec. 6).
//!
//! The paper floods the surface where the nuclear norm of the Hessian is low. Here what counts is
//! the angle by which the surface bends from one vertex to the next, so that a threshold means the
//! same on steep and on level ground, and two thresholds instead of one: a crease is a band of
//! vertices that bend by more than the lower one, with one among them that bends by more than the
//! higher one. What is left falls apart into patches. Then the patches grow into the bands, the
//! vertices that bend least first, until they meet on the bands' ridges; patches with hardly an
//! angle between them become one. Where creases end at the border of the surface, vertices go to the
//! patch that they lie on.
//!
//! ```
//! use developable::patches::{PatchOptions, Patches};
//! use developable::{Heightfield, Lattice};
//! # fn main() -> developable::Result<()> {
//! // Two planes that meet at an angle.
//! let roof = Heightfield::from_fn(Lattice::new(40, 40, 0.025)?, |x, _| -0.5 * (x - 0.52).abs())?;
//! let found = Patches::new(&roof, &PatchOptions::default())?;
//! assert_eq!(found.patches().len(), 2);
//! let ridge = &found.creases()[0];
//! assert!((ridge.fold - 2.0 * 0.5f64.atan()).abs() < 0.02);
//! assert!((ridge.length / (39.0 * roof.lattice().row_spacing()) - 1.0).abs() < 0.05);
//! # Ok(())
//! # }
//! ```

mod bend;
pub(crate) mod chains;
pub(crate) mod crease;
pub(crate) mod extend;
mod flood;
mod heightfield;
mod merge;
mod mesh;
mod options;
mod patch;

pub use crease::Crease;
pub use heightfield::Patches;
pub use mesh::MeshPatches;
pub use options::PatchOptions;
pub use patch::{NO_PATCH, Patch};

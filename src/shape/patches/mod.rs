//! Segmentation of a surface into patches along its creases ([paper](crate#references), Sec. 6).
//!
//! The paper floods the surface where the nuclear norm of the Hessian is low. Here the measure is
//! the angle by which the surface bends from one vertex to the next, so that a threshold means the
//! same on steep and on level ground; and there are two thresholds (hysteresis): a crease is a band of
//! vertices above the lower one that contains a vertex above the
//! higher one. The connected components of the rest are patches. They grow into the bands, the
//! vertices that bend least first, until they meet on the bands' ridges; patches that meet at a small
//! angle are merged. Where creases end at the border of the surface, vertices are assigned to the
//! patch whose extrapolation they lie on.
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

pub(crate) mod bend_angles;
pub(crate) mod chains;
pub(crate) mod crease;
pub(crate) mod extrapolate;
mod flood_fill;
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

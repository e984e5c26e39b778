//! How sheets are put together: in what order, along which seams, and where each of them goes.
//!
//! ```
//! use developable::assembly::Assembly;
//! use developable::patches::{PatchOptions, Patches};
//! use developable::pattern::{PatternOptions, pattern};
//! use developable::{Heightfield, Lattice};
//! # fn main() -> developable::Result<()> {
//! // A pyramid of four faces, which is cut along one of its edges.
//! let lattice = Lattice::covering([0.0, 0.0], [1.0, 1.0], 0.025)?;
//! let roof = Heightfield::from_fn(lattice, |x, y| -0.8 * (x - 0.51).abs().max((y - 0.5).abs()))?;
//! let patches = Patches::new(&roof, &PatchOptions::default())?;
//! let found = pattern(&roof, &patches, &PatternOptions::default())?;
//! let assembly = Assembly::new(&found.sheets);
//! assert_eq!(assembly.steps.len(), found.sheets.len());
//! assert!(!assembly.steps.last().unwrap().joints.is_empty());
//! # Ok(())
//! # }
//! ```

// Only pictures look at it.
#[cfg(feature = "patterns")]
mod built;
mod order;
mod pose;

#[cfg(feature = "patterns")]
pub(crate) use built::{Built, faces_up};
pub use order::{Assembly, Joint, Step};
pub use pose::Pose;

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

use super::drawing::letters;
use super::pattern::Sheet;
#[cfg(feature = "patterns")]
pub(crate) use built::{Built, faces_up};
use order::ordered;
pub use pose::Pose;

/// How sheets are put together.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct Assembly {
    /// Sheet by sheet: first the one with the largest patch, then always the one with the longest seams to those
    /// that are there.
    pub steps: Vec<Step>,
}

/// One sheet and what it is joined to.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct Step {
    /// The sheet's number, from 0; its name has the next one.
    pub sheet: usize,
    /// The seams that are closed when it is there, the longest first.
    pub joints: Vec<Joint>,
}

/// A seam between sheets, or of a sheet with itself.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct Joint {
    /// Its letters on the drawing.
    pub name: String,
    /// The sheet that was there before; that of the step for a seam of its own.
    pub to: usize,
    /// Its length, in the surface's units.
    pub length: f64,
}

impl Assembly {
    /// The order in which sheets are joined. Costs `O(sheets² + runs)`.
    pub fn new(sheets: &[Sheet]) -> Self {
        Assembly {
            steps: ordered(sheets, &letters(sheets)),
        }
    }
}

//! Heightfields to piecewise-developable surfaces.

mod error;
mod heightfield;
mod lattice;

pub use error::{Error, MAX_CELLS, Result};
pub use heightfield::{HeightImage, Heightfield};
pub use lattice::Lattice;

//! Heightfields to piecewise-developable surfaces.

mod error;
mod heightfield;
mod lattice;
mod resample;

pub use error::{Error, MAX_CELLS, Result};
pub use heightfield::{HeightImage, Heightfield};
pub use lattice::Lattice;

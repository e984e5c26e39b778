//! Heightfields to piecewise-developable surfaces.

mod domain;
mod error;
mod examples;
#[cfg(feature = "formats")]
pub mod formats;
mod heightfield;
mod hessian;
mod lattice;
mod resample;
mod restore;
mod solver;
mod spectral;
mod stencil;
mod surface;
#[cfg(target_arch = "wasm32")]
mod wasm;

pub use domain::{Domain, Role};
pub use error::{Error, MAX_CELLS, Result};
pub use examples::{Example, ExampleOptions, Sample};
pub use heightfield::{HeightImage, Heightfield};
pub use hessian::HessianOperator;
pub use lattice::Lattice;
pub use solver::{
    Lambda, LevelReport, Normalization, Options, Progress, Report, Schedule, Seconds, Solver,
    Status, StopReason, fit, fit_with,
};
pub use spectral::Sym2;
pub use stencil::Quadratic;
pub use surface::Surface;

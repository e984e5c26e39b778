//! Meshes as they are, without a view: closed, overhanging, with borders or in parts.
//!
//! The paper's energy needs heights. Here each vertex moves along a ray, and what takes the place of the
//! Hessian is the second fundamental form by a quadratic fit over its neighbours, linearised about a
//! smoothed base; the operator is a sparse matrix, and everything else is that of heightfields.

mod ball;
mod base;
mod border;
mod crossing;
mod curve;
mod fairing;
mod fans;
pub(crate) mod geometry;
mod given;
mod known;
pub(crate) mod linear;
mod load;
mod noise;
mod options;
mod penalty;
mod quadratic;
mod report;
mod shape;
mod sharpen;
mod sides;
mod solver;
#[cfg(test)]
mod tests;
pub(crate) mod topology;
mod ways;

pub(crate) use ball::scale_of;
pub use known::MeshKnown;
pub use options::MeshOptions;
pub use report::{MeshPass, MeshReport, Repairs};
pub use solver::{MeshSolver, MeshSurface, fit_mesh};

//! Meshes as they are, without a view: closed, overhanging, with borders or in parts.
//!
//! The paper's energy needs heights. Here each vertex moves along a ray, and what takes the place of the
//! Hessian is the second fundamental form by a quadratic fit over its neighbours, linearised about a
//! smoothed base; the operator is a sparse matrix, and everything else is that of heightfields.

mod border;
mod crossing;
mod curve;
mod fans;
pub(crate) mod geometry;
pub(crate) mod linear;
mod load;
mod noise;
mod options;
mod quadratic;
mod report;
mod sharpen;
mod sides;
mod solver;
#[cfg(test)]
mod tests;
pub(crate) mod topology;

pub use options::MeshOptions;
pub use report::{MeshPass, MeshReport, Repairs};
pub(crate) use solver::scale_of;
pub use solver::{MeshKnown, MeshSolver, MeshSurface, fit_mesh};

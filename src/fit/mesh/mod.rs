//! Fits of whole meshes, as surfaces in space and not as seen from one side: closed, overhanging, with borders or in
//! components.
//!
//! The paper's energy needs heights. Here each vertex moves along a ray, and the second fundamental form takes
//! the place of the Hessian: that of a quadratic fitted to the neighbours, linearised about a smoothed base.
//! The operator is a sparse matrix, and everything else is as for heightfields.

mod adjacency;
mod base;
mod bounding_sphere;
mod clusters;
mod crease_directions;
mod edge_load;
mod fairing;
mod finishing;
pub(crate) mod geometry;
mod input;
mod interpolation;
mod known;
mod level_transfer;
mod level_vertices;
mod levels;
pub(crate) mod linearisation;
mod morton_order;
mod noise_level;
mod options;
mod orientation;
mod quadratic;
mod reach;
mod report;
mod rho_shares;
mod self_intersections;
mod shape_measures;
mod smooth_regions;
mod solver;
#[cfg(test)]
mod tests;
mod tight_bends;
pub(crate) mod topology;

pub(crate) use bounding_sphere::bounding_sphere_scale;
pub use known::MeshKnown;
pub use options::MeshOptions;
pub use report::{EntangledTriangle, MeshPass, MeshReport, Repairs};
pub use solver::{MeshSolver, MeshSurface, fit_mesh};

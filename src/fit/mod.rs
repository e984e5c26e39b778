//! The solve: from heights or meshes to the surface that minimises the energy (paper, Sec. 4), with a certified duality
//! gap.

mod admm;
mod border_load;
mod coarsen;
mod component_setup;
pub(crate) mod component_solver;
mod components;
mod coordinates;
pub(crate) mod cylinder;
mod energy;
mod extrapolate_omitted;
mod heightfields;
pub(crate) mod input;
mod linear;
pub(crate) mod mesh;
mod multilevel;
mod operator;
pub(crate) mod options;
mod prolong;
pub(crate) mod report;
pub(crate) mod solver;
pub(crate) mod surface;
mod thin_plate;
pub(crate) mod threads;
mod totals;
mod tuning;
mod warm_start;

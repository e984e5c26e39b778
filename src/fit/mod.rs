//! From heights to the surface that minimises the energy (paper, Sec. 4), with a certified
//! duality gap.

mod admm;
mod border_load;
mod cascade;
mod coarsen;
mod components;
mod coordinates;
pub(crate) mod cylinder;
mod energy;
mod heightfields;
pub(crate) mod input;
mod linear;
pub(crate) mod mesh;
mod operator;
pub(crate) mod options;
pub(crate) mod partwise;
mod plate;
mod preparation;
mod prolong;
pub(crate) mod report;
mod restore;
pub(crate) mod solver;
pub(crate) mod surface;
mod totals;
mod tuning;
mod warm_start;

//! The hexagonal lattice, the domain of vertices that take part in a solve, and the stencil of the Hessian on
//! it.

pub(crate) mod bands;
pub(crate) mod coarsening;
pub(crate) mod domain;
pub(crate) mod hessian;
pub(crate) mod hexagonal;
pub(crate) mod per_cell;
pub(crate) mod runs;
pub(crate) mod stencil;

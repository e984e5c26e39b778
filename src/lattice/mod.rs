//! The hexagonal lattice, the vertices of it that take part, and the Hessian's stencil on them.

pub(crate) mod coarsening;
pub(crate) mod domain;
pub(crate) mod hessian;
pub(crate) mod hexagonal;
pub(crate) mod per_cell;
pub(crate) mod runs;
pub(crate) mod stencil;

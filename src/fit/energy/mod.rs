//! The energy that a solve minimises: fidelity, spectral penalty of the Hessians, weights at creases, and bending
//! moments on borders.

pub(crate) mod creases;
pub(crate) mod moment_load;
pub(crate) mod problem;
pub(crate) mod spectral_penalty;

//! The energy of a solve: fidelity, spectral penalty of the Hessians, weights at creases, and moments on
//! borders.

pub(crate) mod creases;
pub(crate) mod moment_load;
pub(crate) mod problem;
pub(crate) mod spectral_penalty;

//! The energy, and its norm's proximal map, value and conjugate.

pub(crate) mod creases;
pub(crate) mod moment_load;
pub(crate) mod problem;
pub(crate) mod spectral_penalty;

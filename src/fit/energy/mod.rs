//! The energy, and its norm's proximal map, value and conjugate.

pub(crate) mod creases;
pub(crate) mod law;
pub(crate) mod load;
pub(crate) mod problem;

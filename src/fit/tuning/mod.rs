//! Options from the data: λ and the penalty's parameters from the size of the noise and by cross-validation.

mod correlated_noise;
mod curvature_scales;
pub(crate) mod held_out;
pub(crate) mod merge;
pub(crate) mod noise;
pub(crate) mod search;

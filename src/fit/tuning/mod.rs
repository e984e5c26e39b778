//! Options from the data: how large its noise is, and what predicts heights best that were held out.

mod correlated_noise;
mod curvature_scales;
pub(crate) mod held_out;
pub(crate) mod merge;
pub(crate) mod noise;
pub(crate) mod search;

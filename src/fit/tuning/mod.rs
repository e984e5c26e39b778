//! Options from the data: λ from the noise of the heights, and the penalty that predicts held-out heights best.

pub(crate) mod closed_form;
mod correlated_noise;
mod curvature_scales;
pub(crate) mod levelling;
pub(crate) mod merge;
pub(crate) mod noise;
pub(crate) mod refinement;
pub(crate) mod residual;
pub(crate) mod search;
mod trust;
pub(crate) mod validation;

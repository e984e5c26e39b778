//! Heights on the lattice and on square pixels: resampling between both, occlusions, and bridging of small
//! holes.

pub(crate) mod bridging;
pub(crate) mod heightfield;
mod line_offsets;
pub(crate) mod normalization;
pub(crate) mod occlusions;
pub(crate) mod pixel_noise;
pub(crate) mod resample;

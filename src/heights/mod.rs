//! Heights: on the lattice and on square pixels, from one to the other, and where they are torn.

pub(crate) mod heightfield;
pub(crate) mod normalization;
pub(crate) mod occlusions;
pub(crate) mod resample;

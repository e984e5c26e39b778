//! Heights: on the lattice and on square pixels, from one to the other, where they are torn, and
//! small holes bridged.

pub(crate) mod bridging;
pub(crate) mod heightfield;
pub(crate) mod normalization;
pub(crate) mod occlusions;
pub(crate) mod resample;

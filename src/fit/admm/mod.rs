//! ADMM (paper, Eq. 17 to 19): its iterate, its schedule and its certificate.

mod affine;
mod ascent;
mod balance;
pub(crate) mod best;
pub(crate) mod iteration;
mod rank;
pub(crate) mod schedule;
pub(crate) mod state;

//! ADMM (paper, Eq. 15 to 19): its iterate, the two schedules that it follows, and its certificate.
//!
//! [`paper`] is the algorithm of the paper, to be read beside it, and [`default_schedule`] what runs unless
//! that is asked for. Both are made of the same [`steps`].

mod affine;
mod balance;
mod certificate;
pub(crate) mod default_rho;
mod default_schedule;
mod divergence;
mod dual_ascent;
pub(crate) mod incumbent;
pub(crate) mod iterate;
mod matrix_field;
mod paper;
pub(crate) mod parameters;
mod rank;
pub(crate) mod solver;
pub(crate) mod steps;
mod timing;
mod z_step;

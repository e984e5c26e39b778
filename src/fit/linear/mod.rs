//! The z-step's linear system: conjugate gradients, preconditioned by multigrid.

mod border;
pub(crate) mod cg;
pub(crate) mod grid;
pub(crate) mod multigrid;
pub(crate) mod refined_solver;
pub(crate) mod transfer;
pub(crate) mod z_step_solver;

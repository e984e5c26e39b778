//! The interface between ADMM and the linear solvers of its z-step (paper, Eq. 17).

use std::fmt::Debug;

use crate::error::Result;
use crate::fit::energy::problem::Problem;
use crate::fit::operator::Operator;

/// An operator for whose z-step there is a linear solver.
pub(crate) trait SolvableOperator: Operator {
    /// Type of the z-step's linear solver.
    type Solver: ZStepSolver<Self>;
}

/// Stopping criteria of conjugate gradients in double precision.
#[derive(Debug, Clone, Copy)]
pub(crate) struct CgCriteria {
    /// Residual, relative to the first residual, at which conjugate gradients stop.
    pub tolerance: f64,
    pub max_iterations: usize,
}

/// Linear solver of the z-step: finds the correction `δ` with `A δ = b − A z`, `A = 2λw + ρCᵀC`, over the vertices that
/// are not constrained.
pub(crate) trait ZStepSolver<O: Operator>: Clone + Debug {
    /// Changes ρ in the matrix `A`; the residual has to be written again.
    fn set_rho(&mut self, rho: f64);

    /// Buffer for the residual `b − A z`: whoever changes `b` or `z` writes it, times [`Self::residual_scale`], and
    /// calls [`Self::restart`].
    fn residual(&mut self) -> &mut [f32];

    /// Factor by which the residual `b − A z` is multiplied in the solver.
    fn residual_scale(&self) -> f64;

    /// Starts the iterations again from the residual that was just written.
    fn restart(&mut self, operator: &O);

    /// Squared residual `‖r‖²` in the norm of the matrix's inverse diagonal.
    fn energy(&self) -> f64;

    /// Residual relative to the right-hand side `2λw z̃`, both in the norm of the matrix's inverse diagonal.
    fn relative_residual(&self, problem: &Problem<O>) -> f64;

    /// Takes one iteration, of conjugate gradients or a V-cycle; returns `false`, with nothing changed, when nothing is left to improve.
    fn step(&mut self, operator: &O) -> bool;

    /// Adds the correction `δ` found so far to the heights `z`.
    fn correct(&mut self, operator: &O, z: &mut [f64]);

    /// Solves the system in double precision: improves `x` until its `residual`, which the caller provides, meets the
    /// criteria relative to its first value. Returns the number of iterations; the residual is of no use afterwards.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    fn solve_precisely(
        &mut self,
        problem: &Problem<O>,
        residual: &mut Vec<f64>,
        x: &mut [f64],
        criteria: CgCriteria,
    ) -> Result<usize>;
}

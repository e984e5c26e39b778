//! The interface between ADMM and the linear solvers of its z-step (paper, Eq. 17).

use std::fmt::Debug;

use crate::error::Result;
use crate::fit::energy::problem::Problem;
use crate::fit::operator::Operator;

/// An operator whose z-step has a solver.
pub(crate) trait SolvableOperator: Operator {
    /// The solver of the z-step.
    type Solver: ZStepSolver<Self>;
}

/// When conjugate gradients in double precision stop.
#[derive(Debug, Clone, Copy)]
pub(crate) struct CgCriteria {
    /// Residual relative to the first one.
    pub tolerance: f64,
    pub max_iterations: usize,
}

/// Linear solver of the z-step: finds the correction of `A δ = b − A z`, `A = 2λw + ρCᵀC`, over the vertices
/// that are not constrained.
pub(crate) trait ZStepSolver<O: Operator>: Clone + Debug {
    /// Changes ρ in `A`; the residual has to be written again.
    fn set_rho(&mut self, rho: f64);

    /// The residual `b − A z` in the system's scale: whoever changes `b` or `z` writes it (times
    /// [`Self::residual_scale`]) and calls [`Self::restart`].
    fn residual(&mut self) -> &mut [f32];

    /// Factor from `b − A z` to the system's scale.
    fn residual_scale(&self) -> f64;

    /// Starts again from the residual that was just written.
    fn restart(&mut self, operator: &O);

    /// Squared residual `‖r‖²` in the norm of the inverse diagonal.
    fn energy(&self) -> f64;

    /// Residual relative to `‖2λw z̃‖`, in the norm of the inverse diagonal.
    fn relative_residual(&self, problem: &Problem<O>) -> f64;

    /// Takes one iteration; `false`, with nothing changed, when there is nothing left to improve.
    fn step(&mut self, operator: &O) -> bool;

    /// Adds the correction found so far to `z`.
    fn correct(&mut self, operator: &O, z: &mut [f64]);

    /// Solves in double precision: adds to `x` until the residual, which is given for `x`, meets the criteria
    /// relative to what it was. Returns the number of iterations; the residual is of no use afterwards.
    ///
    /// # Errors
    /// Out of memory.
    fn solve_precisely(
        &mut self,
        problem: &Problem<O>,
        residual: &mut Vec<f64>,
        x: &mut [f64],
        criteria: CgCriteria,
    ) -> Result<usize>;
}

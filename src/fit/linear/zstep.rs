//! What ADMM asks of a solver of its z-step (paper, Eq. 17), whatever operator there is.

use std::fmt::Debug;

use crate::error::Result;
use crate::fit::energy::problem::Problem;
use crate::fit::operator::Operator;

/// An operator for whose z-step there is a solver.
pub(crate) trait Solvable: Operator {
    type Solver: Solver<Self>;
}

/// The z-step: finds the correction of `A δ = b − A z`, `A = 2λw + ρCᵀC`, over the vertices that are
/// not constrained.
pub(crate) trait Solver<O: Operator>: Clone + Debug {
    /// Changes `A`; the residual must be made anew.
    fn set_rho(&mut self, rho: f64);

    /// `b − A z`, in the system's scale: whoever changes `b` or `z` writes it (times
    /// [`Self::residual_scale`]) and calls [`Self::restart`].
    fn residual(&mut self) -> &mut [f32];

    /// Factor from `b − A z` to the system's scale.
    fn residual_scale(&self) -> f64;

    /// Starts anew from the residual that was just written.
    fn restart(&mut self, operator: &O);

    /// `‖r‖²` in the norm of the inverse diagonal.
    fn energy(&self) -> f64;

    /// `‖r‖` relative to `‖2λw z̃‖`, in that norm.
    fn relative_residual(&self, problem: &Problem<O>) -> f64;

    /// One iteration on the correction. Returns `false`, and changes nothing, when nothing is left to
    /// improve.
    fn step(&mut self, operator: &O) -> bool;

    /// Adds the correction found so far to `z`.
    fn correct(&mut self, operator: &O, z: &mut [f64]);

    /// In double precision, adds to `x` until the residual, which is given for `x`, is `tolerance` of
    /// what it was, or after so many `steps`. Returns how many there were; what is left of the
    /// residual is of no use.
    ///
    /// # Errors
    /// Out of memory.
    fn solve_precisely(
        &mut self,
        problem: &Problem<O>,
        residual: &mut Vec<f64>,
        x: &mut [f64],
        enough: (f64, usize),
    ) -> Result<usize>;
}

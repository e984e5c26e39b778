//! Where λ is so small that no bend pays: the affine surface of least squares, and the proof that
//! it is optimal.
//!
//! ADMM takes long there, since what is to be found is a dual as smooth as the domain is large. But
//! the optimality condition of that surface is a linear system: a stiffness κ (see `balance`) that
//! lets nothing bend gives a dual that satisfies it, the one of least norm. Where that is a little
//! too large for the ball, ADMM goes on from there.

use super::balance::balanced_bound;
use super::best::MAX_AFFINE_GAP;
use super::iteration::Level;
use crate::error::Result;
use crate::fit::linear::zstep::{Solvable, Solver};

/// Screening length `(κ/2λ)^¼` of a surface that counts as stiff, in sizes of the domain: its bends are then
/// a millionth of what they could be.
const STIFF_SCREENING_LENGTH: f64 = 10.0;

/// Residuals at which the affine surface's dual is found, relative to the first: the usual one, and the one
/// where fidelity is weak and what is left costs more.
const DUAL_RESIDUALS: [f64; 2] = [1e-4, 1e-9];

/// Largest number of conjugate-gradient iterations for the affine surface's dual.
const MAX_DUAL_ITERATIONS: usize = 100;

impl<O: Solvable> Level<O> {
    /// Takes the affine surface, and a bound about it, where it is better than the best one so far.
    pub(super) fn try_affine(&mut self) -> Result<()> {
        let trivial = self.best.objective() <= self.best.rounding;
        if trivial || !self.plan.tries_affine(&self.problem) {
            return Ok(());
        }
        let z = self.problem.least_squares()?;
        let cost = [self.problem.distance(&z), self.problem.smoothness(&z)];
        let objective = cost[0] + cost[1];
        if objective > self.best.objective() {
            return Ok(());
        }
        let stiffness = 2.0
            * self.problem.lambda
            * (STIFF_SCREENING_LENGTH * self.problem.operator.size()).powi(4);
        self.solver.set_rho(stiffness);
        let (state, problem) = (&mut self.state, &self.problem);
        let enough = (
            DUAL_RESIDUALS[usize::from(problem.loose)],
            MAX_DUAL_ITERATIONS,
        );
        let balanced = balanced_bound(state, problem, &z, stiffness, &mut self.solver, enough)?;
        self.solver.set_rho(self.state.rho);
        self.cg_iterations += balanced.steps;
        self.best.dual_bound = self.best.dual_bound.max(balanced.bound);
        self.best.take_affine(&z, cost);
        if objective - balanced.bound <= MAX_AFFINE_GAP * objective {
            self.state.z = z;
            self.state
                .take_balanced(&self.problem, stiffness, &balanced);
        }
        Ok(())
    }
}

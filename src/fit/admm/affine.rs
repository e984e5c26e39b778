//! The affine least-squares surface, which is optimal where λ is so small that no bend pays, and the proof of that.
//!
//! ADMM takes long there, because it has to find a dual as smooth as the domain is large. But the optimality
//! condition of that surface is a linear system: a stiffness κ (see [`balance`](super::balance)) that lets
//! nothing bend gives a dual that satisfies it, the one of least norm. Where that is a little too large for the
//! dual ball, ADMM goes on from there.

use super::balance::balanced_bound;
use super::steps::Admm;
use crate::error::Result;
use crate::fit::linear::z_step_solver::{SolvableOperator, ZStepSolver};

/// Maximum relative duality gap at which the affine least-squares surface may be the optimum; with a larger gap, the
/// optimal surface bends.
pub(super) const MAX_AFFINE_GAP: f64 = 0.1;

/// Screening length `(κ/2λ)^¼` (distance over which a stiffness `κ` smooths), in sizes of the domain, at which the
/// surface counts as rigid: its bends are then a millionth of what they could be.
const STIFF_SCREENING_LENGTH: f64 = 10.0;

impl<O: SolvableOperator> Admm<O> {
    /// Computes the affine least-squares surface and a dual bound for it, and makes it the incumbent (best surface so
    /// far) if its objective is smaller.
    pub(super) fn try_affine(&mut self) -> Result<()> {
        let is_trivial = self.incumbent.objective() <= self.incumbent.rounding;
        let is_fixed = self.parameters.follows_normals || !self.problem.constrained.is_empty();
        if is_trivial || is_fixed {
            return Ok(());
        }
        let z = self.problem.least_squares()?;
        let (fidelity, nuclear_norm) = (self.problem.distance(&z), self.problem.smoothness(&z));
        let objective = fidelity + nuclear_norm;
        if objective > self.incumbent.objective() {
            return Ok(());
        }
        let stiffness = 2.0
            * self.problem.lambda
            * (STIFF_SCREENING_LENGTH * self.problem.operator.size()).powi(4);
        self.solver.set_rho(stiffness);
        let (iterate, problem) = (&mut self.iterate, &self.problem);
        let balanced = balanced_bound(iterate, problem, &z, stiffness, &mut self.solver)?;
        self.solver.set_rho(self.iterate.rho);
        self.cg_iterations += balanced.iterations;
        let incumbent = &mut self.incumbent;
        incumbent.dual_bound = incumbent.dual_bound.max(balanced.bound);
        incumbent.set_surface(&z, fidelity, nuclear_norm);
        incumbent.is_affine = true;
        if objective - balanced.bound <= MAX_AFFINE_GAP * objective {
            self.iterate.z = z;
            self.iterate
                .set_balanced_dual(&self.problem, stiffness, &balanced);
        }
        Ok(())
    }
}

//! The incumbent: the best surface and the best dual bound that ADMM has found so far.

use super::certificate::Certificate;
use crate::fit::energy::problem::Problem;
use crate::fit::linear::z_step_solver::SolvableOperator;
use crate::fit::report::relative_gap;

/// Incumbent: the surface of least objective that ADMM has found so far and the largest dual bound so far, maybe from
/// different iterates.
#[derive(Debug, Clone)]
pub(crate) struct Incumbent {
    pub z: Vec<f64>,
    pub fidelity: f64,
    pub nuclear_norm: f64,
    pub dual_bound: f64,
    /// Magnitude of rounding errors in the objective and in the dual bound.
    pub rounding: f64,
    /// Whether the incumbent is the affine least-squares surface.
    pub is_affine: bool,
}

impl Incumbent {
    /// Makes the input heights the first incumbent: their objective is finite, and 0 is a dual bound of every energy
    /// without an offset.
    pub(crate) fn from_input<O: SolvableOperator>(problem: &Problem<O>) -> Self {
        Incumbent {
            z: problem.target.clone(),
            fidelity: -problem.offset,
            nuclear_norm: problem.smoothness(&problem.target),
            dual_bound: -problem.offset,
            rounding: problem.rounding,
            is_affine: false,
        }
    }

    /// Objective `P` of the incumbent: the sum of fidelity and penalty.
    pub(crate) fn objective(&self) -> f64 {
        self.fidelity + self.nuclear_norm
    }

    /// Relative duality gap of the incumbent; 1 where it is not known.
    pub(crate) fn gap(&self) -> f64 {
        relative_gap(self.objective(), self.dual_bound, self.rounding).unwrap_or(1.0)
    }

    /// Returns whether the dual bound certifies the relative duality `gap` for a surface of this `objective`.
    pub(super) fn certifies(&self, objective: f64, gap: f64) -> bool {
        objective - self.dual_bound + self.rounding <= gap * objective
    }

    /// Returns whether the incumbent is optimal up to rounding: its objective, or its duality gap where `gap` is not
    /// certified, is no larger than rounding errors.
    pub(super) fn is_exact(&self, gap: f64) -> bool {
        let objective = self.objective();
        let is_tight = objective - self.dual_bound <= self.rounding;
        objective <= self.rounding || (is_tight && !self.certifies(objective, gap))
    }

    /// Takes over the surface of an iterate if its objective is smaller than the incumbent's, and its dual bound if
    /// that is larger. An iterate that is not finite changes nothing.
    pub(crate) fn update(&mut self, z: &[f64], certificate: &Certificate) {
        if certificate.objective() < self.objective() {
            self.set_surface(z, certificate.fidelity, certificate.nuclear_norm);
        }
        self.dual_bound = self.dual_bound.max(certificate.dual_bound);
    }

    /// Takes over both surface and dual bound of an iterate, without comparison, because the energy has changed.
    pub(super) fn replace(&mut self, z: &[f64], certificate: &Certificate) {
        self.set_surface(z, certificate.fidelity, certificate.nuclear_norm);
        self.dual_bound = certificate.dual_bound;
    }

    /// Replaces the incumbent surface, and the two terms of its objective, by one that is not the affine one.
    pub(super) fn set_surface(&mut self, z: &[f64], fidelity: f64, nuclear_norm: f64) {
        self.z.copy_from_slice(z);
        self.fidelity = fidelity;
        self.nuclear_norm = nuclear_norm;
        self.is_affine = false;
    }
}

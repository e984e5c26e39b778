//! The best surface and the best bound that ADMM has found so far.

use super::state::Certificate;
use crate::fit::energy::problem::Problem;
use crate::fit::linear::zstep::Solvable;
use crate::fit::report::relative_gap;

/// Largest relative duality gap of the affine surface at which it may be the answer: a larger gap means that
/// the surface bends.
pub(super) const MAX_AFFINE_GAP: f64 = 0.1;

/// The best iterate so far and the best bound so far; they need not belong together.
#[derive(Debug, Clone)]
pub(crate) struct Best {
    pub z: Vec<f64>,
    pub fidelity: f64,
    pub nuclear_norm: f64,
    pub dual_bound: f64,
    /// What rounding errors of the heights may change in both.
    pub rounding: f64,
    /// Whether the iterate is the affine surface of least squares.
    pub affine: bool,
}

impl Best {
    /// The target itself: its objective is finite, and 0 is a bound of every energy without an offset.
    pub(crate) fn of_input<O: Solvable>(problem: &Problem<O>) -> Self {
        Best {
            z: problem.target.clone(),
            fidelity: -problem.offset,
            nuclear_norm: problem.smoothness(&problem.target),
            dual_bound: -problem.offset,
            rounding: problem.rounding,
            affine: false,
        }
    }

    pub(crate) fn objective(&self) -> f64 {
        self.fidelity + self.nuclear_norm
    }

    /// Everything, where it is not known.
    pub(crate) fn gap(&self) -> f64 {
        relative_gap(self.objective(), self.dual_bound, self.rounding).unwrap_or(1.0)
    }

    /// Takes what is better of an iterate. One that is not finite has nothing that is.
    pub(crate) fn take(&mut self, z: &[f64], certificate: &Certificate) {
        if certificate.objective() < self.objective() {
            self.take_surface(z, certificate);
        }
        self.dual_bound = self.dual_bound.max(certificate.dual_bound);
    }

    /// Takes the affine surface of least squares.
    pub(super) fn take_affine(&mut self, z: &[f64], [fidelity, nuclear_norm]: [f64; 2]) {
        self.z.copy_from_slice(z);
        (self.fidelity, self.nuclear_norm) = (fidelity, nuclear_norm);
        self.affine = true;
    }

    /// Takes a surface and bound of another energy than before.
    pub(super) fn replace(&mut self, z: &[f64], certificate: &Certificate) {
        self.take_surface(z, certificate);
        self.dual_bound = certificate.dual_bound;
    }

    fn take_surface(&mut self, z: &[f64], certificate: &Certificate) {
        self.z.copy_from_slice(z);
        self.fidelity = certificate.fidelity;
        self.nuclear_norm = certificate.nuclear_norm;
        self.affine = false;
    }
}

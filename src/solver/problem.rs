//! The energy on one lattice, in normalised coordinates.

use std::sync::Arc;

use super::frame::Frame;
use crate::domain::Domain;
use crate::error::{Result, try_filled};
use crate::heightfield::Heightfield;
use crate::stencil::{HessianMap, Ring};

/// `P(z) = λ Σ (z − z̃)² + Σ ‖H(z)‖_*` over a domain (paper, Eq. 15).
#[derive(Debug, Clone)]
pub(crate) struct Problem {
    pub domain: Arc<Domain>,
    pub lambda: f64,
    /// `z̃` on the padded box, zero outside `I ∪ ∂I`.
    pub target: Vec<f64>,
    pub map: HessianMap,
    /// Lattice spacing in normalised coordinates.
    pub spacing: f64,
    /// Objectives up to this are rounding errors of zero.
    pub rounding: f64,
}

impl Problem {
    pub(crate) fn new(
        field: &Heightfield,
        domain: Arc<Domain>,
        frame: &Frame,
        lambda: f64,
    ) -> Result<Self> {
        let mut target = try_filled("input heights", domain.cells(), 0.0)?;
        let mut largest = 0.0f64;
        for cell in domain.active().cells() {
            let height = field.heights()[domain.lattice_index(cell)];
            target[cell] = frame.inward(position(&domain, cell), height);
            largest = largest.max((frame.scale * height).abs());
        }
        let spacing = frame.scale * domain.lattice().spacing();
        // Each Hessian is a handful of heights over h², each with its own rounding error.
        let rounding =
            16.0 * f64::EPSILON * largest / (spacing * spacing) * domain.interior_len() as f64;
        Ok(Problem {
            lambda,
            target,
            map: HessianMap::new(spacing),
            spacing,
            rounding,
            domain,
        })
    }

    /// `P(z̃)`, the nuclear norm alone.
    pub(crate) fn input_objective(&self) -> f64 {
        let domain = &self.domain;
        let mut sum = 0.0;
        for row in 1..=domain.rows() {
            for run in domain.interior().row(row) {
                let ring = Ring::new(&self.target, domain, row, *run);
                for i in 0..run.end - run.start {
                    sum += self.map.hessian(ring.differences(i)).nuclear_norm();
                }
            }
        }
        sum
    }

    /// Heights in the user's units from `z` on the padded box; NaN outside `I ∪ ∂I`.
    pub(crate) fn heights(&self, frame: &Frame, z: &[f64]) -> Vec<f64> {
        let mut heights = vec![f64::NAN; self.domain.lattice().len()];
        for cell in self.domain.active().cells() {
            heights[self.domain.lattice_index(cell)] =
                frame.outward(position(&self.domain, cell), z[cell]);
        }
        heights
    }
}

fn position(domain: &Domain, cell: usize) -> [f64; 2] {
    let (row, col) = domain.lattice_vertex(cell);
    domain.lattice().position(row, col)
}

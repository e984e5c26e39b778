//! The energy, for methods that are not the library's own: on all vertices of the lattice, in the
//! input's own coordinates. Vertices outside `I ∪ ∂I` stand apart from the rest, at height 0.

use developable::{Domain, HessianOperator, Sym2};
use sprs::{CsMat, TriMat};

/// `P(z) = λ Σ (z − z̃)² + Σ ‖Cz‖_*`.
pub struct Energy<'a> {
    pub lambda: f64,
    /// `z̃`.
    pub target: Vec<f64>,
    pub c: HessianOperator<'a>,
    domain: &'a Domain,
}

impl<'a> Energy<'a> {
    pub fn new(domain: &'a Domain, heights: &[f64], lambda: f64) -> Self {
        let cols = domain.lattice().cols();
        let target = heights.iter().enumerate().map(|(i, z)| {
            let active = domain.role(i / cols, i % cols).is_active();
            if active { *z } else { 0.0 }
        });
        Energy {
            lambda,
            target: target.collect(),
            c: HessianOperator::new(domain),
            domain,
        }
    }

    /// Number of unknowns.
    pub fn len(&self) -> usize {
        self.target.len()
    }

    /// Number of Hessians, `|I|`.
    pub fn interior(&self) -> usize {
        self.domain.interior_len()
    }

    /// Number of vertices that have a height.
    pub fn vertices(&self) -> usize {
        let domain = self.domain;
        domain.interior_len() + domain.boundary_len() + domain.omitted_len()
    }

    pub fn objective(&self, z: &[f64]) -> f64 {
        let pairs = z.iter().zip(&self.target);
        let fidelity: f64 = pairs.map(|(z, target)| (z - target).powi(2)).sum();
        let hessians = self.c.apply(z);
        self.lambda * fidelity + hessians.iter().map(|h| h.nuclear_norm()).sum::<f64>()
    }

    /// `D(Y) = ⟨CᵀY, z̃⟩ − ‖CᵀY‖²/4λ`, a lower bound of the optimum for feasible `Y`.
    pub fn dual_bound(&self, y: &[Sym2]) -> f64 {
        let force = self.c.adjoint(y);
        let product: f64 = force.iter().zip(&self.target).map(|(f, z)| f * z).sum();
        product - force.iter().map(|f| f * f).sum::<f64>() / (4.0 * self.lambda)
    }

    /// `C` as a sparse matrix.
    pub fn operator(&self) -> CsMat<f64> {
        let mut triplets = TriMat::new((3 * self.interior(), self.len()));
        for (row, column, value) in self.c.triplets() {
            triplets.add_triplet(row, column, value);
        }
        triplets.to_csr()
    }

    /// `CᵀC` in the Frobenius inner product, which counts `h_xy` twice.
    pub fn normal_matrix(&self) -> CsMat<f64> {
        let c = self.operator();
        let mut weighted = c.clone();
        for (row, mut entries) in weighted.outer_iterator_mut().enumerate() {
            if row % 3 == 1 {
                entries.iter_mut().for_each(|(_, value)| *value *= 2.0);
            }
        }
        &c.transpose_into().to_csr() * &weighted
    }
}

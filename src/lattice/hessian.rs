//! The operator `C` from heights to Hessians of the best-fit quadratics, and its adjoint.

use super::domain::Domain;
use super::stencil::{HessianMap, Ring, Rolling, weights_of};
use crate::math::sym2::Sym2;

/// The linear operator `C` from heights at the lattice's vertices to Hessians at the interior vertices, without a
/// stored matrix (paper, Eq. 16). Heights of vertices outside the domain are ignored.
///
/// Heights are in the lattice's row-major order and in the user's units, Hessians in the row-major order of the
/// interior vertices ([`HessianOperator::vertices`]).
#[derive(Debug, Clone, Copy)]
pub struct HessianOperator<'a> {
    domain: &'a Domain,
}

impl<'a> HessianOperator<'a> {
    /// Makes the operator over the interior vertices of `domain`.
    pub fn new(domain: &'a Domain) -> Self {
        HessianOperator { domain }
    }

    /// Iterates over row and column of each interior vertex, in the order of the Hessians.
    pub fn vertices(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        let domain = self.domain;
        domain
            .interior()
            .cells()
            .map(|cell| domain.lattice_vertex(cell))
    }

    /// Computes the Hessian at each interior vertex. `heights` has one value for each lattice vertex; those outside the
    /// domain may be NaN. Linear cost.
    ///
    /// # Panics
    /// If `heights` does not have `lattice.len()` values.
    pub fn apply(&self, heights: &[f64]) -> Vec<Sym2> {
        let domain = self.domain;
        assert_eq!(heights.len(), domain.lattice().len());
        let padded = gather_active(domain, heights);
        let map = HessianMap::new(domain.lattice().spacing());
        let mut hessians = Vec::with_capacity(domain.interior_len());
        for row in 1..=domain.rows() {
            for run in domain.interior().row(row) {
                let ring = Ring::new(&padded, domain, row, *run);
                hessians.extend((0..run.end - run.start).map(|i| map.hessian(ring.differences(i))));
            }
        }
        hessians
    }

    /// Applies the adjoint `Cᵀ`, with respect to the Frobenius inner product, to one matrix for each interior vertex.
    /// Returns one value for each lattice vertex, zero outside the domain. Linear cost.
    ///
    /// # Panics
    /// If there is not one matrix for each interior vertex.
    pub fn adjoint(&self, matrices: &[Sym2]) -> Vec<f64> {
        let domain = self.domain;
        assert_eq!(matrices.len(), domain.interior_len());
        let map = HessianMap::new(domain.lattice().spacing());
        let mut out = vec![0.0; domain.lattice().len()];
        let mut padded = vec![Sym2::default(); domain.cells()];
        for (cell, y) in domain.interior().cells().zip(matrices) {
            padded[cell] = *y;
        }
        let mut sums = vec![0.0; domain.cells()];
        Rolling::<f64>::new(domain).sweep(
            domain,
            &mut domain.bands().split(&mut sums).collect::<Vec<_>>(),
            |_, row, weights| {
                for run in domain.interior().row(row) {
                    let [w1, w2, w3] = weights_of(weights, domain, row, *run);
                    for (i, y) in padded[run.start..run.end].iter().enumerate() {
                        (w1[i], w2[i], w3[i]) = map.adjoint(*y).into();
                    }
                }
            },
            |to, row, sums| {
                for run in domain.active().row(row) {
                    let sum = sums.run(*run);
                    for (i, to) in to.run_mut(*run).iter_mut().enumerate() {
                        *to = sum.at(i);
                    }
                }
            },
        );
        for cell in domain.active().cells() {
            out[domain.lattice_index(cell)] = sums[cell];
        }
        out
    }

    /// Returns the entries of `C` as row, column and value, for a library of sparse matrices: three rows `h_xx, h_xy, h_yy` for
    /// each interior vertex, one column for each lattice vertex. Remember the factor 2 that `h_xy` carries in the Frobenius inner
    /// product.
    pub fn triplets(&self) -> Vec<(usize, usize, f64)> {
        let lattice = self.domain.lattice();
        let inverse = 1.0 / (lattice.spacing() * lattice.spacing());
        let (third, root) = (inverse / 3.0, inverse / 3f64.sqrt());
        // Coefficients of h_xx, h_xy, h_yy at W, E, NW, NE, SW, SE.
        let ring: [[f64; 3]; 6] = [
            [inverse, 0.0, -third],
            [inverse, 0.0, -third],
            [0.0, -root, 2.0 * third],
            [0.0, root, 2.0 * third],
            [0.0, root, 2.0 * third],
            [0.0, -root, 2.0 * third],
        ];
        let mut triplets = Vec::new();
        for (i, (row, col)) in self.vertices().enumerate() {
            let own = lattice.index(row, col);
            triplets.extend([3 * i, 3 * i + 2].map(|row| (row, own, -2.0 * inverse)));
            for (neighbour, entries) in lattice.neighbours(row, col).into_iter().zip(ring) {
                for (k, entry) in entries.into_iter().enumerate() {
                    if let (Some((r, c)), true) = (neighbour, entry != 0.0) {
                        triplets.push((3 * i + k, lattice.index(r, c), entry));
                    }
                }
            }
        }
        triplets
    }
}

/// Copies values of the lattice's vertices to an array over the domain's padded box, with zero outside the domain.
pub(crate) fn gather_active(domain: &Domain, values: &[f64]) -> Vec<f64> {
    let mut padded = vec![0.0; domain.cells()];
    for cell in domain.active().cells() {
        padded[cell] = values[domain.lattice_index(cell)];
    }
    padded
}

#[cfg(all(test, not(target_arch = "wasm32")))] // proptest is native
mod tests {
    use super::*;
    use crate::lattice::domain::tests::{arbitrary_field, single_ring};
    use proptest::prelude::*;

    impl HessianOperator<'_> {
        pub(crate) fn to_sparse(self) -> sprs::CsMat<f64> {
            let size = (3 * self.domain.interior_len(), self.domain.lattice().len());
            let mut matrix = sprs::TriMat::new(size);
            for (row, column, value) in self.triplets() {
                matrix.add_triplet(row, column, value);
            }
            matrix.to_csr()
        }
    }

    fn pseudo_random(n: usize) -> impl Iterator<Item = f64> {
        (0..n).scan(0.3f64, |x, _| {
            *x = 3.9 * *x * (1.0 - *x);
            Some(*x - 0.5)
        })
    }

    fn check_operator(domain: &Domain) {
        let c = HessianOperator::new(domain);
        let n = domain.lattice().len();
        let scale = domain.lattice().spacing().powi(-2);
        let z: Vec<f64> = pseudo_random(n).collect();
        let y: Vec<Sym2> = pseudo_random(3 * domain.interior_len())
            .collect::<Vec<_>>()
            .chunks(3)
            .map(|e| Sym2::new(e[0], e[1], e[2]))
            .collect();

        let hessians = c.apply(&z);
        let adjoint = c.adjoint(&y);
        let left: f64 = hessians.iter().zip(&y).map(|(h, y)| h.dot(*y)).sum();
        let right: f64 = z.iter().zip(&adjoint).map(|(z, a)| z * a).sum();
        let size = scale * n as f64;
        assert!((left - right).abs() < 1e-13 * size, "{left} {right}");

        let sparse = c.to_sparse();
        let product = &sparse * &sprs::CsVec::new(n, (0..n).collect(), z);
        for (i, h) in hessians.iter().enumerate() {
            for (k, entry) in h.entries().into_iter().enumerate() {
                let expected = product.get(3 * i + k).copied().unwrap_or(0.0);
                assert!((entry - expected).abs() < 1e-13 * scale);
            }
        }
        let weighted: Vec<f64> = y
            .iter()
            .flat_map(|y| {
                let [xx, xy, yy] = y.entries();
                [xx, 2.0 * xy, yy]
            })
            .collect();
        let transposed = sparse.transpose_view();
        let mut expected = vec![0.0; n];
        sprs::prod::mul_acc_mat_vec_csc(transposed.to_csc().view(), &weighted, &mut expected);
        for (a, b) in adjoint.iter().zip(&expected) {
            assert!((a - b).abs() < 1e-12 * scale, "{a} {b}");
        }
    }

    #[test]
    fn one_interior_vertex() {
        check_operator(&Domain::new(&single_ring()).unwrap());
    }

    proptest! {
        #[test]
        fn adjoint_to_rounding_and_equal_to_the_sparse_matrix(field in arbitrary_field()) {
            if let Ok(domain) = Domain::new(&field) {
                check_operator(&domain);
            }
        }
    }
}

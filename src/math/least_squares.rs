//! Weighted linear least squares by normal equations, for small numbers of unknowns.

use nalgebra::{Cholesky, Const, SMatrix, SVector};

/// Normal equations `(Σ w a aᵀ + R) x = Σ w a b` of the weighted least-squares problem
/// `min Σ w |aᵀ x − b|² + xᵀ R x`, where each observation has a row `a` of coefficients, a right-hand side of `K`
/// values `b` and a weight `w`, and `R` is an optional diagonal (a ridge) that regularises what observations leave open.
#[derive(Debug, Clone)]
pub(crate) struct LeastSquares<const N: usize, const K: usize = 1> {
    pub matrix: SMatrix<f64, N, N>,
    pub right: SMatrix<f64, N, K>,
}

impl<const N: usize, const K: usize> LeastSquares<N, K> {
    /// Makes normal equations without observations.
    pub(crate) fn new() -> Self {
        Self::with_ridge([0.0; N])
    }

    /// Makes normal equations without observations, with a diagonal `R` that regularises their matrix.
    pub(crate) fn with_ridge(ridge: [f64; N]) -> Self {
        LeastSquares {
            matrix: SMatrix::from_diagonal(&SVector::from(ridge)),
            right: SMatrix::zeros(),
        }
    }

    /// Adds an observation to the normal equations: its row of coefficients, its values, and its weight.
    pub(crate) fn add(&mut self, row: &SVector<f64, N>, values: [f64; K], weight: f64) {
        self.matrix.ger(1.0, &(row * weight), row, 1.0);
        for (mut column, value) in self.right.column_iter_mut().zip(values) {
            column.axpy(weight * value, row, 1.0);
        }
    }

    /// Adds `ridge` to the diagonal of the normal equations' matrix.
    pub(crate) fn add_ridge(&mut self, ridge: &[f64]) {
        for (k, value) in ridge.iter().enumerate() {
            self.matrix[(k, k)] += value;
        }
    }

    /// Returns the Cholesky factor of the normal equations' matrix; `None` if that is not positive definite.
    pub(crate) fn factor(&self) -> Option<Cholesky<f64, Const<N>>> {
        self.matrix.cholesky()
    }

    /// Solves the normal equations and returns the minimiser; `None` if observations and ridge do not determine it.
    pub(crate) fn solve(&self) -> Option<SMatrix<f64, N, K>> {
        Some(self.factor()?.solve(&self.right))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{DMatrix, DVector, Vector2, Vector3};

    /// Coefficients, value and weight of some observations that no plane meets.
    fn observations() -> Vec<([f64; 3], f64, f64)> {
        let observation = |i: i32| {
            let (x, y) = (f64::from(i % 4), f64::from(i / 4));
            (
                [1.0, x, y],
                (1.3 * x - y).sin(),
                1.0 + 0.25 * f64::from(i % 3),
            )
        };
        (0..12).map(observation).collect()
    }

    /// The minimiser by an orthogonal factorisation, which forms no normal equations.
    fn by_singular_values() -> DVector<f64> {
        let all = observations();
        let rows = DMatrix::from_fn(all.len(), 3, |i, k| all[i].0[k] * all[i].2.sqrt());
        let values = DVector::from_fn(all.len(), |i, _| all[i].1 * all[i].2.sqrt());
        rows.svd(true, true).solve(&values, 1e-12).unwrap()
    }

    #[test]
    fn the_minimiser_is_that_of_an_orthogonal_factorisation() {
        let mut fixed = LeastSquares::<3>::new();
        for (row, value, weight) in observations() {
            fixed.add(&Vector3::from(row), [value], weight);
        }
        let expected = by_singular_values();
        let fixed = fixed.solve().unwrap();
        assert!((0..3).all(|k| (fixed[k] - expected[k]).abs() < 1e-12));
    }

    #[test]
    fn a_ridge_determines_what_observations_leave_open() {
        let mut line = LeastSquares::<2, 2>::new();
        line.add(&Vector2::new(1.0, 0.0), [3.0, -2.0], 4.0);
        assert!(line.solve().is_none());
        // Minimises 4 (x − 3)² + x² + y², and 4 (x + 2)² + x² + y².
        line.add_ridge(&[1.0, 1.0]);
        let found = line.solve().unwrap();
        assert!((found[(0, 0)] - 2.4).abs() < 1e-15 && (found[(0, 1)] + 1.6).abs() < 1e-15);
        assert_eq!([found[(1, 0)], found[(1, 1)]], [0.0; 2]);
        let ridge = LeastSquares::<2, 2>::with_ridge([1.0, 1.0]);
        assert_eq!(ridge.solve().unwrap().norm(), 0.0);
    }
}

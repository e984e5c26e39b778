//! Symmetric 2×2 matrices and their spectral functions, all in closed form.

use super::real::{Real, larger, smaller};

/// A symmetric 2×2 matrix, held as `[[mean + diff, off], [off, mean − diff]]`.
///
/// In the coordinates `mean`, `diff`, `off` the eigenvalues are `mean ± √(diff² + off²)`, the Frobenius inner product
/// is twice the ordinary one, and no eigenvectors are needed for any spectral function.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Sym2 {
    pub(crate) mean: f64,
    pub(crate) diff: f64,
    pub(crate) off: f64,
}

impl Sym2 {
    /// Makes the matrix `[[xx, xy], [xy, yy]]`.
    pub fn new(xx: f64, xy: f64, yy: f64) -> Self {
        Sym2 {
            mean: 0.5 * (xx + yy),
            diff: 0.5 * (xx - yy),
            off: xy,
        }
    }

    /// Returns the entries `[xx, xy, yy]`.
    pub fn entries(self) -> [f64; 3] {
        [self.mean + self.diff, self.off, self.mean - self.diff]
    }

    /// Makes the matrix with the coordinates `[mean, diff, off]`.
    #[inline(always)]
    pub(crate) fn from_coordinates([mean, diff, off]: [f64; 3]) -> Self {
        Sym2 { mean, diff, off }
    }

    /// Returns the coordinates `[mean, diff, off]`.
    #[inline(always)]
    pub(crate) fn coordinates(self) -> [f64; 3] {
        [self.mean, self.diff, self.off]
    }

    /// Half of the difference between the eigenvalues.
    #[inline(always)]
    pub(crate) fn radius(self) -> f64 {
        (self.diff * self.diff + self.off * self.off).sqrt()
    }

    /// Returns the eigenvalues, the larger one first.
    pub fn eigenvalues(self) -> [f64; 2] {
        let r = self.radius();
        [self.mean + r, self.mean - r]
    }

    /// Sum of the absolute eigenvalues, `2 max(|mean|, radius)`.
    #[inline(always)]
    pub fn nuclear_norm(self) -> f64 {
        2.0 * larger(self.mean.abs(), self.radius())
    }

    /// Spectral norm: the largest absolute eigenvalue.
    #[inline(always)]
    pub(crate) fn spectral_norm(self) -> f64 {
        self.mean.abs() + self.radius()
    }

    /// Frobenius inner product of two matrices: the sum of products of their entries.
    #[inline(always)]
    pub fn dot(self, other: Sym2) -> f64 {
        2.0 * (self.mean * other.mean + self.diff * other.diff + self.off * other.off)
    }

    /// Projects the matrix onto those whose eigenvalues lie in `[−limit, limit]`, by clamping its eigenvalues.
    #[inline(always)]
    pub fn clamp(self, limit: f64) -> Sym2 {
        let [mean, diff, off] = clamp([self.mean, self.diff, self.off], limit);
        Sym2 { mean, diff, off }
    }

    /// Soft threshold: moves each eigenvalue towards 0 by at most `threshold`. This is the minimiser `H` of `threshold
    /// · ‖H‖_* + ½ ‖H − self‖_F²` (paper, App. D).
    #[inline(always)]
    pub fn soft_threshold(self, threshold: f64) -> Sym2 {
        // Moreau: a matrix is its soft threshold plus its projection onto the dual ball.
        self - self.clamp(threshold)
    }

    /// Multiplies the matrix by a factor.
    #[inline(always)]
    pub(crate) fn scale(self, factor: f64) -> Sym2 {
        Sym2 {
            mean: factor * self.mean,
            diff: factor * self.diff,
            off: factor * self.off,
        }
    }
}

impl std::ops::Add for Sym2 {
    type Output = Sym2;
    #[inline(always)]
    fn add(self, other: Sym2) -> Sym2 {
        Sym2 {
            mean: self.mean + other.mean,
            diff: self.diff + other.diff,
            off: self.off + other.off,
        }
    }
}

impl std::ops::Sub for Sym2 {
    type Output = Sym2;
    #[inline(always)]
    fn sub(self, other: Sym2) -> Sym2 {
        Sym2 {
            mean: self.mean - other.mean,
            diff: self.diff - other.diff,
            off: self.off - other.off,
        }
    }
}

impl std::ops::Mul<f64> for Sym2 {
    type Output = Sym2;
    #[inline(always)]
    fn mul(self, factor: f64) -> Sym2 {
        self.scale(factor)
    }
}

/// Clamps the eigenvalues of a symmetric matrix, given and returned by its coordinates `[mean, diff, off]`, to
/// `[−limit, limit]`, in any precision.
#[inline(always)]
pub(crate) fn clamp<T: Real>([mean, diff, off]: [T; 3], limit: T) -> [T; 3] {
    let r = (diff * diff + off * off).sqrt();
    let high = smaller(larger(mean + r, -limit), limit);
    let low = smaller(larger(mean - r, -limit), limit);
    // Without a branch, so that loops over it vectorise; at r = 0 both numerators vanish.
    let zero = T::default();
    let factor = if r > zero {
        T::HALF * (high - low) / r
    } else {
        zero
    };
    [T::HALF * (high + low), factor * diff, factor * off]
}

#[cfg(all(test, not(target_arch = "wasm32")))] // proptest is native
mod tests {
    use super::*;
    use nalgebra::{Matrix2, SymmetricEigen, Vector2};
    use proptest::prelude::*;

    /// The same function through nalgebra's eigen-decomposition.
    fn through_eigen(a: Sym2, f: impl Fn(f64) -> f64) -> Matrix2<f64> {
        let eigen = SymmetricEigen::new(dense(a));
        let values = Vector2::new(f(eigen.eigenvalues[0]), f(eigen.eigenvalues[1]));
        eigen.eigenvectors * Matrix2::from_diagonal(&values) * eigen.eigenvectors.transpose()
    }

    fn dense(a: Sym2) -> Matrix2<f64> {
        let [xx, xy, yy] = a.entries();
        Matrix2::new(xx, xy, xy, yy)
    }

    fn check(a: Sym2, limit: f64) {
        let size = 1.0 + a.dot(a).sqrt();
        let close = |x: Matrix2<f64>, y: Matrix2<f64>| (x - y).norm() <= 1e-13 * size;
        let soft = |v: f64| v.signum() * (v.abs() - limit).max(0.0);
        assert!(close(
            dense(a.clamp(limit)),
            through_eigen(a, |v| v.clamp(-limit, limit))
        ));
        assert!(close(
            dense(a.soft_threshold(limit)),
            through_eigen(a, soft)
        ));
        let eigen = SymmetricEigen::new(dense(a)).eigenvalues;
        assert!((a.nuclear_norm() - eigen.abs().sum()).abs() <= 1e-13 * size);
        assert!((a.eigenvalues()[0] - eigen.max()).abs() <= 1e-13 * size);
        assert!((a.eigenvalues()[1] - eigen.min()).abs() <= 1e-13 * size);
        assert!((a.dot(a) - dense(a).norm_squared()).abs() <= 1e-13 * size * size);
    }

    #[test]
    fn degenerate_matrices() {
        for [xx, xy, yy] in [
            [0.0, 0.0, 0.0],
            [3.0, 0.0, 3.0],
            [-3.0, 0.0, -3.0],
            [1.0, 1.0, 1.0],
            [-2.0, 0.0, 0.0],
            [1.0, 0.0, -1.0],
            [0.0, 5.0, 0.0],
            [1e-300, 0.0, 0.0],
            [1.0, 1e-200, 1.0],
            [1e8, 1.0, -1e8],
        ] {
            for limit in [0.0, 0.5, 1.0, 1e3] {
                check(Sym2::new(xx, xy, yy), limit);
            }
        }
    }

    proptest! {
        #[test]
        fn agrees_with_eigen_decomposition(
            xx in -1e3..1e3f64, xy in -1e3..1e3f64, yy in -1e3..1e3f64, limit in 0.0..1e3f64,
        ) {
            check(Sym2::new(xx, xy, yy), limit);
        }

        #[test]
        fn soft_threshold_minimises_its_energy(
            xx in -3.0..3.0f64, xy in -3.0..3.0f64, yy in -3.0..3.0f64, t in 0.01..2.0f64,
            dx in -1.0..1.0f64, dxy in -1.0..1.0f64, dy in -1.0..1.0f64,
        ) {
            let a = Sym2::new(xx, xy, yy);
            let energy = |h: Sym2| t * h.nuclear_norm() + 0.5 * (h - a).dot(h - a);
            let best = a.soft_threshold(t);
            prop_assert!(energy(best) <= energy(best + Sym2::new(dx, dxy, dy)) + 1e-12);
        }
    }
}

//! Eigenvalues and eigenvectors of symmetric 3×3 matrices.

use nalgebra::{Matrix3, Vector3};

/// Maximum number of sweeps of Jacobi's eigenvalue method. The error falls quadratically: five sweeps suffice for
/// finite entries.
const MAX_JACOBI_SWEEPS: usize = 12;

/// Eigenvalues of a symmetric 3×3 matrix with their unit eigenvectors, the largest eigenvalue first, by Jacobi's
/// method. The vectors have length 1 even if entries are not finite.
pub(crate) fn symmetric_eigen3(mut matrix: Matrix3<f64>) -> [(f64, Vector3<f64>); 3] {
    let mut vectors = Matrix3::identity();
    for _ in 0..MAX_JACOBI_SWEEPS {
        let off_diagonal = matrix[(0, 1)].abs() + matrix[(0, 2)].abs() + matrix[(1, 2)].abs();
        if off_diagonal <= f64::EPSILON * f64::EPSILON * matrix.amax() {
            break;
        }
        for (p, q) in [(0, 1), (0, 2), (1, 2)] {
            let off_diagonal = matrix[(p, q)];
            if off_diagonal == 0.0 || !off_diagonal.is_finite() {
                continue;
            }
            let angle = 0.5 * (2.0 * off_diagonal).atan2(matrix[(q, q)] - matrix[(p, p)]);
            let (sin, cos) = angle.sin_cos();
            let mut rotation = Matrix3::identity();
            (rotation[(p, p)], rotation[(q, q)]) = (cos, cos);
            (rotation[(p, q)], rotation[(q, p)]) = (sin, -sin);
            matrix = rotation.transpose() * matrix * rotation;
            vectors *= rotation;
        }
    }
    let mut pairs = [0, 1, 2].map(|k| (matrix[(k, k)], vectors.column(k).into_owned()));
    pairs.sort_by(|a, b| b.0.total_cmp(&a.0));
    pairs
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn eigenpairs_make_up_the_matrix() {
        let matrix = Matrix3::new(4.0, 1.0, -2.0, 1.0, 3.0, 0.5, -2.0, 0.5, 1.0);
        let pairs = symmetric_eigen3(matrix);
        let sum = pairs.iter().map(|(value, v)| v * v.transpose() * *value);
        assert!((sum.sum::<Matrix3<f64>>() - matrix).norm() < 1e-12);
        let identity = pairs.iter().map(|(_, v)| v * v.transpose());
        assert!((identity.sum::<Matrix3<f64>>() - Matrix3::identity()).norm() < 1e-12);
        assert!(pairs[0].0 >= pairs[1].0 && pairs[1].0 >= pairs[2].0);
    }

    #[test]
    fn vectors_have_length_1_without_finite_entries() {
        let pairs = symmetric_eigen3(Matrix3::from_element(f64::NAN));
        assert!(pairs.iter().all(|(_, v)| v.norm() == 1.0));
    }
}

//! Main axes of symmetric 3×3 matrices.

use nalgebra::{Matrix3, Vector3};

/// Sweeps, at most; five are enough for what is finite.
const SWEEPS: usize = 12;

/// The eigenvalues of a symmetric matrix with their unit vectors, the highest first, by Jacobi's rotations.
pub(crate) fn axes(mut matrix: Matrix3<f64>) -> [(f64, Vector3<f64>); 3] {
    let mut vectors = Matrix3::identity();
    for _ in 0..SWEEPS {
        for (p, q) in [(0, 1), (0, 2), (1, 2)] {
            let off = matrix[(p, q)];
            if off == 0.0 || !off.is_finite() {
                continue;
            }
            let angle = 0.5 * (2.0 * off).atan2(matrix[(q, q)] - matrix[(p, p)]);
            let (sin, cos) = angle.sin_cos();
            let mut turn = Matrix3::identity();
            (turn[(p, p)], turn[(q, q)]) = (cos, cos);
            (turn[(p, q)], turn[(q, p)]) = (sin, -sin);
            matrix = turn.transpose() * matrix * turn;
            vectors *= turn;
        }
    }
    let mut found = [0, 1, 2].map(|k| (matrix[(k, k)], vectors.column(k).into_owned()));
    found.sort_by(|a, b| b.0.total_cmp(&a.0));
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_matrix_is_made_of_its_axes() {
        let matrix = Matrix3::new(4.0, 1.0, -2.0, 1.0, 3.0, 0.5, -2.0, 0.5, 1.0);
        let found = axes(matrix);
        let again = found.iter().map(|(value, v)| v * v.transpose() * *value);
        assert!((again.sum::<Matrix3<f64>>() - matrix).norm() < 1e-12);
        let unit = found.iter().map(|(_, v)| v * v.transpose());
        assert!((unit.sum::<Matrix3<f64>>() - Matrix3::identity()).norm() < 1e-12);
        assert!(found[0].0 >= found[1].0 && found[1].0 >= found[2].0);
        assert!(
            axes(Matrix3::from_element(f64::NAN))
                .iter()
                .all(|(_, v)| v.norm() == 1.0)
        );
    }
}

//! Finds the rigid motion that moves a flat sheet closest to its place on the surface.

use nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3};

use crate::pattern::Faces;

/// A rigid motion in space: a rotation, then a translation.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Pose {
    /// Rotation as a unit quaternion: x, y, z, w.
    pub turn: [f64; 4],
    /// Translation after the rotation, in the surface's units.
    pub shift: [f64; 3],
}

impl Pose {
    /// Finds the rigid motion that moves a flat sheet to the surface with the least sum of squared distances between
    /// vertices. `middle`, a point of the flat sheet, is the origin of the rotation.
    pub fn of(faces: &Faces, middle: [f64; 2]) -> Pose {
        let count = faces.built.len().max(1) as f64;
        let flat = |p: &[f64; 2]| Vector3::new(p[0] - middle[0], p[1] - middle[1], 0.0);
        let built = |p: &[f64; 3]| Vector3::from(*p);
        let here = faces.flat.iter().map(flat).sum::<Vector3<f64>>() / count;
        let there = faces.built.iter().map(built).sum::<Vector3<f64>>() / count;
        let pairs = faces.flat.iter().zip(&faces.built);
        let spread: Matrix3<f64> = pairs
            .map(|(p, q)| (built(q) - there) * (flat(p) - here).transpose())
            .sum();
        let turn = match spread.norm() > 0.0 {
            true => nearest(spread / spread.norm()),
            false => Rotation3::identity(),
        };
        let shift = there - turn * here;
        let q = UnitQuaternion::from_rotation_matrix(&turn);
        Pose {
            turn: [q.i, q.j, q.k, q.w],
            shift: shift.into(),
        }
    }

    /// Computes the position to which the rigid motion moves a point.
    pub fn of_place(&self, place: [f64; 3]) -> [f64; 3] {
        (self.rotation() * Vector3::from(place) + Vector3::from(self.shift)).into()
    }

    /// Computes the point that the rigid motion moves to a given position (the inverse motion).
    pub fn back(&self, place: [f64; 3]) -> [f64; 3] {
        let moved = Vector3::from(place) - Vector3::from(self.shift);
        self.rotation().inverse_transform_vector(&moved).into()
    }

    fn rotation(&self) -> UnitQuaternion<f64> {
        let [x, y, z, w] = self.turn;
        UnitQuaternion::from_quaternion(nalgebra::Quaternion::new(w, x, y, z))
    }
}

/// Finds the rotation nearest to a matrix (orthogonal Procrustes problem). The matrix of a flat sheet has no third
/// column; the cross product of the other two columns replaces it.
fn nearest(matrix: Matrix3<f64>) -> Rotation3<f64> {
    let [a, b] = [matrix.column(0).into_owned(), matrix.column(1).into_owned()];
    let normal = a.cross(&b);
    let long = normal.norm();
    if long <= 1e-12 {
        return Rotation3::identity();
    }
    // In the plane of the two columns the problem is that of a 2 × 2 matrix, solved by an angle.
    let normal = normal / long;
    let first = a / a.norm();
    let second = normal.cross(&first);
    let (p, q) = (
        first.dot(&a) + second.dot(&b),
        second.dot(&a) - first.dot(&b),
    );
    let (cos, sin) = (p / p.hypot(q), q / p.hypot(q));
    let x = first * cos + second * sin;
    let y = second * cos - first * sin;
    Rotation3::from_matrix_unchecked(Matrix3::from_columns(&[x, y, normal]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_turned_sheet_is_found_again() {
        let turn = Rotation3::from_euler_angles(0.7, -1.1, 2.3);
        let shift = Vector3::new(3.0, -2.0, 9.0);
        let flat: Vec<[f64; 2]> = (0..30)
            .map(|i| [f64::from(i % 6) * 1.5, f64::from(i / 6)])
            .collect();
        let built = (flat.iter())
            .map(|p| (turn * Vector3::new(p[0], p[1], 0.0) + shift).into())
            .collect();
        let faces = Faces {
            built,
            flat,
            ..Faces::default()
        };
        let pose = Pose::of(&faces, [2.0, 1.0]);
        for (p, q) in faces.flat.iter().zip(&faces.built) {
            let found = pose.of_place([p[0] - 2.0, p[1] - 1.0, 0.0]);
            let back = pose.back(*q);
            for k in 0..3 {
                assert!((found[k] - q[k]).abs() < 1e-9, "{found:?} {q:?}");
                assert!((back[k] - [p[0] - 2.0, p[1] - 1.0, 0.0][k]).abs() < 1e-9);
            }
        }
    }
}

//! From the user's heights to the energy's and back.

use nalgebra::{Matrix3, Vector3};

use super::input::Input;
use crate::lattice::domain::Domain;

/// Normalised coordinates: lengths times `scale`, heights above the best-fit
/// plane of a component. The energy does not see affine functions, and without
/// them nothing is lost to rounding.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Coordinates {
    /// Factor from the user's units.
    pub scale: f64,
    centre: [f64; 2],
    constant: f64,
    pub slope: [f64; 2],
}

impl Coordinates {
    /// With the least squares, by confidence, over what is given in `I ∪ ∂I`.
    pub(crate) fn new(input: &Input, domain: &Domain, scale: f64) -> Self {
        let field = input.field();
        let given = || {
            let vertices = domain.active().cells().map(|c| domain.lattice_vertex(c));
            vertices.filter_map(|(row, col)| {
                let vertex = field.lattice().index(row, col);
                let weight = if input.is_constrained(vertex) {
                    1.0
                } else {
                    input.weight(vertex)
                };
                // Heights that mean nothing do not count.
                (weight > 0.0).then(|| {
                    let [x, y] = field.lattice().position(row, col);
                    ([x, y, field.heights()[vertex]], weight)
                })
            })
        };
        let total: f64 = given().map(|(_, weight)| weight).sum();
        let mean = |k: usize| {
            given()
                .map(|(at, weight)| weight / total * at[k])
                .sum::<f64>()
        };
        let [x0, y0, z0] = [0, 1, 2].map(mean);
        let mut normal = Matrix3::zeros();
        let mut right = Vector3::zeros();
        for ([x, y, z], weight) in given() {
            let [x, y, z] = [x - x0, y - y0, z - z0].map(|length| scale * length);
            let row = Vector3::new(1.0, x, y);
            normal += weight / total * row * row.transpose();
            right += weight / total * z * row;
        }
        // What holds a component in place spans a plane; zero is for overflow only.
        let solution = normal.cholesky().map(|c| c.solve(&right));
        let [constant, sx, sy] = solution.map_or([0.0; 3], |s| [s[0], s[1], s[2]]);
        Coordinates {
            scale,
            centre: [x0, y0],
            constant: z0 + constant / scale,
            slope: [sx, sy],
        }
    }

    fn plane(&self, [x, y]: [f64; 2]) -> f64 {
        self.constant + self.slope[0] * (x - self.centre[0]) + self.slope[1] * (y - self.centre[1])
    }

    /// A height at a position, both in the user's units, in normalised coordinates.
    pub(crate) fn inward(&self, position: [f64; 2], height: f64) -> f64 {
        self.scale * (height - self.plane(position))
    }

    /// The way back.
    pub(crate) fn outward(&self, position: [f64; 2], z: f64) -> f64 {
        z / self.scale + self.plane(position)
    }
}

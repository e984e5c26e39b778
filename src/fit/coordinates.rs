//! From the user's heights to the energy's and back.

use nalgebra::{Matrix3, Vector3};

use super::input::Input;
use crate::heights::normalization::Normalization;
use crate::lattice::domain::Domain;

/// Normalised coordinates: lengths times `scale`, heights above the input's
/// best-fit plane. The energy does not see affine functions, and without them
/// nothing is lost to rounding.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Coordinates {
    /// Factor from the user's units.
    pub scale: f64,
    centre: [f64; 2],
    constant: f64,
    pub slope: [f64; 2],
}

impl Coordinates {
    pub(crate) fn new(input: &Input, domain: &Domain, normalization: Normalization) -> Self {
        let field = input.field();
        let scale = normalization.factor(field);
        // Heights that mean nothing do not count.
        let given = |v: &(usize, usize)| input.is_given(field.lattice().index(v.0, v.1));
        let cells = || domain.active().cells();
        let vertices = || cells().map(|c| domain.lattice_vertex(c)).filter(given);
        let n = vertices().count() as f64;
        let position = |(row, col)| field.lattice().position(row, col);
        let height = |(row, col)| field.height(row, col);
        let centre = [0, 1].map(|k| vertices().map(|v| position(v)[k]).sum::<f64>() / n);
        let mean = vertices().map(height).sum::<f64>() / n;

        // Least squares over what is given in I ∪ ∂I.
        let mut normal = Matrix3::zeros();
        let mut right = Vector3::zeros();
        for v in vertices() {
            let [x, y] = position(v);
            let row = Vector3::new(1.0, scale * (x - centre[0]), scale * (y - centre[1]));
            normal += row * row.transpose();
            right += row * (height(v) - mean);
        }
        // What holds a component in place spans a plane; zero is for overflow only.
        let solution = normal.cholesky().map(|c| c.solve(&right));
        let [constant, sx, sy] = solution.map_or([0.0; 3], |s| [s[0], s[1], s[2]]);
        Coordinates {
            scale,
            centre,
            constant: mean + constant,
            slope: [scale * sx, scale * sy],
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

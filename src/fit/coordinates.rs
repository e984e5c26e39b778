//! Normalised coordinates: the conversion of the user's heights to the heights in the energy, and back.

use nalgebra::Vector3;

use super::input::Input;
use crate::lattice::domain::Domain;
use crate::math::least_squares::LeastSquares;

/// Normalised coordinates of a component: lengths times `scale`, heights relative to the best-fit plane. The energy
/// does not depend on affine functions, and without them less is lost to rounding.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Coordinates {
    /// Factor from the user's units to normalised coordinates.
    pub scale: f64,
    plane: Plane,
}

/// A plane: height as an affine function of the position.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Plane {
    centre: [f64; 2],
    constant: f64,
    slope: [f64; 2],
}

impl Plane {
    /// Fits a plane to weighted points (x, y, height) by least squares.
    pub(crate) fn fit(points: impl Iterator<Item = ([f64; 3], f64)> + Clone) -> Self {
        let total: f64 = points.clone().map(|(_, weight)| weight).sum();
        let points = points.map(|(point, weight)| (point, weight / total));
        let [x0, y0, z0] = points.clone().fold([0.0; 3], |means, (at, weight)| {
            std::array::from_fn(|k| means[k] + weight * at[k])
        });
        // Of unit size, so that squares neither over- nor underflow.
        let size = points.clone().fold(0.0f64, |size, ([x, y, _], _)| {
            size.max((x - x0).abs()).max((y - y0).abs())
        });
        let mut plane = LeastSquares::<3>::new();
        for ([x, y, z], weight) in points.clone() {
            let row = Vector3::new(1.0, (x - x0) / size, (y - y0) / size);
            plane.add(&row, [z - z0], weight);
        }
        // What holds a component in place spans a plane; zero is for overflow only.
        let solution = plane.solve();
        let [constant, sx, sy] = solution.map_or([0.0; 3], |s| [s[0], s[1], s[2]]);
        Plane {
            centre: [x0, y0],
            constant: z0 + constant,
            slope: [sx / size, sy / size],
        }
    }

    pub(crate) fn at(&self, [x, y]: [f64; 2]) -> f64 {
        self.constant + self.slope[0] * (x - self.centre[0]) + self.slope[1] * (y - self.centre[1])
    }
}

impl Coordinates {
    /// Makes coordinates relative to the best-fit plane of the heights of all active vertices, weighted by confidence.
    pub(crate) fn new(input: &Input, domain: &Domain, scale: f64) -> Self {
        let field = input.field();
        let vertices = domain.vertices(domain.active());
        let plane = Plane::fit(vertices.filter_map(|(_, (row, col))| {
            let vertex = field.lattice().index(row, col);
            let weight = input.trust(vertex);
            // Heights that mean nothing do not count.
            (weight > 0.0).then(|| {
                let [x, y] = field.lattice().position(row, col);
                ([x, y, field.heights()[vertex]], weight)
            })
        }));
        Coordinates { scale, plane }
    }

    /// Slope of the best-fit plane in the x and the y direction.
    pub(crate) fn slope(&self) -> [f64; 2] {
        self.plane.slope
    }

    /// Converts a height at a position, both in the user's units, to a normalised height.
    pub(crate) fn inward(&self, position: [f64; 2], height: f64) -> f64 {
        self.scale * (height - self.plane.at(position))
    }

    /// Converts a normalised height `z`, at a position in the user's units, to a height in the user's units.
    pub(crate) fn outward(&self, position: [f64; 2], z: f64) -> f64 {
        z / self.scale + self.plane.at(position)
    }
}

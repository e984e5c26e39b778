//! The least-squares quadratic of a warp map around a pixel.

use nalgebra::SVector;

use super::WarpMap;
use crate::math::least_squares::LeastSquares;

/// Number of coefficients of a quadratic in two variables.
const QUADRATIC_TERMS: usize = 6;

/// Maximum number of samples along each side of the window that the quadratic is fitted to.
const MAX_SAMPLES_PER_SIDE: usize = 24;

/// Ridge weight of each coefficient, relative to the number of samples: so small that it decides only what the samples leave
/// open. Curvature is given up first.
const RIDGE_WEIGHTS: [f64; QUADRATIC_TERMS] = [1e-9, 1e-8, 1e-8, 1e-5, 1e-5, 1e-5];

/// The least-squares quadratic of a warp map's places over a square window.
pub(super) struct LocalQuadratic {
    centre: [f64; 2],
    /// Half the side of the window, in pixels.
    radius: f64,
    /// Coefficients for x and for y.
    coefficients: [SVector<f64, QUADRATIC_TERMS>; 2],
}

impl LocalQuadratic {
    /// Fits a quadratic to a square window around a pixel, `radius` pixels to each side; a plane where the samples do not
    /// determine a quadratic. None if there is no sheet in the window.
    pub(super) fn new(map: &WarpMap, centre: [f64; 2], radius: f64) -> Option<Self> {
        let size = [map.width(), map.height()];
        let [first, last] = [-1.0, 1.0].map(|side| {
            let at = |k: usize| (centre[k] + side * radius).clamp(0.0, (size[k] - 1) as f64);
            [at(0), at(1)]
        });
        let count = |k: usize| MAX_SAMPLES_PER_SIDE.min((last[k] - first[k]) as usize + 1);
        let sample = |k: usize, i: usize| {
            let share = if count(k) > 1 {
                i as f64 / (count(k) - 1) as f64
            } else {
                0.5
            };
            (first[k] + share * (last[k] - first[k])).round() as usize
        };
        let mut fit = LeastSquares::<QUADRATIC_TERMS, 2>::new();
        let mut found = 0;
        for j in 0..count(1) {
            for i in 0..count(0) {
                let [col, row] = [sample(0, i), sample(1, j)];
                let place = map.places()[row * size[0] + col];
                if place[0].is_nan() {
                    continue;
                }
                found += 1;
                let terms = terms([col as f64, row as f64], centre, radius);
                fit.add(&terms, place.map(f64::from), 1.0);
            }
        }
        if found == 0 {
            return None;
        }
        let scale = found as f64;
        fit.add_ridge(&RIDGE_WEIGHTS.map(|weight| weight * scale));
        let solution = fit.solve()?;
        Some(LocalQuadratic {
            centre,
            radius,
            coefficients: [0, 1].map(|k| solution.column(k).into_owned()),
        })
    }

    /// Extrapolated place in the photo of a pixel.
    pub(super) fn at(&self, pixel: [f64; 2]) -> [f64; 2] {
        let terms = terms(pixel, self.centre, self.radius);
        [0, 1].map(|k| self.coefficients[k].dot(&terms))
    }
}

/// Monomials of a quadratic, in coordinates scaled to the window.
fn terms(at: [f64; 2], centre: [f64; 2], radius: f64) -> SVector<f64, QUADRATIC_TERMS> {
    let [x, y] = [0, 1].map(|k| (at[k] - centre[k]) / radius);
    SVector::from([1.0, x, y, x * x, x * y, y * y])
}

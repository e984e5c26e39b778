//! Least-squares quadratic of a warp map around a pixel, for extrapolating the map.

use nalgebra::SVector;

use super::WarpMap;
use crate::math::least_squares::LeastSquares;

/// Number of coefficients of a quadratic in two variables.
const QUADRATIC_TERMS: usize = QUADRATIC_FIT_RIDGE_WEIGHTS.len();

/// Maximum number of sampled pixels along each side of the window to which a quadratic is fitted.
const MAX_SAMPLES_PER_SIDE: usize = 24;

/// Ridge weight of each coefficient of the quadratic, relative to the number of samples: so small that it decides only
/// what the samples leave undetermined. Curvature is given up first.
const QUADRATIC_FIT_RIDGE_WEIGHTS: [f64; 6] = [1e-9, 1e-8, 1e-8, 1e-5, 1e-5, 1e-5];

/// Quadratic that fits a warp map over a square window: from pixels of the flat image to places in the photo.
pub(super) struct LocalQuadratic {
    centre: [f64; 2],
    /// Half the side of the window, in pixels.
    radius: f64,
    /// Coefficients of the quadratic for x and for y in the photo.
    coefficients: [SVector<f64, QUADRATIC_TERMS>; 2],
}

impl LocalQuadratic {
    /// Fits a quadratic to the map in a square window around the pixel `centre`, `radius` pixels to each side; a plane
    /// where the samples do not determine a quadratic. None if the window shows no sheet.
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
        fit.add_ridge(&QUADRATIC_FIT_RIDGE_WEIGHTS.map(|weight| weight * scale));
        let solution = fit.solve()?;
        Some(LocalQuadratic {
            centre,
            radius,
            coefficients: [0, 1].map(|k| solution.column(k).into_owned()),
        })
    }

    /// Evaluates the quadratic: the place in the photo of a pixel of the flat image.
    pub(super) fn at(&self, pixel: [f64; 2]) -> [f64; 2] {
        let terms = terms(pixel, self.centre, self.radius);
        [0, 1].map(|k| self.coefficients[k].dot(&terms))
    }
}

/// Monomials of a quadratic at a pixel, in coordinates relative to the window's centre and scaled by its radius.
fn terms(at: [f64; 2], centre: [f64; 2], radius: f64) -> SVector<f64, QUADRATIC_TERMS> {
    let [x, y] = [0, 1].map(|k| (at[k] - centre[k]) / radius);
    SVector::from([1.0, x, y, x * x, x * y, y * y])
}

//! How a warp map goes on near a place: a polynomial through the pixels around it.

use nalgebra::SVector;

use super::WarpMap;
use crate::math::least_squares::LeastSquares;

/// The coefficients of a quadratic in two variables.
const TERMS: usize = 6;

/// Most samples along each side of the window.
const SAMPLES: usize = 24;

/// The least-squares quadratic of the map's places over a window.
pub(super) struct Local {
    centre: [f64; 2],
    reach: f64,
    /// For x and for y.
    coefficients: [SVector<f64, TERMS>; 2],
}

impl Local {
    /// That of a square window around a pixel, which reaches so many pixels to each side. Nothing
    /// where there is no sheet. Where the samples do not bear a quadratic it is a plane.
    pub(super) fn new(map: &WarpMap, centre: [f64; 2], reach: f64) -> Option<Self> {
        let size = [map.width(), map.height()];
        let [first, last] = [-1.0, 1.0].map(|side| {
            let at = |k: usize| (centre[k] + side * reach).clamp(0.0, (size[k] - 1) as f64);
            [at(0), at(1)]
        });
        let count = |k: usize| SAMPLES.min((last[k] - first[k]) as usize + 1);
        let sample = |k: usize, i: usize| {
            let share = if count(k) > 1 {
                i as f64 / (count(k) - 1) as f64
            } else {
                0.5
            };
            (first[k] + share * (last[k] - first[k])).round() as usize
        };
        let mut fit = LeastSquares::<TERMS, 2>::new();
        let mut found = 0;
        for j in 0..count(1) {
            for i in 0..count(0) {
                let [col, row] = [sample(0, i), sample(1, j)];
                let place = map.places()[row * size[0] + col];
                if place[0].is_nan() {
                    continue;
                }
                found += 1;
                let terms = terms([col as f64, row as f64], centre, reach);
                fit.add(&terms, place.map(f64::from), 1.0);
            }
        }
        if found == 0 {
            return None;
        }
        // So little that it counts only where samples say nothing; curvature is given up first.
        let scale = found as f64;
        fit.add_ridge(&[1e-9, 1e-8, 1e-8, 1e-5, 1e-5, 1e-5].map(|weight| weight * scale));
        let solution = fit.solve()?;
        Some(Local {
            centre,
            reach,
            coefficients: [0, 1].map(|k| solution.column(k).into_owned()),
        })
    }

    pub(super) fn at(&self, pixel: [f64; 2]) -> [f64; 2] {
        let terms = terms(pixel, self.centre, self.reach);
        [0, 1].map(|k| self.coefficients[k].dot(&terms))
    }
}

fn terms(at: [f64; 2], centre: [f64; 2], reach: f64) -> SVector<f64, TERMS> {
    let [x, y] = [0, 1].map(|k| (at[k] - centre[k]) / reach);
    SVector::from([1.0, x, y, x * x, x * y, y * y])
}

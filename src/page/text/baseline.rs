//! Baselines of bands of ink, and the test which of them are lines of text: they are smooth.

use nalgebra::SVector;

use super::bands::{Band, MIN_BAND_STRIPS, SmoothedProfiles};
use crate::math::least_squares::LeastSquares;
use crate::math::statistics::{MAD_TO_SIGMA, median};

/// Baseline of a line of text, in pixels of the ink image.
#[derive(Debug, Clone)]
pub(super) struct Baseline {
    pub points: Vec<[f64; 2]>,
    /// Half the x-height of the line's letters, in pixels.
    pub sigma: f64,
    /// Mean row of the baseline, in pixels of the ink image.
    pub level: f64,
}

/// Minimum share of the vertical strips of a band of ink in which its lower edge lies on the fitted baseline.
/// Its row: `benches/page.md`, Models.
const MIN_INLIER_SHARE: f64 = 0.6;

/// Maximum scatter of the lower edges of a band of ink about its fitted baseline, in pixels of the ink image;
/// [`MAX_SCATTER_SCALES`] adds a share of the letters' height. Letters of print stand on a line; handwriting and
/// pictures do not.
/// Its row: `benches/page.md`, One rule at a time.
const MAX_SCATTER_PIXELS: f64 = 0.3;

/// Addition to the maximum scatter of lower edges about a baseline, as a share of half the x-height.
/// Its row: `benches/page.md`, Models.
const MAX_SCATTER_SCALES: f64 = 0.05;

impl Baseline {
    /// Fits the baseline of a band of ink: a polynomial through the band's lower edges in each vertical strip, `step`
    /// pixels wide. None if the edges scatter too much.
    pub fn new(band: &Band, fine: &SmoothedProfiles, sigma: f64, step: f64) -> Option<Self> {
        let all: Vec<[f64; 2]> = (band.iter())
            .filter_map(|(strip, row)| {
                let y = fine.baseline(*strip, *row, sigma)?;
                Some([(*strip as f64 + 0.5) * step, y])
            })
            .collect();
        if all.len() < MIN_BAND_STRIPS {
            return None;
        }
        let off = distances_from_curve(&all, 4.min(all.len() / 6).max(1))?;
        let scatter = MAD_TO_SIGMA * median(&mut off.clone())?;
        let near = (2.5 * scatter).max(0.3);
        let points: Vec<[f64; 2]> = (all.iter().zip(&off))
            .filter(|(_, off)| **off <= near)
            .map(|(p, _)| *p)
            .collect();
        let enough = MIN_BAND_STRIPS.max((MIN_INLIER_SHARE * band.len() as f64).ceil() as usize);
        if scatter > MAX_SCATTER_PIXELS + MAX_SCATTER_SCALES * sigma || points.len() < enough {
            return None;
        }
        Some(Baseline {
            level: points.iter().map(|p| p[1]).sum::<f64>() / points.len() as f64,
            points,
            sigma,
        })
    }

    /// Whether two baselines run at the same place, so that one of them is superfluous.
    pub fn covers(&self, other: &Baseline) -> bool {
        let near = 2.0 * self.sigma.max(other.sigma);
        let both = (self.points.iter())
            .filter(|p| (other.points.iter()).any(|q| p[0] == q[0] && (p[1] - q[1]).abs() < near))
            .count();
        both >= 3
    }
}

/// Fits the polynomial of a degree of at most 5 with the least sum of absolute distances from points, by iteratively reweighted
/// least squares; returns the distances. None if there are no points.
fn distances_from_curve(points: &[[f64; 2]], degree: usize) -> Option<Vec<f64>> {
    let [from, to] = [points.first()?[0], points.last()?[0]];
    let powers = |p: &[f64; 2]| {
        let at = 2.0 * (p[0] - from) / (to - from).max(1e-9) - 1.0;
        SVector::<f64, 6>::from_fn(|k, _| if k > degree { 0.0 } else { at.powi(k as i32) })
    };
    let rows: Vec<SVector<f64, 6>> = points.iter().map(powers).collect();
    let mut distances = vec![1.0; points.len()];
    for _ in 0..12 {
        let mut fit = LeastSquares::<6>::with_ridge([1e-9; 6]);
        for ((row, point), off) in rows.iter().zip(points).zip(&distances) {
            fit.add(row, [point[1]], 1.0 / f64::max(*off, 0.05));
        }
        let curve = fit.solve()?;
        for ((row, point), off) in rows.iter().zip(points).zip(&mut distances) {
            *off = (point[1] - row.dot(&curve)).abs();
        }
    }
    Some(distances)
}

//! Baselines of bands of ink, and the test which of them are lines of text: they are smooth.

use nalgebra::{DMatrix, DVector};

use super::bands::{Band, MIN_BAND_STRIPS, SmoothedProfiles};
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
        let curve = fit_robust(&all, 4.min(all.len() / 6).max(1))?;
        let off: Vec<f64> = all.iter().map(|p| (p[1] - curve.at(p[0])).abs()).collect();
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

/// A polynomial over an interval, as a Legendre series.
struct Polynomial {
    from: f64,
    span: f64,
    coefficients: DVector<f64>,
}

impl Polynomial {
    /// Evaluates the polynomial at `x`.
    fn at(&self, x: f64) -> f64 {
        let degree = self.coefficients.len() - 1;
        let values = legendre_values(degree, (x - self.from) / self.span);
        values
            .iter()
            .zip(&self.coefficients)
            .map(|(p, c)| p * c)
            .sum()
    }
}

/// Fits the polynomial with the least sum of absolute distances from points, by iteratively reweighted least squares.
/// None if there are no points.
fn fit_robust(points: &[[f64; 2]], degree: usize) -> Option<Polynomial> {
    let from = points.first()?[0];
    let span = (points.last()?[0] - from).max(1e-9);
    let rows: Vec<DVector<f64>> = (points.iter())
        .map(|p| DVector::from_vec(legendre_values(degree, (p[0] - from) / span)))
        .collect();
    let mut weights = vec![1.0; points.len()];
    let mut found = None;
    for _ in 0..12 {
        let mut normal = DMatrix::<f64>::identity(degree + 1, degree + 1) * 1e-9;
        let mut right = DVector::<f64>::zeros(degree + 1);
        for ((row, point), weight) in rows.iter().zip(points).zip(&weights) {
            normal.ger(*weight, row, row, 1.0);
            right += row * (*weight * point[1]);
        }
        let polynomial = Polynomial {
            from,
            span,
            coefficients: normal.cholesky()?.solve(&right),
        };
        for (weight, p) in weights.iter_mut().zip(points) {
            *weight = 1.0 / (p[1] - polynomial.at(p[0])).abs().max(0.05);
        }
        found = Some(polynomial);
    }
    found
}

/// Evaluates the Legendre polynomials of degrees 0 to `degree`, scaled to the interval from 0 to 1, at a place `at` in
/// it.
fn legendre_values(degree: usize, at: f64) -> Vec<f64> {
    let x = 2.0 * at - 1.0;
    let mut values = vec![1.0];
    for k in 0..degree {
        let before = if k > 0 { values[k - 1] } else { 0.0 };
        let order = k as f64;
        values.push(((2.0 * order + 1.0) * x * values[k] - order * before) / (order + 1.0));
    }
    values
}

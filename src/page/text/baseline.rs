//! Baselines of bands of ink, and the test which of them are lines of text: smooth, and parallel to their neighbours.

use nalgebra::{DMatrix, DVector};

use super::bands::{Band, MIN_BAND_STRIPS, SmoothedProfiles};
use super::ranking::ranked;
use crate::page::cylinder::legendre_values;

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
const MIN_INLIER_SHARE: f64 = 0.6;

/// Maximum scatter of the lower edges of a band of ink about its fitted baseline, in pixels of the ink image;
/// [`MAX_SCATTER_SCALES`] adds a share of the letters' height. Letters of print stand on a line; handwriting and
/// pictures do not.
const MAX_SCATTER_PIXELS: f64 = 0.3;

/// Addition to the maximum scatter of lower edges about a baseline, as a share of half the x-height.
const MAX_SCATTER_SCALES: f64 = 0.05;

/// Minimum number of parallel lines of text on a page: fewer may be parallel by chance.
const MIN_TEXT_LINES: usize = 4;

/// Maximum distance between lines that are compared for being parallel, as a multiple of half the x-height.
const MAX_NEIGHBOUR_DISTANCE: f64 = 25.0;

/// Number of nearest lines with which a line is compared for being parallel.
const COMPARED_NEIGHBOURS: usize = 4;

/// Maximum variation (standard deviation) of the distance between two lines of text that count as parallel, in pixels
/// of the ink image; [`MAX_NON_PARALLEL_SCALES`] adds a share of the letters' height.
const MAX_NON_PARALLEL_PIXELS: f64 = 0.5;

/// Addition to the maximum variation of the distance between parallel lines of text, as a share of half the x-height.
const MAX_NON_PARALLEL_SCALES: f64 = 0.08;

/// Minimum share of all candidate lines of text that are parallel to their neighbours: below it the page is assumed to
/// have no print.
const MIN_PARALLEL_SHARE: f64 = 0.65;

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
        let scatter = 1.4826 * median(off.clone());
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

    /// Variation (standard deviation), along the lines, of the distance between two lines of text, in pixels; None if
    /// they have too few strips in common.
    fn distance_change(&self, other: &Baseline) -> Option<f64> {
        let gaps: Vec<f64> = (self.points.iter())
            .filter_map(|p| {
                let q = other.points.iter().find(|q| q[0] == p[0])?;
                Some(q[1] - p[1])
            })
            .collect();
        if gaps.len() < MIN_BAND_STRIPS / 2 {
            return None;
        }
        let mean = gaps.iter().sum::<f64>() / gaps.len() as f64;
        let squares = gaps.iter().map(|gap| (gap - mean).powi(2)).sum::<f64>();
        Some((squares / gaps.len() as f64).sqrt())
    }

    /// Whether the line is parallel to at least half of its nearest neighbours in `lines`; `own` is its own index
    /// there.
    fn is_parallel(&self, lines: &[Baseline], own: usize) -> bool {
        let (away, apart): (Vec<f64>, Vec<f64>) = (lines.iter().enumerate())
            .filter(|(i, other)| {
                *i != own && (other.level - self.level).abs() < MAX_NEIGHBOUR_DISTANCE * self.sigma
            })
            .filter_map(|(_, other)| {
                Some((
                    (other.level - self.level).abs(),
                    self.distance_change(other)?,
                ))
            })
            .unzip();
        let mut near = ranked(&away);
        near.truncate(COMPARED_NEIGHBOURS);
        let limit = MAX_NON_PARALLEL_PIXELS + MAX_NON_PARALLEL_SCALES * self.sigma;
        let alike = near.iter().filter(|k| apart[**k] < limit).count();
        2 * alike >= near.len().max(COMPARED_NEIGHBOURS)
    }
}

/// Keeps the lines that are parallel to at least half of their neighbours, as those of print are; returns none if too
/// few remain.
pub(super) fn parallel_lines(mut lines: Vec<Baseline>) -> Vec<Baseline> {
    let all = lines.len();
    loop {
        let kept: Vec<Baseline> = (lines.iter().enumerate())
            .filter(|(i, line)| line.is_parallel(&lines, *i))
            .map(|(_, line)| line.clone())
            .collect();
        if kept.len() < MIN_TEXT_LINES || (kept.len() as f64) < MIN_PARALLEL_SHARE * all as f64 {
            return Vec::new();
        }
        if kept.len() == lines.len() {
            return kept;
        }
        lines = kept;
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

/// Median of values; 0 if there are none.
fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(0.0)
}

//! Baselines of bands of ink, and which of them are lines of text: those with a smooth baseline that is parallel to its
//! neighbours.

use nalgebra::{DMatrix, DVector};

use super::bands::{Band, MIN_BAND_STRIPS, SmoothedProfiles};
use super::ranking::ranked;
use crate::page::cylinder::legendre_values;

/// Baseline of a line of text, in pixels of the ink image.
#[derive(Debug, Clone)]
pub(super) struct Baseline {
    pub points: Vec<[f64; 2]>,
    /// Half the x-height.
    pub sigma: f64,
    /// Mean row.
    pub level: f64,
}

/// Minimum share of a band's strips whose lower edge lies on the baseline.
const MIN_INLIER_SHARE: f64 = 0.6;

/// Maximum scatter of the strips' lower edges about the baseline, in pixels of the ink image, to which a share of the letters'
/// height is added. Letters of print stand on a line; handwriting and pictures do not.
const MAX_SCATTER_PIXELS: f64 = 0.3;

/// Share of half the x-height that is added to the maximum scatter.
const MAX_SCATTER_SCALES: f64 = 0.05;

/// Minimum number of lines on a page: fewer may be parallel by chance.
const MIN_LINES: usize = 4;

/// Maximum distance of a neighbouring line that a line is compared with, over half the x-height.
const MAX_NEIGHBOUR_DISTANCE: f64 = 25.0;

/// Number of neighbouring lines that a line is compared with.
const COMPARED_NEIGHBOURS: usize = 4;

/// Maximum root mean square change of the distance between parallel lines, in pixels of the ink image, to which a share of the
/// letters' height is added.
const MAX_NON_PARALLEL_PIXELS: f64 = 0.5;

/// Share of half the x-height that is added to the maximum change.
const MAX_NON_PARALLEL_SCALES: f64 = 0.08;

/// Minimum share of all lines that are parallel to those around them: below it the page has no print.
const MIN_PARALLEL_SHARE: f64 = 0.65;

impl Baseline {
    /// The baseline of a band, by a polynomial through its strips' lower edges. None if these scatter too much.
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

    /// Whether both lines are at the same place.
    pub fn covers(&self, other: &Baseline) -> bool {
        let near = 2.0 * self.sigma.max(other.sigma);
        let both = (self.points.iter())
            .filter(|p| (other.points.iter()).any(|q| p[0] == q[0] && (p[1] - q[1]).abs() < near))
            .count();
        both >= 3
    }

    /// Root mean square change of the distance from another line; None if they have too few strips in common.
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

    /// Whether the line is parallel to half of its neighbours.
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

/// Lines that are parallel to half of the lines above and below them, as those of print are; none if they are too few.
pub(super) fn parallel_lines(mut lines: Vec<Baseline>) -> Vec<Baseline> {
    let all = lines.len();
    loop {
        let kept: Vec<Baseline> = (lines.iter().enumerate())
            .filter(|(i, line)| line.is_parallel(&lines, *i))
            .map(|(_, line)| line.clone())
            .collect();
        if kept.len() < MIN_LINES || (kept.len() as f64) < MIN_PARALLEL_SHARE * all as f64 {
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
    /// Value at a place.
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

/// The polynomial with the least sum of absolute distances from points, by iteratively reweighted least squares.
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

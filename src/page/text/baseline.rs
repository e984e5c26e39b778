//! Which bands are lines of text: those that end below at a smooth line, as all of their neighbours do.

use nalgebra::{DMatrix, DVector};

use super::bands::{Band, LEAST, Smoothed};
use super::ranking::ranked;
use crate::page::cylinder::legendre;

/// A line that letters stand on, in pixels of the ink.
#[derive(Debug, Clone)]
pub(super) struct Baseline {
    pub points: Vec<[f64; 2]>,
    pub sigma: f64,
    /// Its mean row.
    pub level: f64,
}

/// Share of a band's strips that lie on its line, at least.
const ON: f64 = 0.6;

/// Scatter of all about the line, at most, in pixels of the ink, and over half the height of letters besides:
/// letters of a print stand on a line, those of a hand, and round things, do not.
const SCATTER: [f64; 2] = [0.3, 0.05];

/// Lines on a page, at least: fewer prove nothing.
const FEW: usize = 4;

/// How far away a line may be that another is compared with, over half the height of its letters, and how many
/// are.
const AWAY: f64 = 25.0;
const AROUND: usize = 4;

/// What parallel lines may be off, as a root mean square: in pixels of the ink, and over half the height of
/// letters besides.
const PARALLEL: [f64; 2] = [0.5, 0.08];

/// Share of all lines that are parallel to those around them, at least: else it is no print.
const PRINT: f64 = 0.65;

impl Baseline {
    pub fn new(band: &Band, fine: &Smoothed, sigma: f64, step: f64) -> Option<Self> {
        let all: Vec<[f64; 2]> = (band.iter())
            .filter_map(|(strip, row)| {
                let y = fine.baseline(*strip, *row, sigma)?;
                Some([(*strip as f64 + 0.5) * step, y])
            })
            .collect();
        if all.len() < LEAST {
            return None;
        }
        let curve = robust(&all, 4.min(all.len() / 6).max(1))?;
        let off: Vec<f64> = all.iter().map(|p| (p[1] - curve.at(p[0])).abs()).collect();
        let scatter = 1.4826 * median(off.clone());
        let near = (2.5 * scatter).max(0.3);
        let points: Vec<[f64; 2]> = (all.iter().zip(&off))
            .filter(|(_, off)| **off <= near)
            .map(|(p, _)| *p)
            .collect();
        let enough = LEAST.max((ON * band.len() as f64).ceil() as usize);
        if scatter > SCATTER[0] + SCATTER[1] * sigma || points.len() < enough {
            return None;
        }
        Some(Baseline {
            level: points.iter().map(|p| p[1]).sum::<f64>() / points.len() as f64,
            points,
            sigma,
        })
    }

    /// Whether both are seen in one place.
    pub fn covers(&self, other: &Baseline) -> bool {
        let near = 2.0 * self.sigma.max(other.sigma);
        let both = (self.points.iter())
            .filter(|p| (other.points.iter()).any(|q| p[0] == q[0] && (p[1] - q[1]).abs() < near))
            .count();
        both >= 3
    }

    /// The root mean square by which the distance from another line changes along it; none where they have too
    /// little in common.
    fn apart(&self, other: &Baseline) -> Option<f64> {
        let gaps: Vec<f64> = (self.points.iter())
            .filter_map(|p| {
                let q = other.points.iter().find(|q| q[0] == p[0])?;
                Some(q[1] - p[1])
            })
            .collect();
        if gaps.len() < LEAST / 2 {
            return None;
        }
        let mean = gaps.iter().sum::<f64>() / gaps.len() as f64;
        let squares = gaps.iter().map(|gap| (gap - mean).powi(2)).sum::<f64>();
        Some((squares / gaps.len() as f64).sqrt())
    }

    fn agrees(&self, lines: &[Baseline], own: usize) -> bool {
        let (away, apart): (Vec<f64>, Vec<f64>) = (lines.iter().enumerate())
            .filter(|(i, other)| *i != own && (other.level - self.level).abs() < AWAY * self.sigma)
            .filter_map(|(_, other)| Some(((other.level - self.level).abs(), self.apart(other)?)))
            .unzip();
        let mut near = ranked(&away);
        near.truncate(AROUND);
        let limit = PARALLEL[0] + PARALLEL[1] * self.sigma;
        let alike = near.iter().filter(|k| apart[**k] < limit).count();
        2 * alike >= near.len().max(AROUND)
    }
}

/// Those that are parallel to half of the lines above and below them: print is, and little else.
pub(super) fn together(mut lines: Vec<Baseline>) -> Vec<Baseline> {
    let all = lines.len();
    loop {
        let kept: Vec<Baseline> = (lines.iter().enumerate())
            .filter(|(i, line)| line.agrees(&lines, *i))
            .map(|(_, line)| line.clone())
            .collect();
        if kept.len() < FEW || (kept.len() as f64) < PRINT * all as f64 {
            return Vec::new();
        }
        if kept.len() == lines.len() {
            return kept;
        }
        lines = kept;
    }
}

/// A polynomial over an interval.
struct Polynomial {
    from: f64,
    span: f64,
    coefficients: DVector<f64>,
}

impl Polynomial {
    fn at(&self, x: f64) -> f64 {
        let degree = self.coefficients.len() - 1;
        let values = legendre(degree, (x - self.from) / self.span);
        values
            .iter()
            .zip(&self.coefficients)
            .map(|(p, c)| p * c)
            .sum()
    }
}

/// The polynomial whose distances from the points are smallest, by their sizes.
fn robust(points: &[[f64; 2]], degree: usize) -> Option<Polynomial> {
    let from = points.first()?[0];
    let span = (points.last()?[0] - from).max(1e-9);
    let rows: Vec<DVector<f64>> = (points.iter())
        .map(|p| DVector::from_vec(legendre(degree, (p[0] - from) / span)))
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

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(0.0)
}

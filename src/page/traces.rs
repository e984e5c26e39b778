//! Traced edges and lines of pages as observations of a least-squares problem: a cylinder's residuals and their
//! Jacobian.

use nalgebra::{DMatrix, DVector};

use super::cross_sections::{CrossSections, LineResiduals};
use super::cylinder::{CURVE_PIECES, Cylinder, DIFFERENCE_STEP, SampledCurve};
use super::prior::{Prior, prior_rows};
use super::residual_statistics::ResidualStatistics;
use super::robust_fit::{self, RobustProblem};
use super::traced_line::TracedPage;
use crate::error::Result;

/// A traced point of a page's bent edge.
#[derive(Debug, Clone, Copy)]
struct TracedPoint {
    edge: usize,
    page: usize,
    /// 0 or 1 for a corner at the start or the end of the edge, which the cylinder's corner should meet; None for a
    /// point that should lie anywhere on the edge.
    corner: Option<f64>,
    at: [f64; 2],
    weight: f64,
}

/// All traced edges and lines of text of a photo, thinned out and weighted: the observations to which a page's cylinder
/// is fitted.
#[derive(Debug, Clone)]
pub(super) struct Traces {
    points: Vec<TracedPoint>,
    crosses: CrossSections,
}

/// Residuals of a page's cylinder: distances in the photo between the traced points and the cylinder's projection.
#[derive(Debug, Clone)]
pub(super) struct Residuals {
    /// Residual of each traced point of a bent edge.
    found: Vec<EdgeResidual>,
    crosses: Vec<LineResiduals>,
    /// Objective of the least-squares problem: sum of the robust penalties of all residuals and of the squares of prior
    /// knowledge.
    pub cost: f64,
}

/// Residual of a traced point of a bent edge.
#[derive(Debug, Clone, Copy)]
struct EdgeResidual {
    /// Position of the nearest point along the cylinder's edge, as a share of the page's width.
    share: f64,
    /// Unit normal of the projected edge at the nearest point.
    normal: [f64; 2],
    /// Distance from the projected edge, in pixels: across the edge and, only for a corner, along it.
    distance: [f64; 2],
    /// Robust weight of the point: 1, or less for an outlier.
    trust: f64,
}

/// Maximum number of steps of the fit of a page's cylinder.
const MAX_ITERATIONS: usize = 40;

/// Relative decrease of the least-squares cost by one step below which the fit of the cylinder has converged.
const RELATIVE_COST_TOLERANCE: f64 = 1e-3;

/// Number added to the cost in the test of its relative decrease, so that the fit of exact traces, whose cost tends to
/// 0, converges, too.
const ABSOLUTE_COST: f64 = 1e-3;

/// Approximate maximum number of points of each traced edge that the fit uses.
const MAX_POINTS_PER_EDGE: usize = 120;

/// Maximum number of independent points that one edge counts as: errors of one hand, or of one algorithm, are
/// correlated along the edge.
const MAX_INDEPENDENT_POINTS: f64 = 60.0;

impl Traces {
    /// Collects the observations of the least-squares problem from the traces of all pages. `sideways` says that the
    /// left and right edges are bent.
    ///
    /// # Errors
    /// [`Error::Edges`](crate::Error::Edges) for lines of text beside their page.
    pub fn new(pages: &[TracedPage], sideways: bool) -> Result<Self> {
        let mut points = Vec::new();
        for (page, traced) in pages.iter().enumerate() {
            for (edge, line) in traced.pair.iter().enumerate() {
                let last = line.points.len() - 1;
                let step = line.points.len().div_ceil(MAX_POINTS_PER_EDGE);
                let count = (last / step) as f64;
                let weight =
                    (line.independent.min(MAX_INDEPENDENT_POINTS) / count.max(1.0)).min(1.0);
                for (i, at) in line.points.iter().enumerate() {
                    let corner = match i {
                        0 => Some(0.0),
                        _ if i == last => Some(1.0),
                        _ if i % step == 0 => None,
                        _ => continue,
                    };
                    points.push(TracedPoint {
                        edge,
                        page,
                        corner,
                        at: *at,
                        weight: if corner.is_some() { 1.0 } else { weight },
                    });
                }
            }
        }
        let crosses = CrossSections::new(pages, sideways)?;
        Ok(Traces { points, crosses })
    }

    /// Number of lines of text, traced and detected.
    pub fn text(&self) -> usize {
        self.crosses.text
    }

    /// Number of independent observations in all traces: the sum of their weights.
    pub fn count(&self) -> f64 {
        let own = |p: &TracedPoint| p.weight * if p.corner.is_some() { 2.0 } else { 1.0 };
        self.points.iter().map(own).sum::<f64>() + self.crosses.count()
    }

    /// Finds the cylinder that fits the traces best, from an initial guess; returns it with its residuals. None if a cylinder
    /// on the way is not in front of the camera.
    pub fn solve(&self, start: Cylinder, prior: &Prior) -> Option<(Cylinder, Residuals)> {
        let residuals = self.residuals(&start, prior)?;
        let problem = CylinderFit {
            traces: self,
            prior,
        };
        let tolerance = |cost: f64| RELATIVE_COST_TOLERANCE * (ABSOLUTE_COST + cost.min(1.0));
        robust_fit::fit(&problem, (start, residuals), MAX_ITERATIONS, tolerance)
    }

    /// Computes the residuals of a page's cylinder. None if part of it is not in front of the camera.
    pub fn residuals(&self, cylinder: &Cylinder, prior: &Prior) -> Option<Residuals> {
        let curve = cylinder.curve();
        let edges = self.edges(cylinder, &curve)?;
        let mut found = Vec::with_capacity(self.points.len());
        let mut cost = 0.0;
        for point in &self.points {
            let nodes = &edges[point.page][point.edge];
            let (share, piece) = match point.corner {
                Some(end) => (end, if end > 0.0 { CURVE_PIECES - 1 } else { 0 }),
                None => nearest(nodes, point.at),
            };
            let on = match point.corner {
                Some(end) => nodes[if end > 0.0 { CURVE_PIECES } else { 0 }],
                None => self.project(cylinder, &curve, point, share)?,
            };
            let way = difference(nodes[piece + 1], nodes[piece]);
            let length = way[0].hypot(way[1]);
            if !(length > 0.0 && length.is_finite()) {
                return None;
            }
            let normal = [-way[1] / length, way[0] / length];
            let off = difference(point.at, on);
            let across = off[0] * normal[0] + off[1] * normal[1];
            let along = match point.corner {
                Some(_) => off[0] * normal[1] - off[1] * normal[0],
                None => 0.0,
            };
            let size = across.hypot(along) / prior.accuracy;
            let trust = robust_fit::weight(size / robust_fit::OUTLIER_DEVIATIONS);
            cost += point.weight * robust_fit::outlier_penalty(size);
            found.push(EdgeResidual {
                share,
                normal,
                distance: [across, along],
                trust,
            });
        }
        let (crosses, of_crosses) = self.crosses.residuals(cylinder, prior)?;
        cost += of_crosses;
        cost += prior_rows(cylinder, prior)
            .iter()
            .map(|(value, _)| value * value)
            .sum::<f64>();
        cost.is_finite().then_some(Residuals {
            found,
            crosses,
            cost,
        })
    }

    /// Computes the Jacobian of the weighted residuals by the cylinder's parameters (central differences), and these
    /// residuals; the rows of prior knowledge come last. Nearest points on the edges stay the same, because moving
    /// along an edge changes no distance.
    pub fn jacobian(
        &self,
        cylinder: &Cylinder,
        residuals: &Residuals,
        prior: &Prior,
    ) -> Option<(DMatrix<f64>, DVector<f64>)> {
        let parameters = cylinder.parameters();
        let known = prior_rows(cylinder, prior);
        let (own, first) = (2 * self.points.len(), self.rows());
        let rows = first + known.len();
        let mut matrix = DMatrix::zeros(rows, parameters);
        let mut values = DVector::zeros(rows);
        let factors: Vec<f64> = (self.points.iter().zip(&residuals.found))
            .map(|(p, found)| (p.weight * found.trust).sqrt() / prior.accuracy)
            .collect();
        let mut step = vec![0.0; parameters];
        for k in 0..parameters {
            let mut column = matrix.column_mut(k);
            let both = [1.0, -1.0].map(|sign| {
                step[k] = sign * DIFFERENCE_STEP;
                cylinder.moved(&step)
            });
            for (sign, moved) in [1.0, -1.0].into_iter().zip(&both) {
                let curve = moved.curve();
                for (i, (point, found)) in self.points.iter().zip(&residuals.found).enumerate() {
                    let on = self.project(moved, &curve, point, found.share)?;
                    let scale = sign / (2.0 * DIFFERENCE_STEP) * factors[i];
                    let [nx, ny] = found.normal;
                    column[2 * i] += scale * (on[0] * nx + on[1] * ny);
                    if point.corner.is_some() {
                        column[2 * i + 1] += scale * (on[0] * ny - on[1] * nx);
                    }
                }
            }
            let [plus, minus] = &both;
            let write = |row, value| column[row] = value;
            (self.crosses).write_derivatives(
                own,
                &residuals.crosses,
                [plus, minus],
                prior,
                write,
            )?;
            step[k] = 0.0;
        }
        (self.crosses).write_residuals(own, &residuals.crosses, prior, &mut values);
        for (i, (found, factor)) in residuals.found.iter().zip(&factors).enumerate() {
            values[2 * i] = factor * found.distance[0];
            values[2 * i + 1] = factor * found.distance[1];
        }
        for (i, (value, derivative)) in known.iter().enumerate() {
            values[first + i] = -value;
            for (k, d) in derivative {
                matrix[(first + i, *k)] = *d;
            }
        }
        Some((matrix, values))
    }

    /// Residual statistics in three lists: of each edge (the bent ones first), of each traced line of text, and of each
    /// detected line of text.
    pub fn statistics(&self, residuals: &Residuals) -> [Vec<ResidualStatistics>; 3] {
        let mut edges = Vec::new();
        let key = |p: &TracedPoint| (p.page, p.edge);
        let mut start = 0;
        while start < self.points.len() {
            let here = key(&self.points[start]);
            let count = self.points[start..]
                .iter()
                .take_while(|p| key(p) == here)
                .count();
            let own: Vec<f64> = (residuals.found[start..start + count].iter())
                .map(|found| found.distance[0])
                .collect();
            let weight = self.points[start + count / 2].weight;
            edges.push(ResidualStatistics::new(&own, weight * count as f64));
            start += count;
        }
        let [sides, given, found] = self.crosses.statistics(&residuals.crosses);
        edges.extend(sides);
        [edges, given, found]
    }

    /// Covariance of the residuals of neighbouring lines of text, in pixels²; 0 if it is not significant.
    pub fn common(&self, residuals: &Residuals) -> f64 {
        let (product, count) = self.crosses.covariance(&residuals.crosses);
        let [_, given, found] = self.statistics(residuals);
        let Some(pooled) = ResidualStatistics::pooled(&[given, found].concat()) else {
            return 0.0;
        };
        let independent = count / pooled.points_per_error();
        let sure = product > MIN_COVARIANCE_DEVIATIONS * pooled.mean_square / independent.sqrt();
        if sure && independent > MIN_COVARIANCE_POINTS {
            product
        } else {
            0.0
        }
    }

    /// Weighted sum of squares of all residuals, in pixels².
    pub fn squares(&self, residuals: &Residuals) -> f64 {
        let edges: f64 = (self.points.iter().zip(&residuals.found))
            .map(|(p, found)| {
                let [across, along] = found.distance;
                p.weight * (across * across + along * along)
            })
            .sum();
        edges + self.crosses.squares(&residuals.crosses)
    }

    /// Bow (largest distance from the chord) in the photo, in pixels, of each bent edge of the cylinder, and of each
    /// line of text that runs like these. None if the cylinder is not in front of the camera.
    pub fn bows(&self, cylinder: &Cylinder) -> Option<Vec<f64>> {
        let mut bows = [0.0f64; 2];
        for pair in self.edges(cylinder, &cylinder.curve())? {
            for (bow, nodes) in bows.iter_mut().zip(pair) {
                let from = nodes[0];
                let way = difference(nodes[CURVE_PIECES], from);
                for node in nodes {
                    let off = difference(node, from);
                    let across = way[0] * off[1] - way[1] * off[0];
                    *bow = bow.max(across.abs() / way[0].hypot(way[1]));
                }
            }
        }
        let mut bows = bows.to_vec();
        bows.extend(self.crosses.bows());
        Some(bows)
    }

    /// Number of rows that the observations take in the Jacobian.
    pub fn rows(&self) -> usize {
        2 * self.points.len() + self.crosses.rows()
    }

    /// Computes the Jacobian of the weighted residuals by the two coordinates of the principal point.
    pub fn principal_point_jacobian(
        &self,
        cylinder: &Cylinder,
        residuals: &Residuals,
        prior: &Prior,
    ) -> Option<DMatrix<f64>> {
        let mut matrix = DMatrix::zeros(self.rows(), 2);
        for (i, (point, found)) in self.points.iter().zip(&residuals.found).enumerate() {
            let factor = (point.weight * found.trust).sqrt() / prior.accuracy;
            let [nx, ny] = found.normal;
            for (k, (across, along)) in [(nx, ny), (ny, -nx)].into_iter().enumerate() {
                matrix[(2 * i, k)] = factor * across;
                if point.corner.is_some() {
                    matrix[(2 * i + 1, k)] = factor * along;
                }
            }
        }
        let first = 2 * self.points.len();
        (self.crosses).principal_point_jacobian(
            first,
            &residuals.crosses,
            cylinder,
            prior,
            &mut matrix,
        )?;
        Some(matrix)
    }

    /// Number of neighbouring points that share one independent error, from the correlation of their residuals; the
    /// largest over edges and lines of text.
    pub fn points_per_error(&self, residuals: &Residuals) -> f64 {
        // The largest of edges and of lines of text: a short line does not show all of the correlation.
        (self.statistics(residuals).iter())
            .filter_map(|list| ResidualStatistics::pooled(list))
            .map(|pooled| pooled.points_per_error())
            .fold(1.0, f64::max)
    }

    /// Projects the nodes of both bent edges of each page's cylinder to pixels. None if a node is not in front of the
    /// camera.
    fn edges(&self, cylinder: &Cylinder, curve: &SampledCurve) -> Option<Vec<[Vec<[f64; 2]>; 2]>> {
        let edge = |page: usize, down: f64| -> Option<Vec<[f64; 2]>> {
            (0..=CURVE_PIECES)
                .map(|i| cylinder.project(curve.node(page, i), down))
                .collect()
        };
        (0..cylinder.pages.len())
            .map(|page| Some([edge(page, 0.0)?, edge(page, cylinder.length)?]))
            .collect()
    }

    /// Projects a point of the cylinder to pixels: on the edge to which the traced point `point` belongs, at a share of
    /// the page's width. None if it is not in front of the camera.
    fn project(
        &self,
        of: &Cylinder,
        curve: &SampledCurve,
        point: &TracedPoint,
        share: f64,
    ) -> Option<[f64; 2]> {
        of.project(curve.at(point.page, share), point.edge as f64 * of.length)
    }
}

/// The fit of a cylinder to traces, with prior knowledge.
struct CylinderFit<'a> {
    traces: &'a Traces,
    prior: &'a Prior,
}

impl RobustProblem for CylinderFit<'_> {
    type Model = (Cylinder, Residuals);
    type System = (DMatrix<f64>, DVector<f64>);

    fn system(&self, (cylinder, residuals): &Self::Model) -> Option<Self::System> {
        let (matrix, values) = self.traces.jacobian(cylinder, residuals, self.prior)?;
        Some((matrix.tr_mul(&matrix), matrix.tr_mul(&values)))
    }

    fn stepped(
        &self,
        (cylinder, _): &Self::Model,
        (normal, right): &Self::System,
        damping: f64,
    ) -> Option<Self::Model> {
        let mut damped = normal.clone();
        for k in 0..damped.nrows() {
            damped[(k, k)] += damping * (normal[(k, k)] + 1e-9);
        }
        let moved = cylinder.moved(damped.cholesky()?.solve(right).as_slice());
        let residuals = self.traces.residuals(&moved, self.prior)?;
        Some((moved, residuals))
    }

    fn cost(&self, (_, residuals): &Self::Model) -> f64 {
        residuals.cost
    }
}

/// Minimum covariance between the residuals of neighbouring lines of text that counts as significant, in standard
/// deviations of this covariance.
const MIN_COVARIANCE_DEVIATIONS: f64 = 3.0;

/// Minimum number of independent points for the covariance of neighbouring lines' residuals to be significant.
const MIN_COVARIANCE_POINTS: f64 = 8.0;

/// Finds the point of a projected edge that is nearest to the point `at`: returns its share of the page's width, and
/// the number of the edge's piece.
fn nearest(nodes: &[[f64; 2]], at: [f64; 2]) -> (f64, usize) {
    let mut best = (f64::INFINITY, 0.0, 0);
    for (i, w) in nodes.windows(2).enumerate() {
        let (way, off) = (difference(w[1], w[0]), difference(at, w[0]));
        let squared = way[0] * way[0] + way[1] * way[1];
        let t = ((way[0] * off[0] + way[1] * off[1]) / squared).clamp(0.0, 1.0);
        let rest = [off[0] - t * way[0], off[1] - t * way[1]];
        let distance = rest[0] * rest[0] + rest[1] * rest[1];
        if distance < best.0 {
            best = (distance, (i as f64 + t) / CURVE_PIECES as f64, i);
        }
    }
    (best.1, best.2)
}

/// Vector from point `q` to point `p`.
fn difference(p: [f64; 2], q: [f64; 2]) -> [f64; 2] {
    [p[0] - q[0], p[1] - q[1]]
}

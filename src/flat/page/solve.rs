//! The cylinder whose edges are seen nearest to the traces: least squares, by Levenberg and
//! Marquardt.

use nalgebra::{DMatrix, DVector};

use super::cylinder::{Curve, Cylinder, PIECES};
use super::trace::Line;

/// What is known besides the traces, each as a value and its standard deviation.
#[derive(Debug, Clone, Copy)]
pub(super) struct Prior {
    /// Logarithm of the focal length.
    pub focal: Option<[f64; 2]>,
    /// Logarithm of length over width.
    pub ratio: Option<[f64; 2]>,
    /// Standard deviation of a traced point, in pixels.
    pub accuracy: f64,
}

/// A traced point.
#[derive(Debug, Clone, Copy)]
struct Point {
    edge: usize,
    page: usize,
    /// 0 or 1 for the corner at the page's start or end, which has to be met; others only have to
    /// lie on the edge.
    corner: Option<f64>,
    at: [f64; 2],
    weight: f64,
}

/// All traced points.
#[derive(Debug, Clone)]
pub(super) struct Traces {
    points: Vec<Point>,
}

/// How far from the traces a cylinder is seen.
#[derive(Debug, Clone)]
pub(super) struct Residuals {
    /// For each point its share of the page, and the distance, in pixels: across the edge, and for
    /// corners along it, too.
    found: Vec<Found>,
    /// What is minimised.
    pub cost: f64,
}

#[derive(Debug, Clone, Copy)]
struct Found {
    share: f64,
    normal: [f64; 2],
    distance: [f64; 2],
    /// What the weight of an outlier comes down to.
    trust: f64,
}

/// About as many points of each edge are looked at.
const MOST: usize = 300;

/// Most independent points that the errors of one hand, or of one algorithm, are taken for.
const INDEPENDENT: f64 = 60.0;

/// Distances above so many standard deviations count by their size, not by their square (Huber).
const OUTLIER: f64 = 3.0;

/// Standard deviation of a coefficient of the curve's direction, over its degree, in radians.
const TURN: f64 = 1.0;

impl Traces {
    pub fn new(pages: &[[Line; 2]]) -> Self {
        let mut points = Vec::new();
        for (page, pair) in pages.iter().enumerate() {
            for (edge, line) in pair.iter().enumerate() {
                let last = line.points.len() - 1;
                let step = line.points.len().div_ceil(MOST);
                let count = (last / step) as f64;
                let weight = (line.independent.min(INDEPENDENT) / count.max(1.0)).min(1.0);
                for (i, at) in line.points.iter().enumerate() {
                    let corner = match i {
                        0 => Some(0.0),
                        _ if i == last => Some(1.0),
                        _ if i % step == 0 => None,
                        _ => continue,
                    };
                    points.push(Point {
                        edge,
                        page,
                        corner,
                        at: *at,
                        weight: if corner.is_some() { 1.0 } else { weight },
                    });
                }
            }
        }
        Traces { points }
    }

    /// How many distances count, by their weights.
    pub fn count(&self) -> f64 {
        let own = |p: &Point| p.weight * if p.corner.is_some() { 2.0 } else { 1.0 };
        self.points.iter().map(own).sum()
    }

    /// Distances of a cylinder from the traces; none if part of it is not in front of the camera.
    pub fn residuals(&self, cylinder: &Cylinder, prior: &Prior) -> Option<Residuals> {
        let curve = cylinder.curve();
        let edges = self.edges(cylinder, &curve)?;
        let mut found = Vec::with_capacity(self.points.len());
        let mut cost = 0.0;
        for point in &self.points {
            let nodes = &edges[point.page][point.edge];
            let (share, piece) = match point.corner {
                Some(end) => (end, if end > 0.0 { PIECES - 1 } else { 0 }),
                None => nearest(nodes, point.at),
            };
            let on = match point.corner {
                Some(end) => nodes[if end > 0.0 { PIECES } else { 0 }],
                None => self.seen(cylinder, &curve, point, share)?,
            };
            let way = sub(nodes[piece + 1], nodes[piece]);
            let length = way[0].hypot(way[1]);
            if !(length > 0.0 && length.is_finite()) {
                return None;
            }
            let normal = [-way[1] / length, way[0] / length];
            let off = sub(point.at, on);
            let across = off[0] * normal[0] + off[1] * normal[1];
            let along = match point.corner {
                Some(_) => off[0] * normal[1] - off[1] * normal[0],
                None => 0.0,
            };
            let size = across.hypot(along) / prior.accuracy;
            let trust = if size > OUTLIER { OUTLIER / size } else { 1.0 };
            cost += point.weight
                * if size > OUTLIER {
                    OUTLIER * (2.0 * size - OUTLIER)
                } else {
                    size * size
                };
            found.push(Found {
                share,
                normal,
                distance: [across, along],
                trust,
            });
        }
        cost += prior_rows(cylinder, prior)
            .iter()
            .map(|(value, _)| value * value)
            .sum::<f64>();
        cost.is_finite().then_some(Residuals { found, cost })
    }

    /// Derivatives of the weighted distances by the parameters, and these distances; the rows of
    /// what is known besides come last. Nearest points may be held, for moving along the edge
    /// changes no distance.
    pub fn jacobian(
        &self,
        cylinder: &Cylinder,
        residuals: &Residuals,
        prior: &Prior,
    ) -> Option<(DMatrix<f64>, DVector<f64>)> {
        let parameters = cylinder.parameters();
        let known = prior_rows(cylinder, prior);
        let rows = 2 * self.points.len() + known.len();
        let mut matrix = DMatrix::zeros(rows, parameters);
        let mut values = DVector::zeros(rows);
        let factors: Vec<f64> = (self.points.iter().zip(&residuals.found))
            .map(|(p, found)| (p.weight * found.trust).sqrt() / prior.accuracy)
            .collect();
        let mut step = vec![0.0; parameters];
        for k in 0..parameters {
            let mut column = matrix.column_mut(k);
            for sign in [1.0, -1.0] {
                step[k] = sign * STEP;
                let moved = cylinder.moved(&step);
                let curve = moved.curve();
                for (i, (point, found)) in self.points.iter().zip(&residuals.found).enumerate() {
                    let on = self.seen(&moved, &curve, point, found.share)?;
                    let scale = sign / (2.0 * STEP) * factors[i];
                    let [nx, ny] = found.normal;
                    column[2 * i] += scale * (on[0] * nx + on[1] * ny);
                    if point.corner.is_some() {
                        column[2 * i + 1] += scale * (on[0] * ny - on[1] * nx);
                    }
                }
            }
            step[k] = 0.0;
        }
        for (i, (found, factor)) in residuals.found.iter().zip(&factors).enumerate() {
            values[2 * i] = factor * found.distance[0];
            values[2 * i + 1] = factor * found.distance[1];
        }
        for (i, (value, derivative)) in known.iter().enumerate() {
            values[2 * self.points.len() + i] = -value;
            for (k, d) in derivative {
                matrix[(2 * self.points.len() + i, *k)] = *d;
            }
        }
        Some((matrix, values))
    }

    /// The least-squares cylinder nearby, and its residuals.
    pub fn solve(&self, start: Cylinder, prior: &Prior) -> Option<(Cylinder, Residuals)> {
        let mut best = start;
        let mut residuals = self.residuals(&best, prior)?;
        let mut damping = 1e-3;
        for _ in 0..ITERATIONS {
            let (matrix, values) = self.jacobian(&best, &residuals, prior)?;
            let normal = matrix.tr_mul(&matrix);
            let right = matrix.tr_mul(&values);
            let mut better = None;
            while damping < 1e10 {
                let mut damped = normal.clone();
                for k in 0..damped.nrows() {
                    damped[(k, k)] += damping * (normal[(k, k)] + 1e-9);
                }
                let step = damped.cholesky()?.solve(&right);
                let moved = best.moved(step.as_slice());
                match self.residuals(&moved, prior) {
                    Some(found) if found.cost < residuals.cost => {
                        better = Some((moved, found));
                        damping = (damping * 0.2).max(1e-12);
                        break;
                    }
                    _ => damping *= 4.0,
                }
            }
            let Some((moved, found)) = better else { break };
            let gain = residuals.cost - found.cost;
            (best, residuals) = (moved, found);
            if gain < 1e-3 * (1e-3 + residuals.cost.min(1.0)) {
                break;
            }
        }
        Some((best, residuals))
    }

    /// Mean squares of the distances across the edges, in pixels², by page and edge: all of it, and
    /// what does not change from one point to the next, which no noise of single points explains.
    pub fn misfit(&self, residuals: &Residuals) -> Vec<[f64; 2]> {
        let mut out = Vec::new();
        let key = |p: &Point| (p.page, p.edge);
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
            let all = own.iter().map(|d| d * d).sum::<f64>() / count as f64;
            // Of white noise, one independent point has no correlation with the next.
            let weight = self.points[start + count / 2].weight;
            let lag = ((1.0 / weight).round() as usize).clamp(1, count - 1);
            let both: f64 = own.iter().zip(&own[lag..]).map(|(d, e)| d * e).sum();
            let smooth = (both / (count - lag) as f64).clamp(0.0, all);
            // A correlation that as many points of white noise have, too, is none.
            let chance = 2.5 / (count as f64 / lag as f64).sqrt();
            let smooth = if smooth > chance * all { smooth } else { 0.0 };
            out.push([all, smooth]);
            start += count;
        }
        out
    }

    /// The weighted sum of squares of the distances, in pixels².
    pub fn squares(&self, residuals: &Residuals) -> f64 {
        (self.points.iter().zip(&residuals.found))
            .map(|(p, found)| {
                let [across, along] = found.distance;
                p.weight * (across * across + along * along)
            })
            .sum()
    }

    /// How far from straight the edges are seen, in pixels: each edge's farthest point.
    pub fn bows(&self, cylinder: &Cylinder) -> Option<[f64; 2]> {
        let mut bows = [0.0f64; 2];
        for pair in self.edges(cylinder, &cylinder.curve())? {
            for (bow, nodes) in bows.iter_mut().zip(pair) {
                let from = nodes[0];
                let way = sub(nodes[PIECES], from);
                for node in nodes {
                    let off = sub(node, from);
                    let across = way[0] * off[1] - way[1] * off[0];
                    *bow = bow.max(across.abs() / way[0].hypot(way[1]));
                }
            }
        }
        Some(bows)
    }

    /// Rows of the traces in the matrix of derivatives.
    pub fn rows(&self) -> usize {
        2 * self.points.len()
    }

    /// Derivatives of the weighted distances by the principal point.
    pub fn shifted(&self, residuals: &Residuals, prior: &Prior) -> DMatrix<f64> {
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
        matrix
    }

    /// How many neighbouring points have one error in common, from the correlation of their
    /// distances.
    pub fn correlation(&self, residuals: &Residuals) -> f64 {
        let found = self.misfit(residuals);
        let [all, smooth] = [0, 1].map(|k| found.iter().map(|edge| edge[k]).sum::<f64>());
        let share = (smooth / all.max(1e-12)).min(0.9);
        (1.0 + share) / (1.0 - share)
    }

    fn edges(&self, cylinder: &Cylinder, curve: &Curve) -> Option<Vec<[Vec<[f64; 2]>; 2]>> {
        let edge = |page: usize, down: f64| -> Option<Vec<[f64; 2]>> {
            (0..=PIECES)
                .map(|i| cylinder.seen(curve.node(page, i), down))
                .collect()
        };
        (0..cylinder.pages.len())
            .map(|page| Some([edge(page, 0.0)?, edge(page, cylinder.length)?]))
            .collect()
    }

    fn seen(&self, of: &Cylinder, curve: &Curve, point: &Point, share: f64) -> Option<[f64; 2]> {
        of.seen(curve.at(point.page, share), point.edge as f64 * of.length)
    }
}

/// Half the step of central differences.
const STEP: f64 = 1e-5;

const ITERATIONS: usize = 40;

/// What is known besides the traces: how far off it is, over its standard deviation, and the
/// derivatives of that.
fn prior_rows(cylinder: &Cylinder, prior: &Prior) -> Vec<(f64, Vec<(usize, f64)>)> {
    let mut rows = Vec::new();
    if let Some([value, deviation]) = prior.focal {
        rows.push((
            (cylinder.focal.ln() - value) / deviation,
            vec![(0, 1.0 / deviation)],
        ));
    }
    if let Some([value, deviation]) = prior.ratio {
        let mut at = 8 + cylinder.degree();
        // All pages of a spread are alike.
        for page in &cylinder.pages[1..] {
            rows.push((page.width.ln() / deviation, vec![(at, 1.0 / deviation)]));
            at += page.turns.len() + 1;
        }
        let off = (cylinder.length.ln() - value) / deviation;
        rows.push((off, vec![(7, 1.0 / deviation)]));
    }
    let mut at = 8;
    for (number, page) in cylinder.pages.iter().enumerate() {
        // All but the first have a width and a mean.
        at += if number > 0 { 2 } else { 0 };
        for (k, turn) in page.turns.iter().enumerate().skip(1) {
            let scale = k as f64 / TURN;
            rows.push((turn * scale, vec![(at, scale)]));
            at += 1;
        }
    }
    rows
}

/// The share of the page at the nearest point of an edge, and the piece it lies on.
fn nearest(nodes: &[[f64; 2]], at: [f64; 2]) -> (f64, usize) {
    let mut best = (f64::INFINITY, 0.0, 0);
    for (i, w) in nodes.windows(2).enumerate() {
        let (way, off) = (sub(w[1], w[0]), sub(at, w[0]));
        let squared = way[0] * way[0] + way[1] * way[1];
        let t = ((way[0] * off[0] + way[1] * off[1]) / squared).clamp(0.0, 1.0);
        let rest = [off[0] - t * way[0], off[1] - t * way[1]];
        let distance = rest[0] * rest[0] + rest[1] * rest[1];
        if distance < best.0 {
            best = (distance, (i as f64 + t) / PIECES as f64, i);
        }
    }
    (best.1, best.2)
}

fn sub(p: [f64; 2], q: [f64; 2]) -> [f64; 2] {
    [p[0] - q[0], p[1] - q[1]]
}

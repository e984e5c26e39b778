//! The cylinder whose edges are seen nearest to the traces: least squares, by Levenberg and
//! Marquardt.

use nalgebra::{DMatrix, DVector};

use super::cross::{Crosses, Off};
use super::cylinder::{Curve, Cylinder, DIFFERENCE_STEP, PIECES};
use super::huber::{huber_cost, huber_weight};
use super::line::Traced;
use super::misfit::Misfit;
use super::prior::{Prior, prior_rows};
use crate::error::Result;

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
    crosses: Crosses,
}

/// How far from the traces a cylinder is seen.
#[derive(Debug, Clone)]
pub(super) struct Residuals {
    /// For each point its share of the page, and the distance, in pixels: across the edge, and for
    /// corners along it, too.
    found: Vec<Found>,
    crosses: Vec<Off>,
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

impl Traces {
    /// # Errors
    /// [`Error::Edges`](crate::Error::Edges) for lines of text beside their page.
    pub fn new(pages: &[Traced], sideways: bool) -> Result<Self> {
        let mut points = Vec::new();
        for (page, traced) in pages.iter().enumerate() {
            for (edge, line) in traced.pair.iter().enumerate() {
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
        let crosses = Crosses::new(pages, sideways)?;
        Ok(Traces { points, crosses })
    }

    /// How many lines of text there are.
    pub fn text(&self) -> usize {
        self.crosses.text
    }

    /// How many distances count, by their weights.
    pub fn count(&self) -> f64 {
        let own = |p: &Point| p.weight * if p.corner.is_some() { 2.0 } else { 1.0 };
        self.points.iter().map(own).sum::<f64>() + self.crosses.count()
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
            let trust = huber_weight(size);
            cost += point.weight * huber_cost(size);
            found.push(Found {
                share,
                normal,
                distance: [across, along],
                trust,
            });
        }
        let (crosses, of_crosses) = self.crosses.distances(cylinder, prior)?;
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
                    let on = self.seen(moved, &curve, point, found.share)?;
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
            (self.crosses).column(own, &residuals.crosses, [plus, minus], prior, write)?;
            step[k] = 0.0;
        }
        (self.crosses).values(own, &residuals.crosses, prior, &mut values);
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

    /// How the distances are spread along each of the edges, the bent ones first, along each line of text that
    /// was given, and along each that was found.
    pub fn misfits(&self, residuals: &Residuals) -> [Vec<Misfit>; 3] {
        let mut edges = Vec::new();
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
            let weight = self.points[start + count / 2].weight;
            edges.push(Misfit::new(&own, weight * count as f64));
            start += count;
        }
        let [sides, given, found] = self.crosses.misfits(&residuals.crosses);
        edges.extend(sides);
        [edges, given, found]
    }

    /// What neighbouring lines of text have in common of their distances, as a mean square in pixels²: that
    /// of errors of tracing them is not certain to be above 0.
    pub fn common(&self, residuals: &Residuals) -> f64 {
        let (product, count) = self.crosses.common(&residuals.crosses);
        let [_, given, found] = self.misfits(residuals);
        let Some(all) = Misfit::together(&[given, found].concat()) else {
            return 0.0;
        };
        let independent = count / all.correlation();
        let sure = product > 3.0 * all.all / independent.sqrt();
        if sure && independent > 8.0 {
            product
        } else {
            0.0
        }
    }

    /// The weighted sum of squares of the distances, in pixels².
    pub fn squares(&self, residuals: &Residuals) -> f64 {
        let edges: f64 = (self.points.iter().zip(&residuals.found))
            .map(|(p, found)| {
                let [across, along] = found.distance;
                p.weight * (across * across + along * along)
            })
            .sum();
        edges + self.crosses.squares(&residuals.crosses)
    }

    /// How far from straight both edges and the lines of text are seen, in pixels, as far as these run
    /// like the edges: by the farthest point of each.
    pub fn bows(&self, cylinder: &Cylinder) -> Option<Vec<f64>> {
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
        let mut bows = bows.to_vec();
        bows.extend(self.crosses.bows());
        Some(bows)
    }

    /// Rows of the traces in the matrix of derivatives.
    pub fn rows(&self) -> usize {
        2 * self.points.len() + self.crosses.rows()
    }

    /// Derivatives of the weighted distances by the principal point.
    pub fn shifted(
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
        (self.crosses).shifted(first, &residuals.crosses, cylinder, prior, &mut matrix)?;
        Some(matrix)
    }

    /// How many neighbouring points have one error in common, from the correlation of their
    /// distances.
    pub fn correlation(&self, residuals: &Residuals) -> f64 {
        // By the edges, or by the lines of text: a short line does not show all of it.
        (self.misfits(residuals).iter())
            .filter_map(|list| Misfit::together(list))
            .map(|all| all.correlation())
            .fold(1.0, f64::max)
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

const ITERATIONS: usize = 40;

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

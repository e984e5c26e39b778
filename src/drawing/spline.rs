//! Fits smooth curves to many points: uniform cubic B-splines by least squares, with as few spans as possible.

use nalgebra::{DMatrix, DVector};

use super::curve::Curve;
use crate::unroll::flat_triangle::Point;

/// A fitted curve, with the maximum and the root mean square distance of the given points from it.
pub(super) struct Fit {
    pub curve: Curve,
    pub most: f64,
    pub rms: f64,
}

/// Number of times that a spline fit moves the curve parameter of each point to that of the nearest point of the
/// spline.
const REPARAMETRISATION_PASSES: usize = 3;

/// Minimum factor by which a spline with more spans must reduce the root mean square distance from the points to be
/// preferred.
const MIN_IMPROVEMENT_FACTOR: f64 = 3.0;

/// Fits the spline with the fewest spans to points, each given with its distance along the line. It interpolates
/// the first and the last point; a closed line repeats its first point at the end. `None` if spans would have to be
/// shorter than `shortest`.
///
/// A fit with a root mean square distance below `exact` is accepted as exact. The spline is twice continuously
/// differentiable, so it has no kinks between spans; least squares removes noise that an interpolation would
/// follow.
pub(super) fn fit_spline(
    points: &[(f64, Point)],
    closed: bool,
    tolerance: f64,
    exact: f64,
    shortest: f64,
) -> Option<Curve> {
    let (first, last) = (points.first()?, points.last()?);
    let long = last.0 - first.0;
    let most = ((long / shortest) as usize).min(points.len() / 2);
    let mut spans = if closed { 4 } else { 1 };
    let mut found = (!closed).then(|| straight(points));
    while spans <= most {
        let next = Spline::fit(points, closed, spans);
        if let (Some(fit), Some(next)) = (&found, &next) {
            let better = next.most <= tolerance && next.rms < fit.rms / MIN_IMPROVEMENT_FACTOR;
            let enough = fit.rms <= exact || !better;
            if fit.most <= tolerance && enough {
                break;
            }
        }
        found = next.or(found);
        spans += spans.div_ceil(3);
    }
    found
        .filter(|fit| fit.most <= tolerance)
        .map(|fit| fit.curve)
}

fn straight(points: &[(f64, Point)]) -> Fit {
    let (from, to) = (points[0].1, points[points.len() - 1].1);
    let along = (to - from) / (to - from).norm().max(f64::MIN_POSITIVE);
    let away = points.iter().map(|(_, p)| (along.conj() * (p - from)).im);
    Fit::new(Curve::through(&[[from.re, from.im], [to.re, to.im]]), away)
}

impl Fit {
    fn new(curve: Curve, away: impl Iterator<Item = f64>) -> Self {
        let (mut most, mut sum, mut count) = (0.0f64, 0.0, 0.0);
        for d in away {
            most = most.max(d.abs());
            sum += d * d;
            count += 1.0;
        }
        Fit {
            curve,
            most,
            rms: f64::sqrt(sum / f64::max(count, 1.0)),
        }
    }
}

/// Uniform cubic B-spline with control points d₀, d₁, …; span `s` depends on the four control points from `s` on.
struct Spline {
    controls: Vec<Point>,
    spans: usize,
}

/// Computes the weights of the four control points of a spline's span at a parameter, and the derivatives of these
/// weights.
fn weights(t: f64) -> ([f64; 4], [f64; 4]) {
    let s = 1.0 - t;
    let b = [
        s * s * s / 6.0,
        (3.0 * t * t * t - 6.0 * t * t + 4.0) / 6.0,
        (3.0 * s * s * s - 6.0 * s * s + 4.0) / 6.0,
        t * t * t / 6.0,
    ];
    let d = [
        -0.5 * s * s,
        1.5 * t * t - 2.0 * t,
        -1.5 * s * s + 2.0 * s,
        0.5 * t * t,
    ];
    (b, d)
}

impl Spline {
    fn fit(points: &[(f64, Point)], closed: bool, spans: usize) -> Option<Fit> {
        let (first, last) = (points[0], points[points.len() - 1]);
        let long = last.0 - first.0;
        let scale = spans as f64 / long;
        let mut at: Vec<f64> = points.iter().map(|(s, _)| scale * (s - first.0)).collect();
        let mut spline = Spline::least_squares(points, &at, closed, spans)?;
        for _ in 0..REPARAMETRISATION_PASSES {
            for (u, (_, point)) in at.iter_mut().zip(points) {
                *u = spline.nearer(*u, *point);
            }
            spline = Spline::least_squares(points, &at, closed, spans)?;
        }
        let away = at.iter().zip(points).map(|(u, (_, point))| {
            let u = spline.nearer(*u, *point);
            (spline.at(u).0 - point).norm()
        });
        Some(Fit::new(spline.beziers(), away))
    }

    /// Returns the number of the span at a curve parameter, and the parameter within that span, from 0 to 1.
    fn span(&self, u: f64) -> (usize, f64) {
        let span = (u.max(0.0) as usize).min(self.spans - 1);
        (span, (u - span as f64).clamp(0.0, 1.0))
    }

    fn at(&self, u: f64) -> (Point, Point) {
        let (span, t) = self.span(u);
        let (b, d) = weights(t);
        let sum = |w: [f64; 4]| (0..4).map(|k| self.controls[span + k] * w[k]).sum();
        (sum(b), sum(d))
    }

    /// Makes one Gauss-Newton step from a curve parameter towards the parameter of the spline's point nearest to a
    /// given point.
    fn nearer(&self, u: f64, point: Point) -> f64 {
        let (place, slope) = self.at(u);
        let square = slope.norm_sqr();
        if square == 0.0 {
            return u;
        }
        let step = (slope.conj() * (point - place)).re / square;
        (u + step.clamp(-0.5, 0.5)).clamp(0.0, self.spans as f64)
    }

    fn least_squares(
        points: &[(f64, Point)],
        at: &[f64],
        closed: bool,
        spans: usize,
    ) -> Option<Spline> {
        // An open spline interpolates its ends, which determines its outermost control points, so `spans + 1` inner
        // ones are unknown. The control points of a closed spline are periodic.
        let unknowns = if closed { spans } else { spans + 1 };
        let ends = [points[0].1, points[points.len() - 1].1];
        let empty = Spline {
            controls: Vec::new(),
            spans,
        };
        let mut matrix = DMatrix::<f64>::zeros(unknowns, unknowns);
        let mut sides = [DVector::<f64>::zeros(unknowns), DVector::zeros(unknowns)];
        for (u, (_, point)) in at.iter().zip(points) {
            let (span, t) = empty.span(*u);
            let (b, _) = weights(t);
            let mut rest = *point;
            let mut row: Vec<(usize, f64)> = Vec::with_capacity(8);
            for (k, b) in b.into_iter().enumerate() {
                match span + k {
                    i if closed => row.push((i % spans, b)),
                    // d₀ = 6p − 4d₁ − d₂, and likewise at the other end.
                    0 => {
                        rest -= ends[0] * (6.0 * b);
                        row.extend([(0, -4.0 * b), (1, -b)]);
                    }
                    i if i == spans + 2 => {
                        rest -= ends[1] * (6.0 * b);
                        row.extend([(spans, -4.0 * b), (spans - 1, -b)]);
                    }
                    i => row.push((i - 1, b)),
                }
            }
            for (i, a) in &row {
                sides[0][*i] += a * rest.re;
                sides[1][*i] += a * rest.im;
                for (j, b) in &row {
                    matrix[(*i, *j)] += a * b;
                }
            }
        }
        let factor = matrix.cholesky()?;
        let [x, y] = sides.map(|side| factor.solve(&side));
        let inner: Vec<Point> = x
            .iter()
            .zip(y.iter())
            .map(|(x, y)| Point::new(*x, *y))
            .collect();
        let controls = match closed {
            true => (0..spans + 3).map(|i| inner[i % spans]).collect(),
            false => {
                let before = ends[0] * 6.0 - inner[0] * 4.0 - inner[1];
                let after = ends[1] * 6.0 - inner[spans] * 4.0 - inner[spans - 1];
                [&[before], &inner[..], &[after]].concat()
            }
        };
        let finite = controls
            .iter()
            .all(|c| c.re.is_finite() && c.im.is_finite());
        finite.then_some(Spline { controls, spans })
    }

    fn beziers(&self) -> Curve {
        let pair = |p: Point| [p.re, p.im];
        let d = &self.controls;
        let joint = |i: usize| (d[i] + d[i + 1] * 4.0 + d[i + 2]) / 6.0;
        let mut controls = vec![pair(joint(0))];
        for i in 0..self.spans {
            let inner = [
                (d[i + 1] * 2.0 + d[i + 2]) / 3.0,
                (d[i + 1] + d[i + 2] * 2.0) / 3.0,
            ];
            controls.extend([pair(inner[0]), pair(inner[1]), pair(joint(i + 1))]);
        }
        Curve::of(controls)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn along(places: impl Iterator<Item = Point>) -> Vec<(f64, Point)> {
        let mut gone = 0.0;
        let mut out: Vec<(f64, Point)> = Vec::new();
        for place in places {
            gone += out.last().map_or(0.0, |(_, p)| (place - p).norm());
            out.push((gone, place));
        }
        out
    }

    /// A part of a circle of radius 40 about the origin, waved by a third in and out.
    fn wavy(turn: f64) -> Vec<(f64, Point)> {
        along((0..=400).map(|i| {
            let angle = turn * f64::from(i) / 400.0;
            // None of it at the ends.
            Point::from_polar(
                40.0 + 0.3 * (31.0 * std::f64::consts::PI * f64::from(i) / 400.0).sin(),
                angle,
            )
        }))
    }

    #[test]
    fn waves_are_taken_out_of_an_arc() {
        let curve = fit_spline(&wavy(1.5), false, 0.5, 0.03, 1.5).unwrap();
        assert!(curve.pieces().count() <= 2, "{curve:?}");
        let away = |p: &[f64; 2]| (p[0].hypot(p[1]) - 40.0).abs();
        let worst = curve.points(0.01).iter().map(away).fold(0.0, f64::max);
        assert!(worst < 0.1, "{worst}");
    }

    #[test]
    fn a_closed_line_has_no_kink() {
        let circle = wavy(std::f64::consts::TAU);
        let curve = fit_spline(&circle, true, 0.5, 0.03, 1.5).unwrap();
        let c = curve.controls();
        assert_eq!(c[0], c[c.len() - 1]);
        let away = |p: &[f64; 2]| (p[0].hypot(p[1]) - 40.0).abs();
        let worst = curve.points(0.01).iter().map(away).fold(0.0, f64::max);
        assert!(worst < 0.2, "{worst}");
        for i in (0..c.len() - 1).step_by(3) {
            let before = if i == 0 { c[c.len() - 2] } else { c[i - 1] };
            let [u, v] =
                [[before, c[i]], [c[i], c[i + 1]]].map(|[p, q]| [q[0] - p[0], q[1] - p[1]]);
            assert!((u[0] - v[0]).hypot(u[1] - v[1]) < 1e-9, "{u:?} {v:?}");
        }
    }

    #[test]
    fn waves_wider_than_the_tolerance_are_kept() {
        let wave = along((0..=400).map(|i| {
            let x = 0.25 * f64::from(i);
            Point::new(x, 3.0 * (0.2 * x).sin())
        }));
        let curve = fit_spline(&wave, false, 0.1, 0.03, 1.5).unwrap();
        for [x, y] in curve.points(0.01) {
            assert!((y - 3.0 * (0.2 * x).sin()).abs() < 0.15, "{x} {y}");
        }
        assert!(fit_spline(&wave, false, 1e-9, 0.0, 20.0).is_none());
    }
}

//! Smooth curves through lines of short straight pieces: straight lines and cubic Bézier curves between corners.
//!
//! A piece between two corners is fitted by one cubic curve with the line's directions at its ends, by least squares, and divided
//! where that is off by more than the tolerance (Schneider, *An Algorithm for Automatically Fitting Digitized Curves*, 1990).

use super::curve::{Curve, MIN_CORNER_TURN};
use crate::math::planar::{Point2, distance_to_segment};
use crate::math::simplify::simplify_polyline;

/// Share of the tolerance within which a line is simplified before curves are fitted to it.
const MAX_SIMPLIFICATION_SHARE: f64 = 0.25;

/// Number of parts of each straight piece at whose ends a curve's distance from it is measured.
const MEASURED_PARTS: u32 = 8;

/// Number of times that the parameters of points on a fitted curve are moved to the nearest points of the curve.
const REPARAMETRISATION_PASSES: usize = 3;

/// Creates a curve within a tolerance of a line; a closed line repeats its first point at the end. Corners stay where they are.
pub(super) fn curve_through(line: &[[f64; 2]], tolerance: f64) -> Curve {
    let points: Vec<Point2> = line.iter().map(|[x, y]| Point2::new(*x, *y)).collect();
    // Points close to each other would say little about the directions at corners and ends.
    let mut points = simplify_polyline(&points, MAX_SIMPLIFICATION_SHARE * tolerance);
    points.dedup();
    let last = points.len() - 1;
    if last == 0 {
        return Curve::through(line);
    }
    let is_closed = last > 2 && points[0] == points[last];
    let mut corners: Vec<usize> = (1..last)
        .filter(|i| turn(points[i - 1], points[*i], points[i + 1]) > MIN_CORNER_TURN)
        .collect();
    let is_smooth_at_start =
        is_closed && turn(points[last - 1], points[0], points[1]) <= MIN_CORNER_TURN;
    if is_smooth_at_start && let Some(first) = corners.first().copied() {
        // Begin at a corner.
        points.pop();
        points.rotate_left(first);
        points.push(points[0]);
        corners = corners.iter().map(|i| i - first).skip(1).collect();
    }
    let ends: Vec<usize> = [0].into_iter().chain(corners).chain([last]).collect();
    // A closed line without a corner has one direction at its beginning and end.
    let around = (is_smooth_at_start && ends.len() == 2)
        .then(|| heading(points[last - 1], points[0], points[1]));
    let mut curve = Curve::through(&[[points[0].re, points[0].im]]);
    for pair in ends.windows(2) {
        let section = &points[pair[0]..=pair[1]];
        let count = section.len();
        let headings = [
            around
                .unwrap_or_else(|| end_heading(section[0], section[1], section[2.min(count - 1)])),
            around.unwrap_or_else(|| {
                -end_heading(
                    section[count - 1],
                    section[count - 2],
                    section[count.max(3) - 3],
                )
            }),
        ];
        fit(&divided(section), headings, tolerance, &mut curve);
    }
    curve
}

/// The points of a line, and others between them: where its pieces are long, a curve may be far from them though it is near their ends.
fn divided(points: &[Point2]) -> Vec<Point2> {
    let share = |part: u32| f64::from(part) / f64::from(MEASURED_PARTS);
    let pieces = points.windows(2);
    let inner =
        pieces.flat_map(|p| (0..MEASURED_PARTS).map(move |k| p[0] + (p[1] - p[0]) * share(k)));
    inner.chain(points.last().copied()).collect()
}

/// Angle by which a line turns at the second of three points, in radians.
fn turn(before: Point2, here: Point2, after: Point2) -> f64 {
    ((here - before).conj() * (after - here)).arg().abs()
}

fn unit(along: Point2) -> Point2 {
    along / along.norm().max(f64::MIN_POSITIVE)
}

/// Direction at its second point of the circle through three points of a line.
fn heading(before: Point2, here: Point2, after: Point2) -> Point2 {
    let (a, b) = (here - before, after - here);
    unit(a / a.norm_sqr() + b / b.norm_sqr())
}

/// Direction at its first point of the circle through three points of a line.
fn end_heading(first: Point2, second: Point2, third: Point2) -> Point2 {
    let (a, b) = (unit(second - first), unit(third - second));
    // The chord's direction is turned back by half of the angle from the middle of one chord to that of the next.
    let share = (second - first).norm() / ((second - first).norm() + (third - second).norm());
    let back = (a.conj() * b).arg() * share;
    a * Point2::from_polar(1.0, -back)
}

/// Adds curves along points to a curve, with given directions at both ends.
fn fit(points: &[Point2], headings: [Point2; 2], tolerance: f64, curve: &mut Curve) {
    let (from, to) = (points[0], points[points.len() - 1]);
    let is_near = |p: &Point2| distance_to_segment(*p, [from, to]) <= tolerance;
    if points.iter().all(is_near) {
        curve.line_to([to.re, to.im]);
        return;
    }
    let (controls, worst) = cubic(points, headings);
    if worst.1 <= tolerance {
        curve.bezier_to([controls[1], controls[2], controls[3]].map(|p| [p.re, p.im]));
        return;
    }
    let middle = worst.0.clamp(1, points.len() - 2);
    let heading = heading(points[middle - 1], points[middle], points[middle + 1]);
    fit(&points[..=middle], [headings[0], heading], tolerance, curve);
    fit(&points[middle..], [heading, headings[1]], tolerance, curve);
}

/// Fits a cubic Bézier curve with given directions at its ends. Returns its control points, and the number of the point that is farthest
/// from it, with its distance.
fn cubic(points: &[Point2], headings: [Point2; 2]) -> ([Point2; 4], (usize, f64)) {
    let (from, to) = (points[0], points[points.len() - 1]);
    let mut along = vec![0.0];
    for pair in points.windows(2) {
        along.push(along[along.len() - 1] + (pair[1] - pair[0]).norm());
    }
    let length = along[along.len() - 1];
    let mut at: Vec<f64> = along.iter().map(|s| s / length).collect();
    let mut controls = [from; 4];
    for _ in 0..REPARAMETRISATION_PASSES {
        let arms = arms(points, &at, headings)
            .filter(|arms| arms.iter().all(|arm| (0.0..length).contains(arm)));
        let [first, second] = arms.unwrap_or([length / 3.0; 2]);
        controls = [
            from,
            from + headings[0] * first,
            to - headings[1] * second,
            to,
        ];
        for (t, point) in at.iter_mut().zip(points) {
            let (place, slope) = value(&controls, *t);
            let step =
                (slope.conj() * (point - place)).re / slope.norm_sqr().max(f64::MIN_POSITIVE);
            *t = (*t + step).clamp(0.0, 1.0);
        }
    }
    let away = at
        .iter()
        .zip(points)
        .map(|(t, p)| (value(&controls, *t).0 - p).norm());
    let worst = away.enumerate().max_by(|a, b| a.1.total_cmp(&b.1));
    (controls, worst.unwrap_or_default())
}

/// Least-squares lengths of the arms from the ends of a curve to its inner control points.
fn arms(points: &[Point2], at: &[f64], headings: [Point2; 2]) -> Option<[f64; 2]> {
    let (from, to) = (points[0], points[points.len() - 1]);
    let dot = |a: Point2, b: Point2| (a.conj() * b).re;
    let (mut squares, mut products) = ([0.0; 3], [0.0; 2]);
    for (t, point) in at.iter().zip(points) {
        let s = 1.0 - t;
        let [b0, b1, b2, b3] = [s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t];
        let (first, second) = (headings[0] * b1, headings[1] * -b2);
        let rest = point - from * (b0 + b1) - to * (b2 + b3);
        squares[0] += dot(first, first);
        squares[1] += dot(first, second);
        squares[2] += dot(second, second);
        products[0] += dot(first, rest);
        products[1] += dot(second, rest);
    }
    let determinant = squares[0] * squares[2] - squares[1] * squares[1];
    (determinant > 1e-12 * squares[0] * squares[2]).then(|| {
        [
            (products[0] * squares[2] - products[1] * squares[1]) / determinant,
            (products[1] * squares[0] - products[0] * squares[1]) / determinant,
        ]
    })
}

/// Point of a cubic Bézier curve at a parameter, and its derivative.
fn value(controls: &[Point2; 4], t: f64) -> (Point2, Point2) {
    let s = 1.0 - t;
    let [a, b, c, d] = *controls;
    (
        a * (s * s * s) + b * (3.0 * s * s * t) + c * (3.0 * s * t * t) + d * (t * t * t),
        ((b - a) * (s * s) + (c - b) * (2.0 * s * t) + (d - c) * (t * t)) * 3.0,
    )
}

#[cfg(test)]
mod tests {
    use super::super::curve::Piece;
    use super::*;

    fn sampled(count: u32, at: impl Fn(f64) -> [f64; 2]) -> Vec<[f64; 2]> {
        (0..=count)
            .map(|i| at(f64::from(i) / f64::from(count)))
            .collect()
    }

    #[test]
    fn a_closed_line_has_no_kink() {
        let mut circle = sampled(90, |t| {
            let (sin, cos) = (std::f64::consts::TAU * t).sin_cos();
            [40.0 * cos, 40.0 * sin]
        });
        circle[90] = circle[0];
        let curve = curve_through(&circle, 0.05);
        let c = curve.controls();
        assert_eq!(c[0], c[c.len() - 1]);
        assert!(c.len() < 30, "{}", c.len());
        let away = |p: &[f64; 2]| (p[0].hypot(p[1]) - 40.0).abs();
        let worst = curve.points(0.001).iter().map(away).fold(0.0, f64::max);
        assert!(worst < 0.06, "{worst}");
        for i in (0..c.len() - 1).step_by(3) {
            let before = if i == 0 { c[c.len() - 2] } else { c[i - 1] };
            let turn = turn(
                Point2::new(before[0], before[1]),
                Point2::new(c[i][0], c[i][1]),
                Point2::new(c[i + 1][0], c[i + 1][1]),
            );
            assert!(turn < 1e-9, "{turn}");
        }
    }

    #[test]
    fn waves_are_kept_within_the_tolerance() {
        let wave = sampled(400, |t| [100.0 * t, 3.0 * (20.0 * t).sin()]);
        let curve = curve_through(&wave, 0.1);
        assert!(curve.pieces().count() < 30, "{}", curve.pieces().count());
        for [x, y] in curve.points(0.01) {
            assert!((y - 3.0 * (0.2 * x).sin()).abs() < 0.15, "{x} {y}");
        }
    }

    #[test]
    fn a_long_side_with_a_bent_end_stays_straight() {
        let line = [[0.0, 0.0], [97.0, 0.0], [99.0, 0.2], [100.0, 0.7]];
        for line in [line.to_vec(), line.into_iter().rev().collect()] {
            for [x, y] in curve_through(&line, 0.1).points(0.001) {
                let away = if x < 97.0 { y.abs() } else { 0.0 };
                assert!(away < 0.2 && (-0.2..0.9).contains(&y), "{x} {y}");
            }
        }
    }

    #[test]
    fn corners_stay_and_what_is_straight_is_one_line() {
        // A square that begins within a side, and a circle on a stem.
        let mut square = vec![
            [5.0, 0.0],
            [10.0, 0.0],
            [10.0, 10.0],
            [0.0, 10.0],
            [0.0, 0.0],
        ];
        square.push(square[0]);
        let pieces: Vec<Piece> = curve_through(&square, 0.01).pieces().collect();
        assert_eq!(pieces.len(), 4, "{pieces:?}");
        assert!(pieces.iter().all(|piece| matches!(piece, Piece::Line(_))));
        let mut line = sampled(10, |t| [0.0, 20.0 * t]);
        line.extend(
            sampled(40, |t| {
                [10.0 - 10.0 * (3.0 * t).cos(), 20.0 + 10.0 * (3.0 * t).sin()]
            })
            .split_off(1),
        );
        let curve = curve_through(&line, 0.02);
        for [x, y] in curve.points(0.001) {
            let away = match y < 20.0 && x < 5.0 {
                true => x.abs(),
                false => ((x - 10.0).hypot(y - 20.0) - 10.0).abs(),
            };
            assert!(away < 0.05, "{x} {y}");
        }
    }
}

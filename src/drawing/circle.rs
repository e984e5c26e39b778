//! Arcs of circles in lines of straight pieces, as CAD divides them.

use super::curve::Curve;
use crate::math::planar::{Point2, bounds, circle_through, distance, distance_to_segment};
use crate::math::simplify::simplify_polyline;
use crate::scene::polyhedron::MAX_BEND_STEP;

/// Maximum distance of an arc's points from its circle, as a share of how far the circle bulges beyond the pieces there.
const MAX_OFF_PER_BULGE: f64 = 0.2;

/// Minimum number of pieces of an arc; any three may be on a circle.
const MIN_ARC_PIECES: usize = 4;

/// Maximum angle, in radians, of a Bézier curve that stands for an arc: it is off by four millionths of the radius.
const MAX_BEZIER_ANGLE: f64 = std::f64::consts::FRAC_PI_4;

/// Largest distance of a point from a straight line that it counts to be on, as a share of the line's extent: some roundings of the
/// numbers of 32 bits that an STL file has.
const STRAIGHT_TOLERANCE_SHARE: f64 = 8.0 * f32::EPSILON as f64;

/// Makes a curve of a line's straight pieces, with Bézier curves along the pieces that lie on a circle and are nowhere farther from it
/// than `max_bulge`.
pub(super) fn with_arcs(points: &[[f64; 2]], max_bulge: f64) -> Curve {
    let points = &corners(points);
    let mut curve = Curve::through(&points[..1]);
    let mut start = 0;
    while start + 1 < points.len() {
        match longest_arc(&points[start..], max_bulge) {
            Some((pieces, centre)) => {
                add_arc(&mut curve, &points[start..=start + pieces], centre);
                start += pieces;
            }
            None => {
                start += 1;
                curve.line_to(points[start]);
            }
        }
    }
    curve
}

/// The points of a line at which it turns, and its ends.
pub(super) fn corners(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let [low, high] = bounds(points.iter());
    let tolerance = STRAIGHT_TOLERANCE_SHARE * distance(low, high);
    let is_on = |p: [f64; 2], ends: [[f64; 2]; 2]| distance_to_segment(p, ends) <= tolerance;
    let places: Vec<Point2> = points.iter().map(|[x, y]| Point2::new(*x, *y)).collect();
    let mut out: Vec<[f64; 2]> = (simplify_polyline(&places, tolerance).iter())
        .map(|place| [place.re, place.im])
        .collect();
    // A closed line may begin within a side.
    if let [first, second, .., before, last] = out[..]
        && out.len() > 3
        && first == last
        && is_on(first, [before, second])
    {
        out.remove(0);
        let end = out.len() - 1;
        out[end] = second;
    }
    out
}

/// Number of pieces, from the first point on, that lie on one circle, and its centre.
fn longest_arc(points: &[[f64; 2]], max_bulge: f64) -> Option<(usize, [f64; 2])> {
    let (centre, radius) = circle_through(points.get(..3)?.try_into().ok()?)?;
    let arm = |p: [f64; 2]| [p[0] - centre[0], p[1] - centre[1]];
    // Angle of a piece as seen from the centre.
    let step = |from: [f64; 2], to: [f64; 2]| {
        let ([a, b], [c, d]) = (arm(from), arm(to));
        (a * d - b * c).atan2(a * c + b * d)
    };
    let way = step(points[0], points[1]).signum();
    let mut before = 0.0;
    let is_on = |pair: &&[[f64; 2]]| {
        let (angle, long) = (way * step(pair[0], pair[1]), distance(pair[0], pair[1]));
        let bulge = f64::max(before, long).powi(2) / (8.0 * radius);
        before = long;
        let away = (distance(pair[1], centre) - radius).abs();
        angle > 0.0
            && angle <= MAX_BEND_STEP
            && bulge <= max_bulge
            && away <= MAX_OFF_PER_BULGE * bulge
    };
    let pieces = points.windows(2).take_while(is_on).count();
    (pieces >= MIN_ARC_PIECES).then_some((pieces, centre))
}

/// Adds Bézier curves along the arc around a centre through points.
fn add_arc(curve: &mut Curve, points: &[[f64; 2]], centre: [f64; 2]) {
    let angle = |p: [f64; 2]| (p[1] - centre[1]).atan2(p[0] - centre[0]);
    let turn = |pair: &[[f64; 2]]| {
        let turn = angle(pair[1]) - angle(pair[0]);
        turn.sin().atan2(turn.cos())
    };
    let whole: f64 = points.windows(2).map(turn).sum();
    let (first, last) = (points[0], points[points.len() - 1]);
    let radius = distance(first, centre);
    let count = (whole.abs() / MAX_BEZIER_ANGLE).ceil().max(1.0) as usize;
    let part = whole / count as f64;
    // Length of the control arms along the tangents.
    let arm = 4.0 / 3.0 * (part / 4.0).tan() * radius;
    let at = |i: usize| {
        let (sin, cos) = (angle(first) + part * i as f64).sin_cos();
        (
            [centre[0] + radius * cos, centre[1] + radius * sin],
            [-arm * sin, arm * cos],
        )
    };
    for i in 0..count {
        let ((from, out), (to, back)) = (at(i), at(i + 1));
        let to = if i + 1 == count { last } else { to };
        let from = if i == 0 { first } else { from };
        curve.bezier_to([
            [from[0] + out[0], from[1] + out[1]],
            [to[0] - back[0], to[1] - back[1]],
            to,
        ]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A polygon of corners on a circle of radius 8 about (3, 4), closed.
    fn polygon(corners: usize) -> Vec<[f64; 2]> {
        let at = |i: usize| {
            let (sin, cos) =
                (std::f64::consts::TAU * (i % corners) as f64 / corners as f64).sin_cos();
            [3.0 + 8.0 * cos, 4.0 + 8.0 * sin]
        };
        (0..=corners).map(at).collect()
    }

    #[test]
    fn a_polygon_of_many_sides_is_a_circle_and_one_of_few_is_not() {
        let (centre, radius) = with_arcs(&polygon(48), f64::INFINITY).circle().unwrap();
        assert!(
            (radius - 8.0).abs() < 1e-4 && distance(centre, [3.0, 4.0]) < 1e-4,
            "{centre:?} {radius}"
        );
        let few = polygon(12);
        assert_eq!(with_arcs(&few, f64::INFINITY), Curve::through(&few));
    }

    /// A rectangle with points along its sides and points that rounding has doubled, begun within a side.
    #[test]
    fn sides_have_two_ends() {
        let line = [
            [3.0, 0.0],
            [9.0, 0.0],
            [9.0, 2.0],
            [9.0, 2.0000003],
            [9.0, 1.9999998],
            [9.0, 2.4],
            [9.0, 5.0],
            [0.0, 5.0],
            [1e-16, 2.0],
            [0.0, 0.0],
            [3.0, 0.0],
        ];
        let sides = [[9.0, 0.0], [9.0, 5.0], [0.0, 5.0], [0.0, 0.0], [9.0, 0.0]];
        assert_eq!(with_arcs(&line, f64::INFINITY), Curve::through(&sides));
    }

    /// A plate whose corners are rounded, begun within one of them: three pieces of a corner follow a long side.
    #[test]
    fn long_sides_between_rounded_corners_stay_straight() {
        let mut line = Vec::new();
        for (k, [x, y]) in [[300.0, 0.0], [300.0, 300.0], [0.0, 300.0], [0.0, 0.0]]
            .into_iter()
            .enumerate()
        {
            line.extend((0..=18).map(|i| {
                let angle = std::f64::consts::FRAC_PI_2 * (k as f64 - 1.0 + f64::from(i) / 18.0);
                [x + 3.0 * angle.cos(), y + 3.0 * angle.sin()]
            }));
        }
        line.rotate_left(9);
        line.push(line[0]);
        for p in with_arcs(&line, f64::INFINITY).points(1e-3) {
            let [x, y] = p.map(|v| (v - 150.0).abs());
            assert!(x < 153.001 && y < 153.001, "{p:?}");
        }
    }

    #[test]
    fn straight_pieces_beside_an_arc_stay_straight() {
        let mut line = vec![[30.0, 4.0]];
        line.extend(&polygon(32)[..17]);
        line.push([-30.0, 4.0]);
        let curve = with_arcs(&line, f64::INFINITY);
        let half = std::f64::consts::PI * 8.0;
        assert_eq!(curve.controls().len(), 3 * (1 + 4 + 1) + 1);
        assert!(
            (curve.length() - (19.0 + half + 25.0)).abs() < 1e-3,
            "{}",
            curve.length()
        );
    }
}

//! Points, segments and polygons in the plane.

use nalgebra::Complex;

/// A point or vector in the plane as a complex number: a product with a number of modulus 1 is a rotation.
pub(crate) type Point2 = Complex<f64>;

/// Types that hold a point of the plane: [`Point2`] and `[f64; 2]`.
pub(crate) trait Planar: Copy {
    /// Returns the coordinates `[x, y]`.
    fn xy(self) -> [f64; 2];
    /// Makes a point of its coordinates `[x, y]`.
    fn from_xy(xy: [f64; 2]) -> Self;
}

impl Planar for [f64; 2] {
    #[inline(always)]
    fn xy(self) -> [f64; 2] {
        self
    }

    #[inline(always)]
    fn from_xy(xy: [f64; 2]) -> Self {
        xy
    }
}

impl Planar for Point2 {
    #[inline(always)]
    fn xy(self) -> [f64; 2] {
        [self.re, self.im]
    }

    #[inline(always)]
    fn from_xy([x, y]: [f64; 2]) -> Self {
        Point2::new(x, y)
    }
}

/// Returns the vector from one point to another.
pub(crate) fn difference(from: impl Planar, to: impl Planar) -> [f64; 2] {
    let ([a, b], [c, d]) = (from.xy(), to.xy());
    [c - a, d - b]
}

/// Cross product `u₁v₂ − u₂v₁` of two vectors: the area of their parallelogram, above 0 if `v` is to the left of `u`.
pub(crate) fn cross(u: impl Planar, v: impl Planar) -> f64 {
    let ([a, b], [c, d]) = (u.xy(), v.xy());
    a * d - b * c
}

/// Euclidean distance between two points.
pub(crate) fn distance<P: Planar>(a: P, b: P) -> f64 {
    let [x, y] = difference(a, b);
    x.hypot(y)
}

/// Twice the signed area of a triangle: above 0 if its corners are in anticlockwise order, 0 if they are on a line.
pub(crate) fn orientation<P: Planar>(a: P, b: P, c: P) -> f64 {
    cross(difference(a, b), difference(a, c))
}

/// Returns whether two segments intersect. A segment that only touches the other one with an end counts or does not, by
/// the side that the end is on after rounding. Segments beside each other on one line do not intersect, however they are rounded.
pub(crate) fn segments_intersect<P: Planar>([a, b]: [P; 2], [c, d]: [P; 2]) -> bool {
    let [a_to_b, a_to_c, a_to_d] = [b, c, d].map(|p| difference(a, p));
    let are_beside = (0..2).any(|k| {
        let (low, high) = (a_to_b[k].min(0.0), a_to_b[k].max(0.0));
        a_to_c[k].max(a_to_d[k]) < low || a_to_c[k].min(a_to_d[k]) > high
    });
    if are_beside {
        return false;
    }
    let separates = |p, q, r, s| (orientation(p, q, r) > 0.0) != (orientation(p, q, s) > 0.0);
    separates(a, b, c, d) && separates(c, d, a, b)
}

/// Intersection point of the lines through two pairs of points; `None` if the sine of the angle between them is at most
/// `max_parallel_sine` (0: only if they are exactly parallel).
pub(crate) fn line_intersection<P: Planar>(
    [a, b]: [P; 2],
    [c, d]: [P; 2],
    max_parallel_sine: f64,
) -> Option<P> {
    let (u, v) = (difference(a, b), difference(c, d));
    let denominator = cross(u, v);
    if denominator.abs() <= max_parallel_sine * u[0].hypot(u[1]) * v[0].hypot(v[1]) {
        return None;
    }
    let t = cross(difference(a, c), v) / denominator;
    let [x, y] = a.xy();
    Some(P::from_xy([x + u[0] * t, y + u[1] * t]))
}

/// Centre and radius of the circle through three points; `None` if they are on a line.
pub(crate) fn circle_through<P: Planar>([a, b, c]: [P; 3]) -> Option<(P, f64)> {
    let (u, v) = (difference(a, b), difference(a, c));
    let twice = 2.0 * cross(u, v);
    let (uu, vv) = (u[0] * u[0] + u[1] * u[1], v[0] * v[0] + v[1] * v[1]);
    let off = [
        (v[1] * uu - u[1] * vv) / twice,
        (u[0] * vv - v[0] * uu) / twice,
    ];
    let [x, y] = a.xy();
    let radius = off[0].hypot(off[1]);
    radius
        .is_finite()
        .then(|| (P::from_xy([x + off[0], y + off[1]]), radius))
}

/// Shortest distance from a point to a segment.
pub(crate) fn distance_to_segment<P: Planar>(point: P, [a, b]: [P; 2]) -> f64 {
    let (u, v) = (difference(a, b), difference(a, point));
    let t = nearest_parameter(u, v);
    (v[0] - t * u[0]).hypot(v[1] - t * u[1])
}

/// Returns the point of a segment that is nearest to `point`.
pub(crate) fn nearest_on_segment<P: Planar>(point: P, [a, b]: [P; 2]) -> P {
    let u = difference(a, b);
    let t = nearest_parameter(u, difference(a, point));
    let [x, y] = a.xy();
    P::from_xy([x + t * u[0], y + t * u[1]])
}

/// Projects `v` onto `u`, both from one end of a segment along `u`: the share of `u` at the point nearest to the end of
/// `v`, clamped to 0 to 1.
fn nearest_parameter(u: [f64; 2], v: [f64; 2]) -> f64 {
    let squared_length = u[0] * u[0] + u[1] * u[1];
    if squared_length > 0.0 {
        ((v[0] * u[0] + v[1] * u[1]) / squared_length).clamp(0.0, 1.0)
    } else {
        0.0
    }
}

/// Length of a polyline: the sum of the distances between consecutive points.
pub(crate) fn polyline_length<P: Planar>(points: &[P]) -> f64 {
    points.windows(2).map(|p| distance(p[0], p[1])).sum()
}

/// Straight line of least squared distances from points: their mean, and the unit vector in which they extend most.
pub(crate) fn principal_line(points: &[[f64; 2]]) -> ([f64; 2], [f64; 2]) {
    let mean = [0, 1].map(|k| points.iter().map(|p| p[k]).sum::<f64>() / points.len() as f64);
    let (mut across, mut along) = (0.0, 0.0);
    for p in points {
        let [x, y] = difference(mean, *p);
        (across, along) = (across + 2.0 * x * y, along + x * x - y * y);
    }
    let (sin, cos) = (0.5 * across.atan2(along)).sin_cos();
    (mean, [cos, sin])
}

/// Iterates over the edges of a closed polygon whose last corner is not its first one again.
fn polygon_edges<P: Planar>(polygon: &[P]) -> impl Iterator<Item = [P; 2]> {
    let next = |i: usize| if i + 1 == polygon.len() { 0 } else { i + 1 };
    (0..polygon.len()).map(move |i| [polygon[i], polygon[next(i)]])
}

/// Signed area of a closed polygon: above 0 if its corners are in anticlockwise order.
pub(crate) fn polygon_area<P: Planar>(polygon: &[P]) -> f64 {
    0.5 * polygon_edges(polygon)
        .map(|[a, b]| cross(a, b))
        .sum::<f64>()
}

/// Returns whether a point is inside of a closed polygon, by the even-odd rule.
pub(crate) fn polygon_contains<P: Planar>(polygon: &[P], point: P) -> bool {
    is_within(point, polygon_edges(polygon))
}

/// Returns whether a point is within closed lines, given by all their edges, by the even-odd rule.
pub(crate) fn is_within<P: Planar>(point: P, edges: impl Iterator<Item = [P; 2]>) -> bool {
    let [x, y] = point.xy();
    let crossings = edges.filter(|[a, b]| {
        let ([qx, qy], [px, py]) = (a.xy(), b.xy());
        (py > y) != (qy > y) && x < (qx - px) * (y - py) / (qy - py) + px
    });
    crossings.count() % 2 == 1
}

/// Minimum share of a bounding box's area that a rotation must save; otherwise a box stays upright, in which things are
/// easier to recognise.
const MIN_TURN_AREA_SAVING: f64 = 0.03;

/// The bounding box of least area of points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct LeastBox {
    /// Cosine and sine of the rotation after which the box is upright.
    pub turn: [f64; 2],
    /// Lower left corner of the upright box.
    pub low: [f64; 2],
    /// Width and height of the upright box.
    pub size: [f64; 2],
}

impl LeastBox {
    /// Finds the box of least area around points, which aligns an edge of their convex hull with an axis; the upright one if
    /// that is hardly larger.
    pub(crate) fn around(points: Vec<[f64; 2]>) -> LeastBox {
        let (best, upright) = LeastBox::turned_and_upright(points);
        match best.area() < (1.0 - MIN_TURN_AREA_SAVING) * upright.area() {
            true => best,
            false => upright,
        }
    }

    fn area(&self) -> f64 {
        self.size[0] * self.size[1]
    }

    /// Finds the box of least area around points, and the upright one.
    pub(crate) fn turned_and_upright(points: Vec<[f64; 2]>) -> (LeastBox, LeastBox) {
        let hull = convex_hull(points);
        let boxed = |turn: [f64; 2]| {
            let turned = hull.iter().map(|[x, y]| {
                let [cos, sin] = turn;
                [cos * x - sin * y, sin * x + cos * y]
            });
            let start = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
            let [low, high] = turned.fold(start, |[low, high], p| {
                let ends = |k: usize| [low[k].min(p[k]), high[k].max(p[k])];
                let [[a, b], [c, d]] = [ends(0), ends(1)];
                [[a, c], [b, d]]
            });
            LeastBox {
                turn,
                low,
                size: [high[0] - low[0], high[1] - low[1]],
            }
        };
        let upright = boxed([1.0, 0.0]);
        let mut best = upright;
        for [p, q] in polygon_edges(&hull) {
            let [x, y] = difference(p, q);
            let long = x.hypot(y);
            if long > 0.0 {
                let found = boxed([x / long, -y / long]);
                if found.area() < (1.0 - 1e-9) * best.area() {
                    best = found;
                }
            }
        }
        (best, upright)
    }
}

/// Computes the corners of the convex hull of points, counter-clockwise (Andrew 1979).
pub(crate) fn convex_hull(mut points: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    points.sort_by(|p, q| p[0].total_cmp(&q[0]).then(p[1].total_cmp(&q[1])));
    points.dedup();
    if points.len() < 3 {
        return points;
    }
    let side = |p: [f64; 2], q: [f64; 2], r: [f64; 2]| {
        (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])
    };
    let half = |points: &mut dyn Iterator<Item = [f64; 2]>| {
        let mut out: Vec<[f64; 2]> = Vec::new();
        for point in points {
            while let [.., p, q] = out[..] {
                if side(p, q, point) > 0.0 {
                    break;
                }
                out.pop();
            }
            out.push(point);
        }
        out.pop();
        out
    };
    let mut out = half(&mut points.iter().copied());
    out.extend(half(&mut points.iter().rev().copied()));
    out
}

/// Computes the lower left and upper right corner of the bounding box of points.
pub(crate) fn bounds<'a>(points: impl Iterator<Item = &'a [f64; 2]>) -> [[f64; 2]; 2] {
    let empty = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
    points.fold(empty, |[low, high], p| {
        [
            [0, 1].map(|k| low[k].min(p[k])),
            [0, 1].map(|k| high[k].max(p[k])),
        ]
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The letter L, anticlockwise, with an area of 14 and a perimeter of 18.
    const L_SHAPE: [[f64; 2]; 6] = [
        [0.0, 0.0],
        [4.0, 0.0],
        [4.0, 2.0],
        [2.0, 2.0],
        [2.0, 5.0],
        [0.0, 5.0],
    ];

    #[test]
    fn area_of_a_polygon_and_length_of_a_line() {
        let clockwise: Vec<Point2> = (L_SHAPE.iter().rev())
            .map(|p| Point2::from_xy(*p))
            .collect();
        assert_eq!(polygon_area(&L_SHAPE), 14.0);
        assert_eq!(polygon_area(&clockwise), -14.0);
        assert_eq!(polyline_length(&L_SHAPE), 13.0);
    }

    #[test]
    fn a_concave_polygon_contains_points() {
        for (point, inside) in [
            ([1.0, 1.0], true),
            ([3.0, 1.0], true),
            ([1.0, 4.0], true),
            ([3.0, 3.0], false),
            ([-1.0, 1.0], false),
            ([5.0, 1.0], false),
        ] {
            assert_eq!(polygon_contains(&L_SHAPE, point), inside, "{point:?}");
        }
        assert!(!polygon_contains(&[], [0.0, 0.0]));
    }

    #[test]
    fn segments_and_lines_intersect() {
        let rising = [[0.0, 0.0], [2.0, 4.0]];
        let falling = [[0.0, 4.0], [2.0, 0.0]];
        assert!(segments_intersect(rising, falling));
        assert_eq!(line_intersection(rising, falling, 0.0), Some([1.0, 2.0]));
        let beyond = [[3.0, 1.0], [5.0, 1.0]];
        assert!(!segments_intersect(rising, beyond));
        // Pieces of one slanting line, whose points are rounded.
        let on = |k: usize| [0.1 * k as f64, 0.3 * (0.1 * k as f64) + 0.7];
        for k in 0..50 {
            assert!(!segments_intersect(
                [on(k), on(k + 1)],
                [on(k + 2), on(k + 3)]
            ));
        }
        assert_eq!(line_intersection(rising, beyond, 0.0), Some([0.5, 1.0]));
        let parallel = [[1.0, 0.0], [2.0, 2.0]];
        assert_eq!(line_intersection(rising, parallel, 0.0), None);
        // The sine between them is 0.6.
        assert!(line_intersection(rising, falling, 0.79).is_some());
        assert_eq!(line_intersection(rising, falling, 0.81), None);
    }

    #[test]
    fn the_nearest_point_of_a_segment_is_a_foot_or_an_end() {
        let segment = [[1.0, 1.0], [5.0, 1.0]];
        for (point, nearest) in [
            ([3.0, 4.0], [3.0, 1.0]),
            ([-3.0, 0.0], [1.0, 1.0]),
            ([6.0, 2.0], [5.0, 1.0]),
        ] {
            assert_eq!(nearest_on_segment(point, segment), nearest);
            let length = distance(point, nearest);
            assert_eq!(distance_to_segment(point, segment), length);
        }
        assert_eq!(nearest_on_segment([7.0, 8.0], [[2.0, 3.0]; 2]), [2.0, 3.0]);
    }
}

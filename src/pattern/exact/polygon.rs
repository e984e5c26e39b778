//! Polygons with holes: simplified lines, and triangles (ear clipping).

use crate::math::planar::{Point2, orientation, polygon_area, segments_intersect};
use crate::math::symmetric_eigen::symmetric_eigen3;
use crate::scene::polyhedron::Place;

/// Maximum number of corners of a face: cutting off ears costs the cube of it, a second for these.
const MAX_FACE_CORNERS: usize = 600;

/// Minimum sine of the angle between two lines whose corner is where they meet, and not where it was measured.
const MIN_CORNER_SINE: f64 = 0.2;

/// A straight part of a line with noise: the numbers of its first and last points, and the line nearest to all of them.
pub(super) struct Straight {
    pub ends: [usize; 2],
    middle: Place,
    along: Place,
}

impl Straight {
    pub(super) fn new(ends: [usize; 2], middle: Place, along: Place) -> Straight {
        Straight {
            ends,
            middle,
            along: along.normalize(),
        }
    }

    fn fit(points: &[Place], ends: [usize; 2]) -> Straight {
        let own = &points[ends[0]..=ends[1]];
        let middle = own.iter().sum::<Place>() / own.len() as f64;
        let spread = own.iter().map(|p| (p - middle) * (p - middle).transpose());
        let [(_, along), ..] = symmetric_eigen3(spread.sum());
        Straight::new(ends, middle, along)
    }

    /// Whether the part has two ends, and its points lie on its line but for a tolerance.
    fn is_near(&self, points: &[Place], tolerance: f64) -> bool {
        let [first, last] = self.ends;
        let away = |p: &Place| (p - self.middle).cross(&self.along).norm();
        points[first] != points[last] && points[first..=last].iter().all(|p| away(p) <= tolerance)
    }

    /// The point of the line that is nearest to another one, unless they run nearly the same way.
    pub(super) fn meet(&self, other: &Straight) -> Option<Place> {
        let (cosine, off) = (self.along.dot(&other.along), other.middle - self.middle);
        let squared_sine = 1.0 - cosine * cosine;
        let far = (self.along.dot(&off) - cosine * other.along.dot(&off)) / squared_sine;
        (squared_sine >= MIN_CORNER_SINE.powi(2)).then(|| self.middle + self.along * far)
    }
}

/// Divides a line into straight parts from which its points differ by no more than a tolerance (as Douglas and Peucker do, but for
/// lines that have the noise of all their points and not that of two). A closed line is divided at the point farthest from its
/// ends.
pub(super) fn straight_parts(points: &[Place], tolerance: f64) -> Vec<Straight> {
    let (mut parts, mut open) = (Vec::new(), vec![[0, points.len() - 1]]);
    while let Some([first, last]) = open.pop() {
        let part = Straight::fit(points, [first, last]);
        let own = first + 1..last;
        let is_straight = part.is_near(points, tolerance);
        let chord = points[last] - points[first];
        let away = |k: &usize| {
            let off = points[*k] - points[first];
            let share = off.dot(&chord) / chord.norm_squared().max(f64::MIN_POSITIVE);
            (off - chord * share.clamp(0.0, 1.0)).norm()
        };
        match own.max_by(|a, b| away(a).total_cmp(&away(b))) {
            Some(k) if !is_straight => open.extend([[k, last], [first, k]]),
            _ => parts.push(part),
        }
    }
    // A part may have been divided where its noise was largest.
    let mut k = 0;
    while k + 1 < parts.len() {
        let both = Straight::fit(points, [parts[k].ends[0], parts[k + 1].ends[1]]);
        match both.is_near(points, tolerance) {
            true => {
                parts[k] = both;
                parts.remove(k + 1);
            }
            false => k += 1,
        }
    }
    parts
}

/// Triangles of the polygon within closed lines, by the numbers of their points; outer lines are anticlockwise and holes
/// clockwise. `None` if lines cross.
pub(super) fn triangulate(lines: Vec<Vec<Point2>>) -> Option<Vec<[usize; 3]>> {
    let points: Vec<Point2> = lines.concat();
    let mut first = 0;
    let (mut outer, mut holes) = (Vec::new(), Vec::new());
    for line in &lines {
        let numbers: Vec<usize> = (first..first + line.len()).collect();
        first += line.len();
        match polygon_area(line) > 0.0 {
            true => outer.push(numbers),
            false => holes.push(numbers),
        }
    }
    if points.len() > MAX_FACE_CORNERS {
        return None;
    }
    let [mut ring] = <[Vec<usize>; 1]>::try_from(outer).ok()?;
    while !holes.is_empty() {
        // The shortest bridge to a hole that crosses no line.
        let mut bridges: Vec<(f64, usize, usize, usize)> = Vec::new();
        for (i, a) in ring.iter().enumerate() {
            for (hole, line) in holes.iter().enumerate() {
                let far = |b: &usize| (points[*b] - points[*a]).norm();
                bridges.extend(line.iter().enumerate().map(|(k, b)| (far(b), i, hole, k)));
            }
        }
        bridges.sort_by(|a, b| a.0.total_cmp(&b.0));
        let crosses = |a: usize, b: usize| {
            let mut edges = std::iter::once(&ring)
                .chain(&holes)
                .flat_map(|line| (0..line.len()).map(|k| [line[k], line[(k + 1) % line.len()]]));
            edges.any(|[c, d]| {
                let meets = [c, d].iter().any(|v| [a, b].contains(v));
                !meets && segments_intersect([points[a], points[b]], [points[c], points[d]])
            })
        };
        let is_free = |bridge: &&(f64, usize, usize, usize)| {
            !crosses(ring[bridge.1], holes[bridge.2][bridge.3])
        };
        let (_, i, hole, k) = *bridges.iter().find(is_free)?;
        let mut line = holes.swap_remove(hole);
        line.rotate_left(k);
        line.extend([line[0], ring[i]]);
        ring.splice(i + 1..i + 1, line);
    }
    let mut triangles = Vec::new();
    while ring.len() > 3 {
        let n = ring.len();
        let corner = |k: usize| [(k + n - 1) % n, k, (k + 1) % n].map(|k| ring[k]);
        let turn = |[a, b, c]: [usize; 3]| orientation(points[a], points[b], points[c]);
        let is_ear = |k: &usize| {
            let [a, b, c] = corner(*k);
            let is_inside = |v: &usize| {
                let is_corner = [a, b, c].iter().any(|own| points[*own] == points[*v]);
                !is_corner
                    && [[a, b, *v], [b, c, *v], [c, a, *v]]
                        .iter()
                        .all(|t| turn(*t) >= 0.0)
            };
            turn([a, b, c]) > 0.0 && !ring.iter().any(is_inside)
        };
        // The ear with the largest smallest side keeps slivers few.
        let width = |k: &usize| {
            let [a, b, c] = corner(*k);
            turn([a, b, c]) / (points[c] - points[a]).norm_sqr()
        };
        let ear = (0..n)
            .filter(is_ear)
            .max_by(|a, b| width(a).total_cmp(&width(b)))?;
        triangles.push(corner(ear));
        ring.remove(ear);
    }
    let last = [ring[0], ring[1], ring[2]];
    let turn = orientation(points[last[0]], points[last[1]], points[last[2]]);
    if turn > 0.0 {
        triangles.push(last);
    }
    (turn >= 0.0).then_some(triangles)
}

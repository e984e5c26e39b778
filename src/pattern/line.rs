//! Simplification of polylines with many points.

use crate::math::planar::{distance_to_segment, line_intersection};
use crate::unroll::flat_triangle::Point;

/// Simplifies a polyline: removes points so that all of them stay within a tolerance of the new line (Douglas and
/// Peucker 1973).
pub(crate) fn simplify_polyline(points: &[Point], tolerance: f64) -> Vec<Point> {
    if points.len() < 3 {
        return points.to_vec();
    }
    let mut kept = vec![false; points.len()];
    let last = points.len() - 1;
    (kept[0], kept[last]) = (true, true);
    let mut stack = vec![(0, last)];
    while let Some((a, b)) = stack.pop() {
        let away = |i: usize| distance_to_segment(points[i], [points[a], points[b]]);
        let farthest = (a + 1..b).max_by(|i, k| away(*i).total_cmp(&away(*k)));
        if let Some(i) = farthest.filter(|i| away(*i) > tolerance) {
            kept[i] = true;
            stack.push((a, i));
            stack.push((i, b));
        }
    }
    // Some kept points were only needed before others were added: remove those without which the line is within the
    // tolerance.
    let mut out = vec![0];
    for i in (1..=last).filter(|i| kept[*i]) {
        if let [.., a, _] = out[..] {
            let straight = (a + 1..i)
                .all(|k| distance_to_segment(points[k], [points[a], points[i]]) <= tolerance);
            if straight {
                out.pop();
            }
        }
        out.push(i);
    }
    out.into_iter().map(|i| points[i]).collect()
}

/// Simplifies a closed polyline, whose last point is not its first, within a tolerance.
pub(super) fn simplify_ring(points: &[Point], tolerance: f64) -> Vec<Point> {
    if points.len() < 4 {
        return points.to_vec();
    }
    // Begin at a point that is far from the line's centroid, because it is sure to be a corner.
    let middle = points.iter().sum::<Point>() / points.len() as f64;
    let away = |i: usize, from: Point| (points[i] - from).norm();
    let farthest = |from: Point| {
        (0..points.len())
            .max_by(|i, k| away(*i, from).total_cmp(&away(*k, from)))
            .unwrap_or(0)
    };
    let first = farthest(middle);
    let mut ring: Vec<Point> = points[first..]
        .iter()
        .chain(&points[..=first])
        .copied()
        .collect();
    let opposite = (farthest(points[first]) + points.len() - first) % points.len();
    let second = simplify_polyline(&ring[opposite..], tolerance);
    ring.truncate(opposite + 1);
    let mut out = simplify_polyline(&ring, tolerance);
    out.extend(&second[1..]);
    out.pop();
    out
}

/// Restores corners of a polyline that were cut off: a segment shorter than `short` between two segments of more
/// than three times `short` is replaced by the intersection of the two, if that is within `short` of both ends of
/// the short segment. A `closed` polyline continues from its last point to its first.
pub(super) fn restore_corners(points: &[Point], short: f64, closed: bool) -> Vec<Point> {
    let n = points.len();
    let mut out = points.to_vec();
    if n < 4 {
        return out;
    }
    let mut gone = vec![false; n];
    for i in 0..n {
        if !closed && (i == 0 || i + 2 >= n) {
            continue;
        }
        let [a, b, c, d] = [n - 1, 0, 1, 2].map(|k| (i + k) % n);
        let [p, q, r, s] = [a, b, c, d].map(|k| points[k]);
        let long = (q - p).norm().min((s - r).norm()) > 3.0 * short;
        if !long || (r - q).norm() >= short || gone[b] {
            continue;
        }
        let near = |corner: &Point| (corner - q).norm().max((corner - r).norm()) < short;
        if let Some(corner) = meeting([p, q], [s, r]).filter(near) {
            out[b] = corner;
            gone[c] = true;
        }
    }
    let pairs = out.into_iter().zip(gone);
    pairs
        .filter(|(_, gone)| !gone)
        .map(|(place, _)| place)
        .collect()
}

/// Computes the intersection of two straight lines; `None` where the lines are parallel.
pub(super) fn meeting([p, q]: [Point; 2], [r, s]: [Point; 2]) -> Option<Point> {
    // Lines at an angle below a hundredth of a radian count as parallel.
    line_intersection([p, q], [r, s], 0.01)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(x: f64, y: f64) -> Point {
        Point::new(x, y)
    }

    #[test]
    fn what_is_straight_has_two_ends_and_a_corner_stays() {
        let line: Vec<Point> = (0..10)
            .map(|i| at(f64::from(i), 0.001 * f64::from(i % 2)))
            .chain((1..10).map(|i| at(9.0, f64::from(i))))
            .collect();
        assert_eq!(
            simplify_polyline(&line, 0.01),
            [at(0.0, 0.0), line[9], at(9.0, 9.0)]
        );
    }

    #[test]
    fn a_square_whose_corners_were_cut_gets_them_back() {
        let mut ring = Vec::new();
        let corners = [at(0.0, 0.0), at(8.0, 0.0), at(8.0, 8.0), at(0.0, 8.0)];
        for (i, corner) in corners.iter().enumerate() {
            let along = (corners[(i + 1) % 4] - corner) / 8.0;
            ring.extend((0..8).map(|k| corner + along * (f64::from(k) + 0.5)));
        }
        let plain = simplify_ring(&ring, 0.01);
        assert_eq!(plain.len(), 8);
        let mut found = restore_corners(&plain, 1.0, true);
        found.sort_by(|p, q| (p.re, p.im).partial_cmp(&(q.re, q.im)).unwrap());
        let expected = [corners[0], corners[3], corners[1], corners[2]];
        assert_eq!(found.len(), 4);
        for (p, q) in found.iter().zip(expected) {
            assert!((p - q).norm() < 1e-12, "{found:?}");
        }
    }
}

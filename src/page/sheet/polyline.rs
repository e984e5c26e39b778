//! Polylines in a photo: nearest points and normals of a page's traced edges.

use crate::math::planar::{distance, principal_line};
use crate::math::statistics::median;

/// Distance between two points of a trace, as a multiple of the median one, above which the edge is not seen between them.
/// Its row: `benches/outline.md`, Covered corners.
const MAX_SPACING_RATIO: f64 = 8.0;

/// A curve of straight segments.
#[derive(Debug, Clone)]
pub(super) struct Polyline {
    points: Vec<[f64; 2]>,
    /// First and last position of each stretch in which the curve is not seen.
    gaps: Vec<[f64; 2]>,
}

/// Nearest point on a polyline to a given point.
#[derive(Debug, Clone, Copy)]
pub(super) struct NearestPoint {
    /// Position along the polyline: the segment's index plus the share of the segment before the point.
    pub position: f64,
    /// Unit normal of the segment on which the nearest point lies.
    pub normal: [f64; 2],
    /// Signed distance of the given point from the segment's line, along the normal.
    pub distance: f64,
}

impl Polyline {
    /// Makes a polyline of at least two points.
    pub fn new(points: Vec<[f64; 2]>) -> Self {
        debug_assert!(points.len() > 1);
        Polyline {
            points,
            gaps: Vec::new(),
        }
    }

    /// Resamples a traced curve to segments of equal length; it is not seen where its points are far apart.
    pub fn resampled(points: &[[f64; 2]], segments: usize) -> Self {
        let (found, total) = equidistant(points, segments + 1);
        let spacings: Vec<f64> = points.windows(2).map(|p| distance(p[0], p[1])).collect();
        let usual = median(&mut spacings.clone()).unwrap_or_default();
        let (mut end, mut gaps) = (0.0, Vec::new());
        for (k, spacing) in spacings.iter().enumerate() {
            let start = end;
            end += spacing;
            // Curves have points that are far apart, too, but not one pair alone.
            let beside = [k.wrapping_sub(1), k + 1].map(|j| spacings.get(j).copied());
            let others = beside.into_iter().flatten().fold(usual, f64::max);
            if *spacing > MAX_SPACING_RATIO * others {
                gaps.push([start, end].map(|at| at / total * segments as f64));
            }
        }
        Polyline {
            gaps,
            ..Polyline::new(found)
        }
    }

    /// Vertices of the polyline.
    pub fn points(&self) -> &[[f64; 2]] {
        &self.points
    }

    /// Whether the curve is seen at a position: the index of a segment plus the share of the segment before it.
    pub fn is_seen(&self, at: f64) -> bool {
        (self.gaps.iter()).all(|[from, to]| at < *from || at > *to)
    }

    /// Finds the point of the polyline that is nearest to the point `at`; beyond the ends, the distance is that from
    /// the outermost segment's line. None if the segment has no length.
    pub fn nearest(&self, at: [f64; 2]) -> Option<NearestPoint> {
        let mut best = (f64::INFINITY, 0, 0.0);
        for (i, w) in self.points.windows(2).enumerate() {
            let way = [w[1][0] - w[0][0], w[1][1] - w[0][1]];
            let off = [at[0] - w[0][0], at[1] - w[0][1]];
            let squared = way[0] * way[0] + way[1] * way[1];
            let t = ((way[0] * off[0] + way[1] * off[1]) / squared.max(1e-300)).clamp(0.0, 1.0);
            let rest = [off[0] - t * way[0], off[1] - t * way[1]];
            let distance = rest[0] * rest[0] + rest[1] * rest[1];
            if distance < best.0 {
                best = (distance, i, t);
            }
        }
        let (_, i, t) = best;
        let [from, to] = [self.points[i], self.points[i + 1]];
        let way = [to[0] - from[0], to[1] - from[1]];
        let length = way[0].hypot(way[1]);
        if !(length > 0.0 && length.is_finite() && best.0.is_finite()) {
            return None;
        }
        let normal = [-way[1] / length, way[0] / length];
        Some(NearestPoint {
            position: i as f64 + t,
            normal,
            distance: normal[0] * (at[0] - from[0]) + normal[1] * (at[1] - from[1]),
        })
    }

    /// Fits a straight line to the polyline by least squares, given by two points. The ends are left out, because corners of
    /// pages are often rounded.
    pub fn line(&self) -> [[f64; 2]; 2] {
        let count = self.points.len();
        let inner = (count / 20..count - count / 20).filter(|i| self.is_seen(*i as f64));
        let inner: Vec<[f64; 2]> = inner.map(|i| self.points[i]).collect();
        let (mean, [cos, sin]) = principal_line(&inner);
        [mean, [mean[0] + cos, mean[1] + sin]]
    }
}

/// Resamples a curve, given by at least two points, to `count` points at equal distances along it; returns them with the
/// curve's length.
pub(super) fn equidistant<const N: usize>(
    points: &[[f64; N]],
    count: usize,
) -> (Vec<[f64; N]>, f64) {
    let mut lengths = vec![0.0];
    for pair in points.windows(2) {
        let squares = (0..N).map(|k| (pair[1][k] - pair[0][k]).powi(2));
        lengths.push(lengths[lengths.len() - 1] + squares.sum::<f64>().sqrt());
    }
    let total = lengths[lengths.len() - 1];
    let resampled = (0..count)
        .map(|i| {
            let at = total * i as f64 / (count - 1) as f64;
            let after = lengths.partition_point(|length| *length < at);
            let after = after.clamp(1, points.len() - 1);
            let span = (lengths[after] - lengths[after - 1]).max(1e-300);
            let t = (at - lengths[after - 1]) / span;
            let (from, to) = (points[after - 1], points[after]);
            std::array::from_fn(|k| from[k] + t * (to[k] - from[k]))
        })
        .collect();
    (resampled, total)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_edge_is_not_seen_where_two_of_its_points_are_far_apart() {
        let line = |places: &[i32]| {
            let points: Vec<[f64; 2]> = places.iter().map(|x| [f64::from(*x), 0.0]).collect();
            Polyline::resampled(&points, 30)
        };
        let seen_at = |line: &Polyline, share: f64| line.is_seen(30.0 * share);
        let inside = line(&[(0..100).collect::<Vec<_>>(), (200..=300).collect()].concat());
        assert_eq!(
            [0.3, 0.5, 0.7].map(|at| seen_at(&inside, at)),
            [true, false, true]
        );
        let end = line(&[vec![0], (100..=300).collect()].concat());
        assert_eq!(
            [0.0, 0.2, 0.5].map(|at| seen_at(&end, at)),
            [false, false, true]
        );
        // Few points are all that is known, and a long curve after short ones has several.
        for places in [&[0, 10, 300][..], &[0, 1, 2, 3, 4, 5, 6, 100, 200, 300]] {
            let whole = line(places);
            assert!((0..=30).all(|at| whole.is_seen(f64::from(at))));
        }
    }
}

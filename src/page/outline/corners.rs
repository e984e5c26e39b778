//! Corners of a page to a fraction of a pixel: where its neighbouring edges meet.

use crate::math::planar::{cross, distance, line_intersection, polyline_length};

/// Share of an edge's length next to a corner that is left out of its end, because paper is worn and bent there.
const WORN_END_SHARE: f64 = 0.015;

/// Share of an edge's length over which its direction near a corner is taken.
const END_LENGTH_SHARE: f64 = 0.08;

/// Share of an edge's length over which its direction is taken where the photo's rim cuts it off.
const CUT_END_LENGTH_SHARE: f64 = 0.2;

/// Minimum number of points that have a direction.
const MIN_END_POINTS: usize = 6;

/// Maximum distance of a corner from the end of an edge in the photo, as a share of the edge's length.
const MAX_CORNER_SHIFT: f64 = 0.06;

/// Maximum distance of a corner outside of the photo from the end of an edge, as a share of the edge's length.
const MAX_EXTRAPOLATION: f64 = 0.6;

/// Sine of the angle below which two edges have no corner.
const MIN_CORNER_SINE: f64 = 0.3;

/// Two points on the least-squares line through a share of an edge at its end.
fn end_line(edge: &[[f64; 2]], share: f64) -> Option<[[f64; 2]; 2]> {
    let n = edge.len();
    let skip = (n as f64 * WORN_END_SHARE) as usize;
    let take = ((n as f64 * share) as usize).max(MIN_END_POINTS);
    let end = edge.get(skip..(skip + take).min(n))?;
    if end.len() < MIN_END_POINTS {
        return None;
    }
    let mean = [0, 1].map(|k| end.iter().map(|p| p[k]).sum::<f64>() / end.len() as f64);
    let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
    for [x, y] in end {
        let (dx, dy) = (x - mean[0], y - mean[1]);
        (xx, xy, yy) = (xx + dx * dx, xy + dx * dy, yy + dy * dy);
    }
    let angle = 0.5 * (2.0 * xy).atan2(xx - yy);
    Some([mean, [mean[0] + angle.cos(), mean[1] + angle.sin()]])
}

/// The corner where two edges meet, both given as points from that corner on; `None` if their extensions do not
/// intersect near their ends.
pub(super) fn corner(one: &[[f64; 2]], other: &[[f64; 2]]) -> Option<[f64; 2]> {
    meeting(one, other, END_LENGTH_SHARE, MAX_CORNER_SHIFT)
}

/// The corner outside of an image of a size between two edges that its rim cuts off, both given from their ends there on;
/// `None` if they meet inside of the image, or far from it.
pub(super) fn outside_corner(
    one: &[[f64; 2]],
    other: &[[f64; 2]],
    size: [usize; 2],
) -> Option<[f64; 2]> {
    let point = meeting(one, other, CUT_END_LENGTH_SHARE, MAX_EXTRAPOLATION)?;
    is_outside(point, size, 0.0).then_some(point)
}

/// Whether a point is outside of an image of a size by more than a distance.
pub(super) fn is_outside(point: [f64; 2], size: [usize; 2], distance: f64) -> bool {
    (0..2).any(|k| point[k] < -distance || point[k] > size[k] as f64 - 1.0 + distance)
}

/// The intersection of the lines along the ends of two edges, if it is within a share of the edges' lengths from both.
fn meeting(one: &[[f64; 2]], other: &[[f64; 2]], end: f64, shift: f64) -> Option<[f64; 2]> {
    let point = line_intersection(end_line(one, end)?, end_line(other, end)?, MIN_CORNER_SINE)?;
    let near = |edge: &[[f64; 2]]| distance(edge[0], point) <= shift * polyline_length(edge);
    (near(one) && near(other)).then_some(point)
}

/// Ends an edge, given from its end on, at a corner: leaves out its worn end and what is beyond the corner.
pub(super) fn end_at(edge: &mut Vec<[f64; 2]>, corner: [f64; 2]) {
    let n = edge.len();
    let mut skip = (n as f64 * WORN_END_SHARE) as usize;
    let limit = n / 4;
    if let Some([a, b]) = end_line(edge, END_LENGTH_SHARE) {
        let inward = [edge[n / 4][0] - edge[0][0], edge[n / 4][1] - edge[0][1]];
        let mut way = [b[0] - a[0], b[1] - a[1]];
        if way[0] * inward[0] + way[1] * inward[1] < 0.0 {
            way = way.map(|v| -v);
        }
        let beyond = |p: [f64; 2]| (p[0] - corner[0]) * way[0] + (p[1] - corner[1]) * way[1] <= 0.5;
        while skip < limit && beyond(edge[skip]) {
            skip += 1;
        }
    }
    edge.splice(..skip, [corner]);
}

/// Whether corners are in clockwise order as seen in the image, around a convex quadrilateral.
pub(super) fn is_convex(corners: &[[f64; 2]; 4]) -> bool {
    (0..4).all(|k| {
        let [a, b, c] = [corners[k], corners[(k + 1) % 4], corners[(k + 2) % 4]];
        cross([b[0] - a[0], b[1] - a[1]], [c[0] - b[0], c[1] - b[1]]) > 0.0
    })
}

//! Corners of a page with subpixel accuracy: intersections of neighbouring edges.

use crate::math::planar::{distance, line_intersection, polyline_length, principal_line};
use crate::page::corners::MAX_TRACING_ERROR;

/// Share of an edge's points next to a corner that is left out, because paper is worn and bent there.
/// Its row: `benches/page.md`, Constants of the outline.
const WORN_END_SHARE: f64 = 0.015;

/// Share of an edge's points from which its direction near a corner is fitted.
/// Its row: `benches/page.md`, Constants of the outline.
pub(super) const END_LENGTH_SHARE: f64 = 0.08;

/// Share of an edge from which its direction is fitted where the photo's rim cuts it off or its end is covered, and by which it may
/// continue beyond a corner.
/// Its row: `benches/page.md`, Constants of the outline.
pub(super) const CUT_END_LENGTH_SHARE: f64 = 0.2;

/// Maximum distance between the end of an edge and the corner that is found for it, as a share of the edge's length.
/// Its row: `benches/page.md`, Constants of the outline.
const MAX_CORNER_SHIFT: f64 = 0.6;

/// Minimum sine of the angle at which two edges are intersected in a corner.
/// Its row: `benches/page.md`, Constants of the outline.
const MIN_CORNER_SINE: f64 = 0.3;

/// Fits a straight line to the first points of an edge, which are the share `share` of all of them, without the worn
/// ones at the end; returns two points on it. None if the points are too few.
fn end_line(edge: &[[f64; 2]], share: f64) -> Option<[[f64; 2]; 2]> {
    let n = edge.len();
    let skip = (n as f64 * WORN_END_SHARE) as usize;
    let take = ((n as f64 * share) as usize).max(2);
    let end = edge.get(skip..(skip + take).min(n))?;
    if end.len() < 2 {
        return None;
    }
    let (mean, [cos, sin]) = principal_line(end);
    Some([mean, [mean[0] + cos, mean[1] + sin]])
}

/// Extrapolates the corner outside of the image where two edges meet that the image's rim cuts off; both are given as
/// points that begin at the rim. `None` if they meet inside of the image of size `size` (width, height), or farther outside than
/// traced edges may be.
pub(super) fn outside_corner(
    one: &[[f64; 2]],
    other: &[[f64; 2]],
    size: [usize; 2],
) -> Option<[f64; 2]> {
    let point = meeting(one, other, CUT_END_LENGTH_SHARE)?;
    let reach = MAX_TRACING_ERROR * (size[0] as f64).hypot(size[1] as f64);
    (is_outside(point, size, 0.0) && !is_outside(point, size, reach)).then_some(point)
}

/// Whether a point is outside of an image of size `size` (width, height) by more than `distance` pixels.
pub(super) fn is_outside(point: [f64; 2], size: [usize; 2], distance: f64) -> bool {
    (0..2).any(|k| point[k] < -distance || point[k] > size[k] as f64 - 1.0 + distance)
}

/// Finds the corner where two edges' extensions meet: straight lines fitted to the first share `end` of their points, which begin
/// at that corner. None if they meet far from either edge's start.
pub(super) fn meeting(one: &[[f64; 2]], other: &[[f64; 2]], end: f64) -> Option<[f64; 2]> {
    let point = line_intersection(end_line(one, end)?, end_line(other, end)?, MIN_CORNER_SINE)?;
    let near =
        |edge: &[[f64; 2]]| distance(edge[0], point) <= MAX_CORNER_SHIFT * polyline_length(edge);
    (near(one) && near(other)).then_some(point)
}

/// Makes an edge begin at a corner: replaces the worn points at its start, and those beyond the corner, by the corner.
/// `edge` begins at that end.
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

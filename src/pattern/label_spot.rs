//! Finds a place for the label of each patch on a sheet.

use super::sheets::Spot;
use crate::math::planar::distance_to_segment;
use crate::unroll::border;
use crate::unroll::flat_triangle::Point;
use rustc_hash::FxHashSet;

/// Maximum number of points of a patch that are compared as the place of its label.
const MAX_LABEL_CANDIDATES: usize = 200;

/// Finds a place for a patch's number: of the centroids of its triangles and the midpoints of its inner edges that which is
/// farthest from its border.
pub(super) fn label_spot(patch: u32, triangles: &[[u32; 3]], places: &[Point]) -> Spot {
    let outer: FxHashSet<[u32; 2]> = border(triangles).collect();
    let edges = outer.iter().map(|ends| ends.map(|v| places[v as usize]));
    let edges: Vec<[Point; 2]> = edges.collect();
    let mean = |vertices: &[u32]| {
        let sum = vertices.iter().map(|v| places[*v as usize]).sum::<Point>();
        sum / vertices.len() as f64
    };
    let sides = |[a, b, c]: &[u32; 3]| [[*a, *b], [*b, *c], [*c, *a]];
    let inner = triangles.iter().flat_map(sides);
    let inner = inner.filter(|ends| ends[0] < ends[1] && !outer.contains(ends));
    let middles = triangles.iter().map(|corners| mean(corners));
    let all: Vec<Point> = middles.chain(inner.map(|ends| mean(&ends))).collect();
    let tried = (all.iter()).step_by(all.len().div_ceil(MAX_LABEL_CANDIDATES).max(1));
    let spots = tried.map(|place| {
        let away = edges.iter().map(|ends| distance_to_segment(*place, *ends));
        (away.fold(f64::INFINITY, f64::min), *place)
    });
    let best = spots.max_by(|a, b| a.0.total_cmp(&b.0));
    let (room, place) = best.unwrap_or_default();
    Spot {
        patch,
        place: [place.re, place.im],
        room,
    }
}

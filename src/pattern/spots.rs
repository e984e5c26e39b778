//! Finds a place for the label of each patch on a sheet.

use super::sheets::Spot;
use crate::math::planar::distance_to_segment;
use crate::unroll::border;
use crate::unroll::flat_triangle::Point;

/// Maximum number of triangles of a part that are compared as the place of its label.
const MAX_LABEL_CANDIDATES: usize = 200;

/// Finds a place for a patch's number: the centroid of one of its triangles, far from its border.
pub(super) fn label_spot(patch: u32, triangles: &[[u32; 3]], places: &[Point]) -> Spot {
    let edges: Vec<[Point; 2]> = border(triangles)
        .map(|ends| ends.map(|v| places[v as usize]))
        .collect();
    let tried = (triangles.iter()).step_by(triangles.len().div_ceil(MAX_LABEL_CANDIDATES).max(1));
    let spots = tried.map(|corners| {
        let middle = corners.iter().map(|v| places[*v as usize]).sum::<Point>() / 3.0;
        let away = edges.iter().map(|ends| distance_to_segment(middle, *ends));
        (away.fold(f64::INFINITY, f64::min), middle)
    });
    let best = spots.max_by(|a, b| a.0.total_cmp(&b.0));
    let (room, place) = best.unwrap_or_default();
    Spot {
        patch,
        place: [place.re, place.im],
        room,
    }
}

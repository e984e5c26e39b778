//! Outlines of candidate pages: their edges traced with subpixel accuracy, their corners, and their scores.

use super::corners::{
    CUT_END_LENGTH_SHARE, END_LENGTH_SHARE, end_at, is_outside, meeting, outside_corner,
};
use super::covered::seen_points;
use super::edge_path::EdgePath;
use super::outline_report::{OutlineReason, PageOutline};
use super::planes::{Planes, RIM_PIXELS};
use super::views::View;
use crate::math::planar::distance;
use crate::page::corners::is_convex;

/// Minimum share of an edge with visible contrast; below it the outline is reported as having a faint edge.
const MIN_EDGE_SUPPORT: f64 = 0.85;

/// Minimum share of an edge's points at which page and background are both in the photo, for the edge to count as
/// visible.
pub(super) const MIN_VISIBLE_SHARE: f64 = 0.5;

/// Distance of a corner outside of the photo that is not reported, as a share of the photo's longer side.
/// Its row: `benches/page.md`, One rule at a time.
const MAX_OUTSIDE_SHARE: f64 = 0.01;

/// Spacing of the points of a traced edge, in pixels of the reduced photo.
/// Its row: `benches/page.md`, One rule at a time.
const POINT_DISTANCE: usize = 3;

/// Every third point of a traced edge, and its last one, in pixels of the photo; `raw` is the reduced photo.
pub(super) fn thinned(edge: &[[f64; 2]], raw: &Planes) -> Vec<[f64; 2]> {
    let last = edge.len() - 1;
    (0..last)
        .step_by(POINT_DISTANCE)
        .filter(|i| *i == 0 || distance(edge[*i], edge[last]) > 1.0)
        .chain([last])
        .map(|i| raw.to_photo(edge[i]))
        .collect()
}

/// Extrapolates the corners that the rim of an image of size `size` cuts off, and removes from the arcs next to them
/// the parts along the rim. None for a corner that is not cut off.
fn cut_corners(arcs: &mut [Vec<[f64; 2]>; 4], size: [usize; 2]) -> [Option<[f64; 2]>; 4] {
    [0, 1, 2, 3].map(|k| {
        let before = (k + 3) % 4;
        let mut one = arcs[before].clone();
        one.reverse();
        let other = &arcs[k];
        let cuts = [&one, other].map(|arc| {
            let is_at_rim = |p: &&[f64; 2]| is_outside(**p, size, -RIM_PIXELS);
            arc.iter().take_while(is_at_rim).count()
        });
        if cuts == [0, 0] || cuts[0] == one.len() || cuts[1] == other.len() {
            return None;
        }
        let corner = outside_corner(&one[cuts[0]..], &other[cuts[1]..], size)?;
        let kept = one.len() - cuts[0];
        arcs[before].truncate(kept);
        arcs[k].drain(..cuts[1]);
        Some(corner)
    })
}

/// Traces the outline of a candidate page in a view of a photo; its border is given as four arcs in pixels of the reduced
/// photo, clockwise, with the score `likeness` of its region. `None` if an edge is too short, or too few edges are visible.
pub(super) fn traced(
    view: &View<'_>,
    mut arcs: [Vec<[f64; 2]>; 4],
    likeness: f64,
) -> Option<PageOutline> {
    let size = [view.raw.width, view.raw.height];
    let cut = cut_corners(&mut arcs, size);
    let paths: Option<Vec<EdgePath>> = arcs.iter().map(|arc| EdgePath::new(view, arc)).collect();
    let paths = paths?;
    let visible: Vec<&EdgePath> = (paths.iter())
        .filter(|path| path.visible >= MIN_VISIBLE_SHARE)
        .collect();
    if visible.len() < view.min_visible_edges {
        return None;
    }
    let support = (visible.iter())
        .map(|path| path.support)
        .fold(1.0, f64::min);
    let mut edges: Vec<Vec<[f64; 2]>> = paths.iter().map(|path| path.points.clone()).collect();
    let ends = [0, 1, 2, 3].map(|k| edges[k][0]);
    let diagonal = distance(ends[0], ends[2]).max(distance(ends[1], ends[3]));
    let seen = match support < MIN_EDGE_SUPPORT {
        // Kinks of an edge that is hardly seen are none of the paper's.
        true => edges.iter().map(|edge| vec![true; edge.len()]).collect(),
        false => seen_points(&edges, diagonal),
    };
    for (edge, seen) in edges.iter_mut().zip(&seen) {
        let mut is_seen = seen.iter();
        edge.retain(|_| is_seen.next() == Some(&true));
    }
    let mut corners = [[0.0; 2]; 4];
    let (mut is_corner_outside, mut is_corner_covered) = (false, false);
    for k in 0..4 {
        let before = (k + 3) % 4;
        let [mut one, mut other] = [edges[before].clone(), edges[k].clone()];
        one.reverse();
        let (a, b) = (one[0], other[0]);
        let is_covered = !(seen[before].ends_with(&[true]) && seen[k].starts_with(&[true]));
        is_corner_covered |= is_covered;
        let exact = match cut[k] {
            Some(_) => outside_corner(&one, &other, size).or(cut[k]),
            None if is_covered => meeting(&one, &other, CUT_END_LENGTH_SHARE),
            None => meeting(&one, &other, END_LENGTH_SHARE),
        };
        corners[k] = exact.unwrap_or_else(|| [0, 1].map(|j| 0.5 * (a[j] + b[j])));
        end_at(&mut one, corners[k]);
        end_at(&mut other, corners[k]);
        one.reverse();
        edges[before] = one;
        edges[k] = other;
        let limit = MAX_OUTSIDE_SHARE * view.raw.longer_side();
        is_corner_outside |= is_outside(corners[k], size, limit);
    }
    let reasons = [
        (OutlineReason::CornerOutside, is_corner_outside),
        (OutlineReason::CornerCovered, is_corner_covered),
        (OutlineReason::EdgeOutside, visible.len() < 4),
        (OutlineReason::UnlikelyShape, !is_convex(&corners)),
        (OutlineReason::FaintEdge, support < MIN_EDGE_SUPPORT),
    ];
    let seen_share = paths.iter().map(|path| path.visible).sum::<f64>() / 4.0;
    let contrast = (visible.iter())
        .map(|path| path.contrast_score())
        .product::<f64>()
        .sqrt()
        .sqrt();
    let mut edges = edges.iter().map(|edge| thinned(edge, view.raw));
    let edges = [edges.next()?, edges.next()?, edges.next()?, edges.next()?];
    Some(PageOutline {
        corners: corners.map(|corner| view.raw.to_photo(corner)),
        edges,
        score: likeness * support * seen_share * contrast,
        reasons: (reasons.into_iter())
            .filter_map(|(reason, holds)| holds.then_some(reason))
            .collect(),
    })
}

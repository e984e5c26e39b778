//! Edges of a page that are known by their two ends, traced in the photo between them.

use super::colour_model::ColourModel;
use super::corners::{END_LENGTH_SHARE, end_at, meeting};
use super::edge_path::EdgePath;
use super::planes::Planes;
use super::region::regions;
use super::search::{MIN_PHOTO_SIDE_PIXELS, SAME_CORNER_SHARE};
use super::tracing::{MIN_VISIBLE_SHARE, thinned};
use super::views::{View, Views};
use crate::dewarp::Photo;
use crate::math::planar::{distance, polygon_contains, polyline_length};
use crate::page::edges::{Edges, Trace};

/// Traces in a photo those edges of pages that are given by two points alone, the page's corners at their ends. The edge
/// between them may be bent: its first guess is the border of what has the colours of the page between the corners. A corner
/// is moved to where two traced edges meet nearby.
///
/// An edge that the photo hardly shows stays as it is, with two points, and so does each edge that has more. Costs one pass
/// over the photo, and none if no edge has two points.
pub fn trace_edges(photo: &Photo<'_>, pages: &[Edges]) -> Vec<Edges> {
    let all_traces = || pages.iter().flat_map(Edges::traces);
    if !all_traces().any(Trace::has_ends_alone) {
        return pages.to_vec();
    }
    let views = Views::new(photo);
    if views.raw.width.min(views.raw.height) < MIN_PHOTO_SIDE_PIXELS {
        return pages.to_vec();
    }
    // Print hides paper, and its removal ground beside it: borders are taken of both.
    let view = views.without_print();
    let raw_half = views.raw.halved();
    let models = [&raw_half, &view.half].map(|half| (half, ColourModel::new(half)));
    let traced = |page: &Edges| {
        let borders: Vec<Vec<[f64; 2]>> = (models.iter())
            .flat_map(|(half, model)| page_borders(half, model, &quadrilateral(page)))
            .collect();
        let mut corners = quadrilateral(page).map(|corner| views.raw.reduced_point(corner));
        let sides = (page.sides()).map(|side| side.is_some_and(Trace::has_ends_alone));
        let paths = [0, 1, 2, 3].map(|k| {
            let ends = [corners[k], corners[(k + 1) % 4]];
            sides[k].then(|| edge_between(&view, &borders, ends))?
        });
        for k in 0..4 {
            let before = (k + 3) % 4;
            if let (Some(one), Some(other)) = (&paths[before], &paths[k]) {
                let mut one = one.clone();
                one.reverse();
                corners[k] = meeting(&one, other, END_LENGTH_SHARE)
                    .filter(|found| distance(*found, corners[k]) <= end_tolerance(&views.raw))
                    .unwrap_or(corners[k]);
            }
        }
        let mut page = page.clone();
        let traces = page.sides_mut().into_iter().zip(paths).enumerate();
        for (k, (trace, path)) in traces {
            if let (Some(trace), Some(mut edge)) = (trace, path) {
                end_at(&mut edge, corners[k]);
                edge.reverse();
                end_at(&mut edge, corners[(k + 1) % 4]);
                if k < 2 {
                    edge.reverse();
                }
                *trace = Trace::Points(thinned(&edge, &views.raw));
            }
        }
        page
    };
    pages.iter().map(traced).collect()
}

/// Finds borders of what has the colours of a page in a photo at half resolution: the page has those between its corners, and
/// the ground the others. The second border is that of a mask from which the colours were counted anew. Both in pixels of the
/// reduced photo.
fn page_borders(
    half: &Planes,
    model: &ColourModel,
    corners: &[[f64; 2]; 4],
) -> impl Iterator<Item = Vec<[f64; 2]>> + use<> {
    let width = half.width;
    let corners = corners.map(|corner| half.reduced_point(corner));
    let place = |i: usize| [i % width, i / width].map(|n| n as f64);
    let is_inside: Vec<bool> = (0..half.len())
        .map(|i| polygon_contains(&corners, place(i)))
        .collect();
    let pixels = |inside: bool| {
        let is_inside = &is_inside;
        (0..half.len()).filter(move |i| is_inside[*i] == inside)
    };
    let first = model.classify(pixels(true), pixels(false));
    let refined = model.refine(&first);
    [first, refined].into_iter().filter_map(move |mask| {
        let largest = (regions(&mask, width, 1).into_iter()).max_by_key(|region| region.area)?;
        let border = largest.border(width).into_iter();
        Some(border.map(|p| p.map(|at| 2.0 * at + 0.5)).collect())
    })
}

/// Corners of a page, clockwise from the upper left one: the ends of two of its edges that face each other.
fn quadrilateral(page: &Edges) -> [[f64; 2]; 4] {
    let ends = |trace: Option<&Trace>| {
        let (Trace::Points(points) | Trace::Beziers(points)) = trace?;
        Some([*points.first()?, *points.last()?])
    };
    let [top, right, bottom, left] = page.sides().map(ends);
    match (top.zip(bottom), left.zip(right)) {
        (Some(([a, b], [d, c])), _) | (None, Some(([a, d], [b, c]))) => [a, b, c, d],
        _ => [[0.0; 2]; 4],
    }
}

/// Maximum distance of a page's border from a given end of its edge, in pixels of the reduced photo.
fn end_tolerance(raw: &Planes) -> f64 {
    SAME_CORNER_SHARE * raw.longer_side()
}

/// Finds the clearest edge between two ends, clockwise around the page: beside the straight line, or beside a border that
/// passes both ends. None if none is visible along half of its length.
fn edge_between(
    view: &View<'_>,
    borders: &[Vec<[f64; 2]>],
    ends: [[f64; 2]; 2],
) -> Option<Vec<[f64; 2]>> {
    let tolerance = end_tolerance(view.raw);
    let beside_borders = (borders.iter()).filter_map(|border| arc_between(border, ends, tolerance));
    let path = std::iter::once(ends.to_vec())
        .chain(beside_borders)
        .filter_map(|guide| EdgePath::new(view, &guide))
        .filter(|path| path.visible * path.support >= MIN_VISIBLE_SHARE)
        .max_by(|one, other| one.clarity().total_cmp(&other.clarity()))?;
    Some(path.points)
}

/// The shorter arc of a closed border from one point to another, moved so that it begins and ends there. None if it passes
/// either at more than the distance `tolerance`, or is too long for an edge.
fn arc_between(border: &[[f64; 2]], ends: [[f64; 2]; 2], tolerance: f64) -> Option<Vec<[f64; 2]>> {
    let nearest = |end: [f64; 2]| {
        let distances = border.iter().map(|p| distance(*p, end)).enumerate();
        distances.min_by(|one, other| one.1.total_cmp(&other.1))
    };
    let [(from, off), (to, other_off)] = [nearest(ends[0])?, nearest(ends[1])?];
    if off.max(other_off) > tolerance {
        return None;
    }
    let n = border.len();
    let forward = |from: usize, to: usize| -> Vec<[f64; 2]> {
        let steps = (to + n - from) % n;
        (0..=steps).map(|k| border[(from + k) % n]).collect()
    };
    let mut back = forward(to, from);
    back.reverse();
    let arc = [forward(from, to), back].into_iter().min_by_key(Vec::len)?;
    let last = arc.len() - 1;
    let moved: Vec<[f64; 2]> = (arc.iter().enumerate())
        .map(|(i, p)| {
            let t = i as f64 / last.max(1) as f64;
            [0, 1].map(|k| {
                p[k] + (1.0 - t) * (ends[0][k] - arc[0][k]) + t * (ends[1][k] - arc[last][k])
            })
        })
        .collect();
    // Every fourth point, so that the stairs of the pixels do not count.
    let coarse: Vec<[f64; 2]> = moved
        .iter()
        .step_by(4)
        .chain(moved.last())
        .copied()
        .collect();
    // At most a half circle.
    let limit = std::f64::consts::FRAC_PI_2 * distance(ends[0], ends[1]);
    (polyline_length(&coarse) <= limit).then_some(moved)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn corners_are_clockwise_whichever_edges_are_given() {
        let corners @ [a, b, c, d] = [[0.0, 0.0], [4.0, 1.0], [5.0, 6.0], [1.0, 7.0]];
        let trace = |from, to| Trace::Points(vec![from, to]);
        let [top, bottom, left, right] = [trace(a, b), trace(d, c), trace(a, d), trace(b, c)];
        let upright = Edges::LeftRight {
            left: left.clone(),
            right: right.clone(),
        };
        assert_eq!(quadrilateral(&upright), corners);
        let all = Edges::All {
            top,
            bottom,
            left,
            right,
        };
        assert_eq!(quadrilateral(&all), corners);
    }
}

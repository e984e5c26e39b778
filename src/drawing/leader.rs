//! Places the number of a small patch beside its sheet, with a leader line to the patch.

use super::curve::Curve;
use super::label::{Label, TEXT_SIZE_MM};
use super::line::Wall;
use crate::math::planar::{distance, distance_to_segment};

/// Number of directions in which a leader line from a small patch to its number is tried, evenly spaced over a full
/// turn.
const LEADER_DIRECTIONS: u32 = 24;

/// Moves the label of a small patch beside the sheet, in the direction in which the leader line (from patch to label)
/// leaves the sheet after the shortest distance and crosses nothing else. Returns the label and the leader line; `None`
/// if there is no such direction.
pub(super) fn place_leader(
    label: &Label,
    walls: &[Wall],
    others: &[Label],
) -> Option<(Label, Curve)> {
    let from = label.place;
    let ways = (0..LEADER_DIRECTIONS).filter_map(|k| {
        let (sin, cos) =
            (std::f64::consts::TAU * f64::from(k) / f64::from(LEADER_DIRECTIONS)).sin_cos();
        let at = |d: f64| [from[0] + d * cos, from[1] + d * sin];
        let mut hits: Vec<f64> = walls
            .iter()
            .filter_map(|w| hit(from, [cos, sin], *w))
            .collect();
        hits.sort_by(f64::total_cmp);
        let edge = *hits.first()?;
        // The ray leaves the sheet at its first intersection; the next one must be far away.
        let next = hits
            .get(1)
            .is_none_or(|next| *next > edge + 4.0 * TEXT_SIZE_MM);
        let place = at(edge + 2.0 * TEXT_SIZE_MM);
        let free = walls.iter().all(|[p, q]| {
            let middle = [0, 1].map(|k| 0.5 * (p[k] + q[k]));
            distance(middle, place) > 1.5 * TEXT_SIZE_MM + 0.5 * distance(*p, *q)
                || distance_to_segment(place, [*p, *q]) > TEXT_SIZE_MM
        });
        let apart = others
            .iter()
            .all(|other| distance(other.place, place) > 5.0);
        (next && free && apart).then(|| (edge, place, at(edge + TEXT_SIZE_MM)))
    });
    let (_, place, end) = ways.min_by(|a, b| a.0.total_cmp(&b.0))?;
    Some((label.clone().outside(place), Curve::through(&[from, end])))
}

/// Computes the distance from the start of a ray to the ray's intersection with a line segment; `None` if they do not
/// meet.
fn hit(from: [f64; 2], [x, y]: [f64; 2], [p, q]: Wall) -> Option<f64> {
    let side = |r: [f64; 2]| x * (r[1] - from[1]) - y * (r[0] - from[0]);
    let (a, b) = (side(p), side(q));
    if (a > 0.0) == (b > 0.0) {
        return None;
    }
    let t = a / (a - b);
    let place = [0, 1].map(|k| p[k] + t * (q[k] - p[k]));
    let along = x * (place[0] - from[0]) + y * (place[1] - from[1]);
    (along > 0.0).then_some(along)
}

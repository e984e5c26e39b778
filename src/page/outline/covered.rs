//! Stretches of a page's edges that are covered, folded over or torn off, so that what borders the page there is not its edge.

use std::f64::consts::PI;

use crate::math::planar::{cross, difference};

/// Length, as a share of the page's diagonal, over which an edge's direction is measured on both sides of a point.
/// Its row: `benches/outline.md`, Covered corners.
const ARM_SHARE: f64 = 0.03;

/// Change of direction, in radians, above which an edge has a kink.
/// Its row: `benches/outline.md`, Covered corners.
const MIN_KINK_ANGLE: f64 = 0.1 * PI;

/// Length, as a share of the page's diagonal, of the shortest stretch between kinks that is taken for paper: folds are farther
/// apart than what covers a corner is wide.
/// Its row: `benches/outline.md`, Covered corners.
const MIN_STRETCH_SHARE: f64 = 0.2;

/// Share of a page's outline that may be covered; where more has kinks, or half of an edge, the paper is crumpled, and all of it is
/// the page's.
/// Its row: `benches/outline.md`, Covered corners.
const MAX_COVERED_SHARE: f64 = 0.2;

/// Whether each point of a page's edges is the page's own: neither in a short stretch between kinks, or between a kink and a
/// corner, nor beside one. `edges` are clockwise points about one pixel apart, `diagonal` is the page's in pixels.
pub(super) fn seen_points(edges: &[Vec<[f64; 2]>], diagonal: f64) -> Vec<Vec<bool>> {
    let seen: Vec<Vec<bool>> = (edges.iter())
        .map(|edge| seen_along(edge, diagonal))
        .collect();
    let covered: Vec<usize> = (seen.iter())
        .map(|own| own.iter().filter(|is_seen| !**is_seen).count())
        .collect();
    let total: usize = edges.iter().map(Vec::len).sum();
    let is_mostly_covered = |(covered, edge): (&usize, &Vec<_>)| 2 * covered > edge.len();
    if covered.iter().sum::<usize>() as f64 > MAX_COVERED_SHARE * total as f64
        || covered.iter().zip(edges).any(is_mostly_covered)
    {
        return edges.iter().map(|edge| vec![true; edge.len()]).collect();
    }
    seen
}

/// Whether each point of one edge is the page's own. Between edges that are seen the outline of paper turns inwards once more
/// than it does at their corner where a corner is missing, and so do things that stick out; folds near a corner may turn it outwards.
fn seen_along(edge: &[[f64; 2]], diagonal: f64) -> Vec<bool> {
    let last = edge.len() - 1;
    let arm = (ARM_SHARE * diagonal) as usize;
    let mut ends = vec![(0, 0.0)];
    ends.extend(kinks(edge, arm));
    ends.push((last, 0.0));
    let length = |pair: &[(usize, f64)]| pair[1].0 - pair[0].0;
    let longest = ends.windows(2).map(length).max();
    let is_paper = |pair: &[(usize, f64)]| {
        Some(length(pair)) == longest || length(pair) as f64 >= MIN_STRETCH_SHARE * diagonal
    };
    let stretches: Vec<&[(usize, f64)]> = ends.windows(2).collect();
    let mut seen = vec![true; edge.len()];
    for run in stretches.chunk_by(|one, other| is_paper(one) == is_paper(other)) {
        let turns_inwards = run.iter().copied().flatten().any(|(_, angle)| *angle > 0.0);
        if !is_paper(run[0]) && turns_inwards {
            let (from, to) = (run[0][0].0, run[run.len() - 1][1].0);
            let from = from.saturating_sub(arm);
            seen[from..=(to + arm).min(last)].fill(false);
        }
    }
    seen
}

/// An edge's kinks: the points at which it turns most of those where it turns by more than what is smooth, and the angles there,
/// positive where paper is convex.
fn kinks(edge: &[[f64; 2]], arm: usize) -> Vec<(usize, f64)> {
    let last = edge.len() - 1;
    let turn = |i: usize| {
        // Nearer to an end there is less of the edge.
        let arm = arm.min(i).min(last - i);
        let [before, after] = [i - arm, i].map(|from| difference(edge[from], edge[from + arm]));
        cross(before, after).atan2(before[0] * after[0] + before[1] * after[1])
    };
    let sharp: Vec<(usize, f64)> = (arm / 3..edge.len().saturating_sub(arm / 3))
        .map(|i| (i, turn(i)))
        .filter(|(_, angle)| angle.abs() > MIN_KINK_ANGLE)
        .collect();
    (sharp.chunk_by(|one, other| one.0 + 1 == other.0 && one.1 * other.1 > 0.0))
        .filter_map(|run| {
            run.iter()
                .max_by(|one, other| one.1.abs().total_cmp(&other.1.abs()))
        })
        .copied()
        .collect()
}

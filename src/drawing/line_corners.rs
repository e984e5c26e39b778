//! Samples a line, and finds its corners.

use crate::unroll::flat_triangle::Point;

/// Minimum angle of a corner of an outline, in radians: between the line's directions before and after it.
/// `benches/patterns.md` has what others give.
pub(super) const CORNER_ANGLE: f64 = 0.44;

/// Length of an outline before and after a corner, in lattice spacings, over which the corner's angle is measured.
/// `benches/patterns.md` has what others give.
const CORNER_ARM_SPACINGS: f64 = 4.0;

/// Minimum share of a corner's angle that remains when it is measured over half the length before and after it; at a
/// smooth bend half of the angle remains.
const CORNER_CONCENTRATION: f64 = 0.62;

/// Minimum length of an outline's piece that is smoothed, in lattice spacings.
/// `benches/patterns.md` has what others give.
pub(super) const MIN_SMOOTHED_LENGTH_SPACINGS: f64 = 3.0;

/// A sample point of a line that is smoothed: its position, its distance along the line, and whether it is one of the
/// line's given points.
#[derive(Clone, Copy)]
pub(super) struct Sample {
    pub along: f64,
    pub place: Point,
    pub given: bool,
}

/// Samples a polyline at most `step` apart; its given points are among the samples.
pub(super) fn samples(points: &[[f64; 2]], step: f64) -> Vec<Sample> {
    let at = |[x, y]: [f64; 2]| Point::new(x, y);
    let mut along = 0.0;
    let mut out = vec![Sample {
        along,
        place: at(points[0]),
        given: true,
    }];
    for p in points.windows(2) {
        let (from, to) = (at(p[0]), at(p[1]));
        let long = (to - from).norm();
        if long == 0.0 {
            continue;
        }
        let steps = (long / step).ceil().max(1.0) as usize;
        out.extend((1..=steps).map(|i| {
            let share = i as f64 / steps as f64;
            let place = if i == steps {
                to
            } else {
                from + (to - from) * share
            };
            Sample {
                along: along + share * long,
                place,
                given: i == steps,
            }
        }));
        along += long;
    }
    out
}

/// Rotates the list of a closed line's samples so that it begins at sample `first`.
pub(super) fn rotated(line: &[Sample], first: usize) -> Vec<Sample> {
    let last = line.len() - 1;
    let whole = line[last].along;
    let start = line[first].along;
    let shifted = |s: &Sample, by: f64| Sample {
        along: s.along - start + by,
        ..*s
    };
    let before = line[first..].iter().map(|s| shifted(s, 0.0));
    before
        .chain(line[1..=first].iter().map(|s| shifted(s, whole)))
        .collect()
}

/// Finds the samples at corners of a line; returns their indices, ascending, without the ends of an open line.
pub(super) fn corners(line: &[Sample], closed: bool, spacing: f64) -> Vec<usize> {
    let last = line.len() - 1;
    let whole = line[last].along;
    let turn = |i: usize, arm: f64| turning_angle(line, i, arm, closed);
    let end = |i: usize| {
        !closed
            && (line[i].along < 0.5 * MIN_SMOOTHED_LENGTH_SPACINGS * spacing
                || whole - line[i].along < 0.5 * MIN_SMOOTHED_LENGTH_SPACINGS * spacing)
    };
    let turns: Vec<f64> = (0..last)
        .map(|i| {
            if end(i) {
                0.0
            } else {
                turn(i, CORNER_ARM_SPACINGS * spacing)
            }
        })
        .collect();
    let apart = |i: usize, k: usize| distance_along(line, i, k, closed);
    let mut order: Vec<usize> = (0..last).filter(|i| turns[*i] > CORNER_ANGLE).collect();
    order.sort_by(|a, b| turns[*b].total_cmp(&turns[*a]));
    let mut found: Vec<usize> = Vec::new();
    for i in order {
        if found
            .iter()
            .any(|k| apart(i, *k) < 0.75 * CORNER_ARM_SPACINGS * spacing)
        {
            continue;
        }
        // Corners are given points of the line.
        let near = (0..last).filter(|k| line[*k].given && !end(*k) && apart(i, *k) < spacing);
        let corner = near
            .max_by(|a, b| turns[*a].total_cmp(&turns[*b]))
            .unwrap_or(i);
        if turn(corner, 0.5 * CORNER_ARM_SPACINGS * spacing) > CORNER_CONCENTRATION * turns[i] {
            found.push(corner);
        }
    }
    found.sort_unstable();
    found.dedup();
    found
}

/// Computes the distance between two samples along a line, the shorter way around if it is closed.
pub(super) fn distance_along(line: &[Sample], i: usize, k: usize, closed: bool) -> f64 {
    let distance = (line[i].along - line[k].along).abs();
    match closed {
        true => distance.min(line[line.len() - 1].along - distance),
        false => distance,
    }
}

/// Computes the angle between a line's directions before and after one of its samples, each over the length `arm`.
pub(super) fn turning_angle(line: &[Sample], i: usize, arm: f64, closed: bool) -> f64 {
    let [back, on] = [-1.0, 1.0].map(|way| heading(line, i, way * arm, closed));
    match (back, on) {
        (Some(back), Some(on)) => ((-back).conj() * on).arg().abs(),
        _ => 0.0,
    }
}

/// Computes the direction of a line after one of its samples, or before it for a negative `arm`: that of the
/// least-squares line through the samples within the length `arm`.
fn heading(line: &[Sample], i: usize, arm: f64, closed: bool) -> Option<Point> {
    let last = line.len() - 1;
    let whole = line[last].along;
    let step = if arm > 0.0 { 1 } else { last - 1 };
    let mut count = 0.0;
    let (mut s1, mut s2, mut p1, mut sp) = (0.0, 0.0, Point::new(0.0, 0.0), Point::new(0.0, 0.0));
    let mut k = i;
    for _ in 0..last {
        let mut s = line[k].along - line[i].along;
        if closed && s * arm < 0.0 {
            s += whole * arm.signum();
        }
        if s.abs() > arm.abs() || (!closed && s * arm < 0.0) {
            break;
        }
        let place = line[k].place;
        (count, s1, s2, p1, sp) = (count + 1.0, s1 + s, s2 + s * s, p1 + place, sp + place * s);
        if !closed && ((arm > 0.0 && k == last) || (arm < 0.0 && k == 0)) {
            break;
        }
        k = match closed {
            true => (k + step) % last,
            false if arm > 0.0 => k + 1,
            false => k - 1,
        };
    }
    let spread = s2 - s1 * s1 / count;
    (count > 2.0 && spread > 0.0).then(|| (sp - p1 * (s1 / count)) * arm.signum())
}

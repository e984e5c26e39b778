//! The shape of one tab, and what is in its way.

use std::f64::consts::{FRAC_PI_2, TAU};

use super::curve::CIRCLE_TOLERANCE_MM;
use super::line::Wall;
use crate::math::planar::{
    bounds, distance, distance_to_segment, is_within, orientation, segments_intersect,
};

/// Inset of a tab's end, as a share of the length of its fold line, from which on the end is steeper than 45° if it has the room.
/// `benches/patterns.md` has what others give.
const STEEP_TAB_INSET_SHARE: f64 = 0.3;

/// Minimum length of a tab's outer edge, as a share of the length of its fold line.
/// `benches/patterns.md` has what others give.
const MIN_TAB_TOP_SHARE: f64 = 0.1;

/// Angle, in radians, that a tab keeps from what is beside it in a notch, and below which two tabs beside each other are cut apart. `benches/patterns.md` has what others give.
const TAB_CLEARANCE_ANGLE: f64 = 0.02;

/// Maximum depth of a tab, as a multiple of the length of its fold line. `benches/patterns.md` has what others give.
const MAX_TAB_DEPTH_SHARE: f64 = 1.5;

/// Distance, in millimetres, that a tab's end keeps from the bisector between it and the next tab, so that they do not
/// touch. `benches/patterns.md` has what others give.
const TAB_CLEARANCE_MM: f64 = 0.1;

/// Maximum number of times that the depth of a tab that does not fit is halved.
/// `benches/patterns.md` has what others give.
pub(super) const MAX_TAB_HALVINGS: usize = 3;

/// Lines that a tab must keep off.
pub(super) struct Surroundings<'a> {
    /// All outlines of the sheet that the tab is on.
    pub sheet: &'a [Wall],
    /// Lines of the outlines, and of the tabs so far, that the tab may reach.
    pub near: Vec<Wall>,
}

/// The walls that tabs along some lines may touch, divided where these lines end on them.
pub(super) fn walls_near(runs: &[Vec<[f64; 2]>], depth: f64, walls: &[Wall]) -> Vec<Wall> {
    let [low, high] = bounds(runs.iter().flatten());
    let is_near = |[a, b]: &&Wall| {
        (0..2).all(|k| a[k].max(b[k]) >= low[k] - depth && a[k].min(b[k]) <= high[k] + depth)
    };
    let mut near: Vec<Wall> = walls.iter().filter(is_near).copied().collect();
    for end in runs.iter().flat_map(|run| [run[0], run[run.len() - 1]]) {
        for k in 0..near.len() {
            let [from, to] = near[k];
            if is_on(end, near[k]) && !same(from, end) && !same(to, end) {
                near[k] = [from, end];
                near.push([end, to]);
            }
        }
    }
    near
}

/// Computes the depth and the outer corners of a tab to the right of its fold line; `None` if the fold line is too short or
/// something is in the way. At an end of a run the tab is cut at 45°, or as far as what is beside it there leaves room; where the
/// next tab follows it is cut along the bisector if the two would overlap, and otherwise at a right angle. It is less deep where
/// its ends would meet.
pub(super) fn flap(
    base: &[[f64; 2]],
    turns: [Option<f64>; 2],
    depth: f64,
    around: &Surroundings<'_>,
) -> Option<(f64, [[f64; 2]; 2])> {
    let (from, to) = (base[0], base[base.len() - 1]);
    let long = distance(from, to);
    if long * MAX_TAB_DEPTH_SHARE < depth || long == 0.0 {
        return None;
    }
    let steepest = STEEP_TAB_INSET_SHARE * long;
    let notches = notches(base, &around.near);
    // The inset of each end: a multiple of the depth, and a length.
    let ends = [0, 1].map(|end| match turns[end] {
        None => {
            let room = (notches[end] - TAB_CLEARANCE_ANGLE).clamp(1e-9, FRAC_PI_2);
            [room.tan().recip().max((steepest / depth).min(1.0)), 0.0]
        }
        Some(turn) if turn < TAB_CLEARANCE_ANGLE => {
            let bisector = (-0.5 * turn).tan().max(0.0);
            match bisector * depth + TAB_CLEARANCE_MM < steepest {
                true => [bisector, TAB_CLEARANCE_MM],
                false => [0.0, steepest],
            }
        }
        Some(_) => [0.0, 0.0],
    });
    let [sloped, fixed] = [0, 1].map(|k| ends[0][k] + ends[1][k]);
    let meeting = ((1.0 - MIN_TAB_TOP_SHARE) * long - fixed) / sloped;
    if meeting < depth / f64::from(1 << MAX_TAB_HALVINGS) {
        return None;
    }
    let depth = depth.min(meeting);
    let insets = ends.map(|[slope, fixed]| slope * depth + fixed);
    let along = [0, 1].map(|k| (to[k] - from[k]) / long);
    let beside = |s: f64| {
        [
            from[0] + along[0] * s + along[1] * depth,
            from[1] + along[1] * s - along[0] * depth,
        ]
    };
    let corners = [beside(insets[0]), beside(long - insets[1])];
    is_free(base, [from, corners[0], corners[1], to], around).then_some((depth, corners))
}

/// Whether nothing crosses a tab, is within it, or lies below it, as beside a slit whose two sides are one line.
fn is_free(base: &[[f64; 2]], line: [[f64; 2]; 4], around: &Surroundings<'_>) -> bool {
    let sides = [[0, 1], [1, 2], [2, 3], [3, 0]].map(|side| side.map(|k| line[k]));
    let is_beyond =
        |p: [f64; 2], side: Wall| orientation(side[0], side[1], p) <= 0.0 || is_on(p, side);
    let is_outside = |p: &[f64; 2]| {
        sides.iter().any(|side| is_beyond(*p, *side)) || base.iter().any(|own| same(*own, *p))
    };
    let is_kept_off = |wall: &Wall| {
        sides[..3].iter().all(|side| !crosses(*side, *wall)) && wall.iter().all(is_outside)
    };
    let outer = [0, 1].map(|k| 0.5 * (line[1][k] + line[2][k]));
    around.near.iter().all(is_kept_off) && !is_within(outer, around.sheet.iter().copied())
}

/// The angles, in radians, at both ends of a tab's fold line, on its outer side, within which nothing else begins.
fn notches(base: &[[f64; 2]], walls: &[Wall]) -> [f64; 2] {
    let last = base.len() - 1;
    [
        (base[0], base[1], base[last], -1.0),
        (base[last], base[last - 1], base[0], 1.0),
    ]
    .map(|(end, own, other, side)| {
        let angle = |p: [f64; 2]| (p[1] - end[1]).atan2(p[0] - end[0]);
        let beside = (walls.iter()).filter_map(|[a, b]| match (same(*a, end), same(*b, end)) {
            (true, false) => Some(*b),
            (false, true) => Some(*a),
            _ => None,
        });
        (beside.filter(|p| !same(*p, own)))
            .map(|p| (side * (angle(p) - angle(other))).rem_euclid(TAU))
            .fold(TAU, f64::min)
    })
}

/// Whether a point is on a line segment as far as a drawing tells.
fn is_on(p: [f64; 2], wall: Wall) -> bool {
    distance_to_segment(p, wall) < CIRCLE_TOLERANCE_MM
}

/// Whether two points are one as far as a drawing tells: numbers of 32 bits round by more than those of 64.
fn same(p: [f64; 2], q: [f64; 2]) -> bool {
    distance(p, q) < CIRCLE_TOLERANCE_MM
}

/// Returns whether two line segments cross, or touch elsewhere than at common ends.
fn crosses([a, b]: Wall, [c, d]: Wall) -> bool {
    if [a, b].iter().any(|p| same(*p, c) || same(*p, d)) {
        return false;
    }
    segments_intersect([a, b], [c, d])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drawing::line::walls_of;

    /// Walls that a tab may reach, of no sheet.
    fn beside_walls(walls: &[Wall]) -> Surroundings<'static> {
        Surroundings {
            sheet: &[],
            near: walls.to_vec(),
        }
    }

    #[test]
    fn a_tab_in_a_slit_keeps_within_it() {
        // The other side of the slit begins where the fold line does, and turns from it by 8°.
        let notch = 8f64.to_radians();
        let base = [[0.0, 0.0], [40.0, 0.0]];
        let side = [base[0], [40.0 * notch.cos(), -40.0 * notch.sin()]];
        let (depth, corners) = flap(&base, [None; 2], 6.0, &beside_walls(&[base, side])).unwrap();
        assert!(depth > 3.0 && depth < 6.0, "{depth}");
        for [x, y] in corners {
            assert!(
                (y + depth).abs() < 1e-12 && depth.atan2(x) < notch,
                "{x} {y}"
            );
        }
        // Where nothing is beside it, both ends are cut at 45°.
        let (depth, corners) = flap(&base, [None; 2], 6.0, &beside_walls(&[base])).unwrap();
        assert_eq!((depth, corners), (6.0, [[6.0, -6.0], [34.0, -6.0]]));
    }

    #[test]
    fn a_closed_slit_has_no_tab_though_its_sides_are_divided_differently() {
        // A square of 60 mm with a slit in it, whose lower side has a corner more; rounding moves it to either side of the upper one.
        for rounding in [-1e-13, 0.0, 1e-13] {
            let square = [
                [0.0, 0.0],
                [60.0, 0.0],
                [60.0, 60.0],
                [0.0, 60.0],
                [0.0, 0.0],
            ];
            let slit = [
                [10.0, 30.0],
                [50.0, 30.0],
                [30.0, 30.0 + rounding],
                [10.0, 30.0],
            ];
            let sheet: Vec<Wall> = [walls_of(&square), walls_of(&slit)].concat();
            let around = Surroundings {
                sheet: &sheet,
                near: sheet.clone(),
            };
            for base in [&slit[..2], &slit[1..3]] {
                assert!(
                    flap(base, [None; 2], 6.0, &around).is_none(),
                    "{rounding} {base:?}"
                );
            }
            // Along the border there is room.
            assert!(flap(&square[..2], [None; 2], 6.0, &around).is_some());
        }
    }

    #[test]
    fn a_tab_may_end_on_a_line_that_goes_on() {
        let base = [[0.0, 0.0], [40.0, 0.0]];
        let across = [[39.99999, -20.0], [39.99999, 20.0]];
        let near = walls_near(&[base.to_vec()], 6.0, &[base, across]);
        let (depth, corners) = flap(&base, [None; 2], 6.0, &beside_walls(&near)).unwrap();
        assert_eq!((depth, corners), (6.0, [[6.0, -6.0], [34.0, -6.0]]));
    }

    #[test]
    fn a_tab_is_not_put_around_what_is_smaller_than_it() {
        let base = [[0.0, 0.0], [40.0, 0.0]];
        let small = [[18.0, -2.0], [22.0, -2.0], [20.0, -4.0], [18.0, -2.0]];
        let around = beside_walls(
            &[base]
                .into_iter()
                .chain(walls_of(&small))
                .collect::<Vec<_>>(),
        );
        assert!(flap(&base, [None; 2], 6.0, &around).is_none());
        assert!(flap(&base, [None; 2], 1.5, &around).is_some());
    }
}

//! Adds tabs (glued flaps) along cut creases: trapezoids outside of the sheet, a comb of short ones along a curve.

use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::{FRAC_PI_2, TAU};

use super::curve::{CIRCLE_TOLERANCE_MM, Curve, MIN_CORNER_TURN};
use super::line::{FLATTENING_TOLERANCE_MM, place_at};
use crate::math::planar::{
    Point2, bounds, distance, distance_to_segment, is_within, orientation, polyline_length,
    segments_intersect,
};
use crate::pattern::{Run, Seam};

/// A tab (a glued flap at an edge), and the line that the tab is folded along.
pub(super) struct Tab {
    pub seam: Seam,
    /// Patch that the tab is on.
    pub patch: Option<u32>,
    /// Number of the run of the outlines that it is on.
    pub run: usize,
    /// Fold line between tab and sheet, in the direction of the outline.
    pub base: Curve,
    pub depth: f64,
    pub middle: [f64; 2],
}

/// Minimum length of a tab's fold line, in millimetres. `benches/patterns.md` has what others give.
const MIN_TAB_LENGTH_MM: f64 = 2.0;

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

/// Minimum length of tabs along a run, as a share of the greatest length that any depth allows, for a depth to be taken
/// for the whole run. `benches/patterns.md` has what others give.
const MIN_TABBED_SHARE: f64 = 0.9;

/// Maximum number of times that the depth of a tab that does not fit is halved.
/// `benches/patterns.md` has what others give.
const MAX_TAB_HALVINGS: usize = 3;

/// The closed outline of a sheet as a list of runs (pieces along one side of a crease or along the border), each with
/// its curve in millimetres.
type Outline<'a> = Vec<(&'a Run, Curve)>;

/// Both sides of each seam as polylines, by the number of its crease and of the patch that the side is on; `None` for a side that
/// is in several pieces.
pub(super) struct SeamSides(BTreeMap<(usize, Option<u32>), Option<Polyline>>);

type Polyline = Vec<[f64; 2]>;

/// A line segment that tabs and texts must not touch.
pub(super) type Wall = [[f64; 2]; 2];

/// Lines that a tab must keep off.
struct Surroundings<'a> {
    /// All outlines of the sheet that the tab is on.
    sheet: &'a [Wall],
    /// Lines of the outlines, and of the tabs so far, that the tab may reach.
    near: Vec<Wall>,
}

impl SeamSides {
    pub(super) fn new(outlines: &[&[Outline<'_>]]) -> Self {
        let mut sides = BTreeMap::new();
        for (run, curve) in outlines.iter().copied().flatten().flatten() {
            if let Some(seam) = run.seam {
                let points = Some(curve.points(FLATTENING_TOLERANCE_MM));
                sides
                    .entry((seam.crease, run.patch))
                    .and_modify(|side| *side = None)
                    .or_insert(points);
            }
        }
        SeamSides(sides)
    }

    /// The sides in one piece, each with the number of its crease.
    pub(super) fn whole(&self) -> impl Iterator<Item = (usize, &Polyline)> {
        let sides = self.0.iter();
        sides.filter_map(|((crease, _), side)| Some((*crease, side.as_ref()?)))
    }

    /// The side that a run is joined to, in the run's direction.
    fn beside(&self, run: &Run) -> Option<Polyline> {
        let seam = run.seam?;
        let patch = (seam.patches.into_iter()).find(|patch| run.patch != Some(*patch));
        let side = self.0.get(&(seam.crease, patch))?.as_ref()?;
        Some(side.iter().rev().copied().collect())
    }
}

/// Area of tabs along each crease, but for their cut ends, on the side of the patch with the lower number except for the `swapped` creases.
fn tabbed_areas(
    outlines: &[&[Outline<'_>]],
    depth: Option<f64>,
    swapped: &BTreeSet<usize>,
    sides: &SeamSides,
) -> BTreeMap<usize, f64> {
    let mut areas = BTreeMap::new();
    for outlines in outlines {
        for tab in add_tabs(outlines, depth, swapped, sides).1 {
            *areas.entry(tab.seam.crease).or_default() += tab.base.length() * tab.depth;
        }
    }
    areas
}

/// The creases whose tabs have more room on the side of the patch with the higher number; `outlines` are those of each
/// sheet.
pub(super) fn swapped_tabs(
    outlines: &[&[Outline<'_>]],
    depth: Option<f64>,
    sides: &SeamSides,
) -> BTreeSet<usize> {
    let first = tabbed_areas(outlines, depth, &BTreeSet::new(), sides);
    let area =
        |areas: &BTreeMap<usize, f64>, crease: &usize| areas.get(crease).copied().unwrap_or(0.0);
    let runs = outlines.iter().copied().flatten().flatten();
    let lacking: BTreeSet<usize> = runs
        .filter_map(|(run, curve)| {
            let crease = run.seam?.crease;
            let enough = MIN_TABBED_SHARE * curve.length() * depth?;
            (area(&first, &crease) < enough).then_some(crease)
        })
        .collect();
    let second = tabbed_areas(outlines, depth, &lacking, sides);
    let is_better = |crease: &usize| area(&second, crease) > area(&first, crease);
    lacking.into_iter().filter(is_better).collect()
}

/// Adds tabs (glued flaps) to the outlines of a sheet where there is room: on the side of the patch with the lower number,
/// of `swapped` creases on the other. Returns the cut lines and the tabs.
pub(super) fn add_tabs(
    outlines: &[Outline<'_>],
    depth: Option<f64>,
    swapped: &BTreeSet<usize>,
    sides: &SeamSides,
) -> (Vec<Curve>, Vec<Tab>) {
    let mut tabs = Vec::new();
    // The two sides of a step are not glued, so they have no tabs.
    let tabbed = |run: &Run| {
        let has_tab = |seam: &Seam| {
            let side = usize::from(swapped.contains(&seam.crease));
            run.patch == Some(seam.patches[side])
        };
        let own = run.seam.filter(has_tab);
        depth.zip(own)
    };
    let parts = |(run, curve): &(&Run, Curve)| match tabbed(run) {
        Some(_) => bases(curve, sides.beside(run).as_deref()),
        None => (vec![curve.clone()], Vec::new()),
    };
    let pieces: Vec<Vec<(Vec<Curve>, Vec<f64>)>> = (outlines.iter())
        .map(|outline| outline.iter().map(parts).collect())
        .collect();
    let sheet: Vec<Wall> = match depth {
        Some(_) => (pieces.iter().flatten().flat_map(|(bases, _)| bases))
            .flat_map(|base| walls_of(&base.points(FLATTENING_TOLERANCE_MM)))
            .collect(),
        None => Vec::new(),
    };
    let mut all_walls = sheet.clone();
    let mut cuts = Vec::new();
    let mut numbers = 0..;
    for (outline, pieces) in outlines.iter().zip(pieces) {
        let mut cut = Curve::of(Vec::new());
        for (((run, curve), (bases, turns)), number_of_run) in
            outline.iter().zip(pieces).zip(&mut numbers)
        {
            let Some((depth, seam)) = tabbed(run) else {
                cut.append(curve);
                continue;
            };
            let runs: Vec<Vec<[f64; 2]>> = (bases.iter())
                .map(|base| base.points(FLATTENING_TOLERANCE_MM))
                .collect();
            let around = |runs: &[Polyline], all_walls: &[Wall]| Surroundings {
                sheet: &sheet,
                near: walls_near(runs, depth, all_walls),
            };
            let own = common_depth(&runs, &turns, depth, &around(&runs, &all_walls));
            for (number, base) in bases.into_iter().enumerate() {
                let points = &runs[number];
                let ends = end_turns(&turns, number);
                let around = around(&runs[number..=number], &all_walls);
                let tab = (0..=MAX_TAB_HALVINGS)
                    .find_map(|k| flap(points, ends, own / f64::from(1 << k), &around));
                let Some((depth, flap)) = tab else {
                    cut.append(&base);
                    continue;
                };
                let line = [points[0], flap[0], flap[1], points[points.len() - 1]];
                all_walls.extend(walls_of(&line));
                tabs.push(Tab {
                    seam,
                    patch: run.patch,
                    run: number_of_run,
                    base,
                    depth,
                    middle: [0, 1].map(|k| line.iter().map(|c| c[k]).sum::<f64>() / 4.0),
                });
                cut.append(&Curve::through(&line));
            }
        }
        cuts.push(cut);
    }
    (cuts, tabs)
}

pub(super) fn walls_of(line: &[[f64; 2]]) -> Vec<Wall> {
    line.windows(2).map(|p| [p[0], p[1]]).collect()
}

/// The walls that tabs along some lines may touch, divided where these lines end on them.
fn walls_near(runs: &[Polyline], depth: f64, walls: &[Wall]) -> Vec<Wall> {
    let [low, high] = bounds(runs.iter().flatten());
    let is_near = |[a, b]: &&Wall| {
        (0..2).all(|k| a[k].max(b[k]) >= low[k] - depth && a[k].min(b[k]) <= high[k] + depth)
    };
    let ends = || runs.iter().flat_map(|run| [run[0], run[run.len() - 1]]);
    let divided = |wall: &Wall| {
        let inner =
            ends().find(|end| is_on(*end, *wall) && wall.iter().all(|tip| !same(*tip, *end)));
        match inner {
            Some(end) => vec![[wall[0], end], [end, wall[1]]],
            None => vec![*wall],
        }
    };
    walls.iter().filter(is_near).flat_map(divided).collect()
}

/// Divides a curve into fold lines of tabs: along each line the curve turns by at most [`MIN_CORNER_TURN`], as does the side that it is
/// joined to, and, where possible, it is at least [`MIN_TAB_LENGTH_MM`] long. Returns also the angle, in radians and to the left, by
/// which each line but the first turns from the one before: on the sheet, or where the tab is glued if that is less.
fn bases(curve: &Curve, beside: Option<&[[f64; 2]]>) -> (Vec<Curve>, Vec<f64>) {
    let points = curve.points(FLATTENING_TOLERANCE_MM);
    let whole = polyline_length(&points);
    let sides: Vec<&[[f64; 2]]> = [Some(&points[..]), beside].into_iter().flatten().collect();
    let mut all: Vec<(f64, usize, f64)> = (sides.iter().enumerate())
        .flat_map(|(side, points)| turns(points).map(move |(share, turn)| (share, side, turn)))
        .collect();
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (mut shares, mut turned) = (vec![0.0], [0.0f64; 2]);
    for (share, side, turn) in all {
        turned[side] += turn;
        let room = (share - shares[shares.len() - 1]).min(1.0 - share) * whole >= MIN_TAB_LENGTH_MM;
        let is_round = turned.iter().any(|turn| turn.abs() > MIN_CORNER_TURN);
        if turn.abs() > MIN_CORNER_TURN || (is_round && room) {
            shares.push(share);
            turned = [0.0; 2];
        }
    }
    let cuts = &shares[1..];
    let between: Vec<Vec<f64>> = (sides.iter())
        .map(|points| {
            let long = polyline_length(points);
            let ends = shares.iter().chain(&[1.0]).map(|share| share * long);
            let corners: Vec<[f64; 2]> = ends.map(|along| place_at(points, along).0).collect();
            turns(&corners).map(|(_, turn)| turn).collect()
        })
        .collect();
    let least = |k: usize| {
        between
            .iter()
            .map(|turns| turns[k])
            .fold(f64::INFINITY, f64::min)
    };
    (curve.split(cuts), (0..cuts.len()).map(least).collect())
}

/// The angles, in radians and to the left, by which a polyline turns at its inner points, each with the point's share of the length.
fn turns(points: &[[f64; 2]]) -> impl Iterator<Item = (f64, f64)> {
    let whole = polyline_length(points);
    let mut gone = 0.0;
    points.windows(3).map(move |p| {
        let [u, v] =
            [[p[0], p[1]], [p[1], p[2]]].map(|[p, q]| Point2::new(q[0] - p[0], q[1] - p[1]));
        gone += u.norm();
        (gone / whole, (u.conj() * v).arg())
    })
}

/// Chooses one depth for the tabs along a run: the largest at which nearly as much of the run gets tabs as at any other.
/// The few that do not fit at that depth are halved on their own.
fn common_depth(runs: &[Polyline], turns: &[f64], depth: f64, around: &Surroundings<'_>) -> f64 {
    let depths: Vec<f64> = (0..=MAX_TAB_HALVINGS)
        .map(|k| depth / f64::from(1 << k))
        .collect();
    let tabbed = |depth: &f64| -> f64 {
        (0..runs.len())
            .filter(|i| flap(&runs[*i], end_turns(turns, *i), *depth, around).is_some())
            .map(|i| polyline_length(&runs[i]))
            .sum()
    };
    let lengths: Vec<f64> = depths.iter().map(tabbed).collect();
    let longest = lengths.iter().copied().fold(0.0, f64::max);
    let enough = |length: &f64| *length >= MIN_TABBED_SHARE * longest;
    depths[lengths.iter().position(enough).unwrap_or_default()]
}

/// The turns at both ends of a fold line of a tab; `None` at an end of the run.
fn end_turns(turns: &[f64], number: usize) -> [Option<f64>; 2] {
    let before = number.checked_sub(1).and_then(|k| turns.get(k));
    [before, turns.get(number)].map(Option::<&f64>::copied)
}

/// Computes the depth and the outer corners of a tab to the right of its fold line; `None` if the fold line is too short or
/// something is in the way. At an end of a run the tab is cut at 45°, or as far as what is beside it there leaves room; where the
/// next tab follows it is cut along the bisector if the two would overlap, and otherwise at a right angle. It is less deep where
/// its ends would meet.
fn flap(
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

    /// An arc around the origin from the angle 0 to `end`, in radians.
    fn arc(radius: f64, end: f64) -> Curve {
        let point = |i: usize| {
            let angle = end * i as f64 / 400.0;
            [radius * angle.cos(), radius * angle.sin()]
        };
        Curve::through(&(0..=400).map(point).collect::<Vec<_>>())
    }

    /// Walls that a tab may reach, of no sheet.
    fn beside_walls(walls: &[Wall]) -> Surroundings<'static> {
        Surroundings {
            sheet: &[],
            near: walls.to_vec(),
        }
    }

    /// Fold lines of the tabs along a curve, which is joined to what is `beside` it, and the tabs' depths and outer corners.
    #[allow(clippy::type_complexity)]
    fn tabs_beside(
        curve: &Curve,
        beside: Option<&[[f64; 2]]>,
        depth: f64,
    ) -> Vec<(Vec<[f64; 2]>, f64, [[f64; 2]; 2])> {
        let (bases, turns) = bases(curve, beside);
        let runs: Vec<_> = (bases.iter())
            .map(|base| base.points(FLATTENING_TOLERANCE_MM))
            .collect();
        let own = common_depth(&runs, &turns, depth, &beside_walls(&[]));
        (0..runs.len())
            .map(|i| {
                let (depth, corners) =
                    flap(&runs[i], end_turns(&turns, i), own, &beside_walls(&[])).unwrap();
                (runs[i].clone(), depth, corners)
            })
            .collect()
    }

    #[test]
    fn tabs_outside_a_bend_are_equally_deep_and_not_cut_in_between() {
        // Counterclockwise: the right side is outside of the circle.
        let tabs = tabs_beside(&arc(40.0, 2.0), None, 6.0);
        assert!(tabs.len() > 4);
        assert!(tabs.iter().all(|(_, depth, _)| *depth == 6.0));
        let insides = &tabs[1..tabs.len() - 1];
        for (base, _, corners) in insides {
            let chord = distance(base[0], base[base.len() - 1]);
            assert!((distance(corners[0], corners[1]) - chord).abs() < 1e-9);
        }
        // At both ends of the run they are cut at 45°, or as far as a short tab allows.
        let (base, _, corners) = &tabs[0];
        let chord = distance(base[0], base[base.len() - 1]);
        assert!(distance(corners[0], corners[1]) < chord - 1.0);
    }

    #[test]
    fn tabs_along_a_straight_edge_have_room_on_the_disc_that_it_is_joined_to() {
        let (radius, depth) = (40.0, 6.0);
        let disc = arc(radius, -TAU).points(FLATTENING_TOLERANCE_MM);
        let edge = Curve::through(&[[0.0, 0.0], [TAU * radius, 0.0]]);
        let tabs = tabs_beside(&edge, Some(&disc), depth);
        assert!((20..=32).contains(&tabs.len()), "{}", tabs.len());
        for (base, depth, [p, q]) in &tabs {
            let [from, to] = [base[0][0], base[base.len() - 1][0]];
            // Both radii of the disc from the ends of the fold line leave so much of the outer edge.
            let free = (to - from) * (1.0 - depth / radius);
            assert!(q[0] - p[0] < free, "{from} {to}: {p:?} {q:?}");
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

    #[test]
    fn tabs_inside_a_bend_meet_at_the_bisector_without_overlap() {
        // Clockwise: the right side is within the circle, where tabs converge.
        let tabs = tabs_beside(&arc(40.0, -2.0), None, 6.0);
        for pair in tabs.windows(2) {
            let ([_, last], [first, _]) = (pair[0].2, pair[1].2);
            let gap = distance(last, first);
            assert!(gap > 0.1 && gap < 1.0, "{gap}");
            // Seen from the middle, one ends before the next begins.
            let angle = |p: [f64; 2]| p[1].atan2(p[0]);
            assert!(angle(last) > angle(first));
        }
    }
}

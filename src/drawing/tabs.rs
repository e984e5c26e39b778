//! Adds tabs (glued flaps) along cut creases: trapezoids outside of the sheet, a comb of short ones along a curve.

use std::collections::{BTreeMap, BTreeSet};

use super::curve::{Curve, MIN_CORNER_TURN};
use super::flap::{MAX_TAB_HALVINGS, Surroundings, flap, walls_near};
use super::line::{FLATTENING_TOLERANCE_MM, Wall, place_at, walls_of};
use crate::math::planar::{Point2, polyline_length};
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

/// Minimum length of tabs along a run, as a share of the greatest length that any depth allows, for a depth to be taken
/// for the whole run. `benches/patterns.md` has what others give.
const MIN_TABBED_SHARE: f64 = 0.9;

/// The closed outline of a sheet as a list of runs (pieces along one side of a crease or along the border), each with
/// its curve in millimetres.
type Outline<'a> = Vec<(&'a Run, Curve)>;

/// Both sides of each seam as polylines, by the number of its crease and of the patch that the side is on; `None` for a side that
/// is in several pieces.
pub(super) struct SeamSides(BTreeMap<(usize, Option<u32>), Option<Polyline>>);

type Polyline = Vec<[f64; 2]>;

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

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;
    use crate::math::planar::distance;

    /// An arc around the origin from the angle 0 to `end`, in radians.
    fn arc(radius: f64, end: f64) -> Curve {
        let point = |i: usize| {
            let angle = end * i as f64 / 400.0;
            [radius * angle.cos(), radius * angle.sin()]
        };
        Curve::through(&(0..=400).map(point).collect::<Vec<_>>())
    }

    fn nothing() -> Surroundings<'static> {
        Surroundings {
            sheet: &[],
            near: Vec::new(),
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
        let own = common_depth(&runs, &turns, depth, &nothing());
        (0..runs.len())
            .map(|i| {
                let (depth, corners) =
                    flap(&runs[i], end_turns(&turns, i), own, &nothing()).unwrap();
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

//! Makes both sides of each joint equally long in a drawing.
//!
//! The two sides of a joint differ in length for two reasons: the strain that is left in a sheet is largest at its
//! border, and smoothing shortens lines. The corners of outlines are moved by the least-squares solution that makes
//! the sides of all joints equally long, and the distances of lines from their chords are scaled, within the
//! tolerance of the smoothing.

use crate::math::planar::{distance, nearest_on_segment};
use std::collections::BTreeMap;
use std::ops::Range;

use super::curve::{Curve, Piece, SEGMENTS_PER_PIECE};
use super::lines::Lines;
use super::options::DrawingOptions;
use super::smooth::crossing_curves;
use crate::pattern::Sheet;

/// Maximum difference between the lengths of a joint's two sides, as a share of the length, at which they count as
/// equally long.
const LENGTH_TOLERANCE: f64 = 1e-4;

/// Maximum distance that a side of a joint and the side's corners may be moved in addition to the smoothing tolerance,
/// as a share of the side's length.
const MAX_SHIFT_SHARE: f64 = 0.01;

/// Maximum number of Kaczmarz sweeps, which solve the linear system for the shifts of sides; each sweep makes the two
/// sides of one joint after another equally long.
const MAX_KACZMARZ_SWEEPS: usize = 400;

/// Maximum number of times that the lengths of the joints' sides are linearised again (Gauss-Newton steps).
/// `benches/patterns.md` has what others give.
const MAX_LENGTH_ROUNDS: usize = 4;

/// A side of a joint (of a seam or a fold between two parts): a piece of an outline, which is a curve between two
/// corners.
struct Side {
    /// Numbers of the outline's corners where the side's curve begins and ends.
    corners: [usize; 2],
    curve: Curve,
    length: f64,
    /// Largest distance of a point of the side's curve from the point of its chord at the same share of the length, in
    /// millimetres.
    bow: f64,
    /// Maximum distance that the side's curve may be moved, in millimetres.
    max_shift: f64,
}

impl Side {
    fn new(curve: &Curve, corners: [usize; 2], cells: f64) -> Side {
        let length = curve.length();
        let mut side = Side {
            corners,
            curve: curve.clone(),
            length,
            bow: 0.0,
            max_shift: cells + MAX_SHIFT_SHARE * length,
        };
        let away = |(p, s): ([f64; 2], f64)| {
            let [x, y] = side.off(p, s);
            x.hypot(y)
        };
        side.bow = (curve.placed()).map(away).fold(0.0, f64::max);
        side
    }

    fn chord(&self) -> [[f64; 2]; 2] {
        let controls = self.curve.controls();
        [controls[0], controls[controls.len() - 1]]
    }

    /// Computes the offset of a point of the side's curve from the point of the chord at the same share of the length.
    fn off(&self, p: [f64; 2], share: f64) -> [f64; 2] {
        let [from, to] = self.chord();
        [0, 1].map(|k| p[k] - from[k] - share * (to[k] - from[k]))
    }

    /// Computes the derivatives of the side's length by the position of its last corner and by its bow (largest
    /// distance from the chord); the derivative by the first corner is the negative of the former.
    fn slopes(&self) -> ([f64; 2], f64) {
        let [from, to] = self.chord();
        let along = [0, 1].map(|k| (to[k] - from[k]) / self.length);
        let square = along[0] * along[0] + along[1] * along[1];
        match self.bow > 0.0 {
            true => (along, self.length * (1.0 - square) / self.bow),
            false => (along, 0.0),
        }
    }

    /// Computes the side's curve with its ends shifted by `from` and `to`, and its offsets from the chord scaled so
    /// that the largest becomes `bow`.
    fn moved(&self, [from, to]: [[f64; 2]; 2], bow: f64) -> Curve {
        let swell = if self.bow > 0.0 { bow / self.bow } else { 0.0 };
        Curve::of(
            (self.curve.placed())
                .map(|(p, s)| {
                    let off = self.off(p, s);
                    [0, 1].map(|k| p[k] + (1.0 - s) * from[k] + s * to[k] + swell * off[k])
                })
                .collect(),
        )
    }
}

/// Computes the smooth outlines and folds of all sheets in millimetres, with both sides of each joint equally long.
pub(super) fn matched_lines<'a>(sheets: &'a [Sheet], options: &DrawingOptions) -> Vec<Lines<'a>> {
    let mut lines: Vec<Lines<'_>> = sheets.iter().map(|s| Lines::new(s, options)).collect();
    // With a bend allowance lengths across a fold differ from those of the surface on purpose.
    if options.bending.is_none() {
        equalise_joints(sheets, &mut lines, options);
    }
    lines
}

/// Makes the two sides of each joint equally long, as far as the limits of the sides' shifts allow; changes nothing
/// where smoothing is disabled, or sheets are exact.
fn equalise_joints(sheets: &[Sheet], lines: &mut [Lines<'_>], options: &DrawingOptions) {
    if options.smoothing == 0.0 || sheets.iter().any(|sheet| sheet.exact) {
        return;
    }
    let mut outlines = Outlines::new(sheets, lines, options);
    if outlines.joints.is_empty() {
        return;
    }
    let before: Vec<Curve> = outlines.sides.iter().map(|s| s.curve.clone()).collect();
    let usual = outlines.crossing(&before);
    let mut share = 1.0;
    while share > LENGTH_TOLERANCE {
        let after = outlines.equalise_joints();
        let mut wrong = outlines.crossing(&after);
        wrong.retain(|number| !usual.contains(number));
        if !wrong.is_empty() {
            outlines.halve_limits(&wrong);
            share *= 0.5;
            continue;
        }
        for (own, sheet) in lines.iter_mut().zip(&outlines.sheets) {
            let [before, after] = [&before, &after].map(|curves| &curves[sheet.sides.clone()]);
            for fold in &mut own.folds {
                let line = Side::new(&fold.curve, [0, 0], 0.0);
                let ways = line
                    .chord()
                    .map(|end| fold_end_shift(end, before, after, sheet.cell));
                *fold = fold.clone().along(line.moved(ways, 0.0));
            }
            let runs = own.outlines.iter_mut().flatten();
            for ((_, curve), after) in runs.zip(after) {
                *curve = after.clone();
            }
        }
        return;
    }
}

/// The sides of joints on one sheet, as a range of their numbers.
struct SheetSides {
    sides: Range<usize>,
    /// Spacing of the lattice's vertices on the drawing, in millimetres.
    cell: f64,
}

/// The outlines of all sheets as one list of sides (curves between two corners), and for each joint the numbers of the
/// sides on both halves of the joint.
struct Outlines {
    sides: Vec<Side>,
    joints: Vec<[Vec<usize>; 2]>,
    sheets: Vec<SheetSides>,
    corners: usize,
    /// Maximum shift of each unknown of the least-squares problem, in millimetres: of the two coordinates of each
    /// corner, then of the bow of each side.
    limits: Vec<f64>,
}

impl Outlines {
    fn new(sheets: &[Sheet], lines: &[Lines<'_>], options: &DrawingOptions) -> Outlines {
        let (mut sides, mut corners, mut ranges) = (Vec::new(), 0, Vec::new());
        let mut joints: BTreeMap<usize, [Vec<usize>; 2]> = BTreeMap::new();
        for (sheet, own) in sheets.iter().zip(lines) {
            let first = sides.len();
            let cell = sheet.spacing * options.scale;
            for outline in &own.outlines {
                let count = outline.len();
                for (k, (run, curve)) in outline.iter().enumerate() {
                    if let (Some(seam), Some(patch)) = (run.seam, run.patch) {
                        let joint = joints.entry(seam.crease).or_default();
                        joint[usize::from(patch == seam.patches[1])].push(sides.len());
                    }
                    let ends = [corners + k, corners + (k + 1) % count];
                    sides.push(Side::new(curve, ends, options.smoothing * cell));
                }
                corners += count;
            }
            let sides = first..sides.len();
            ranges.push(SheetSides { sides, cell });
        }
        let mut limits = vec![0.0f64; 2 * corners + sides.len()];
        for (number, side) in sides.iter().enumerate() {
            for corner in side.corners {
                for limit in &mut limits[2 * corner..2 * corner + 2] {
                    *limit = limit.max(side.max_shift);
                }
            }
            limits[2 * corners + number] = side.max_shift;
        }
        Outlines {
            joints: (joints.into_values())
                .filter(|joint| joint.iter().all(|side| !side.is_empty()))
                .collect(),
            sides,
            sheets: ranges,
            corners,
            limits,
        }
    }

    /// Finds the sides that cross themselves or other sides of their sheet; returns the sides' numbers.
    fn crossing(&self, curves: &[Curve]) -> Vec<usize> {
        let wrong = self.sheets.iter().flat_map(|SheetSides { sides, cell }| {
            let wrong = crossing_curves(&curves[sides.clone()], *cell);
            wrong.into_iter().map(|number| sides.start + number)
        });
        wrong.collect()
    }

    /// Halves the maximum shift of some sides, and of the corners at their ends.
    fn halve_limits(&mut self, lines: &[usize]) {
        for number in lines {
            for corner in self.sides[*number].corners {
                self.limits[2 * corner] *= 0.5;
                self.limits[2 * corner + 1] *= 0.5;
            }
            self.limits[2 * self.corners + number] *= 0.5;
        }
    }

    /// Moves all sides so that the two halves of each joint are as nearly equally long as the limits of the shifts
    /// allow.
    fn equalise_joints(&self) -> Vec<Curve> {
        let rows: Vec<Vec<(usize, f64)>> = self
            .joints
            .iter()
            .map(|joint| self.length_difference_gradient(joint))
            .collect();
        let mut x = vec![0.0; self.limits.len()];
        let mut curves: Vec<Curve> = self.sides.iter().map(|s| s.curve.clone()).collect();
        for _ in 0..MAX_LENGTH_ROUNDS {
            let lengths: Vec<f64> = curves.iter().map(Curve::length).collect();
            let long = |side: &Vec<usize>| side.iter().map(|number| lengths[*number]).sum::<f64>();
            let both: Vec<[f64; 2]> = (self.joints.iter())
                .map(|[one, other]| [long(one), long(other)])
                .collect();
            if both
                .iter()
                .all(|[a, b]| (a - b).abs() <= LENGTH_TOLERANCE * a.max(*b))
            {
                break;
            }
            // Difference at zero shift of the linearisation.
            let rests: Vec<f64> = (rows.iter().zip(&both))
                .map(|(row, [a, b])| a - b - product(row, &x))
                .collect();
            for _ in 0..MAX_KACZMARZ_SWEEPS {
                let mut done = true;
                for ((row, rest), [a, b]) in rows.iter().zip(&rests).zip(&both) {
                    let square: f64 = row.iter().map(|(_, w)| w * w).sum();
                    let difference = rest + product(row, &x);
                    if square == 0.0 || difference.abs() <= 0.1 * LENGTH_TOLERANCE * a.max(*b) {
                        continue;
                    }
                    done = false;
                    for (i, w) in row {
                        let limit = self.limits[*i];
                        x[*i] = (x[*i] - difference / square * w).clamp(-limit, limit);
                    }
                }
                if done {
                    break;
                }
            }
            let of = |corner: usize| [x[2 * corner], x[2 * corner + 1]];
            curves = (self.sides.iter().enumerate())
                .map(|(k, side)| side.moved(side.corners.map(of), x[2 * self.corners + k]))
                .collect();
        }
        curves
    }

    /// Computes the derivatives of the difference between the lengths of a joint's two halves by each corner's
    /// coordinates and each side's bow; returns those that are not 0, each with the number of its unknown.
    fn length_difference_gradient(&self, joint: &[Vec<usize>; 2]) -> Vec<(usize, f64)> {
        let mut row: BTreeMap<usize, f64> = BTreeMap::new();
        for (own, sign) in joint.iter().zip([1.0, -1.0]) {
            for number in own {
                let side = &self.sides[*number];
                if side.length == 0.0 {
                    continue;
                }
                let (along, bow) = side.slopes();
                for (corner, way) in side.corners.into_iter().zip([-sign, sign]) {
                    for (k, slope) in along.iter().enumerate() {
                        *row.entry(2 * corner + k).or_default() += way * slope;
                    }
                }
                *row.entry(2 * self.corners + number).or_default() += sign * bow;
            }
        }
        row.into_iter().filter(|(_, w)| *w != 0.0).collect()
    }
}

fn product(row: &[(usize, f64)], x: &[f64]) -> f64 {
    row.iter().map(|(i, w)| w * x[*i]).sum()
}

/// Computes the shift of a fold's end: the shift of the outline's point nearest to it, or 0 if that is more than half a
/// lattice spacing away.
fn fold_end_shift(end: [f64; 2], before: &[Curve], after: &[Curve], cell: f64) -> [f64; 2] {
    let pieces =
        |curves: &[Curve]| -> Vec<Piece> { curves.iter().flat_map(Curve::pieces).collect() };
    let (mut nearest, mut found) = (0.5 * cell, [0.0; 2]);
    for (old, new) in pieces(before).into_iter().zip(pieces(after)) {
        for k in 0..SEGMENTS_PER_PIECE {
            let at = |i: f64| (k as f64 + i) / SEGMENTS_PER_PIECE as f64;
            let ends = [old.at(at(0.0)), old.at(at(1.0))];
            let place = nearest_on_segment(end, ends);
            if distance(place, end) <= nearest {
                nearest = distance(place, end);
                let share =
                    distance(place, ends[0]) / distance(ends[1], ends[0]).max(f64::MIN_POSITIVE);
                let [from, to] = [old, new].map(|piece| piece.at(at(share)));
                found = [0, 1].map(|k| to[k] - from[k]);
            }
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::super::Drawing;
    use super::*;
    use crate::pattern::{Direction, Faces, Run, Seam};

    /// One side of a cut, or a part of the border.
    fn run(crease: Option<usize>, patch: u32, points: Vec<[f64; 2]>) -> Run {
        let seam = |crease| Seam {
            crease,
            patches: [0, 1],
            direction: Direction::Mountain,
            angle: 0.5,
            slit: false,
        };
        Run {
            seam: crease.map(seam),
            patch: crease.map(|_| patch),
            ends: [None; 2],
            points,
        }
    }

    /// A sheet on a lattice of spacing 1.
    fn sheet(patch: u32, outlines: Vec<Vec<Run>>) -> Sheet {
        Sheet {
            patches: vec![patch],
            outlines,
            folds: Vec::new(),
            spots: Vec::new(),
            faces: Faces::default(),
            spacing: 1.0,
            area: 50.0,
            strain: 0.0,
            seam_gap: 0.0,
            refolding: None,
            exact: false,
        }
    }

    /// Lengths of both sides of a joint as they are drawn, which is the first run of two sheets.
    fn drawn(one: Sheet, other: Sheet) -> ([f64; 2], [Vec<[f64; 2]>; 2]) {
        let sheets = [one, other];
        let options = DrawingOptions::default();
        let lines = matched_lines(&sheets, &options);
        let sides = [0, 1].map(|k| lines[k].outlines[0][0].1.clone());
        let totals = Drawing::new(&sheets, &options).unwrap().summary;
        let [a, b] = totals.worst_joint.unwrap().lengths;
        assert!((totals.mismatch - (a - b).abs() / a.max(b)).abs() < 1e-12);
        (
            sides.each_ref().map(Curve::length),
            sides.map(|side| side.controls().to_vec()),
        )
    }

    #[test]
    fn corners_of_straight_sides_share_what_they_differ_by() {
        // Rectangles, 10 and 10.4 long.
        let rectangle = |patch: u32, long: f64| {
            let corners = [[0.0, 0.0], [long, 0.0], [long, 5.0], [0.0, 5.0]];
            let line = |k: usize| vec![corners[k], corners[(k + 1) % 4]];
            let border = (1..4).map(|k| run(None, patch, line(k)));
            let joint = run(Some(0), patch, line(0));
            sheet(
                patch,
                vec![std::iter::once(joint).chain(border).collect::<Vec<_>>()],
            )
        };
        let ([a, b], [one, other]) = drawn(rectangle(0, 10.0), rectangle(1, 10.4));
        // The least squares of four corners that go along their lines: a fourth of the difference each.
        assert!(
            (a - 10.2).abs() < 2e-3 && (b - 10.2).abs() < 2e-3,
            "{a} {b}"
        );
        for (place, x) in [
            (one[0], -0.1),
            (one[3], 10.1),
            (other[0], 0.1),
            (other[3], 10.3),
        ] {
            assert!(
                (place[0] - x).abs() < 1e-3 && place[1].abs() < 1e-9,
                "{place:?}"
            );
        }
    }

    #[test]
    fn closed_sides_swell_and_shrink() {
        let ring = |radius: f64, turn: f64| {
            let at = |k: usize| {
                let (sin, cos) = (turn * 2.0 * PI * (k % 200) as f64 / 200.0).sin_cos();
                [radius * cos, radius * sin]
            };
            (0..=200).map(at).collect::<Vec<_>>()
        };
        let disc = sheet(0, vec![vec![run(Some(0), 0, ring(20.0, 1.0))]]);
        let mut hole = sheet(1, vec![vec![run(Some(0), 1, ring(20.2, -1.0))]]);
        hole.outlines.insert(0, vec![run(None, 1, ring(40.0, 1.0))]);
        let sheets = [disc, hole];
        let lines = matched_lines(&sheets, &DrawingOptions::default());
        let long = [&lines[0].outlines[0][0].1, &lines[1].outlines[1][0].1].map(Curve::length);
        for long in long {
            assert!((long / (2.0 * PI * 20.1) - 1.0).abs() < 5e-4, "{long}");
        }
        let border = lines[1].outlines[0][0].1.length();
        assert!((border / (2.0 * PI * 40.0) - 1.0).abs() < 5e-4, "{border}");
    }

    #[test]
    fn what_differs_by_more_than_lines_may_be_moved_is_told() {
        let triangle = |patch: u32, long: f64| {
            let corners = [[0.0, 0.0], [long, 0.0], [0.5 * long, 8.0]];
            let line = |k: usize| vec![corners[k], corners[(k + 1) % 3]];
            let border = (1..3).map(|k| run(None, patch, line(k)));
            let joint = run(Some(0), patch, line(0));
            sheet(
                patch,
                vec![std::iter::once(joint).chain(border).collect::<Vec<_>>()],
            )
        };
        let ([a, b], _) = drawn(triangle(0, 10.0), triangle(1, 14.0));
        // Half a cell and a hundredth of the longest line there, at each end.
        assert!(a < 11.3 && b > 12.6, "{a} {b}");
    }
}

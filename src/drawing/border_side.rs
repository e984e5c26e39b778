//! Finds the sides of the surface's border that are straight but for the steps of the lattice.

use super::line_corners::{CORNER_ANGLE, Sample, distance_along, turning_angle};
use crate::unroll::flat_triangle::Point;

/// Length of an outline before and after a corner, in lattice spacings, over which the corner between two sides is
/// measured: along a staircase of the lattice the directions agree over such a length.
const SIDE_ARM_SPACINGS: f64 = 12.0;

/// Maximum distance, as a multiple of the tolerance, of what straight lines replace: of a side's samples from the line fitted
/// to them, since a side that crosses the lattice's rows is a staircase with steps of one edge of the lattice, and of a
/// corner from the intersection of two lines.
pub(super) const MAX_STRAIGHTENING_TOLERANCES: f64 = 1.5;

/// Maximum length of a step of a side that crosses the lattice's rows, in lattice spacings: where the surface is steep,
/// edges of the lattice are longer than the spacing.
const MAX_STEP_SPACINGS: f64 = 2.0;

/// Length at either end of a side, in lattice spacings, where the lattice may have cut its corner off: samples there may
/// be twice as far from the line.
const SIDE_END_SPACINGS: f64 = 4.0;

/// Minimum distance between the ends of a straight side, as a share of the length of its steps: the longest staircase of
/// the lattice has 0.87.
const MIN_CHORD_SHARE: f64 = 0.8;

/// Maximum bow of a straight side, in lattice spacings: distance between the means of the middle third of its samples
/// and of the others.
const MAX_SIDE_BOW_SPACINGS: f64 = 0.15;

/// Maximum bow of a straight side as a share of its length, so that short sides of a curve do not become a polygon.
const MAX_SIDE_BOW_SHARE: f64 = 0.004;

/// Maximum bow of a straight side as a share of its samples' root mean square distance from the line, if that is more:
/// for an arc this share is 1.5, for a staircase it approaches 0. `benches/patterns.md` has what others give.
const MAX_STAIRCASE_BOW_SHARE: f64 = 0.6;

/// Selects those corners of a line at which two of its sides meet: the directions before and after differ over a long
/// way, too, and more than at every other corner within it.
pub(super) fn side_ends(
    line: &[Sample],
    corners: &[usize],
    closed: bool,
    spacing: f64,
) -> Vec<usize> {
    let arm = SIDE_ARM_SPACINGS * spacing;
    let mut order: Vec<(usize, f64)> = (corners.iter())
        .map(|i| (*i, turning_angle(line, *i, arm, closed)))
        .filter(|(_, turn)| *turn > CORNER_ANGLE)
        .collect();
    order.sort_by(|a, b| b.1.total_cmp(&a.1));
    let mut found: Vec<usize> = Vec::new();
    for (i, _) in order {
        if found
            .iter()
            .all(|k| distance_along(line, i, *k, closed) >= arm)
        {
            found.push(i);
        }
    }
    found.sort_unstable();
    found
}

/// Returns whether a side of the surface's border is straight but for the steps of the lattice: its samples are near a
/// straight line, and on the whole it does not bend.
pub(super) fn is_straight_side(line: &[Sample], tolerance: f64, spacing: f64) -> bool {
    let length = line[line.len() - 1].along - line[0].along;
    let chord = (line[line.len() - 1].place - line[0].place).norm();
    // A side has something between its ends.
    if length < 2.0 * SIDE_END_SPACINGS * spacing || chord < MIN_CHORD_SHARE * length {
        return false;
    }
    let [from, to] = axis(line);
    let off: Vec<f64> = (line.iter())
        .map(|s| ((to - from).conj() * (s.place - from)).im)
        .collect();
    let given: Vec<f64> = (line.iter().filter(|s| s.given)).map(|s| s.along).collect();
    let step = (given.windows(2).map(|p| p[1] - p[0]))
        .filter(|step| *step <= MAX_STEP_SPACINGS * spacing)
        .fold(spacing, f64::max);
    let limit = MAX_STRAIGHTENING_TOLERANCES * tolerance * step / spacing;
    let is_near = |(d, s): (&f64, &Sample)| {
        let from_end = (s.along - line[0].along).min(line[line.len() - 1].along - s.along);
        let is_end = from_end < SIDE_END_SPACINGS * spacing;
        d.abs() <= if is_end { 2.0 * limit } else { limit }
    };
    let mean = |part: &[f64]| part.iter().sum::<f64>() / part.len() as f64;
    let third = off.len() / 3;
    let (first, rest) = off.split_at(third);
    let (middle, last) = rest.split_at(rest.len() - third);
    let bow = (mean(middle) - 0.5 * (mean(first) + mean(last))).abs();
    let rms = (off.iter().map(|d| d * d).sum::<f64>() / off.len() as f64).sqrt();
    let max_bow = (MAX_SIDE_BOW_SPACINGS * spacing)
        .min(MAX_SIDE_BOW_SHARE * length)
        .max(MAX_STAIRCASE_BOW_SHARE * rms);
    bow <= max_bow && off.iter().zip(line).all(is_near)
}

/// Fits the least-squares line to samples, and returns two points on it.
pub(super) fn axis(line: &[Sample]) -> [Point; 2] {
    let count = line.len() as f64;
    let middle = line.iter().map(|s| s.place).sum::<Point>() / count;
    // Squares of complex numbers, so that opposite directions count as one.
    let square: Point = line
        .iter()
        .map(|s| (s.place - middle) * (s.place - middle))
        .sum();
    let along = square.sqrt();
    [middle, middle + along / along.norm().max(f64::MIN_POSITIVE)]
}

//! The lines along which a smooth bend of card is scored.

use super::bend::{PIECE_ROUNDING, tips};
use crate::pattern::{Bend, Fold};

/// Leaves of the parallel lines of each smooth bend so many that they are a distance apart in the mean, or as far as they were: of a group
/// of neighbours the one in its middle, with the angles of all. The lines of a cone stay.
pub(super) fn thin_lines(folds: &mut Vec<Fold>, min_distance: f64) {
    let bend_of = |fold: &Fold| fold.bend.map(|bend| bend.number);
    let mut is_left = vec![true; folds.len()];
    for first in 0..folds.len() {
        let bend = bend_of(&folds[first]);
        if bend.is_none() || folds[..first].iter().any(|fold| bend_of(fold) == bend) {
            continue;
        }
        let own = (first..folds.len()).filter(|k| bend_of(&folds[*k]) == bend);
        let own: Vec<usize> = own.collect();
        thin_bend(folds, own, min_distance, &mut is_left);
    }
    let mut is_left = is_left.into_iter();
    folds.retain(|_| is_left.next() == Some(true));
}

/// Thins the lines of one bend, by the numbers of its folds.
fn thin_bend(folds: &mut [Fold], mut own: Vec<usize>, min_distance: f64, is_left: &mut [bool]) {
    let [from, to] = tips(&folds[own[0]]);
    let along = (to - from) / (to - from).norm();
    let is_parallel = |k: &usize| {
        let [from, to] = tips(&folds[*k]);
        let heading = along.conj() * (to - from);
        heading.im.abs() <= PIECE_ROUNDING * heading.norm()
    };
    if !own.iter().all(is_parallel) {
        return;
    }
    let place = |k: usize| (along.conj() * (tips(&folds[k])[0] - from)).im;
    own.sort_unstable_by(|a, b| place(*a).total_cmp(&place(*b)));
    let width = place(own[own.len() - 1]) - place(own[0]);
    let rounding = PIECE_ROUNDING * width / own.len() as f64;
    let is_piece = |a: &usize, b: &usize| {
        folds[*a].seam.crease == folds[*b].seam.crease || place(*b) - place(*a) <= rounding
    };
    let lines: Vec<&[usize]> = own.chunk_by(is_piece).collect();
    // The whole multiple of the mean distance that is wide enough.
    let joined = (min_distance * (lines.len() - 1) as f64 / width - PIECE_ROUNDING).ceil();
    let count = (lines.len() / (joined.max(1.0) as usize)).max(1);
    let ends = |part: usize| part * lines.len() / count;
    for part in 0..count {
        let group = &lines[ends(part)..ends(part + 1)];
        // A bend all around has two patches, and the line between them is the fold of both.
        let parts_patches = |line: &&&[usize]| {
            let [a, b] = folds[line[0]].seam.patches;
            a != b
        };
        let line = group.iter().find(parts_patches);
        let line = *line.unwrap_or(&group[group.len() / 2]);
        let angle: f64 = group.iter().map(|line| folds[line[0]].seam.angle).sum();
        let mut is_middle = false;
        for k in group.iter().copied().flatten() {
            is_middle |= folds[*k].bend.is_some_and(|bend| bend.is_middle);
            is_left[*k] = line.contains(k);
        }
        for k in line {
            let fold = &mut folds[*k];
            fold.seam.angle = angle;
            fold.bend = fold.bend.map(|bend| Bend { is_middle, ..bend });
        }
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use super::*;
    use crate::pattern::{Direction, Seam};

    /// A bend by a right angle of some lines, 50 mm long and evenly apart, each turned by an angle, the fifth in two pieces.
    fn bend(count: usize, apart: f64, turn: f64) -> Vec<Fold> {
        let line = |k: usize, crease: usize, ends: [f64; 2]| Fold {
            seam: Seam {
                crease,
                patches: [0, 0],
                direction: Direction::Mountain,
                angle: FRAC_PI_2 / count as f64,
                slit: false,
            },
            bend: Some(Bend {
                number: 7,
                angle: FRAC_PI_2,
                radius: 2.0,
                chord_radius: 2.0,
                is_middle: k == count / 2,
            }),
            points: ends
                .map(|x| {
                    let (sin, cos) = (turn * k as f64).sin_cos();
                    [x * cos, k as f64 * apart + x * sin]
                })
                .to_vec(),
        };
        let pieces = |k: usize| match k {
            4 => vec![line(k, k, [0.0, 20.0]), line(k, k + count, [30.0, 50.0])],
            _ => vec![line(k, k, [0.0, 50.0])],
        };
        (0..count).flat_map(pieces).collect()
    }

    #[test]
    fn lines_of_a_bend_are_left_that_are_far_enough_apart_and_fold_as_much() {
        for apart in [0.05, 0.25, 0.6, 0.7, 0.9, 0.99] {
            for count in [2, 9, 10, 31] {
                let mut folds = bend(count, apart, 0.0);
                let sharp = Fold {
                    bend: None,
                    ..folds[0].clone()
                };
                folds.push(sharp.clone());
                thin_lines(&mut folds, 1.0);
                assert_eq!(folds.pop(), Some(sharp), "what is no bend stays");
                folds.dedup_by(|a, b| a.points[0][1] == b.points[0][1]);
                let places: Vec<f64> = folds.iter().map(|fold| fold.points[0][1]).collect();
                let near = places.windows(2).filter(|p| p[1] - p[0] < 1.0 - 1e-9);
                assert_eq!(near.count(), 0, "{apart} {count}: {places:?}");
                // No more than needed are left out.
                let all = ((count - 1) as f64 * apart / 2.0).ceil() as usize;
                assert!(folds.len() >= all, "{apart} {count}: {places:?}");
                let angle: f64 = folds.iter().map(|fold| fold.seam.angle).sum();
                assert!((angle - FRAC_PI_2).abs() < 1e-9, "{apart} {count}: {angle}");
                let middles = folds.iter().filter(|fold| fold.bend.unwrap().is_middle);
                assert_eq!(middles.count(), 1);
            }
        }
    }

    #[test]
    fn lines_that_can_be_scored_and_those_of_a_cone_stay_where_they_are() {
        for (apart, turn) in [
            (1.0, 0.0),
            (1.01, 0.0),
            (1.9, 0.0),
            (30.0, 0.0),
            (0.1, 0.05),
        ] {
            let all = bend(10, apart, turn);
            let mut left = all.clone();
            thin_lines(&mut left, 1.0);
            assert_eq!(left, all);
        }
    }
}

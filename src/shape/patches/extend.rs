//! Patches that go on beyond their borders as they are within them, and what that tells of where
//! these should be.

use nalgebra::{Matrix6, Vector6};

use super::bend::Bend;
use super::patch::NO_PATCH;
use crate::heights::heightfield::Heightfield;
use crate::lattice::hexagonal::{ROW, shift};

/// How many spacings around a vertex others are that its height is taken from.
const REACH: usize = 3;

/// A distance that is no reason to move, in spacings.
const LITTLE: f64 = 0.02;

/// How often labels are looked at.
const PASSES: usize = 4;

/// Moves vertices beside a crease's end to the patch that they lie on, where that is another one:
/// with half the distance from its continuation, or less. Patches grow into the vertices of a
/// crease in the order of their angles, and at the border of the surface these have none, where
/// creases would wander off by a cell or two.
pub(super) fn settle(surface: &Heightfield, bend: &Bend, labels: &mut [u32]) {
    let lattice = surface.lattice();
    let at_border =
        |i: usize| bend.angle[i].is_nan() || lattice.around(i).any(|k| bend.angle[k].is_nan());
    for _ in 0..PASSES {
        let mut moves = Vec::new();
        for i in (0..labels.len()).filter(|i| labels[*i] != NO_PATCH && at_border(*i)) {
            let mut others: Vec<u32> = lattice
                .around(i)
                .map(|k| labels[k])
                .filter(|label| *label != labels[i] && *label != NO_PATCH)
                .collect();
            if others.is_empty() {
                continue;
            }
            others.sort_unstable();
            others.dedup();
            let distance = |patch: u32| {
                let away = (surface.heights()[i] - extended(surface, labels, patch, i)).abs();
                if away.is_nan() { f64::INFINITY } else { away }
            };
            let own = distance(labels[i]);
            if own <= LITTLE * lattice.spacing() {
                continue;
            }
            let nearest = others.into_iter().map(|patch| (distance(patch), patch));
            let nearest = nearest.min_by(|a, b| a.0.total_cmp(&b.0));
            if let Some((_, patch)) = nearest.filter(|(away, _)| *away < 0.5 * own) {
                moves.push((i, patch));
            }
        }
        if moves.is_empty() {
            break;
        }
        for (i, patch) in moves {
            labels[i] = patch;
        }
    }
}

/// Height of a patch at a vertex on or beside its border, from its other vertices: that of the quadratic that fits its vertices nearby
/// best, or where they do not determine one, of one that is as nearly a plane, and as level, as
/// they leave it. NaN if there are none.
pub(crate) fn extended(surface: &Heightfield, labels: &[u32], patch: u32, vertex: usize) -> f64 {
    let lattice = surface.lattice();
    let (row, col) = (vertex / lattice.cols(), vertex % lattice.cols());
    let mut samples: Vec<([f64; 2], f64)> = Vec::new();
    for r in row.saturating_sub(REACH)..=(row + REACH).min(lattice.rows() - 1) {
        for c in col.saturating_sub(REACH + 1)..=(col + REACH + 1).min(lattice.cols() - 1) {
            let i = lattice.index(r, c);
            let x = c as f64 - shift(r) - (col as f64 - shift(row));
            let y = (row as f64 - r as f64) * ROW;
            if i != vertex && labels[i] == patch && x.hypot(y) < REACH as f64 + 0.1 {
                samples.push(([x, y], surface.heights()[i]));
            }
        }
    }
    if samples.is_empty() {
        return f64::NAN;
    }
    let mean = samples.iter().map(|(_, z)| z).sum::<f64>() / samples.len() as f64;
    // So little that it decides nothing but what the samples leave open.
    let mut matrix = Matrix6::from_diagonal(&Vector6::new(1e-12, 1e-9, 1e-9, 1e-5, 1e-5, 1e-5));
    let mut right = Vector6::zeros();
    for ([x, y], z) in samples {
        let terms = Vector6::new(1.0, x, y, x * x, x * y, y * y);
        matrix += terms * terms.transpose();
        right += terms * (z - mean);
    }
    let fit = matrix.cholesky().map(|factors| factors.solve(&right)[0]);
    mean + fit.filter(|z| z.is_finite()).unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lattice::hexagonal::Lattice;

    #[test]
    fn a_patch_goes_on_as_the_quadratic_that_it_is() {
        let truth = |x: f64, y: f64| 1.0 + 0.3 * x - 0.2 * y + 0.04 * x * x - 0.03 * x * y;
        let lattice = Lattice::new(12, 12, 0.5).unwrap();
        let field =
            Heightfield::from_fn(lattice, |x, y| if x < 2.6 { truth(x, y) } else { 9.0 }).unwrap();
        let label = |i: usize| u32::from(lattice.position(i / 12, i % 12)[0] >= 2.6);
        let labels: Vec<u32> = (0..lattice.len()).map(label).collect();
        for row in 2..10 {
            let col = (0..12).find(|c| labels[row * 12 + c] == 1).unwrap();
            let [x, y] = lattice.position(row, col);
            let z = extended(&field, &labels, 0, row * 12 + col);
            assert!((z - truth(x, y)).abs() < 1e-4, "{z} {}", truth(x, y));
        }
    }

    #[test]
    fn what_is_too_narrow_for_a_quadratic_goes_on_straight() {
        // Two rows of vertices of a plane.
        let lattice = Lattice::new(3, 12, 1.0).unwrap();
        let field = Heightfield::from_fn(lattice, |x, y| 2.0 * x - y).unwrap();
        let labels: Vec<u32> = (0..36).map(|i| u32::from(i >= 24)).collect();
        let z = extended(&field, &labels, 0, 24 + 6);
        assert!((z - field.height(2, 6)).abs() < 1e-3, "{z}");
        // One row says nothing about its sides.
        let labels: Vec<u32> = (0..36).map(|i| u32::from(i >= 12)).collect();
        assert!((extended(&field, &labels, 0, 12 + 6) - field.height(1, 6)).abs() < 1.0);
    }

    #[test]
    fn vertices_go_to_the_patch_that_they_lie_on() {
        // Two planes; one row of labels is two vertices off.
        let lattice = Lattice::new(9, 12, 1.0).unwrap();
        let field = Heightfield::from_fn(lattice, |x, _| 0.7 * (x - 5.2).abs()).unwrap();
        let side = |i: usize| u32::from(lattice.position(i / 12, i % 12)[0] > 5.2);
        let truth: Vec<u32> = (0..lattice.len()).map(side).collect();
        let mut labels = truth.clone();
        labels[5] = 1;
        labels[4] = 1;
        labels[8 * 12 + 6] = 0;
        settle(&field, &Bend::new(&field).unwrap(), &mut labels);
        assert_eq!(labels, truth);
    }
}

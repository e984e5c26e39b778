//! Extrapolates patches beyond their borders, and corrects the borders by that.

use nalgebra::Vector6;

use super::bend_angles::BendAngles;
use super::patch::NO_PATCH;
use crate::heights::heightfield::Heightfield;
use crate::lattice::hexagonal::{ROW_SPACING, shift};
use crate::math::least_squares::LeastSquares;

/// Radius around a vertex, in lattice spacings, within which the other vertices of a patch determine the patch's
/// extrapolated height there. `benches/patterns.md` has what others give.
const EXTRAPOLATION_RADIUS: usize = 3;

/// Maximum distance of a vertex at the border from the extrapolation of its own patch, in lattice spacings, at which it stays in that
/// patch.
const MAX_OWN_DISTANCE: f64 = 0.02;

/// Maximum distance of a vertex inside of the surface from the extrapolation of its own patch, in lattice spacings, at which it stays in
/// that patch: a fitted surface is round at its creases, but not by that much. `benches/patterns.md` has what others give.
const MAX_INNER_OWN_DISTANCE: f64 = 0.5;

/// Maximum number of passes in which vertices at the surface's border are reassigned to neighbouring patches.
const MAX_REASSIGNMENT_PASSES: usize = 4;

/// Maximum ratio of two distances at which a border vertex moves to another patch: its distance from that patch's
/// extrapolation, over its distance from the extrapolation of its own patch.
const MAX_OTHER_DISTANCE_SHARE: f64 = 0.5;

/// Reassigns vertices at the border of the surface, and at steps, to the neighbouring patch whose extrapolation they lie nearest to.
/// Bend angles, by which regions grow, are missing at the border, so that creases would end a cell or two beside
/// their place, and are large on both sides of a step.
pub(super) fn reassign_border_vertices(
    surface: &Heightfield,
    bend: &BendAngles,
    labels: &mut [u32],
) {
    let lattice = surface.lattice();
    let at_border =
        |i: usize| bend.angle[i].is_nan() || lattice.around(i).any(|k| bend.angle[k].is_nan());
    for _ in 0..MAX_REASSIGNMENT_PASSES {
        let mut moves = Vec::new();
        for i in (0..labels.len()).filter(|i| labels[*i] != NO_PATCH) {
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
                let away =
                    (surface.heights()[i] - extrapolated_height(surface, labels, patch, i)).abs();
                if away.is_nan() { f64::INFINITY } else { away }
            };
            let own = distance(labels[i]);
            let most = match at_border(i) {
                true => MAX_OWN_DISTANCE,
                false => MAX_INNER_OWN_DISTANCE,
            };
            if own <= most * lattice.spacing() {
                continue;
            }
            let nearest = others.into_iter().map(|patch| (distance(patch), patch));
            let nearest = nearest.min_by(|a, b| a.0.total_cmp(&b.0));
            if let Some((_, patch)) =
                nearest.filter(|(away, _)| *away < MAX_OTHER_DISTANCE_SHARE * own)
            {
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

/// Computes the extrapolated height of a patch at a vertex on or beside its border, from the least-squares quadratic of
/// its other vertices nearby. Where they do not determine a quadratic, it is as plane and as level as they allow. NaN
/// if there are none.
pub(crate) fn extrapolated_height(
    surface: &Heightfield,
    labels: &[u32],
    patch: u32,
    vertex: usize,
) -> f64 {
    let lattice = surface.lattice();
    let (row, col) = (vertex / lattice.cols(), vertex % lattice.cols());
    let mut samples: Vec<([f64; 2], f64)> = Vec::new();
    for r in row.saturating_sub(EXTRAPOLATION_RADIUS)
        ..=(row + EXTRAPOLATION_RADIUS).min(lattice.rows() - 1)
    {
        for c in col.saturating_sub(EXTRAPOLATION_RADIUS + 1)
            ..=(col + EXTRAPOLATION_RADIUS + 1).min(lattice.cols() - 1)
        {
            let i = lattice.index(r, c);
            let x = c as f64 - shift(r) - (col as f64 - shift(row));
            let y = (row as f64 - r as f64) * ROW_SPACING;
            if i != vertex && labels[i] == patch && x.hypot(y) < EXTRAPOLATION_RADIUS as f64 + 0.1 {
                samples.push(([x, y], surface.heights()[i]));
            }
        }
    }
    if samples.is_empty() {
        return f64::NAN;
    }
    let mean = samples.iter().map(|(_, z)| z).sum::<f64>() / samples.len() as f64;
    // A ridge so small that it decides only what the samples leave open.
    let mut quadratic = LeastSquares::<6>::with_ridge([1e-12, 1e-9, 1e-9, 1e-5, 1e-5, 1e-5]);
    for ([x, y], z) in samples {
        let terms = Vector6::new(1.0, x, y, x * x, x * y, y * y);
        quadratic.add(&terms, [z - mean], 1.0);
    }
    let fit = quadratic.solve().map(|coefficients| coefficients[0]);
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
            let z = extrapolated_height(&field, &labels, 0, row * 12 + col);
            assert!((z - truth(x, y)).abs() < 1e-4, "{z} {}", truth(x, y));
        }
    }

    #[test]
    fn what_is_too_narrow_for_a_quadratic_goes_on_straight() {
        // Two rows of vertices of a plane.
        let lattice = Lattice::new(3, 12, 1.0).unwrap();
        let field = Heightfield::from_fn(lattice, |x, y| 2.0 * x - y).unwrap();
        let labels: Vec<u32> = (0..36).map(|i| u32::from(i >= 24)).collect();
        let z = extrapolated_height(&field, &labels, 0, 24 + 6);
        assert!((z - field.height(2, 6)).abs() < 1e-3, "{z}");
        // One row says nothing about its sides.
        let labels: Vec<u32> = (0..36).map(|i| u32::from(i >= 12)).collect();
        assert!((extrapolated_height(&field, &labels, 0, 12 + 6) - field.height(1, 6)).abs() < 1.0);
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
        reassign_border_vertices(&field, &BendAngles::new(&field).unwrap(), &mut labels);
        assert_eq!(labels, truth);
    }
}

//! Draws marks along both sides of each seam, by which these are aligned when they are joined.

use crate::math::planar::polyline_length;
use std::collections::BTreeMap;

use super::curve::Curve;
use super::label::TEXT_SIZE_MM;
use super::line::{FLATTENING_TOLERANCE_MM, place_at};
use super::tabs::SeamSides;
use crate::pattern::Run;

/// Computes the number of marks (short lines by which the two sides of a seam are aligned) on each seam, by the number
/// of its crease; none if one of its sides is in several pieces.
pub(super) fn mark_counts(sides: &SeamSides, distance: f64) -> BTreeMap<usize, usize> {
    let mut lengths: BTreeMap<usize, Vec<f64>> = BTreeMap::new();
    for (crease, side) in sides.whole() {
        lengths
            .entry(crease)
            .or_default()
            .push(polyline_length(side));
    }
    let count = |(crease, own): (&usize, &Vec<f64>)| match own[..] {
        [a, b] => Some((
            *crease,
            ((0.5 * (a + b) / distance).round() as usize).saturating_sub(1),
        )),
        _ => None,
    };
    lengths.iter().filter_map(count).collect()
}

/// Draws the marks on one side of a seam: short lines normal to it and evenly spaced, so that the marks of the other
/// side, which runs in the opposite direction, are at the same points.
pub(super) fn seam_marks(run: &Run, curve: &Curve, counts: &BTreeMap<usize, usize>) -> Vec<Curve> {
    let count = run
        .seam
        .and_then(|seam| counts.get(&seam.crease))
        .copied()
        .unwrap_or(0);
    let points = curve.points(FLATTENING_TOLERANCE_MM);
    let whole = polyline_length(&points);
    (1..=count)
        .map(|i| {
            let (place, [x, y]) = place_at(&points, whole * i as f64 / (count + 1) as f64);
            // The sheet is to the left.
            Curve::through(&[
                place,
                [place[0] - TEXT_SIZE_MM * y, place[1] + TEXT_SIZE_MM * x],
            ])
        })
        .collect()
}

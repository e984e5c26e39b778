//! Draws marks along both sides of each seam, by which these are aligned when they are joined.

use crate::math::planar::polyline_length;
use std::collections::BTreeMap;

use super::curve::Curve;
use super::label::TEXT_SIZE_MM;
use super::line::{FLATTENING_TOLERANCE_MM, place_at};
use super::lines::Lines;
use crate::pattern::Run;

/// Computes the number of marks (short lines by which the two sides of a seam are aligned) on each seam, by the number
/// of its crease; 0 if one of its sides is in several pieces.
pub(super) fn mark_counts(lines: &[Lines<'_>], distance: f64) -> BTreeMap<usize, usize> {
    let mut sides: BTreeMap<usize, Vec<(Option<u32>, f64)>> = BTreeMap::new();
    for (run, curve) in lines.iter().flat_map(|own| own.outlines.iter().flatten()) {
        if let Some(seam) = run.seam {
            let side = (
                run.patch,
                polyline_length(&curve.points(FLATTENING_TOLERANCE_MM)),
            );
            sides.entry(seam.crease).or_default().push(side);
        }
    }
    let count = |sides: &Vec<(Option<u32>, f64)>| match sides[..] {
        [(one, a), (other, b)] if one != other => {
            ((0.5 * (a + b) / distance).round() as usize).saturating_sub(1)
        }
        _ => 0,
    };
    sides
        .iter()
        .map(|(crease, own)| (*crease, count(own)))
        .collect()
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

//! Outlines moved outwards, for what a beam burns away and for hems.

use i_overlay::mesh::float::outline::offset::OutlineOffset;
use i_overlay::mesh::float::style::{LineJoin, OutlineStyle};

use super::curve::Curve;
use super::smooth::smooth;

/// How near to the moved line its curves are, in millimetres, and the finest thing that they follow.
const TOLERANCE: f64 = 0.02;
const FINE: f64 = 1.0;

/// How near to curves the points are that are moved.
const NEAR: f64 = 0.005;

/// Corners keep theirs down to this angle, in radians.
const SHARPEST: f64 = 0.5;

/// The closed lines around a sheet, moved outwards by a distance; where they would run into each other, as in a slit
/// that is narrower, they end.
pub(super) fn outwards(curves: &[Curve], distance: f64) -> Vec<Curve> {
    let shape: Vec<Vec<[f64; 2]>> = (curves.iter())
        .map(|curve| {
            let mut points = curve.points(NEAR);
            points.pop();
            points
        })
        .collect();
    let style = OutlineStyle::new(distance).line_join(LineJoin::Miter(SHARPEST));
    let moved = shape.outline(&style);
    let rings = moved.into_iter().flatten().map(|mut ring| {
        ring.extend(ring.first().copied());
        smooth(&ring, TOLERANCE, FINE)
    });
    rings.collect()
}

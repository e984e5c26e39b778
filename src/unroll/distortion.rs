//! Strain of a flat layout.

use super::flat_triangle::{FlatTriangle, Point};

/// Strain above which [`Distortion::above`] counts a triangle, and default maximum of a sheet's root mean square strain: 1 %,
/// which is 3 mm on the longer side of an A4 page. No table chose it; the patterns in `benches/choices.md` keep to it.
pub(crate) const NOTICEABLE_STRAIN: f64 = 0.01;

/// Strain of a flat layout: relative changes of length from the surface to the plane. `σ₁ ≥ σ₂` are the
/// singular values of each triangle's map to the plane.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct Distortion {
    /// Root mean square strain over the area of all triangles: the root of the mean of `((σ₁ − 1)² + (σ₂ − 1)²) / 2`.
    pub rms: f64,
    /// Largest strain of any triangle, `max(σ₁ − 1, 1 − σ₂)`.
    pub maximum: f64,
    /// Share of the area in triangles whose strain is above 0.01, from 0 to 1.
    pub above: f64,
    /// Ratio of the layout's area to the surface's area.
    pub area: f64,
    /// Number of triangles that lie upside down in the layout.
    pub flipped: usize,
}

/// Computes the strain of triangles at given flat positions of the vertices.
pub(super) fn distortion(triangles: &[(FlatTriangle, [u32; 3])], places: &[Point]) -> Distortion {
    let (mut area, mut flat, mut squares, mut above) = (0.0, 0.0, 0.0, 0.0);
    let (mut maximum, mut flipped) = (0.0f64, 0);
    for (triangle, corners) in triangles {
        let [long, short] = triangle.singular_values(corners.map(|v| places[v as usize]));
        let share = triangle.area();
        let strain = (long - 1.0).max(1.0 - short);
        area += share;
        flat += share * long * short;
        squares += share * ((long - 1.0).powi(2) + (short - 1.0).powi(2));
        if strain > NOTICEABLE_STRAIN {
            above += share;
        }
        maximum = maximum.max(strain);
        flipped += usize::from(short <= 0.0);
    }
    Distortion {
        rms: (0.5 * squares / area).sqrt(),
        maximum,
        above: above / area,
        area: flat / area,
        flipped,
    }
}

//! How far a flat layout is from being an unrolling.

use super::pieces::{Name, Pieces, Point};

/// From which strain on a triangle counts as distorted.
pub(super) const NOTICEABLE: f64 = 0.01;

/// Lengths on a flat layout against those on the surface: strains, as shares. `σ₁ ≥ σ₂` are the
/// singular values of the map of each triangle to the plane.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct Distortion {
    /// Root of the mean of `((σ₁ − 1)² + (σ₂ − 1)²) / 2` by area.
    pub rms: f64,
    /// Largest strain of any triangle, `max(σ₁ − 1, 1 − σ₂)`.
    pub maximum: f64,
    /// Share of the area where that exceeds 0.01.
    pub above: f64,
    /// Area of the layout over that of the surface.
    pub area: f64,
    /// Number of triangles that lie upside down.
    pub flipped: usize,
}

/// Singular values of a piece's map to where its corners are.
pub(super) fn stretches(pieces: &Pieces, name: Name, places: &[Point]) -> [f64; 2] {
    let corners = pieces.corners(name).map(|cell| places[cell]);
    pieces.get(name).stretches(corners)
}

/// Of all pieces, or of those of one part.
pub(super) fn distortion(
    pieces: &Pieces,
    names: impl Iterator<Item = Name>,
    places: &[Point],
) -> Distortion {
    let (mut area, mut flat, mut squares, mut above) = (0.0, 0.0, 0.0, 0.0);
    let (mut maximum, mut flipped) = (0.0f64, 0);
    for name in names {
        let [long, short] = stretches(pieces, name, places);
        let share = pieces.get(name).area();
        let strain = (long - 1.0).max(1.0 - short);
        area += share;
        flat += share * long * short;
        squares += share * ((long - 1.0).powi(2) + (short - 1.0).powi(2));
        if strain > NOTICEABLE {
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

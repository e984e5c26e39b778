//! Options of bending sheet metal, and the bend allowance that follows from them.

use crate::error::{Error, Result, positive};
use crate::pattern::Direction;

/// How sheet metal is bent along folds: the thickness of the metal, the inner radius and the K-factor of bends.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Bending {
    /// Thickness of the metal, in millimetres.
    pub thickness: f64,
    /// Inner radius of all bends of the metal, in millimetres. Default: the thickness.
    pub radius: f64,
    /// K-factor of all bends: distance of the neutral line from the inside of a bend, as a share of the thickness; from
    /// 0 to 1, mostly 0.33 to 0.5. Default 0.44.
    pub k_factor: f64,
}

impl Bending {
    /// Creates the bending options for metal of a given thickness in millimetres, with the default radius and K-factor.
    pub fn new(thickness: f64) -> Self {
        Bending {
            thickness,
            radius: thickness,
            k_factor: 0.44,
        }
    }

    /// Sets the inner radius of all bends, in millimetres, and returns the bending options.
    pub fn radius(self, radius: f64) -> Self {
        Bending { radius, ..self }
    }

    /// Sets the K-factor of all bends, from 0 to 1, and returns the bending options.
    pub fn k_factor(self, k_factor: f64) -> Self {
        Bending { k_factor, ..self }
    }

    pub(super) fn check(&self) -> Result<()> {
        positive("thickness", self.thickness)?;
        if !(self.radius >= 0.0 && self.radius.is_finite()) {
            return Err(Error::option(
                "innerRadius",
                self.radius,
                "must be 0 or more",
            ));
        }
        match (0.0..=1.0).contains(&self.k_factor) {
            true => Ok(()),
            false => Err(Error::option(
                "kFactor",
                self.k_factor,
                "must be from 0 to 1",
            )),
        }
    }

    /// Computes for a bend the setback, which is the distance from the crease to where the metal begins to bend, and
    /// half of the bend allowance, both in millimetres. `angle` is in radians.
    pub(super) fn zone(&self, direction: Direction, angle: f64) -> [f64; 2] {
        [
            (self.radius + self.outside(direction)) * (0.5 * angle).tan(),
            0.5 * angle * (self.radius + self.k_factor * self.thickness),
        ]
    }

    /// The same for one fold of a smooth bend, whose upper side has a given radius and chords of a given length for each radian, in
    /// millimetres: the chords that belong to the fold become the arc on the neutral line.
    pub(super) fn smooth_zone(
        &self,
        direction: Direction,
        angle: f64,
        [radius, chord_radius]: [f64; 2],
    ) -> [f64; 2] {
        let neutral = self.inner_radius(direction, radius) + self.k_factor * self.thickness;
        [chord_radius, neutral].map(|radius| 0.5 * angle * radius)
    }

    /// Computes the inner radius of a smooth bend whose upper side has a given radius, in millimetres.
    pub(super) fn inner_radius(&self, direction: Direction, radius: f64) -> f64 {
        radius - self.outside(direction)
    }

    /// Distance of the upper side of a bend from its inside.
    fn outside(&self, direction: Direction) -> f64 {
        match direction {
            Direction::Mountain => self.thickness,
            Direction::Valley => 0.0,
        }
    }
}

//! Rigid motions of the plane.

use super::planar::Point2;

/// A rigid motion in the plane: a rotation about the origin, then a translation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Motion {
    pub turn: Point2,
    pub shift: Point2,
}

impl Motion {
    /// The identity, which leaves every point of the plane where it is.
    pub(crate) const IDENTITY: Motion = Motion {
        turn: Point2::new(1.0, 0.0),
        shift: Point2::new(0.0, 0.0),
    };

    /// Returns where the motion takes a point.
    pub(crate) fn apply(&self, place: Point2) -> Point2 {
        self.turn * place + self.shift
    }

    /// Composes two motions: this motion followed by another. Rounding does not add up to a change of size.
    pub(crate) fn then(&self, next: &Motion) -> Motion {
        let turn = next.turn * self.turn;
        Motion {
            turn: turn / turn.norm(),
            shift: next.apply(self.shift),
        }
    }

    /// Computes the rigid motion that minimises the sum of squared distances from the moved points `from` to the points
    /// `to`.
    pub(crate) fn between(from: &[Point2], to: &[Point2]) -> Motion {
        let count = from.len() as f64;
        let middle = |places: &[Point2]| places.iter().sum::<Point2>() / count;
        let (here, there) = (middle(from), middle(to));
        let pairs = from.iter().zip(to);
        let turn: Point2 = pairs.map(|(p, q)| (p - here).conj() * (q - there)).sum();
        let turn = match turn.norm() > 0.0 {
            true => turn / turn.norm(),
            false => Motion::IDENTITY.turn,
        };
        Motion {
            turn,
            shift: there - turn * here,
        }
    }
}

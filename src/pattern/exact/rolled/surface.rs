//! Surfaces that roll off into the plane.

use crate::math::planar::Point2;
use crate::scene::polyhedron::Place;

/// A surface of straight rulings, in coordinates of an angle across them and a height along them.
pub(super) trait Surface {
    /// Distance along the surface for each radian, at the height 0.
    fn radius(&self) -> f64;

    /// Angle and height of a place, and its distance from the surface.
    fn coordinates(&self, place: &Place) -> [f64; 3];

    /// Angle at which a direction is nearest to the normal.
    fn angle(&self, direction: &Place) -> f64;

    /// Unit normal at an angle, away from the axis.
    fn normal(&self, angle: f64) -> Place;

    /// Unit vector along the ruling at an angle.
    fn ruling(&self, angle: f64) -> Place;

    /// The place at an angle and a height.
    fn place(&self, at: [f64; 2]) -> Place;

    /// Whether all rulings meet at a place.
    fn is_tip(&self, place: &Place, near: f64) -> bool;

    /// Position of a point when the surface is laid flat, as seen from outside: rulings along the second axis at the angle 0, where that
    /// of the height 0 is the origin.
    fn flat(&self, at: [f64; 2]) -> Point2;

    /// Angle and height of a point of the plane that touches the surface at an angle, rolled onto it; `from` is where it lies from the
    /// ruling's point at the height 0.
    fn rolled(&self, touch: f64, from: Place) -> [f64; 2];

    /// Height at which the straight line between two points of the flat surface is at an angle.
    fn crossing(&self, line: f64, ends: [[f64; 2]; 2]) -> f64;

    /// Angles of the rulings at which it turns, in ascending order, if it is flat between them.
    fn edges(&self) -> Option<&[f64]>;
}

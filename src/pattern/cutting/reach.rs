//! Whether two sheets reach into each other.

use crate::math::planar::{distance_to_segment, polygon_contains};
use crate::unroll::flat_triangle::Point;

/// Returns whether two outlines, closed lines each, reach into each other by more than a distance.
pub(super) fn reach_into_each_other([one, other]: [&[Vec<Point>]; 2], distance: f64) -> bool {
    let is_inside = |points: &[Vec<Point>], around: &[Vec<Point>]| {
        let mut probes = points.iter().flatten();
        probes.any(|place| is_deep_inside(*place, around, distance))
    };
    is_inside(one, other) || is_inside(other, one)
}

/// Returns whether a point is inside of closed lines and farther from them than a distance.
fn is_deep_inside(place: Point, lines: &[Vec<Point>], distance: f64) -> bool {
    let around = lines.iter().filter(|line| polygon_contains(line, place));
    let mut segments = lines.iter().flat_map(|line| {
        let ends = line.iter().cycle().skip(1);
        line.iter().zip(ends).map(|(p, q)| [*p, *q])
    });
    around.count() % 2 == 1 && segments.all(|ends| distance_to_segment(place, ends) > distance)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_point_in_a_ring_is_as_deep_as_it_is_far_from_both_circles() {
        let circle = |radius: f64| -> Vec<Point> {
            (0..360)
                .map(|k| Point::from_polar(radius, f64::from(k).to_radians()))
                .collect()
        };
        let ring = [circle(10.0), circle(4.0)];
        let is_deep =
            |radius: f64, distance| is_deep_inside(Point::from_polar(radius, 1.0), &ring, distance);
        assert!(is_deep(7.0, 2.9) && !is_deep(7.0, 3.1));
        assert!(is_deep(9.0, 0.9) && !is_deep(9.0, 1.1));
        assert!(!is_deep(3.0, 0.5), "in the hole");
        assert!(!is_deep(12.0, 0.5), "outside");
    }
}

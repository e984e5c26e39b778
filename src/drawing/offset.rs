//! Offsets the outlines of sheets outwards, by half the kerf and the allowance.

use super::circle::with_arcs;
use super::curve::{CIRCLE_TOLERANCE_MM, Curve, MIN_CORNER_TURN};
use super::line::FLATTENING_TOLERANCE_MM;
use super::loops::remove_loops;
use super::smooth::curve_through;
use crate::math::planar::polygon_area;
use crate::unroll::flat_triangle::Point;
use crate::unroll::overlap::crossings;

/// Minimum offset, in millimetres, from which the maximum size of the loops that are cut off is measured.
const OFFSET_DETAIL_MM: f64 = 1.0;

/// Maximum distance of an offset corner from the corner itself, as a multiple of the offset.
const MAX_MITRE_FACTOR: f64 = 2.0;

/// Maximum size of the loops of an offset line that are cut off, as a multiple of the offset distance. Such loops arise
/// at slits.
const MAX_LOOP_FACTOR: f64 = 8.0;

/// Offsets the closed lines around a sheet outwards by a distance in millimetres. Loops in which an offset line crosses
/// itself, as in a slit narrower than the offset, are cut off. Around an `exact` sheet straight lines and arcs stay what they are.
/// `None` if lines cross nevertheless.
pub(super) fn offset_outwards(curves: &[Curve], distance: f64, exact: bool) -> Option<Vec<Curve>> {
    let mut moved = Vec::new();
    for curve in curves {
        let mut ring: Vec<Point> = (curve.points(CIRCLE_TOLERANCE_MM).into_iter())
            .map(|[x, y]| Point::new(x, y))
            .collect();
        // Remove coinciding points, and the last point, which equals the first.
        ring.dedup_by(|p, q| (*p - *q).norm() < 1e-6);
        if ring.len() > 1 && (ring[0] - ring[ring.len() - 1]).norm() < 1e-6 {
            ring.pop();
        }
        if ring.len() < 3 {
            continue;
        }
        let raw = beside(&ring, distance);
        let clean = remove_loops(raw, MAX_LOOP_FACTOR * distance.max(OFFSET_DETAIL_MM));
        // A hole that is narrower than the offset disappears.
        if polygon_area(&clean) * polygon_area(&ring) > 0.0 {
            moved.push(clean);
        }
    }
    if crosses(&moved) {
        return None;
    }
    let curve = |ring: Vec<Point>| {
        let closed = ring.iter().chain(ring.first());
        let closed: Vec<[f64; 2]> = closed.map(|p| [p.re, p.im]).collect();
        match exact {
            true => with_arcs(&closed),
            false => curve_through(&closed, FLATTENING_TOLERANCE_MM),
        }
    };
    Some(moved.into_iter().map(curve).collect())
}

/// Offsets a closed polyline to its right by a distance in millimetres, corner by corner.
fn beside(ring: &[Point], distance: f64) -> Vec<Point> {
    let n = ring.len();
    let mut out = Vec::with_capacity(n);
    for i in 0..n {
        let (before, here, after) = (ring[(i + n - 1) % n], ring[i], ring[(i + 1) % n]);
        let [u, v] = [here - before, after - here].map(|p| p / p.norm());
        let turn = (u.conj() * v).arg();
        let [p, q] = [u, v].map(|along| here + along * Point::new(0.0, -distance));
        // Intersection of both offset sides, relative to the corner.
        let half = (0.5 * turn).cos();
        let tip = (u + v) / (u + v).norm() * Point::new(0.0, -distance / half);
        if turn.abs() < MIN_CORNER_TURN || (turn > 0.0 && 1.0 <= MAX_MITRE_FACTOR * half) {
            out.push(here + tip);
        } else {
            out.extend([p, q]);
        }
    }
    out
}

fn crosses(rings: &[Vec<Point>]) -> bool {
    let mut edges: Vec<[u32; 2]> = Vec::new();
    for ring in rings {
        let (first, n) = (edges.len() as u32, ring.len() as u32);
        edges.extend((0..n).map(|k| [first + k, first + (k + 1) % n]));
    }
    !crossings(&rings.concat(), &edges).is_empty()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::planar::polyline_length;

    fn bounds(curve: &Curve) -> [[f64; 2]; 2] {
        crate::math::planar::bounds(curve.points(0.01).iter())
    }

    #[test]
    fn a_square_grows_and_its_hole_shrinks() {
        let square = |s: f64, side: f64| {
            let line = [
                [s, s],
                [s + side, s],
                [s + side, s + side],
                [s, s + side],
                [s, s],
            ];
            Curve::through(&line)
        };
        let hole: Vec<[f64; 2]> = square(10.0, 20.0).points(1.0).into_iter().rev().collect();
        let small: Vec<[f64; 2]> = square(33.0, 3.0).points(1.0).into_iter().rev().collect();
        let all = [
            square(0.0, 40.0),
            Curve::through(&hole),
            Curve::through(&small),
        ];
        let found = offset_outwards(&all, 2.0, false).unwrap();
        // The smallest hole has been filled.
        assert_eq!(found.len(), 2);
        for (curve, [low, high]) in found.iter().zip([[-2.0, 42.0], [12.0, 28.0]]) {
            let [from, to] = bounds(curve);
            for k in 0..2 {
                assert!(
                    (from[k] - low).abs() < 0.01 && (to[k] - high).abs() < 0.01,
                    "{from:?} {to:?}"
                );
            }
            assert!((polyline_length(&curve.points(0.01)) - 4.0 * (high - low)).abs() < 0.1);
        }
    }

    #[test]
    fn a_round_hole_stays_a_circle_and_a_plate_has_four_lines() {
        let plate = [
            [0.0, 0.0],
            [60.0, 0.0],
            [60.0, 40.0],
            [0.0, 40.0],
            [0.0, 0.0],
        ];
        let hole: Vec<[f64; 2]> = (0..=48)
            .map(|k| (-std::f64::consts::TAU * f64::from(k % 48) / 48.0).sin_cos())
            .map(|(sin, cos)| [30.0 + 8.0 * cos, 20.0 + 8.0 * sin])
            .collect();
        let all = [with_arcs(&plate), with_arcs(&hole)];
        let found = offset_outwards(&all, 0.1, true).unwrap();
        assert_eq!(found[0].pieces().count(), 4);
        let (centre, radius) = found[1].circle().unwrap();
        assert!((radius - 7.9).abs() < 1e-3, "{radius}");
        assert!(
            (centre[0] - 30.0).hypot(centre[1] - 20.0) < 1e-3,
            "{centre:?}"
        );
    }

    #[test]
    fn a_slit_that_is_narrower_closes() {
        // A square with a slit from the right to its middle, one wide.
        let line = [
            [0.0, 0.0],
            [40.0, 0.0],
            [40.0, 20.0],
            [20.0, 20.5],
            [40.0, 21.0],
            [40.0, 40.0],
            [0.0, 40.0],
            [0.0, 0.0],
        ];
        let found = offset_outwards(&[Curve::through(&line)], 2.0, false).unwrap();
        assert_eq!(found.len(), 1);
        let around = polyline_length(&found[0].points(0.01));
        assert!((around - 4.0 * 44.0).abs() < 2.0, "{around}");
        // A beam's width leaves most of it.
        let found = offset_outwards(&[Curve::through(&line)], 0.1, false).unwrap();
        let around = polyline_length(&found[0].points(0.01));
        assert!(
            (around - (4.0 * 40.2 + 2.0 * 16.0 - 1.0)).abs() < 4.0,
            "{around}"
        );
    }
}

//! Offsets the outlines of sheets outwards, by half the kerf and the allowance.

use std::f64::consts::FRAC_PI_3;

use i_overlay::core::fill_rule::FillRule;
use i_overlay::float::clip::FloatClip;
use i_overlay::mesh::float::outline::offset::OutlineOffset;
use i_overlay::mesh::float::style::{LineJoin, OutlineStyle};
use i_overlay::string::clip::ClipRule;

use super::circle::{corners, with_arcs};
use super::curve::{CIRCLE_TOLERANCE_MM, Curve};
use super::line::FLATTENING_TOLERANCE_MM;
use super::smooth::curve_through;

/// Minimum angle, in radians, of a corner that stays one, moved by up to twice the distance; others are cut off. No table chose it.
const MIN_MITRE_ANGLE: f64 = FRAC_PI_3;

/// Offsets the closed lines around a sheet outwards by a distance in millimetres. What the enlarged sheet covers of them, as slits and
/// holes that are narrower than twice the distance, is returned as well, there and back: it is cut where it is.
/// Around an `exact` sheet straight lines and arcs stay what they are, and the sides of a polygon straight.
pub(super) fn offset_outwards(curves: &[Curve], distance: f64, exact: bool) -> Vec<Curve> {
    let smooth = |line: &[[f64; 2]]| match exact {
        true => with_arcs(line, FLATTENING_TOLERANCE_MM),
        false => curve_through(line, FLATTENING_TOLERANCE_MM),
    };
    let lines: Vec<_> = (curves.iter())
        .map(|curve| curve.points(CIRCLE_TOLERANCE_MM))
        .collect();
    let rings: Vec<&[[f64; 2]]> = lines.iter().map(|line| &line[1..]).collect();
    let outer: Vec<_> = (rings.outline(&style(distance)).into_iter().flatten())
        .map(|mut ring| {
            ring.extend(ring.first().copied());
            corners(&ring)
        })
        .collect();
    let outer_rings: Vec<&[[f64; 2]]> = outer.iter().map(|line| &line[1..]).collect();
    // A hundredth deeper, so that what lies where it did is not covered.
    let covering = outer_rings.outline(&style(-1.01 * distance));
    let strictly_inside = ClipRule {
        invert: false,
        boundary_included: false,
    };
    let covered = lines.clip_by(&covering, FillRule::NonZero, strictly_inside);
    let there_and_back = covered.into_iter().map(|mut line| {
        if line.first() != line.last() {
            let back: Vec<_> = line.iter().rev().skip(1).copied().collect();
            line.extend(back);
        }
        smooth(&line)
    });
    let around = outer.iter().map(|line| smooth(line));
    around.chain(there_and_back).collect()
}

fn style(distance: f64) -> OutlineStyle<f64> {
    OutlineStyle::new(distance).line_join(LineJoin::Miter(MIN_MITRE_ANGLE))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::planar::{polygon_contains, polyline_length};

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
        let found = offset_outwards(&all, 2.0, false);
        // The smallest hole is filled, and cut where it was.
        assert_eq!(found.len(), 3);
        assert!((polyline_length(&found[2].points(0.01)) - 12.0).abs() < 0.01);
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
    fn a_round_hole_stays_a_circle_and_sides_stay_straight() {
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
        let all = [&plate[..], &hole].map(|line| with_arcs(line, f64::INFINITY));
        let found = offset_outwards(&all, 0.1, true);
        assert_eq!(found[0].pieces().count(), 4);
        let (centre, radius) = found[1].circle().unwrap();
        let disc: Vec<[f64; 2]> = hole.into_iter().rev().step_by(2).collect();
        let sides = offset_outwards(&[Curve::through(&disc)], 0.1, true);
        assert_eq!(sides[0], Curve::through(&sides[0].points(1.0)));
        assert_eq!(sides[0].pieces().count(), 24);
        assert!((radius - 7.9).abs() < 1e-3, "{radius}");
        assert!(
            (centre[0] - 30.0).hypot(centre[1] - 20.0) < 1e-3,
            "{centre:?}"
        );
    }

    /// A square of 40 mm with a slit from the right to its middle, whose mouth is `wide`.
    fn slit(wide: f64) -> Curve {
        let (middle, above) = (20.0 + 0.5 * wide, 20.0 + wide);
        through(
            [0.0, 40.0, 40.0, 20.0, 40.0, 40.0, 0.0, 0.0],
            [0.0, 0.0, 20.0, middle, above, 40.0, 40.0, 0.0],
        )
    }

    fn through<const N: usize>(x: [f64; N], y: [f64; N]) -> Curve {
        Curve::through(&std::array::from_fn::<_, N, _>(|k| [x[k], y[k]]))
    }

    fn lengths(curves: &[Curve]) -> Vec<f64> {
        curves
            .iter()
            .map(|curve| polyline_length(&curve.points(0.01)))
            .collect()
    }

    #[test]
    fn a_closed_slit_is_cut_where_it_is() {
        for exact in [false, true] {
            for out in [0.1, 5.0] {
                let found = lengths(&offset_outwards(&[slit(0.0)], out, exact));
                assert_eq!(found.len(), 2, "{found:?}");
                assert!(
                    (found[0] - 4.0 * (40.0 + 2.0 * out)).abs() < 0.01,
                    "{found:?}"
                );
                // There and back, up to the border.
                assert!((found[1] - 40.0).abs() < 0.2, "{found:?}");
            }
        }
    }

    #[test]
    fn a_slit_is_cut_along_both_sides_where_it_is_narrower() {
        // A beam's width leaves sixteen of its twenty millimetres.
        let found = lengths(&offset_outwards(&[slit(1.0)], 0.1, true));
        assert!(
            (found[0] - (4.0 * 40.2 - 0.8 + 2.0 * 16.1)).abs() < 0.1,
            "{found:?}"
        );
        let covered: f64 = found[1..].iter().sum();
        assert!((covered - 4.0 * 4.0).abs() < 1.0, "{found:?}");
        // An allowance that fills it leaves the slit.
        let found = lengths(&offset_outwards(&[slit(1.0)], 2.0, true));
        assert!((found[0] - 4.0 * 44.0).abs() < 0.01, "{found:?}");
        assert!(found[1..].iter().sum::<f64>() > 4.0 * 19.0, "{found:?}");
    }

    #[test]
    fn lines_that_meet_further_out_leave_one_outline() {
        // Two teeth whose tips are 1 mm apart, with a bay between them.
        let teeth = through(
            [0.0, 30.0, 30.0, 15.5, 20.0, 10.0, 14.5, 0.0, 0.0],
            [0.0, 0.0, 20.0, 20.0, 10.0, 10.0, 20.0, 20.0, 0.0],
        );
        let found = lengths(&offset_outwards(&[teeth], 1.0, true));
        assert!(
            (found[0] - (2.0 * 32.0 + 2.0 * 22.0)).abs() < 0.01,
            "{found:?}"
        );
        // The bay has become a hole, and its mouth is cut where it was.
        let bay = 8.0 + 2.0 * 4.5f64.hypot(10.0);
        assert!(found[1] > 0.6 * bay && found[1] < bay, "{found:?}");
    }

    #[test]
    fn rings_of_any_kind_lie_within_what_is_drawn_around_them() {
        let mut random = oorandom::Rand64::new(7);
        for count in (4..200).step_by(4) {
            let out = 0.05 * 200f64.powf(random.rand_float());
            let mut ring: Vec<[f64; 2]> = (0..count)
                .map(|k| {
                    let (sin, cos) = (std::f64::consts::TAU * k as f64 / count as f64).sin_cos();
                    let radius = 20.0 + 80.0 * random.rand_float();
                    [radius * cos, radius * sin]
                })
                .collect();
            // A slit to the middle, a doubled point, and one that rounding has moved.
            ring.extend([
                [0.0, 0.0],
                ring[count - 1],
                ring[count - 1],
                ring[0],
                [ring[0][0], ring[0][1] + 1e-9],
            ]);
            ring.push(ring[0]);
            let found = offset_outwards(&[Curve::through(&ring)], out, true);
            let around = found[0].points(0.01);
            for p in &ring {
                assert!(polygon_contains(&around, *p), "{count} {out} {p:?}");
            }
            let reach = around.iter().map(|p| p[0].hypot(p[1])).fold(0.0, f64::max);
            assert!(reach < 100.0 + 2.01 * out, "{count} {out} {reach}");
        }
    }
}

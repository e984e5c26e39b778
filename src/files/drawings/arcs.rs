//! Approximates curves by circular arcs, for file formats without Bézier curves.

use crate::drawing::{Curve, Piece};

/// Maximum distance between a circular arc and the Bézier curve that it replaces, in millimetres.
const ARC_TOLERANCE_MM: f64 = 0.01;

/// Maximum distance of arcs from the one that they are joined to, in millimetres: a hundredth of what they may be off the curve.
const JOINED_TOLERANCE_MM: f64 = 0.01 * ARC_TOLERANCE_MM;

/// Quarter of the angle of half a circle, in radians.
const HALF_CIRCLE_QUARTER: f64 = std::f64::consts::FRAC_PI_4 * (1.0 + 1e-9);

/// Maximum number of times that a Bézier curve is halved to approximate it by arcs.
const MAX_CURVE_HALVINGS: u32 = 8;

/// A corner of a polyline and the piece that follows it: a straight piece or an arc. `bulge` is the tangent of a
/// quarter of the arc's angle, positive if it runs counter-clockwise, 0 for a straight piece.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Corner {
    pub place: [f64; 2],
    pub bulge: f64,
}

/// Approximates a curve by straight pieces and circular arcs; the last corner is the curve's end.
pub(super) fn arcs(curve: &Curve) -> Vec<Corner> {
    let mut out = Vec::new();
    for piece in curve.pieces() {
        match piece {
            Piece::Line([from, _]) => out.push(Corner {
                place: from,
                bulge: 0.0,
            }),
            Piece::Bezier(_) => halved(&piece, [0.0, 1.0], MAX_CURVE_HALVINGS, &mut out),
        }
    }
    out.extend(curve.controls().last().map(|place| Corner {
        place: *place,
        bulge: 0.0,
    }));
    merge_arcs(&out)
}

/// Makes one arc of neighbouring ones on the same circle, up to half a circle.
fn merge_arcs(corners: &[Corner]) -> Vec<Corner> {
    let mut out: Vec<Corner> = Vec::new();
    for (k, corner) in corners.iter().enumerate() {
        let whole = out.last().zip(corners.get(k + 1)).and_then(|(last, next)| {
            let arcs = [(*last, corner.place), (*corner, next.place)];
            let [quarter, other] = arcs.map(|(arc, _)| arc.bulge.atan());
            let whole = Corner {
                bulge: (quarter + other).tan(),
                ..*last
            };
            let is_on = |place| from_arc(place, whole, next.place) <= JOINED_TOLERANCE_MM;
            let is_one = quarter * other > 0.0
                && (quarter + other).abs() <= HALF_CIRCLE_QUARTER
                && is_on(corner.place)
                && arcs.iter().all(|(arc, to)| is_on(middle(*arc, *to)));
            is_one.then_some(whole)
        });
        match (whole, out.last_mut()) {
            (Some(whole), Some(last)) => *last = whole,
            _ => out.push(*corner),
        }
    }
    out
}

/// The point in the middle of an arc.
fn middle(Corner { place: from, bulge }: Corner, to: [f64; 2]) -> [f64; 2] {
    let chord = less(to, from);
    [
        0.5 * (from[0] + to[0]) + 0.5 * bulge * chord[1],
        0.5 * (from[1] + to[1]) - 0.5 * bulge * chord[0],
    ]
}

/// Approximates a part of a curve by two arcs that have its tangents at the ends and a common tangent where they
/// meet, or recursively by halves.
fn halved(piece: &Piece, [from, to]: [f64; 2], left: u32, out: &mut Vec<Corner>) {
    let ends = [from, to].map(|t| (piece.at(t), tangent(piece, t)));
    let middle = 0.5 * (from + to);
    let two = biarc(ends);
    let near = |pair: &[Corner; 2]| {
        let arcs = [(pair[0], pair[1].place), (pair[1], ends[1].0)];
        (1..8).all(|i| {
            let place = piece.at(from + (to - from) * f64::from(i) / 8.0);
            let away = arcs.map(|(corner, end)| from_arc(place, corner, end));
            away[0].min(away[1]) <= ARC_TOLERANCE_MM
        })
    };
    match two.filter(|pair| left == 0 || near(pair)) {
        Some(pair) => out.extend(pair),
        None if left == 0 => out.push(Corner {
            place: ends[0].0,
            bulge: 0.0,
        }),
        None => {
            halved(piece, [from, middle], left - 1, out);
            halved(piece, [middle, to], left - 1, out);
        }
    }
}

/// Unit tangent of a curve; that beside a point where it stands still.
fn tangent(piece: &Piece, t: f64) -> [f64; 2] {
    /// Difference of the curve's parameter between such a point and those on both sides of it.
    const BESIDE_STEP: f64 = 1e-4;
    let at = |t: f64| piece.at(t.clamp(0.0, 1.0));
    let beside = || less(at(t + BESIDE_STEP), at(t - BESIDE_STEP));
    let velocity = match piece {
        Piece::Line([from, to]) => less(*to, *from),
        Piece::Bezier([a, b, c, d]) => {
            let s = 1.0 - t;
            let [u, v, w] = [less(*b, *a), less(*c, *b), less(*d, *c)];
            [0, 1].map(|k| s * s * u[k] + 2.0 * s * t * v[k] + t * t * w[k])
        }
    };
    let along = if velocity == [0.0; 2] {
        beside()
    } else {
        velocity
    };
    let long = along[0].hypot(along[1]).max(f64::MIN_POSITIVE);
    along.map(|v| v / long)
}

fn dot(u: [f64; 2], v: [f64; 2]) -> f64 {
    u[0] * v[0] + u[1] * v[1]
}

pub(super) fn less(p: [f64; 2], q: [f64; 2]) -> [f64; 2] {
    [p[0] - q[0], p[1] - q[1]]
}

/// Computes two circular arcs that connect two positions with given tangents there and a common tangent where they
/// meet; the tangent lengths on either side of the meeting point are equal (Bolton 1975). `None` if there are no such
/// arcs.
fn biarc([(p, u), (q, v)]: [([f64; 2], [f64; 2]); 2]) -> Option<[Corner; 2]> {
    let chord = less(q, p);
    let sum = [u[0] + v[0], u[1] + v[1]];
    // d² (2 − 2 u·v) + 2 d c·(u + v) − c·c = 0.
    let (a, b, c) = (
        2.0 - 2.0 * dot(u, v),
        2.0 * dot(chord, sum),
        -dot(chord, chord),
    );
    let root = (b * b - 4.0 * a * c).sqrt();
    let d = -2.0 * c / (b + root);
    if !(d > 0.0 && d.is_finite()) {
        return None;
    }
    let joint = [0, 1].map(|k| 0.5 * (p[k] + q[k] + d * (u[k] - v[k])));
    let corner = |from: [f64; 2], to: [f64; 2], heading: [f64; 2], way: f64| {
        let chord = less(to, from);
        let cross = heading[0] * chord[1] - heading[1] * chord[0];
        // Half of the arc's angle lies between tangent and chord.
        let half = way * cross.atan2(dot(heading, chord));
        Corner {
            place: from,
            bulge: (0.5 * half).tan(),
        }
    };
    let second = Corner {
        place: joint,
        ..corner(q, joint, v.map(|x| -x), -1.0)
    };
    Some([corner(p, joint, u, 1.0), second])
}

/// Computes the distance of a position from the circle of an arc, or from the line of a straight piece.
fn from_arc(place: [f64; 2], Corner { place: from, bulge }: Corner, to: [f64; 2]) -> f64 {
    let chord = less(to, from);
    let long = chord[0].hypot(chord[1]);
    if long == 0.0 {
        return f64::INFINITY;
    }
    let normal = [-chord[1] / long, chord[0] / long];
    if bulge.abs() < 1e-9 {
        return dot(less(place, from), normal).abs();
    }
    let radius = 0.25 * long * (bulge + 1.0 / bulge);
    let rise = 0.25 * long * (1.0 / bulge - bulge);
    let centre = [0, 1].map(|k| 0.5 * (from[k] + to[k]) + rise * normal[k]);
    let [x, y] = less(place, centre);
    (x.hypot(y) - radius.abs()).abs()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::planar::distance_to_segment;

    /// Points of a polyline with arcs, as its format defines them.
    fn traced(corners: &[Corner]) -> Vec<[f64; 2]> {
        let mut out = Vec::new();
        for pair in corners.windows(2) {
            let (from, to, bulge) = (pair[0].place, pair[1].place, pair[0].bulge);
            if bulge == 0.0 {
                out.push(from);
                continue;
            }
            let chord = less(to, from);
            let angle = 4.0 * bulge.atan();
            let radius = 0.5 * chord[0].hypot(chord[1]) / (0.5 * angle).sin();
            let start = chord[1].atan2(chord[0]) - 0.5 * angle;
            let centre = [
                from[0] - radius * start.sin(),
                from[1] + radius * start.cos(),
            ];
            for i in 0..20 {
                let at = start + angle * f64::from(i) / 20.0;
                out.push([centre[0] + radius * at.sin(), centre[1] - radius * at.cos()]);
            }
        }
        out
    }

    /// A slot of 30 × 8 mm: two straight pieces and two halves of circles.
    #[test]
    fn an_arc_is_one_arc() {
        let mut controls = vec![[11.0, -4.0]];
        for (centre, from) in [(11.0, -90.0), (-11.0, 90.0)] {
            for step in 0..4 {
                // Bézier curves of 45°, whose arms are 4/3 tan(45°/4) long.
                let [a, b] = [0, 1].map(|end| (from + 45.0 * f64::from(step + end)).to_radians());
                let arm = 4.0 / 3.0 * (std::f64::consts::FRAC_PI_4 / 4.0).tan();
                let at = |t: f64, arm: f64| {
                    let (sin, cos) = t.sin_cos();
                    [centre + 4.0 * (cos - arm * sin), 4.0 * (sin + arm * cos)]
                };
                controls.extend([at(a, arm), at(b, -arm), at(b, 0.0)]);
            }
            controls
                .extend([1.0, -1.0, -3.0].map(|third| [third * centre / 3.0, 4.0 * centre / 11.0]));
        }
        let curve = serde_json::to_string(&controls).unwrap();
        let curve: Curve = serde_json::from_str(&curve).unwrap();
        let corners = arcs(&curve);
        let bulges: Vec<f64> = corners.iter().map(|c| c.bulge).collect();
        assert_eq!(bulges.len(), 5, "{corners:?}");
        for (found, right) in bulges.iter().zip([1.0, 0.0, 1.0, 0.0, 0.0]) {
            assert!((found - right).abs() < 1e-4, "{bulges:?}");
        }
    }

    #[test]
    fn arcs_follow_a_curve_both_ways() {
        let json = "[[0,0],[40,60],[80,-60],[120,10],[140,45],[100,90],[90,20]]";
        let curve: Curve = serde_json::from_str(json).unwrap();
        let fine = curve.points(1e-4);
        let corners = arcs(&curve);
        assert!(corners.len() < 60, "{}", corners.len());
        assert_eq!(corners[corners.len() - 1].place, [90.0, 20.0]);
        for place in traced(&corners) {
            let nearest = (fine.windows(2)).map(|p| distance_to_segment(place, [p[0], p[1]]));
            let nearest = nearest.fold(f64::INFINITY, f64::min);
            assert!(nearest < 0.02, "{place:?}: {nearest}");
        }
    }
}

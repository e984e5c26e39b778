//! Developable surfaces, envelopes of some, and shapes with steps, as heights over the unit square.

use std::f64::consts::TAU;

/// A surface and its name.
pub struct Scene {
    pub name: &'static str,
    pub height: fn(f64, f64) -> f64,
}

macro_rules! scenes {
    ($($name:ident),* $(,)?) => {
        [$(Scene { name: stringify!($name), height: $name }),*]
    };
}

pub fn all() -> Vec<Scene> {
    scenes![
        wave, fan, tangents, groin, valley, tent, fold, accordion, cones, frustum, corner, leaf,
        facets, plane, stairs, ramps, half_pipe, ripples, block, roof, cup, scroll,
    ]
    .into()
}

/// Coordinates about the middle, turned by an angle.
fn turned(x: f64, y: f64, angle: f64) -> [f64; 2] {
    let (sin, cos) = angle.sin_cos();
    let (x, y) = (x - 0.5, y - 0.5);
    [cos * x + sin * y, cos * y - sin * x]
}

/// A circle's arc of a radius, 0 in the middle.
fn arc(u: f64, radius: f64) -> f64 {
    (radius * radius - u * u).sqrt() - radius
}

/// A cylinder over a wave.
fn wave(x: f64, y: f64) -> f64 {
    let [u, _] = turned(x, y, 0.4);
    0.08 * (1.3 * TAU * u).sin() + 0.1 * u * u
}

/// A cone over a wave, its apex outside.
fn fan(x: f64, y: f64) -> f64 {
    let (x, y) = (x + 0.4, y - 0.3);
    x.hypot(y) * 0.12 * (4.0 * y.atan2(x)).sin()
}

/// The tangents of a curve: the planes `t x + t²/2 y − k t³/6` and where two next to each other meet.
fn tangents(x: f64, y: f64) -> f64 {
    let (x, y, k) = (x + 0.3, y - 0.4, 1.5);
    let t = (y + (y * y + 2.0 * k * x).sqrt()) / k;
    0.5 * (t * x + 0.5 * t * t * y - k * t.powi(3) / 6.0)
}

/// Two barrels that cross: an upper envelope.
fn groin(x: f64, y: f64) -> f64 {
    let [u, v] = turned(x, y, 0.3);
    arc(u, 0.8).max(arc(v, 0.75) - 0.01)
}

/// A cone and a cylinder: a lower envelope.
fn valley(x: f64, y: f64) -> f64 {
    let cone = 0.55 * (x - 0.3).hypot(y - 0.6);
    let barrel = 0.25 + arc(turned(x, y, 1.1)[0], 0.9);
    cone.min(barrel)
}

/// A pyramid with the corners of no square.
fn tent(x: f64, y: f64) -> f64 {
    (0.6 * x)
        .min(0.9 * (1.0 - x))
        .min(0.7 * y)
        .min(0.5 * (1.0 - y) + 0.1 * x)
}

/// A cylinder, mirrored above a plane: a curved fold.
fn fold(x: f64, y: f64) -> f64 {
    let [u, v] = turned(x, y, 0.2);
    let f = 0.8 * u * u + 0.5 * v;
    0.12 - (f - 0.12).abs()
}

/// Parallel folds.
fn accordion(x: f64, y: f64) -> f64 {
    let [u, _] = turned(x, y, 0.5);
    let period = 0.31;
    0.5 * ((u / period).rem_euclid(1.0) - 0.5).abs() * period
}

/// Two cones: an upper envelope.
fn cones(x: f64, y: f64) -> f64 {
    let cone = |a: f64, b: f64, slope: f64| 0.5 - slope * (x - a).hypot(y - b);
    cone(0.3, 0.35, 0.6).max(cone(0.75, 0.7, 0.8))
}

/// A cone without its tip.
fn frustum(x: f64, y: f64) -> f64 {
    (0.4 - 0.7 * (x - 0.5).hypot(y - 0.45)).min(0.25)
}

/// A flat sheet with a corner that curls up.
fn corner(x: f64, y: f64) -> f64 {
    let u = (x + 0.7 * y - 1.0).max(0.0);
    0.6 - (0.36 - 0.5 * u * u).sqrt()
}

/// A cylinder over a curve of growing curvature, within an outline.
fn leaf(x: f64, y: f64) -> f64 {
    let [u, v] = turned(x, y, 0.9);
    if (u / 0.48).powi(2) + (v / 0.38).powi(2) > 1.0 {
        return f64::NAN;
    }
    0.25 * (u + 0.5).powi(4)
}

/// The upper envelope of planes.
fn facets(x: f64, y: f64) -> f64 {
    let plane = |k: usize| {
        let angle = 2.4 * k as f64;
        let slope = 0.1 + 0.06 * k as f64;
        let [u, _] = turned(x, y, angle);
        slope * u - 0.5 * slope * slope
    };
    (0..9).map(plane).fold(f64::NEG_INFINITY, f64::max)
}

fn plane(x: f64, y: f64) -> f64 {
    0.3 * x - 0.2 * y
}

/// Level steps, which no surface like paper has.
fn stairs(x: f64, y: f64) -> f64 {
    0.06 * (turned(x, y, 0.35)[0] / 0.15).floor()
}

/// Level steps with ramps between them.
fn ramps(x: f64, y: f64) -> f64 {
    let u = turned(x, y, 0.35)[0] / 0.2;
    0.08 * (u.floor() + (4.0 * u.rem_euclid(1.0) - 1.5).clamp(0.0, 1.0))
}

/// A flat floor between two quarters of a cylinder.
fn half_pipe(x: f64, y: f64) -> f64 {
    let beyond = (turned(x, y, 0.7)[0].abs() - 0.05).clamp(0.0, 0.45);
    0.5 - (0.2501 - beyond * beyond).sqrt()
}

/// A cylinder over a wave of many periods.
fn ripples(x: f64, y: f64) -> f64 {
    0.02 * (7.0 * TAU * turned(x, y, 0.3)[0]).sin()
}

/// A block on a table, seen from above.
fn block(x: f64, y: f64) -> f64 {
    let [u, v] = turned(x, y, 0.2);
    if u.abs() < 0.25 && v.abs() < 0.2 {
        0.2
    } else {
        0.0
    }
}

/// Two gable roofs that cross.
fn roof(x: f64, y: f64) -> f64 {
    let [u, v] = turned(x, y, 0.45);
    (0.3 - 0.7 * u.abs()).max(0.25 - 0.6 * v.abs())
}

/// A disc with a conical rim in a plane.
fn cup(x: f64, y: f64) -> f64 {
    let radius = (x - 0.5).hypot(y - 0.5);
    0.6 * (radius - 0.3).clamp(0.0, 0.12)
}

/// A sheet that begins to roll up steeply.
fn scroll(x: f64, y: f64) -> f64 {
    let u = turned(x, y, 1.2)[0];
    if u < 0.0 {
        0.02 * u
    } else {
        0.35 - (0.1225 - 0.45 * u * u).max(0.0).sqrt()
    }
}

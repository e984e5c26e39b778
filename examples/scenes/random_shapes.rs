//! Shapes by random generators with seeds: developable surfaces, envelopes of some, and steps, over the unit square.

use std::f64::consts::TAU;

use oorandom::Rand64;

/// Height of a shape at a point of the unit square.
pub type Height = Box<dyn Fn(f64, f64) -> f64 + Send + Sync>;

/// Names of the generators. The last four make shapes without noise that are not developable.
pub const NAMES: [&str; 20] = [
    "cylinder",
    "fan",
    "crease_graph",
    "roofs",
    "parabola_fold",
    "corrugated",
    "half_pipe",
    "dcone",
    "book",
    "terraces",
    "planks",
    "rolled_corner",
    "pleats",
    "miura",
    "village",
    "cup",
    "terrain",
    "rough_terrain",
    "dome",
    "head",
];

/// Number of generators whose shapes get noise.
pub const DEVELOPABLE: usize = 16;

/// Makes the shape of a generator for a seed.
pub fn shape(name: &str, seed: u64) -> Height {
    let mut random = Rand64::new(u128::from(seed) * 7919 + name.len() as u128 * 104_729);
    let mut from = move |low: f64, high: f64| low + (high - low) * random.rand_float();
    (0..8).for_each(|_| {
        from(0.0, 1.0);
    });
    let turn = from(0.15, 1.4);
    let middle = [from(0.4, 0.6), from(0.4, 0.6)];
    let turned = move |x: f64, y: f64| {
        let (sin, cos) = turn.sin_cos();
        let (x, y) = (x - middle[0], y - middle[1]);
        [cos * x + sin * y, cos * y - sin * x]
    };
    match name {
        "cylinder" => {
            let (a, k, p, c) = (
                from(0.04, 0.1),
                from(0.8, 1.8),
                from(0.0, TAU),
                from(-0.2, 0.2),
            );
            Box::new(move |x, y| {
                let [u, _] = turned(x, y);
                a * (k * TAU * u + p).sin() + c * u * u
            })
        }
        "fan" => {
            let (d, a, k, p) = (
                from(0.2, 0.6),
                from(0.08, 0.16),
                from(3.0, 5.0),
                from(0.0, TAU),
            );
            Box::new(move |x, y| {
                let (x, y) = (x + d, y - middle[1]);
                a * x.hypot(y) * (k * y.atan2(x) + p).sin()
            })
        }
        "crease_graph" | "roofs" => {
            let planes: Vec<[f64; 3]> = (0..9)
                .map(|_| [from(-0.6, 0.6), from(-0.6, 0.6), from(-0.08, 0.08)])
                .collect();
            let mixed = name == "roofs";
            Box::new(move |x, y| {
                let plane = |[a, b, c]: &[f64; 3]| a * (x - 0.5) + b * (y - 0.5) + c;
                let most = |planes: &[[f64; 3]]| {
                    planes.iter().map(plane).fold(f64::NEG_INFINITY, f64::max)
                };
                match mixed {
                    true => most(&planes[..4]).min(0.1 + most(&planes[4..])),
                    false => most(&planes),
                }
            })
        }
        "parabola_fold" => {
            let (a, b, c) = (from(0.5, 1.0), from(0.3, 0.6), from(0.05, 0.15));
            Box::new(move |x, y| {
                let [u, v] = turned(x, y);
                c - (a * u * u + b * v - c).abs()
            })
        }
        "corrugated" => {
            let (a, k) = (from(0.01, 0.02), from(5.0, 7.0));
            Box::new(move |x, y| a * (k * TAU * turned(x, y)[0]).sin())
        }
        "half_pipe" => {
            let (r, s) = (from(0.15, 0.25), from(0.05, 0.15));
            Box::new(move |x, y| {
                let [u, v] = turned(x, y);
                match u.abs() < r && v.abs() < 0.38 {
                    true => s + (r * r - u * u).sqrt(),
                    false => 0.0,
                }
            })
        }
        "dcone" => {
            let (a, k, p) = (from(0.1, 0.25), from(2.0, 4.0).round(), from(0.0, TAU));
            Box::new(move |x, y| {
                let [u, v] = turned(x, y);
                a * u.hypot(v) * (k * v.atan2(u) + p).cos()
            })
        }
        "book" => {
            let (a, b) = (from(0.08, 0.14), from(4.0, 7.0));
            Box::new(move |x, y| {
                let u = turned(x, y)[0].abs();
                a * (1.0 - (-b * u).exp()) * (1.0 - 0.6 * u)
            })
        }
        "terraces" => {
            let (s, w) = (from(0.03, 0.08), from(0.12, 0.22));
            Box::new(move |x, y| s * (turned(x, y)[0] / w).floor())
        }
        "planks" => {
            let heights: Vec<f64> = (0..12).map(|_| from(0.0, 0.12)).collect();
            let w = from(0.14, 0.2);
            Box::new(move |x, y| {
                let u = turned(x, y)[0] / w + 6.0;
                let (i, t) = (u.floor().clamp(0.0, 10.0) as usize, u - u.floor());
                heights[i] * (1.0 - t) + heights[i + 1] * t
            })
        }
        "rolled_corner" => {
            let (k, r) = (from(0.4, 0.9), from(0.3, 0.5));
            Box::new(move |x, y| {
                let u = (x + k * y - 0.9 * k - 0.3).max(0.0) / (1.0 + k * k).sqrt();
                r - (r * r - (u * u).min(0.81 * r * r)).sqrt()
            })
        }
        "pleats" => {
            let (w, a) = (from(0.09, 0.14), from(0.25, 0.5));
            Box::new(move |x, y| a * w * ((turned(x, y)[0] / w).rem_euclid(1.0) - 0.5).abs())
        }
        "miura" => {
            let (w, l, s) = (from(0.16, 0.24), from(0.25, 0.4), from(0.2, 0.4));
            let wave = |t: f64| (t.rem_euclid(1.0) - 0.5).abs();
            Box::new(move |x, y| {
                let [u, v] = turned(x, y);
                0.5 * w * wave((u + s * l * wave(v / l)) / w)
            })
        }
        "village" => {
            let houses: Vec<[f64; 5]> = (0..4)
                .map(|i| {
                    let (x, y) = (
                        0.27 + 0.46 * f64::from(i % 2),
                        0.27 + 0.46 * f64::from(i / 2),
                    );
                    [x, y, from(0.0, TAU), from(0.05, 0.12), from(0.3, 0.9)]
                })
                .collect();
            Box::new(move |x, y| {
                let house = |[a, b, turn, wall, slope]: &[f64; 5]| {
                    let (sin, cos) = turn.sin_cos();
                    let [u, v] = [cos * (x - a) + sin * (y - b), cos * (y - b) - sin * (x - a)];
                    match u.abs() < 0.17 && v.abs() < 0.11 {
                        true => wall + slope * (0.11 - v.abs()),
                        false => 0.0,
                    }
                };
                houses.iter().map(house).fold(0.0, f64::max)
            })
        }
        "cup" => {
            let (s, r) = (from(0.4, 0.9), from(0.2, 0.3));
            Box::new(move |x, y| {
                let [u, v] = turned(x, y);
                s * (u.hypot(v) - r).clamp(0.0, 0.13)
            })
        }
        "dome" => {
            let r = from(0.6, 0.9);
            Box::new(move |x, y| {
                let [u, v] = turned(x, y);
                (r * r - (u * u + v * v).min(0.9 * r * r)).sqrt()
            })
        }
        "head" => {
            let bumps: Vec<[f64; 4]> = (0..14)
                .map(|_| {
                    [
                        from(0.1, 0.9),
                        from(0.1, 0.9),
                        from(0.05, 0.25),
                        from(-0.08, 0.15),
                    ]
                })
                .collect();
            Box::new(move |x, y| {
                let bump = |[a, b, w, h]: &[f64; 4]| {
                    h * (-((x - a).powi(2) + (y - b).powi(2)) / (w * w)).exp()
                };
                bumps.iter().map(bump).sum()
            })
        }
        _ => fractal(if name == "terrain" { 2.1 } else { 1.7 }, from),
    }
}

/// Sum of waves in random directions, whose amplitude falls with a power of their frequency.
fn fractal(power: f64, mut from: impl FnMut(f64, f64) -> f64) -> Height {
    let waves: Vec<[f64; 4]> = (0..150)
        .map(|_| {
            let frequency = 70f64.powf(from(0.0, 1.0));
            let turn = from(0.0, TAU);
            let size = frequency.powf(1.0 - power) * 0.04;
            [
                frequency * turn.cos(),
                frequency * turn.sin(),
                from(0.0, TAU),
                size,
            ]
        })
        .collect();
    Box::new(move |x, y| {
        let wave = |[a, b, p, size]: &[f64; 4]| size * (TAU * (a * x + b * y) + p).sin();
        waves.iter().map(wave).sum()
    })
}

//! Surfaces whose flat shape is known, laid flat; from exact heights, and from noisy ones that were
//! solved first.

use crate::native::common::{cut, noisy, unit_square};
use developable::dewarp::{DewarpOptions, Extent, Verdict, WarpMap};
use developable::unroll::{UnrollOptions, Unrolling, unroll};
use developable::{Heightfield, Lattice, Options, fit};
use nalgebra::Complex;
use proptest::prelude::*;

/// A surface over the unit square and where its points lie when it is flat.
struct Known {
    height: fn(f64, f64) -> f64,
    flat: fn(f64, f64) -> [f64; 2],
}

/// Part of a circular cylinder of radius 0.9, its axis turned by 25°.
const CYLINDER: Known = Known {
    height: |x, y| {
        let [across, _] = turned(x, y);
        (0.81 - across * across).sqrt()
    },
    flat: |x, y| {
        let [across, along] = turned(x, y);
        [0.9 * (across / 0.9).asin(), along]
    },
};

/// A cone of slope 0.8 with its apex beside the square.
const CONE: Known = Known {
    height: |x, y| -0.8 * (x - 0.5).hypot(y + 0.2),
    flat: |x, y| {
        let stretch = (1.0f64 + 0.64).sqrt();
        let radius = (x - 0.5).hypot(y + 0.2) * stretch;
        let angle = (x - 0.5).atan2(y + 0.2) / stretch;
        [radius * angle.sin(), radius * angle.cos()]
    },
};

/// A page with a fold along a slanting line: flat on one side, rising at 35° on the other.
const FOLDED: Known = Known {
    height: |x, y| 0.7 * turned(x, y)[0].max(0.0),
    flat: |x, y| {
        let [across, along] = turned(x, y);
        [
            across.min(0.0) + (1.0f64 + 0.49).sqrt() * across.max(0.0),
            along,
        ]
    },
};

/// Coordinates about the middle of the square, turned by 25°.
fn turned(x: f64, y: f64) -> [f64; 2] {
    let (sin, cos) = 25f64.to_radians().sin_cos();
    let (x, y) = (x - 0.5, y - 0.5);
    [cos * x + sin * y, cos * y - sin * x]
}

fn lay_flat(surface: &Heightfield) -> Unrolling {
    let sheet = unroll(surface, &UnrollOptions::default()).unwrap();
    assert_eq!(sheet.report().distortion.flipped, 0);
    assert_eq!(sheet.report().crossings, 0);
    sheet
}

/// Largest distance between the sheet and the true shape, laid upon each other by least squares, as
/// a share of the true shape's longer side.
fn mismatch(sheet: &Unrolling, flat: impl Fn(f64, f64) -> [f64; 2]) -> f64 {
    let truth: Vec<[f64; 2]> = (sheet.mesh().positions().iter())
        .map(|[x, y, _]| flat(*x, *y))
        .collect();
    let n = truth.len() as f64;
    let mean = |points: &[[f64; 2]]| [0, 1].map(|k| points.iter().map(|p| p[k]).sum::<f64>() / n);
    let (from, to) = (mean(sheet.places()), mean(&truth));
    let (mut cos, mut sin) = (0.0, 0.0);
    for (p, q) in sheet.places().iter().zip(&truth) {
        let ([a, b], [c, d]) = (
            [p[0] - from[0], p[1] - from[1]],
            [q[0] - to[0], q[1] - to[1]],
        );
        cos += a * c + b * d;
        sin += a * d - b * c;
    }
    let size = cos.hypot(sin);
    let (cos, sin) = (cos / size, sin / size);
    let distances = sheet.places().iter().zip(&truth).map(|(p, q)| {
        let [a, b] = [p[0] - from[0], p[1] - from[1]];
        (cos * a - sin * b + to[0] - q[0]).hypot(sin * a + cos * b + to[1] - q[1])
    });
    let extent = |k: usize| {
        let values = || truth.iter().map(|p| p[k]);
        values().fold(f64::MIN, f64::max) - values().fold(f64::MAX, f64::min)
    };
    distances.fold(0.0, f64::max) / extent(0).max(extent(1))
}

#[test]
fn exact_surfaces_unroll_to_their_flat_shape() {
    for (name, known) in [("cylinder", CYLINDER), ("cone", CONE), ("folded", FOLDED)] {
        let sheet = lay_flat(&unit_square(200, known.height));
        let error = mismatch(&sheet, known.flat);
        println!("{name}: {error:.1e}");
        assert!(error < 0.001, "{name}: {error}");
    }
}

#[test]
fn noisy_surfaces_unroll_to_it_once_they_are_solved() {
    for (name, known) in [("cylinder", CYLINDER), ("cone", CONE), ("folded", FOLDED)] {
        let truth = unit_square(200, known.height);
        let heights = truth.heights().iter().copied();
        let range = heights.clone().fold(f64::MIN, f64::max) - heights.fold(f64::MAX, f64::min);
        // Uniform noise, whose standard deviation is 1 % of the height range.
        let input = noisy(&truth, 0.01 * range * 3f64.sqrt(), 5);
        let surface = fit(&input, &Options::paper()).unwrap();
        let error = mismatch(&lay_flat(surface.heightfield()), known.flat);
        println!("{name}: {error:.1e}");
        assert!(error < 0.002, "{name}: {error}");
    }
}

/// Ends of the ruling of an oloid of parameter `u = tan(t/2)`, with `t` the angle on the circle in
/// the plane; the other circle is upright.
fn oloid_ends(u: f64) -> [[f64; 3]; 2] {
    let (sin, cos) = (2.0 * u / (1.0 + u * u), (1.0 - u * u) / (1.0 + u * u));
    let top = 0.5 * ((3.0 - u * u) * (1.0 + u * u)).max(0.0).sqrt();
    [[sin, -0.5 - cos, 0.0], [0.0, 0.5 * u * u, top]]
}

/// The ruling above a point, if there is one, and the share of its first end there:
/// `x u⁴ − 2u³ + 4y u + 3x` changes sign there once.
fn oloid_ruling(x: f64, y: f64) -> Option<(f64, f64)> {
    let root = (1.0 - x * x).max(0.0).sqrt();
    let (mut low, mut high) = (x / (1.0 + root), 3f64.sqrt().min((1.0 + root) / x));
    let excess = |u: f64| ((x * u - 2.0) * u * u + 4.0 * y) * u + 3.0 * x;
    if excess(low) < 0.0 || excess(high) > 0.0 {
        return None;
    }
    for _ in 0..80 {
        let middle = 0.5 * (low + high);
        if excess(middle) > 0.0 {
            low = middle
        } else {
            high = middle
        }
    }
    let share = x * (1.0 + low * low) / (2.0 * low);
    (share <= 1.0).then_some((low, share))
}

/// The right half of an oloid's upper half, without the outermost part and the upper end, which are
/// upright.
fn oloid(spacing: f64, top: f64) -> Heightfield {
    let lattice = Lattice::covering([0.04, -1.5], [0.96, top], spacing).unwrap();
    Heightfield::from_fn(lattice, |x, y| {
        oloid_ruling(x, y)
            .filter(|(_, share)| *share < 0.9)
            .map_or(f64::NAN, |(u, share)| (1.0 - share) * oloid_ends(u)[1][2])
    })
    .unwrap()
}

/// Its rulings in the plane, by laying one narrow triangle after another beside what is flat
/// already, at so many equal steps of `u`.
fn oloid_development(steps: usize) -> Vec<[Complex<f64>; 2]> {
    let between =
        |p: [f64; 3], q: [f64; 3]| (0..3).map(|k| (p[k] - q[k]).powi(2)).sum::<f64>().sqrt();
    // The third corner, on the right of the way from `p` to `q`, from its distances to both.
    let third = |p: Complex<f64>, q: Complex<f64>, to_p: f64, to_q: f64| {
        let base = (q - p).norm();
        let along = (base * base + to_p * to_p - to_q * to_q) / (2.0 * base);
        let off = (to_p * to_p - along * along).max(0.0).sqrt();
        p + (q - p) / base * Complex::new(along, -off)
    };
    let mut ends = oloid_ends(0.0);
    let mut flat = [
        Complex::new(0.0, 0.0),
        Complex::new(between(ends[0], ends[1]), 0.0),
    ];
    let mut rulings = vec![flat];
    for i in 1..=steps {
        let next = oloid_ends(3f64.sqrt() * i as f64 / steps as f64);
        let a = third(
            flat[0],
            flat[1],
            between(next[0], ends[0]),
            between(next[0], ends[1]),
        );
        let b = third(
            a,
            flat[1],
            between(next[1], next[0]),
            between(next[1], ends[1]),
        );
        (ends, flat) = (next, [a, b]);
        rulings.push(flat);
    }
    rulings
}

#[test]
fn an_oloid_unrolls_to_its_development_before_noise_and_after() {
    const STEPS: usize = 20_000;
    let rulings = oloid_development(STEPS);
    let flat = |x: f64, y: f64| {
        let (u, share) = oloid_ruling(x, y).unwrap();
        let at = u / 3f64.sqrt() * STEPS as f64;
        let i = (at as usize).min(STEPS - 1);
        let place = |[a, b]: [Complex<f64>; 2]| a * share + b * (1.0 - share);
        let (p, q) = (place(rulings[i]), place(rulings[i + 1]));
        let r = p + (q - p) * (at - i as f64);
        [r.re, r.im]
    };
    // As many vertices as a square of 200 by 200 has.
    let truth = oloid(1.0 / 150.0, 0.8);
    let exact = mismatch(&lay_flat(&truth), flat);
    println!("exact {exact:.1e}");
    assert!(exact < 0.001, "{exact}");
    let heights = || truth.heights().iter().copied().filter(|z| !z.is_nan());
    let range = heights().fold(f64::MIN, f64::max) - heights().fold(f64::MAX, f64::min);
    let input = noisy(&truth, 0.01 * range * 3f64.sqrt(), 5);
    // Curvature that grows towards one end is what the energy shrinks most; a reweighted pass takes
    // half of that back.
    let [solved, reweighted] = [0, 1].map(|passes| {
        let options = Options::paper();
        let surface = fit(&input, &options.reweighting(passes)).unwrap();
        mismatch(&lay_flat(surface.heightfield()), flat)
    });
    println!("solved {solved:.1e}, reweighted {reweighted:.1e}");
    assert!(solved < 0.02 && reweighted < 0.01, "{solved}, {reweighted}");
}

/// Rulings from the circle in the plane to the upright one become straight lines of the same length.
#[test]
fn rulings_of_an_oloid_stay_straight_and_as_long() {
    let surface = oloid(1.0 / 110.0, 1.5);
    let sheet = lay_flat(&surface);
    // The place of a point of the surface, from the triangle around it.
    let place = |p: [f64; 3]| -> Option<[f64; 2]> {
        let near = sheet.mesh().triangles().iter().find_map(|t| {
            let c = t.map(|v| sheet.mesh().positions()[v as usize]);
            let cross = |a: [f64; 3], b: [f64; 3]| {
                (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])
            };
            let w = [cross(c[1], c[2]), cross(c[2], c[0]), cross(c[0], c[1])];
            let sum: f64 = w.iter().sum();
            w.iter()
                .all(|w| *w >= 0.0)
                .then(|| (*t, w.map(|w| w / sum)))
        })?;
        let (t, w) = near;
        Some([0, 1].map(|k| {
            (0..3)
                .map(|i| w[i] * sheet.places()[t[i] as usize][k])
                .sum()
        }))
    };
    let mut seen = 0;
    let mut worst = 0.0f64;
    for i in 1..40 {
        let [a, b] = oloid_ends(0.043 * f64::from(i));
        let at = |share: f64| [0, 1, 2].map(|k| share * a[k] + (1.0 - share) * b[k]);
        let shares = [0.15, 0.5, 0.85];
        let places = shares.map(|share| place(at(share)));
        if let [Some(p), Some(q), Some(r)] = places {
            let length = (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>().sqrt();
            let flat = |p: [f64; 2], q: [f64; 2]| (p[0] - q[0]).hypot(p[1] - q[1]);
            worst = worst.max((flat(p, r) / (0.7 * length) - 1.0).abs());
            // Half way, to the straight line.
            let middle = [0, 1].map(|k| 0.5 * (p[k] + r[k]));
            worst = worst.max(flat(middle, q) / length);
            seen += 1;
        }
    }
    assert!(seen > 20 && worst < 0.002, "{seen} rulings: {worst}");
}

/// Waves of height 0.1 along a strip twelve times as long as it is wide, which a start from above
/// has far to go on.
#[test]
fn a_long_strip_is_as_long_as_its_curve() {
    let wave = |x: f64| 0.1 * (12.0 * x).sin();
    let strip = cut(&unit_square(200, |x, _| 0.1 * (12.0 * x).sin()), |_, y| {
        (y - 0.5).abs() < 0.04
    });
    let sheet = lay_flat(&strip);
    let positions = sheet.mesh().positions();
    let end = |sign: f64| {
        let x = |i: &usize| sign * positions[*i][0];
        (0..positions.len())
            .max_by(|a, b| x(a).total_cmp(&x(b)))
            .unwrap()
    };
    let (left, right) = (end(-1.0), end(1.0));
    let steps = 100_000;
    let at = |i: usize| {
        let (a, b) = (positions[left][0], positions[right][0]);
        a + (b - a) * i as f64 / steps as f64
    };
    let length: f64 = (0..steps)
        .map(|i| (at(i + 1) - at(i)).hypot(wave(at(i + 1)) - wave(at(i))))
        .sum();
    let along = length.hypot(positions[left][1] - positions[right][1]);
    let [p, q] = [left, right].map(|i| sheet.places()[i]);
    let found = (p[0] - q[0]).hypot(p[1] - q[1]);
    assert!((found / along - 1.0).abs() < 0.001, "{found} {along}");
}

#[test]
fn parts_are_laid_flat_one_by_one() {
    let two = cut(&unit_square(60, CYLINDER.height), |x, _| {
        (x - 0.5).abs() > 0.05
    });
    let sheet = lay_flat(&two);
    assert_eq!(sheet.report().parts, 2);
    let whole = mismatch(&lay_flat(&unit_square(60, CYLINDER.height)), CYLINDER.flat);
    assert!(whole < 0.002, "{whole}");
    assert!(sheet.report().distortion.rms < 1e-4);
}

/// `z = r f(θ)` is a cone whatever `f` is: its sheet is a sector, whose angle is the length of the
/// curve that its rulings draw on the unit sphere. With enough waves it is more than a full turn,
/// and the sheet lies on itself.
#[test]
fn a_sheet_of_more_than_a_full_turn_is_seen_to_overlap() {
    let ring = |waves: f64| {
        let fan = |x: f64, y: f64| {
            let (x, y) = (x - 0.5, y - 0.5);
            0.8 * x.hypot(y) * (waves * y.atan2(x)).cos()
        };
        cut(&unit_square(120, fan), |x, y| {
            let (x, y) = (x - 0.5, y - 0.5);
            let slit = x < 0.0 && y.abs() < 0.02;
            (0.15..0.5).contains(&x.hypot(y)) && !slit
        })
    };
    let angle = |waves: f64| -> f64 {
        let n = 10_000;
        (0..n)
            .map(|i| {
                let theta = std::f64::consts::TAU * (i as f64 + 0.5) / n as f64;
                let f = 0.8 * (waves * theta).cos();
                let slope = -0.8 * waves * (waves * theta).sin();
                (1.0 + f * f + slope * slope).sqrt() / (1.0 + f * f)
            })
            .sum::<f64>()
            / n as f64
    };
    assert!(
        angle(0.0) < 0.8 && angle(3.0) > 1.2,
        "{} {}",
        angle(0.0),
        angle(3.0)
    );
    let unrolled = |waves| unroll(&ring(waves), &UnrollOptions::default()).unwrap();
    assert_eq!(unrolled(0.0).report().crossings, 0);
    let overlapping = unrolled(3.0);
    assert!(overlapping.report().crossings > 0);
    assert_eq!(overlapping.report().crossings, overlapping.overlaps().len());
    assert!(overlapping.report().distortion.rms < 0.005);
    let verdict = |sheet: &Unrolling| {
        let extent = Extent {
            min: [0.0; 2],
            max: [1.0; 2],
        };
        let map = WarpMap::new(sheet, extent, [500, 500], &DewarpOptions::default()).unwrap();
        map.verdict(sheet.report())
    };
    assert_eq!(verdict(&overlapping), Verdict::Stretched);
    assert_eq!(verdict(&unrolled(0.0)), Verdict::Unrolled);
}

#[test]
fn what_cannot_be_unrolled_is_refused() {
    let code = |field: &Heightfield, options| unroll(field, &options).unwrap_err().code();
    let line = Heightfield::from_fn(Lattice::new(5, 1, 1.0).unwrap(), |_, _| 0.0).unwrap();
    assert_eq!(code(&line, UnrollOptions::default()), "UNSUPPORTED");
    let flat = unit_square(5, |_, _| 0.0);
    assert_eq!(
        code(&flat, UnrollOptions::default().tolerance(0.0)),
        "OPTION"
    );
    let steep = unit_square(5, |x, _| 1e200 * x * x);
    assert_eq!(code(&steep, UnrollOptions::default()), "OVERFLOW");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// Whatever the heights and holes: places are finite, and fit no worse than those from above.
    #[test]
    fn any_surface_has_a_layout_no_worse_than_its_plan(
        rows in 2usize..12, cols in 2usize..12,
        rough in 0.0..3.0f64,
        bits in proptest::collection::vec(0u8..8, 144),
        bumps in proptest::collection::vec(-1.0..1.0f64, 144),
    ) {
        let lattice = Lattice::new(rows, cols, 0.7).unwrap();
        let heights = (0..lattice.len())
            .map(|i| if bits[i] == 0 { f64::NAN } else { rough * bumps[i] })
            .collect();
        let field = Heightfield::new(lattice, heights).unwrap();
        if let Ok(sheet) = unroll(&field, &UnrollOptions::default()) {
            prop_assert!(sheet.places().iter().flatten().all(|p| p.is_finite()));
            prop_assert_eq!(sheet.places().len(), sheet.mesh().vertices().len());
            prop_assert_eq!(sheet.stretches().len(), sheet.mesh().triangles().len());
            let report = sheet.report();
            // Turning flipped triangles over may cost more than they did.
            let repaired = rough > 0.3;
            prop_assert!(
                repaired || report.distortion.rms <= report.plan.rms * 1.001 + 1e-9,
                "{report:?}"
            );
        }
    }

    /// Neither the unit nor a shift of the heights changes a strain.
    #[test]
    fn strains_do_not_depend_on_where_the_surface_is(rise in -50.0..50.0f64, scale in 0.01..100.0f64) {
        let bump = |x: f64, y: f64| 0.2 * (5.0 * x).sin() * (4.0 * y).cos();
        let here = unit_square(30, bump);
        let there = Heightfield::from_fn(
            Lattice::covering([0.0; 2], [scale; 2], scale / 30.0).unwrap(),
            |x, y| scale * (bump(x / scale, y / scale) + rise),
        ).unwrap();
        let rms = |field: &Heightfield| {
            unroll(field, &UnrollOptions::default()).unwrap().report().distortion.rms
        };
        let (a, b) = (rms(&here), rms(&there));
        prop_assert!((a - b).abs() < 1e-3 * a, "{} {}", a, b);
    }
}

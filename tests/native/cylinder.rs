//! Heights of a cylinder: of known profiles, and of other shapes.

use crate::native::common::{Random, rms_difference};
use developable::{
    Cylinder, CylinderVerdict, Error, Heightfield, Lambda, Lattice, Options, fit, fit_cylinder,
};

const SIDE: usize = 120;
const SPACING: f64 = 1.0 / SIDE as f64;

fn field(f: impl Fn(f64, f64) -> f64) -> Heightfield {
    // Rows go down from y = 1.
    let lattice = Lattice::new(SIDE, SIDE, SPACING).unwrap();
    Heightfield::from_fn(lattice.with_origin([0.0, 1.0]).unwrap(), f).unwrap()
}

/// Noise that is alike over about `reach` vertices, as a depth camera's is: means over a square of them, three times.
fn with_noise(truth: &Heightfield, sigma: f64, reach: usize, seed: u64) -> Heightfield {
    let mut noise = Random::new(seed);
    let mut values: Vec<f64> = (0..SIDE * SIDE).map(|_| noise.sample()).collect();
    let mean = |values: &[f64], step: usize, count: usize| -> Vec<f64> {
        (0..values.len())
            .map(|i| {
                let at = i / step % count;
                let low = at.saturating_sub(reach);
                let high = (at + reach).min(count - 1);
                let own: f64 = (low..=high).map(|k| values[i + k * step - at * step]).sum();
                own / (high - low + 1) as f64
            })
            .collect()
    };
    for _ in 0..if reach > 0 { 3 } else { 0 } {
        values = mean(&mean(&values, 1, SIDE), SIDE, SIDE);
    }
    let rms = (values.iter().map(|v| v * v).sum::<f64>() / values.len() as f64).sqrt();
    let heights = truth.heights().iter().zip(&values);
    let heights = heights.map(|(z, v)| z + sigma * v / rms).collect();
    Heightfield::new(*truth.lattice(), heights).unwrap()
}

fn found(input: &Heightfield) -> Cylinder {
    fit_cylinder(input.clone()).unwrap()
}

/// Across rulings that run at 70° to the x axis, and rise.
fn slanted(profile: impl Fn(f64) -> f64) -> impl Fn(f64, f64) -> f64 {
    move |x, y| {
        let (sin, cos) = (-20f64).to_radians().sin_cos();
        profile(cos * x + sin * y) + 0.1 * (cos * y - sin * x)
    }
}

#[test]
fn curled_and_folded_sheets_are_found_under_noise_and_more_exactly_than_by_the_energy() {
    let curled = field(slanted(|t| 0.1 * (4.0 * t).sin()));
    let folded = field(slanted(|t| 0.3 * (t - 0.35).abs()));
    for truth in [curled, folded] {
        for (sigma, reach) in [(0.002, 0), (0.004, 2)] {
            let input = with_noise(&truth, sigma, reach, 3);
            let cylinder = found(&input);
            let report = cylinder.report();
            assert_eq!(report.verdict, CylinderVerdict::Cylinder, "{report:?}");
            assert!((report.residual / sigma - 1.0).abs() < 0.1, "{report:?}");
            // (-sin, cos) of -20°, and a rise of 0.1 in the plane.
            let rulings = [20f64.to_radians().sin(), 20f64.to_radians().cos(), 0.1];
            let along: f64 = (report.rulings.iter().zip(rulings))
                .map(|(a, b)| a * b)
                .sum();
            let angle = (along.abs() / 1.01f64.sqrt()).min(1.0).acos().to_degrees();
            assert!(angle < 1.0, "{angle}° {report:?}");
            let off = rms_difference(&truth, cylinder.heightfield());
            let options = Options::paper().lambda(Lambda::Auto);
            let by_energy = fit(input, &options).unwrap();
            let other = rms_difference(&truth, by_energy.heightfield());
            assert!(off < other && off < 0.45 * sigma, "{reach}: {off} {other}");
        }
    }
}

/// Noise that is smooth over nine vertices, as that of a phone's depths, is as correlated along the rulings as across them.
#[test]
fn smoother_noise_makes_no_other_shape() {
    let truth = field(slanted(|t| 0.1 * (4.0 * t).sin()));
    let cone = field(|x, y| 0.3 * (x - 0.5).hypot(y + 0.1));
    for seed in 0..6 {
        let report = *found(&with_noise(&truth, 0.008, 4, seed)).report();
        assert_eq!(
            report.verdict,
            CylinderVerdict::Cylinder,
            "{seed}: {report:?}"
        );
        let report = *found(&with_noise(&cone, 0.002, 4, seed)).report();
        assert_eq!(report.verdict, CylinderVerdict::Other, "{seed}: {report:?}");
    }
}

/// A narrow strip under smooth noise has too few independent heights for its tilt.
#[test]
fn few_independent_heights_do_not_tell() {
    let truth = field(slanted(|t| 0.1 * (4.0 * t).sin()));
    let noisy = with_noise(&truth, 0.008, 4, 1);
    let strip: Vec<u8> = (0..SIDE * SIDE)
        .map(|i| u8::from((i % SIDE) < 40))
        .collect();
    let report = *found(&noisy.masked(&strip).unwrap()).report();
    assert_eq!(report.verdict, CylinderVerdict::Other);
    assert!(report.excess.is_nan(), "{report:?}");
}

#[test]
fn other_shapes_are_none() {
    let cone = field(|x, y| 0.3 * ((x - 0.5).hypot(y + 0.1)));
    let dish = field(|x, y| 0.1 * (4.0 * x).sin() + 0.03 * (2.0 * y - 1.0).powi(2));
    let crumpled = field(|x, y| {
        let zigzag = |t: f64| (t - 2.0 * (t / 2.0).round()).abs();
        0.05 * zigzag(4.5 * (y - 0.1 * zigzag(4.0 * x))) + 0.04 * zigzag(3.0 * x + y)
    });
    let steps = field(|x, y| 0.1 * (4.0 * x).sin() + if y > 0.6 { 0.02 } else { 0.0 });
    for (name, truth) in [
        ("cone", cone),
        ("dish", dish),
        ("crumpled", crumpled),
        ("step", steps),
    ] {
        for (sigma, reach) in [(0.0, 0), (0.001, 0), (0.004, 2)] {
            let report = *found(&with_noise(&truth, sigma, reach, 4)).report();
            assert_eq!(
                report.verdict,
                CylinderVerdict::Other,
                "{name}, {sigma}: {report:?}"
            );
        }
    }
}

#[test]
fn units_and_levels_do_not_matter() {
    let truth = field(slanted(|t| 0.1 * (4.0 * t).sin()));
    let input = with_noise(&truth, 0.002, 1, 5);
    let large = Lattice::new(SIDE, SIDE, 1000.0 * SPACING).unwrap();
    let heights = input.heights().iter().map(|z| 1000.0 * z + 7e4).collect();
    let other = found(&Heightfield::new(large, heights).unwrap());
    let own = found(&input);
    assert_eq!(own.report().verdict, other.report().verdict);
    assert!((other.report().excess / own.report().excess - 1.0).abs() < 1e-3);
    for (a, b) in own
        .heightfield()
        .heights()
        .iter()
        .zip(other.heightfield().heights())
    {
        assert!((1000.0 * a + 7e4 - b).abs() < 0.01);
    }
}

#[test]
fn large_holes_stay_and_small_ones_are_bridged() {
    let truth = field(slanted(|t| 0.1 * (4.0 * t).sin()));
    let mut heights = with_noise(&truth, 0.002, 1, 6).into_heights();
    heights[40 * SIDE + 40] = f64::NAN;
    for row in 60..90 {
        heights[row * SIDE + 50..row * SIDE + 80].fill(f64::NAN);
    }
    let cylinder = found(&Heightfield::new(*truth.lattice(), heights).unwrap());
    assert_eq!(cylinder.report().verdict, CylinderVerdict::Cylinder);
    let field = cylinder.heightfield();
    assert!((field.height(40, 40) - truth.height(40, 40)).abs() < 0.002);
    assert!(field.height(75, 65).is_nan());
}

#[test]
fn too_few_heights_are_refused_in_words() {
    let lattice = Lattice::new(10, 10, 1.0).unwrap();
    let few = Heightfield::from_fn(lattice, |x, _| x).unwrap();
    let none = Heightfield::from_fn(lattice, |_, _| f64::NAN).unwrap();
    for field in [few, none] {
        let error = fit_cylinder(field).unwrap_err();
        assert!(matches!(error, Error::Unsupported { .. }), "{error}");
        assert!(error.to_string().contains("too few"), "{error}");
    }
    // A strip of three vertices across has no rulings to speak of.
    let strip = Heightfield::from_fn(Lattice::new(200, 3, 1.0).unwrap(), |x, y| {
        x + (y / 9.0).sin()
    });
    let report = *fit_cylinder(strip.unwrap()).unwrap().report();
    assert_eq!(report.verdict, CylinderVerdict::Other, "{report:?}");
}

/// A plane is a cylinder, with and without noise.
#[test]
fn a_plane_is_met() {
    let truth = field(|x, y| 0.2 * x - 0.1 * y + 3.0);
    let exact = found(&truth);
    assert!(rms_difference(&truth, exact.heightfield()) < 1e-9);
    let noisy = found(&with_noise(&truth, 0.002, 2, 8));
    assert_eq!(noisy.report().verdict, CylinderVerdict::Cylinder);
    assert!(rms_difference(&truth, noisy.heightfield()) < 0.001);
}

//! How far heights are trusted.

use crate::native::common::conic::Instance;
use crate::native::common::{Random, bumps, cut, max_difference, noisy, unit_square};
use developable::{Error, Heightfield, Input, Lattice, Options, fit};

fn field(seed: u64) -> Heightfield {
    cut(&noisy(&unit_square(13, bumps), 0.02, seed), |x, y| {
        (x - 0.6).hypot(y - 0.4) > 0.15
    })
}

/// One value for each vertex.
fn each(lattice: &Lattice, f: impl Fn(f64, f64) -> f64) -> Vec<f64> {
    let position = |i: usize| lattice.position(i / lattice.cols(), i % lattice.cols());
    (0..lattice.len())
        .map(position)
        .map(|[x, y]| f(x, y))
        .collect()
}

#[test]
fn random_weights() {
    for (seed, lambda) in [(1, 1e4), (2, 1e5), (3, 1e6)] {
        let mut instance = Instance::new(&field(seed), lambda);
        let mut noise = Random::new(100 + seed);
        for weight in &mut instance.confidence {
            *weight = (3.0 * noise.sample()).exp();
        }
        instance.check();
    }
}

#[test]
fn random_weights_some_of_them_zero() {
    for (seed, lambda) in [(4, 1e4), (5, 1e6)] {
        let mut instance = Instance::new(&field(seed), lambda);
        let mut noise = Random::new(100 + seed);
        for weight in &mut instance.confidence {
            *weight = noise.sample().max(0.0);
        }
        let report = instance.check();
        assert!(report.free > 50, "{report:?}");
    }
}

#[test]
fn the_same_weight_everywhere_is_a_factor_of_lambda() {
    let field = noisy(&unit_square(40, bumps), 0.02, 6);
    let options = Options::paper().gap(1e-6);
    for weight in [0.1, 1.0, 7.0] {
        let input = Input::new(field.clone())
            .with_confidence(vec![weight; field.lattice().len()])
            .unwrap();
        let weighted = fit(input, &options.lambda(1e5)).unwrap();
        let plain = fit(&field, &options.lambda(1e5 * weight)).unwrap();
        let (a, b) = (weighted.report(), plain.report());
        assert!((a.objective / b.objective - 1.0).abs() < 2e-6);
        assert_eq!(a.free, 0);
        let distance = max_difference(weighted.heightfield(), plain.heightfield());
        // Each is within √(gap·P/λ) of the optimum that they share.
        let bound = 2.0 * (1e-6 * b.objective / b.lambda).sqrt();
        assert!(distance < bound, "{distance:e} against {bound:e}");
    }
}

/// One over such a weight, or its product with a square, is infinite: nothing may be certified from it.
#[test]
fn weights_of_next_to_nothing_certify_nothing_false() {
    let field = noisy(&unit_square(80, bumps), 0.02, 7);
    let options = Options::paper().lambda(1e5).gap(1e-3);
    let optimum = fit(&field, &options).unwrap().report().objective;
    for weight in [1e-300, 1e-310] {
        let mut confidence = vec![1.0; field.lattice().len()];
        for weak in confidence.iter_mut().step_by(7) {
            *weak = weight;
        }
        let input = Input::new(field.clone())
            .with_confidence(confidence)
            .unwrap();
        let surface = fit(input, &options.max_iterations(200)).unwrap();
        let report = surface.report();
        // With less to be true to, the optimum is lower.
        assert!(report.dual_bound <= optimum, "{report:?}");
        assert!(report.dual_bound <= report.objective, "{report:?}");
        let gap = 1.0 - report.dual_bound / report.objective;
        assert!((report.gap.unwrap() - gap).abs() < 1e-9, "{report:?}");
    }
}

#[test]
fn where_nothing_is_trusted_the_surface_goes_on_from_around() {
    let truth = unit_square(60, |x, y| (1.0 - (0.8 * x + 0.6 * y - 0.7).powi(2)).sqrt());
    let trusted = |x: f64, y: f64| (x - 0.5).hypot(y - 0.45) > 0.2;
    let lattice = *truth.lattice();
    let confidence = each(&lattice, |x, y| f64::from(u8::from(trusted(x, y))));
    // What stands there instead is nonsense.
    let heights = truth.heights().iter().zip(&confidence);
    let heights = heights.map(|(z, weight)| if *weight > 0.0 { *z } else { -3.0 });
    let input = Input::new(Heightfield::new(lattice, heights.collect()).unwrap())
        .with_confidence(confidence)
        .unwrap();
    let surface = fit(input, &Options::paper().lambda(1e7).gap(1e-3)).unwrap();
    let worst = max_difference(&truth, surface.heightfield());
    assert!(worst < 2e-3, "{worst}");
    assert!(surface.report().is_certified(1e-3));
}

#[test]
fn heights_that_are_not_trusted_do_not_matter() {
    for energy in [
        developable::Energy::Nuclear,
        developable::Energy::SecondFormOfInput,
    ] {
        let surfaces: Vec<_> = [0.0, -1.0, 1e6]
            .into_iter()
            .map(|nonsense| {
                let field = noisy(&unit_square(30, bumps), 0.02, 8);
                let lattice = *field.lattice();
                let confidence = each(&lattice, |x, y| if x + y > 1.4 { 0.0 } else { 1.0 });
                let heights = field.heights().iter().zip(&confidence);
                let heights = heights.map(|(z, w)| if *w > 0.0 { *z } else { nonsense });
                let input = Input::new(Heightfield::new(lattice, heights.collect()).unwrap())
                    .with_confidence(confidence)
                    .unwrap();
                fit(input, &Options::paper().energy(energy)).unwrap()
            })
            .collect();
        for other in &surfaces[1..] {
            let d = max_difference(surfaces[0].heightfield(), other.heightfield());
            assert!(d < 1e-9, "{energy:?} {d} {:?}", other.report());
        }
    }
}

#[test]
fn weights_that_make_no_sense_are_named() {
    let field = field(7);
    let n = field.lattice().len();
    let with = |i: usize, weight: f64| {
        let mut confidence = vec![1.0; n];
        confidence[i] = weight;
        Input::new(field.clone()).with_confidence(confidence)
    };
    let cols = field.lattice().cols();
    assert!(matches!(
        with(cols + 2, f64::NAN),
        Err(Error::NotFinite { row: 1, col: 2, .. })
    ));
    assert_eq!(with(0, -0.1).unwrap_err().code(), "OPTION");
    let hole = field.heights().iter().position(|z| z.is_nan()).unwrap();
    assert!(with(hole, f64::NAN).is_ok());
    let short = Input::new(field.clone()).with_confidence(vec![1.0; n - 1]);
    assert_eq!(short.unwrap_err().code(), "SHAPE");
}

//! The energy that costs small bends by their square: against an independent conic solver, its limits,
//! and its passes at creases.

use crate::native::common::conic::Instance;
use crate::native::common::{max_difference, noisy, ring, rms_difference, unit_square};
use developable::{
    Border, Energy, Heightfield, Lambda, Lattice, Normalization, Options, Report, StopReason, fit,
};

fn roof(x: f64, y: f64) -> f64 {
    (0.6 * (x - 0.5).abs()).max(0.1 + 0.3 * (y - 0.6))
}

fn options() -> Options {
    Options::default()
        .lambda(Lambda::Medium)
        .normalization(Normalization::Off)
}

#[test]
fn the_optimum_is_the_conic_solvers() {
    for (seed, (lambda, huber)) in [
        (3e3, [0.3, 0.1]),
        (1e5, [0.0, 0.1]),
        (1e5, [0.3, 0.02]),
        (1e6, [0.7, 1.0]),
    ]
    .into_iter()
    .enumerate()
    {
        let mut instance = Instance::new(&ring(14, 40 + seed as u64), lambda).energy(Energy::Huber);
        instance.huber = huber;
        let report = instance.check();
        let used = report.huber.unwrap();
        assert_eq!([used.flatness, used.bend_radius], huber);
    }
}

/// Constraints and free vertices beside data.
#[test]
fn the_optimum_under_constraints_is_the_conic_solvers() {
    let field = unit_square(12, |x, y| (x - 0.5).abs() + 0.5 * y * y);
    let mut instance = Instance::design(&field, 1e3, |row, col| row % 5 == 1 && col % 4 == 1);
    instance.energy = Energy::Huber;
    instance.gap = 1e-5;
    instance.check();
}

/// Each pass minimises the energy whose slopes end where the surface before says.
#[test]
fn a_pass_at_creases_is_the_conic_solvers() {
    let field = noisy(&unit_square(16, roof), 0.002, 3);
    let mut instance = Instance::new(&field, 3e4).energy(Energy::Huber);
    let first = instance.solve();
    let norms = instance.norms(first.heightfield().heights());
    let radius = 0.2;
    let slope = |[_, spread]: &[f64; 2]| (1.0 / (radius * spread)).clamp(0.05, 1.0);
    instance.slopes = Some(norms.iter().map(slope).collect());
    let creases = norms.iter().filter(|norms| slope(norms) < 1.0).count();
    let passes = instance.options().crease_passes(1).crease_radius(radius);
    let passes = passes.border(Border::Free);
    let second = fit(instance.input(), &passes).unwrap();
    let report = instance.compare(&second, &instance.optimum());
    let huber = report.huber.unwrap();
    assert_eq!((huber.crease_passes, huber.creases), (1, creases));
    assert!(creases > 10 && creases < norms.len() / 2, "{creases}");
    assert!(max_difference(first.heightfield(), second.heightfield()) > 1e-4);
}

#[test]
fn full_flatness_is_the_nuclear_norm_and_large_curvatures_its_square() {
    let field = ring(24, 50);
    let solve = |options: Options| {
        let surface = fit(&field, &options.gap(1e-9)).unwrap();
        assert_eq!(surface.report().stop_reason, StopReason::Gap);
        surface.into_heightfield()
    };
    let base = Options::paper().normalization(Normalization::Off);
    let huber = base.energy(Energy::Huber).crease_passes(0);
    let nuclear = solve(base.lambda(1e5));
    let flat = solve(huber.lambda(1e5).flatness(1.0));
    assert!(max_difference(&nuclear, &flat) < 2e-6);
    // Of curvatures far below δ nothing but the square is left: s²/2δ.
    let delta = 1e5;
    let squared = solve(base.lambda(1e5).energy(Energy::SquaredNuclear));
    let smooth = huber.flatness(0.0).bend_radius(1.0 / delta);
    let smooth = solve(smooth.lambda(1e5 / (2.0 * delta)));
    assert!(max_difference(&squared, &smooth) < 2e-6);
    assert!(max_difference(&squared, &nuclear) > 1e-3);
}

fn errors(truth: &Heightfield, input: &Heightfield, options: Options) -> (f64, Report) {
    let surface = fit(input, &options).unwrap();
    assert!(surface.report().is_certified(0.01));
    (
        rms_difference(truth, surface.heightfield()),
        surface.report().clone(),
    )
}

#[test]
fn smooth_bends_come_closer_to_the_truth() {
    let truth = unit_square(80, |x, y| 0.08 * (8.0 * (0.9 * x + 0.4 * y)).sin());
    let input = noisy(&truth, 0.004, 6);
    let options = options().lambda(Lambda::Value(2e5));
    let (nuclear, _) = errors(&truth, &input, options.energy(Energy::Nuclear));
    let (huber, report) = errors(&truth, &input, options);
    assert!(huber < 0.8 * nuclear, "{huber} {nuclear}");
    assert_eq!(report.huber.unwrap().creases, 0);
}

#[test]
fn creases_keep_their_angle_in_passes_that_end_by_themselves() {
    let truth = unit_square(80, roof);
    let input = noisy(&truth, 0.002, 7);
    let passes = |passes: usize| {
        let options = options().lambda(4e5).crease_passes(passes);
        let (error, report) = errors(&truth, &input, options);
        (error, report.huber.unwrap().crease_passes)
    };
    let [none, one, many] = [0, 1, 20].map(passes);
    assert!(
        one.0 < 0.8 * none.0 && many.0 < 0.8 * none.0,
        "{none:?} {one:?} {many:?}"
    );
    assert_eq!((none.1, one.1), (0, 1));
    assert!((2..20).contains(&many.1), "{many:?}");
}

#[test]
fn where_lambda_is_too_large_for_the_noise_it_is_the_nuclear_norm() {
    let truth = unit_square(60, roof);
    let input = noisy(&truth, 0.05, 8);
    let options = options().lambda(Lambda::Big);
    let (nuclear, _) = errors(&truth, &input, options.energy(Energy::Nuclear));
    let (huber, report) = errors(&truth, &input, options);
    let used = report.huber.unwrap();
    assert_eq!((used.crease_passes, used.flatness), (0, 1.0));
    assert!((huber / nuclear - 1.0).abs() < 1e-6, "{huber} {nuclear}");
    // Unless one asks for it.
    let (_, report) = errors(&truth, &input, options.flatness(0.3));
    assert_eq!(report.huber.unwrap().flatness, 0.3);
}

#[test]
fn options_of_its_own_are_checked() {
    let code = |options: Options| options.validate().unwrap_err().to_string();
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(code(options().bend_radius(bad)).contains("bend_radius"));
        assert!(code(options().crease_radius(bad)).contains("crease_radius"));
    }
    for bad in [-0.1, 1.1, f64::NAN] {
        assert!(code(options().flatness(bad)).contains("flatness"));
    }
    assert!(code(options().crease_passes(21)).contains("crease_passes"));
    assert!(code(options().energy(Energy::Huber).reweighting(1)).contains("reweighting"));
}

/// A free border of a plate on a foundation, bent by the moment `M`, goes off by `2β²M/k` (Hetényi,
/// Beams on Elastic Foundation, 1946); a loaded one does not.
#[test]
fn bent_sheet_keeps_its_border() {
    let (curvature, flatness, bend_radius, lambda) = (2.0, 0.3, 0.1, 1e4);
    let lattice = Lattice::covering([0.0, 0.0], [1.0, 1.0], 1.0 / 60.0).unwrap();
    let places =
        (0..lattice.len()).map(|i| lattice.position(i / lattice.cols(), i % lattice.cols()));
    let truth: Vec<f64> = places
        .clone()
        .map(|[x, _]| 0.5 * curvature * x * x)
        .collect();
    let field = Heightfield::new(lattice, truth.clone()).unwrap();
    let options = Options::default()
        .lambda(lambda)
        .flatness(flatness)
        .bend_radius(bend_radius)
        .gap(1e-4);
    let off = |options: &Options| {
        let surface = fit(field.clone(), options).unwrap();
        let heights = surface.heightfield().heights();
        let ends = places.clone().zip(heights).zip(&truth);
        let ends = ends.filter(|(([x, y], _), _)| *x > 0.99 && (y - 0.5).abs() < 0.3);
        let errors: Vec<f64> = ends.map(|((_, z), truth)| (z - truth).abs()).collect();
        errors.iter().sum::<f64>() / errors.len() as f64
    };
    let moment = flatness + curvature * bend_radius;
    let beta_squared = (2.0 * lambda / (4.0 * bend_radius)).sqrt();
    let free = 2.0 * beta_squared * moment / (2.0 * lambda);
    let [without, with] = [Border::Free, Border::Loaded].map(|border| off(&options.border(border)));
    assert!(
        (0.4..1.3).contains(&(without / free)),
        "{without} for {free}"
    );
    assert!(with < 0.2 * free, "{with} for {free}");
}

/// At steep borders the moments are as large as can be borne.
#[test]
fn what_rises_steeply_to_its_border_is_not_folded_along_it() {
    let truth = unit_square(100, |x, _| {
        let across = 0.98 * (2.0 * x - 1.0);
        0.5 * (1.0 - across * across).sqrt()
    });
    let input = noisy(&truth, 0.05, 2);
    let options = Options::default().lambda(3e4);
    let [free, loaded] = [Border::Free, Border::Loaded].map(|border| {
        let surface = fit(&input, &options.border(border)).unwrap();
        rms_difference(surface.heightfield(), &truth)
    });
    assert!(free < 0.3 * rms_difference(&input, &truth), "{free}");
    assert!(loaded < free, "{loaded} and {free}");
}

//! The optimum against an independent conic solver.

use crate::native::common::conic::Instance;
use crate::native::common::{bumps, cut, noisy, unit_square};
use developable::{Heightfield, Lambda, Normalization, Options, Report, Schedule, StopReason, fit};

fn check(field: &Heightfield, lambda: Lambda) -> Report {
    Instance::new(field, lambda.value()).check()
}

#[test]
fn noise_at_small_lambda() {
    check(&noisy(&unit_square(12, bumps), 0.02, 1), Lambda::Small);
}

#[test]
fn noise_at_medium_lambda() {
    check(&noisy(&unit_square(14, bumps), 0.02, 2), Lambda::Medium);
}

#[test]
fn noise_at_big_lambda() {
    check(&noisy(&unit_square(12, bumps), 0.02, 3), Lambda::Big);
}

#[test]
fn tiny_lambda_leaves_little_but_a_plane() {
    check(
        &noisy(&unit_square(10, bumps), 0.02, 4),
        Lambda::Value(300.0),
    );
}

#[test]
fn optima_that_are_almost_planes_are_found() {
    // Where λ or the relief is small there is hardly any curvature left to balance ρ by.
    for (cols, relief, lambda) in [(30, 1.0, 1.0), (30, 1e-5, 1e6), (50, 1.0, 30.0)] {
        let field = noisy(
            &unit_square(cols, |x, y| relief * bumps(x, y)),
            0.02 * relief,
            11,
        );
        let options = Options::paper().lambda(lambda);
        let report = fit(&field, &options).unwrap().report().clone();
        assert_eq!(report.stop_reason, StopReason::Gap, "{report:?}");
    }
}

#[test]
fn a_hole_in_a_disk() {
    let ring = |x: f64, y: f64| {
        let r = (x - 0.5).hypot(y - 0.5);
        r < 0.5 && r > 0.17
    };
    let field = cut(&noisy(&unit_square(18, bumps), 0.03, 5), ring);
    check(&field, Lambda::Small);
}

#[test]
fn two_islands_and_a_needle() {
    let keep = |x: f64, y: f64| {
        let left = x < 0.4 && y < 0.7;
        let right = x > 0.55 && (y - 0.5).abs() < 0.3;
        let needle = y > 0.9;
        left || right || needle
    };
    let field = cut(&noisy(&unit_square(16, bumps), 0.05, 6), keep);
    check(&field, Lambda::Medium);
}

#[test]
fn a_sharp_step() {
    let step = |x: f64, y: f64| if x + 0.3 * y > 0.6 { 0.5 } else { 0.0 };
    check(&unit_square(13, step), Lambda::Value(2e4));
}

#[test]
fn coarse_to_fine_around_holes_that_vanish_on_the_way() {
    let keep = |x: f64, y: f64| {
        let pinholes = (40.0 * x).sin() * (40.0 * y).sin() < 0.9;
        let slit = (x - y).abs() > 0.02 || x < 0.3;
        let island = (x - 0.9).hypot(y - 0.1);
        pinholes && slit && !(0.1..0.15).contains(&island)
    };
    let field = cut(&noisy(&unit_square(56, bumps), 0.02, 10), keep);
    let report = check(&field, Lambda::Value(3e4));
    assert!(report.levels.len() > 1, "{report:?}");
}

#[test]
fn one_interior_vertex() {
    let field = cut(&noisy(&unit_square(3, bumps), 0.1, 7), |x, y| {
        (x - 0.5).hypot(y - 0.711) < 0.36
    });
    check(&field, Lambda::Value(50.0));
}

#[test]
fn normalisation_solves_the_normalised_problem() {
    // 30 units wide: the same energy as the unit square's, with every length times 30.
    let small = noisy(&unit_square(12, bumps), 0.02, 8);
    let big = Heightfield::new(
        developable::Lattice::new(
            small.lattice().rows(),
            small.lattice().cols(),
            30.0 * small.lattice().spacing(),
        )
        .unwrap(),
        small.heights().iter().map(|z| 30.0 * z + 7.0).collect(),
    )
    .unwrap();
    let surface = fit(&big, &Options::paper().gap(1e-8).max_iterations(100_000)).unwrap();
    let report = surface.report();
    // Odd rows stick out by half a spacing on the left, and one column more covers them.
    let width = small.lattice().spacing() * (small.lattice().cols() as f64 - 0.5);
    assert!((report.scale * 30.0 * width - 1.0).abs() < 1e-12);
    let normalised = Heightfield::new(
        developable::Lattice::new(
            small.lattice().rows(),
            small.lattice().cols(),
            small.lattice().spacing() / width,
        )
        .unwrap(),
        small.heights().iter().map(|z| z / width).collect(),
    )
    .unwrap();
    let exact = Instance::new(&normalised, 1e6).optimum();
    assert!((report.objective / exact.objective - 1.0).abs() < 1e-6);
    let worst = surface
        .heightfield()
        .heights()
        .iter()
        .zip(&exact.heights)
        .filter(|(_, z)| !z.is_nan())
        .map(|(a, z)| (a - (z * 30.0 * width + 7.0)).abs())
        .fold(0.0, f64::max);
    assert!(worst < 30.0 * 1e-4, "{worst}");
}

#[test]
fn the_paper_schedule_ends_close_to_the_optimum_and_knows_how_close() {
    let field = noisy(&unit_square(14, bumps), 0.02, 9);
    let exact = Instance::new(&field, 1e5).optimum();
    let options = Options::paper()
        .lambda(Lambda::Small)
        .schedule(Schedule::Paper)
        .normalization(Normalization::Off);
    let report = fit(&field, &options).unwrap().report().clone();
    assert_eq!(report.stop_reason, StopReason::Residuals, "{report:?}");
    let error = report.objective / exact.objective - 1.0;
    assert!((-1e-9..0.02).contains(&error), "{error}");
    assert!(
        report.is_certified(0.05) && error <= report.gap.unwrap() + 1e-9,
        "{report:?}"
    );
}

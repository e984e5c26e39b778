//! Surfaces of several parts, each of which is solved for itself.

use crate::native::common::conic::Instance;
use crate::native::common::{bumps, cut, max_difference, noisy, unit_square};
use developable::{
    Bridging, Heightfield, Input, Lattice, Normalization, Options, Solver, Status, StopReason, fit,
};

/// Three islands of quite different shapes and sizes.
fn island(x: f64, y: f64) -> Option<usize> {
    if x < 0.45 && y > 0.3 {
        Some(0)
    } else if (x - 0.75).hypot(y - 0.55) < 0.22 {
        Some(1)
    } else if y < 0.2 {
        Some(2)
    } else {
        None
    }
}

fn archipelago(cols: usize, seed: u64) -> Heightfield {
    let field = noisy(&unit_square(cols, bumps), 0.02, seed);
    cut(&field, |x, y| island(x, y).is_some())
}

fn options(gap: f64) -> Options {
    Options::paper()
        .lambda(1e5)
        .gap(gap)
        .max_iterations(100_000)
        .normalization(Normalization::Off)
}

/// Narrow straits are none to be bridged.
fn apart(field: &Heightfield) -> Input {
    Input::new(field.clone())
        .with_bridging(Bridging::Off)
        .unwrap()
}

#[test]
fn together_as_alone() {
    for cols in [20, 90] {
        let field = archipelago(cols, 1);
        let together = fit(apart(&field), &options(1e-6)).unwrap();
        assert_eq!(together.report().components, 3);
        let (mut objective, mut bound) = (0.0, 0.0);
        for number in 0..3 {
            let own = cut(&field, |x, y| island(x, y) == Some(number));
            let alone = fit(apart(&own), &options(1e-6)).unwrap();
            assert_eq!(alone.report().components, 1);
            objective += alone.report().objective;
            bound += alone.report().dual_bound;
            let distance = max_difference(alone.heightfield(), together.heightfield());
            // What the two differ by is the rounding of single-precision z-steps.
            assert!(distance < 1e-5, "{cols}: {distance:e}");
        }
        let report = together.report();
        assert!((report.objective / objective - 1.0).abs() < 1e-6);
        assert!((report.dual_bound / bound - 1.0).abs() < 1e-6);
        assert!(report.is_certified(1e-6) && report.stop_reason == StopReason::Gap);
    }
}

#[test]
fn islands_against_the_conic_solver() {
    let report = Instance::new(&archipelago(18, 2), 1e5).check();
    assert_eq!(report.components, 3);
}

#[test]
fn hinges_hold_parts_together() {
    // Two triangles of stencils that share a border vertex but no edge.
    let field = cut(&noisy(&unit_square(16, bumps), 0.05, 3), |x, y| {
        (x - 0.5).abs() > 0.03 || (y - 0.5).abs() < 0.12
    });
    Instance::new(&field, 1e4).check();
}

#[test]
fn two_hundred_hexagons_of_one_stencil() {
    let lattice = Lattice::new(40, 62, 0.01).unwrap();
    let noise = noisy(
        &Heightfield::new(lattice, vec![0.0; lattice.len()]).unwrap(),
        0.01,
        4,
    );
    let centre = |r: usize, c: usize| r % 4 == 1 && c % 3 == 1 && r < 40;
    let mut heights = vec![f64::NAN; lattice.len()];
    let mut count = 0;
    for row in 0..40 {
        for col in 0..60 {
            if centre(row, col) {
                count += 1;
                heights[lattice.index(row, col)] = noise.height(row, col);
                for (r, c) in lattice.neighbours(row, col).into_iter().flatten() {
                    heights[lattice.index(r, c)] = noise.height(r, c);
                }
            }
        }
    }
    assert_eq!(count, 200);
    let field = Heightfield::new(lattice, heights).unwrap();
    let report = Instance::new(&field, 1e5).check();
    assert_eq!((report.components, report.interior), (200, 200));
}

#[test]
fn long_and_thin() {
    let lattice = Lattice::new(3, 150, 0.004).unwrap();
    let strip = Heightfield::from_fn(lattice, |x, _| bumps(3.0 * x, 0.0)).unwrap();
    let report = Instance::new(&noisy(&strip, 0.01, 5), 1e5).check();
    assert_eq!(report.interior, 148);
}

/// The bound never lies above the optimum, nor the objective below it, at any
/// time on the finest lattice; and what a cancelled solve returns is complete.
#[test]
fn figures_are_honest_all_along() {
    let field = archipelago(24, 6);
    let instance = Instance::new(&field, 1e5);
    let exact = instance.optimum().objective;
    let mut solver = Solver::new(instance.input(), &options(1e-7)).unwrap();
    let mut finest = 0;
    let mut last = f64::INFINITY;
    loop {
        let progress = solver.progress();
        if progress.level == 0 {
            finest += 1;
            assert!(progress.dual_bound <= exact * (1.0 + 1e-8), "{progress:?}");
            assert!(progress.objective >= exact * (1.0 - 1e-8), "{progress:?}");
            let gap = progress.gap.unwrap();
            assert!(gap <= last + 1e-12, "{last} then {progress:?}");
            last = gap;
        }
        if finest % 20 == 1 {
            let mut cancelled = solver.clone();
            cancelled.cancel();
            let surface = cancelled.surface().unwrap();
            let report = surface.report();
            assert!(report.stop_reason != StopReason::Gap);
            assert!(report.dual_bound <= exact * (1.0 + 1e-8), "{report:?}");
            assert!(report.objective >= exact * (1.0 - 1e-8), "{report:?}");
            let heights = surface.heightfield().heights();
            for (z, given) in heights.iter().zip(field.heights()) {
                assert_eq!(z.is_nan(), given.is_nan());
            }
            let energy: f64 = instance.terms(heights).iter().sum();
            assert!(
                (energy / report.objective - 1.0).abs() < 1e-9,
                "{energy}: {report:?}"
            );
        }
        if solver.advance(5).unwrap() != Status::Running {
            break;
        }
    }
    assert!(finest > 20);
    assert!(solver.progress().gap.unwrap() <= 1e-7);
}

//! Solving again from where a solver stands.

use crate::native::common::conic::Instance;
use crate::native::common::{bumps, cut, noisy, unit_square};
use developable::{
    Energy, Error, Heightfield, Input, Lattice, Occlusions, Options, Solver, Status, StopReason,
    Surface, fit,
};

fn field(seed: u64) -> Heightfield {
    cut(&noisy(&unit_square(60, bumps), 0.02, seed), |x, y| {
        (x - 0.6).hypot(y - 0.4) > 0.1
    })
}

fn options(lambda: f64) -> Options {
    Options::paper().lambda(lambda).gap(1e-5)
}

fn run(solver: &mut Solver) -> Surface {
    while solver.advance(1000).unwrap() == Status::Running {}
    solver.surface().unwrap()
}

fn solved(input: impl Into<Input>, options: &Options) -> Solver {
    let mut solver = Solver::new(input, options).unwrap();
    run(&mut solver);
    solver
}

fn bits(surface: &Surface) -> Vec<u64> {
    let heights = surface.heightfield().heights();
    heights.iter().map(|z| z.to_bits()).collect()
}

/// Both are certified, so both are close to the optimum that they share: within
/// `√((P − D)/λ)` of it, in normalised coordinates and over `I ∪ ∂I`.
fn agree(warm: &Surface, cold: &Surface, input: &Heightfield) {
    let (a, b) = (warm.report(), cold.report());
    for report in [a, b] {
        assert_eq!(report.stop_reason, StopReason::Gap, "{report:?}");
        assert!(report.is_certified(1e-5), "{report:?}");
    }
    assert!((a.objective / b.objective - 1.0).abs() <= 1e-5);
    assert!(a.dual_bound <= b.objective && b.dual_bound <= a.objective);
    let domain = developable::Domain::new(input).unwrap();
    let cols = input.lattice().cols();
    let heights = |s: &Surface| s.heightfield().heights().to_vec();
    let distance: f64 = (heights(warm).iter().zip(heights(cold)).enumerate())
        .filter(|(i, _)| domain.role(i / cols, i % cols).is_active())
        .map(|(_, (a, b))| (a - b).powi(2))
        .sum();
    let radius = |r: &developable::Report| ((r.objective - r.dual_bound) / r.lambda).sqrt();
    let bound = radius(a) + radius(b);
    let distance = a.scale * distance.sqrt();
    assert!(distance <= bound, "{distance:e} against {bound:e}");
}

#[test]
fn another_lambda() {
    let field = field(1);
    let mut solver = solved(&field, &options(1e5));
    for lambda in [1.5e5, 1e5, 3e5, 2e6, 5e4, 1e3] {
        solver.restart(&options(lambda)).unwrap();
        let warm = run(&mut solver);
        let cold = fit(&field, &options(lambda)).unwrap();
        agree(&warm, &cold, &field);
    }
}

#[test]
fn the_same_again_is_done_at_once() {
    for energy in [
        Energy::Nuclear,
        Energy::Frobenius,
        Energy::SecondFormOfInput,
    ] {
        let options = options(1e5).energy(energy);
        let mut solver = solved(field(2), &options);
        let first = solver.surface().unwrap();
        solver.restart(&options).unwrap();
        let again = run(&mut solver);
        assert_eq!(again.report().iterations, 0, "{:?}", again.report());
        assert!(again.report().is_certified(1e-5));
        assert!(
            crate::native::common::max_difference(first.heightfield(), again.heightfield()) < 1e-12
        );
    }
}

/// Where vertices are free or weights follow the surface, it takes another certificate.
#[test]
fn the_same_again_is_soon_done_by_other_energies_and_in_designs() {
    let mut design = Instance::design(&unit_square(30, bumps), 1e6, |r, c| (r * 5 + c) % 9 == 0);
    design.gap = 1e-3;
    let second_form = options(1e5).energy(Energy::SecondForm).gap(0.01);
    let cases = [
        (design.input(), design.options()),
        (field(2).into(), second_form),
    ];
    for (input, options) in cases {
        let mut solver = solved(input, &options);
        let first = solver.surface().unwrap();
        solver.restart(&options).unwrap();
        let again = run(&mut solver);
        assert_eq!(again.report().stop_reason, StopReason::Gap);
        let iterations = [first, again].map(|s| s.report().iterations);
        assert!(
            iterations[1] <= 30 && iterations[1] < iterations[0],
            "{iterations:?}"
        );
    }
}

#[test]
fn other_heights_another_mask_other_constraints() {
    let first = field(3);
    let options = options(1e5);
    let start = solved(&first, &options);
    let (lattice, n) = (*first.lattice(), first.lattice().len());

    let other = noisy(&first, 0.002, 4);
    let smaller = cut(&first, |x, y| x < 0.8 || y > 0.5);
    let larger = noisy(&unit_square(60, bumps), 0.02, 3);
    let split = cut(&first, |x, _| (x - 0.3).abs() > 0.03);
    for next in [&other, &smaller, &larger, &split] {
        let mut solver = start.clone();
        solver.restart_with(next, &options).unwrap();
        agree(&run(&mut solver), &fit(next, &options).unwrap(), next);
    }
    // And back again, from several parts.
    let mut solver = solved(&split, &options);
    solver.restart_with(&first, &options).unwrap();
    agree(&run(&mut solver), &start.surface().unwrap(), &first);

    // Weights, constraints and tears appear and are met.
    let mut points = vec![f64::NAN; n];
    (points[500], points[901], points[2000]) = (0.3, -0.1, 0.2);
    let torn: Vec<u8> = (0..n).map(|i| u8::from(i % 97 == 0)).collect();
    let full = Input::from(&first)
        .with_confidence((0..n).map(|i| 0.5 + (i % 3) as f64).collect())
        .and_then(|input| input.with_constraints(points))
        .and_then(|input| input.with_occlusions(Occlusions::from_vertices(&lattice, &torn)?))
        .unwrap();
    let mut solver = start.clone();
    solver.restart_with(full.clone(), &options).unwrap();
    let (warm, cold) = (run(&mut solver), fit(full, &options).unwrap());
    assert!((warm.report().objective / cold.report().objective - 1.0).abs() <= 1e-5);
    assert!(warm.report().is_certified(1e-5));
    assert_eq!(warm.heightfield().heights()[901], -0.1);
    assert_eq!(warm.report().occluded, cold.report().occluded);
}

#[test]
fn another_lattice_or_energy_starts_from_nothing() {
    let options = options(1e5);
    let next = noisy(&unit_square(40, bumps), 0.02, 5);
    let mut solver = solved(field(5), &options);
    solver.restart_with(&next, &options).unwrap();
    assert_eq!(
        bits(&run(&mut solver)),
        bits(&fit(&next, &options).unwrap())
    );
    let smooth = options.energy(Energy::Frobenius);
    solver.restart(&smooth).unwrap();
    assert_eq!(bits(&run(&mut solver)), bits(&fit(&next, &smooth).unwrap()));
    // The same shape in other units.
    let big = Heightfield::new(
        Lattice::new(next.lattice().rows(), next.lattice().cols(), 2.0).unwrap(),
        next.heights().iter().map(|z| 80.0 * z).collect(),
    )
    .unwrap();
    solver.restart_with(&big, &options).unwrap();
    agree(&run(&mut solver), &fit(&big, &options).unwrap(), &big);
}

#[test]
fn a_failed_restart_changes_nothing() {
    let field = field(6);
    let options = options(1e5);
    let mut running = Solver::new(&field, &options).unwrap();
    running.advance(100).unwrap();
    let stopped = solved(&field, &options);
    for solver in [running, stopped] {
        let mut tried = solver.clone();
        assert_eq!(
            tried.restart(&options.gap(0.0)).unwrap_err().code(),
            "OPTION"
        );
        assert_eq!(
            tried.restart(&options.lambda(-1.0)).unwrap_err().code(),
            "OPTION"
        );
        let none = cut(&field, |_, _| false);
        let error = tried.restart_with(&none, &options).unwrap_err();
        assert!(matches!(error, Error::NoInterior { .. }));
        let n = field.lattice().len();
        let loose = Input::from(&field).with_confidence(vec![0.0; n]).unwrap();
        let error = tried.restart_with(loose, &options).unwrap_err();
        assert!(matches!(error, Error::Underdetermined { .. }));
        let mut untouched = solver.clone();
        assert_eq!(tried.progress().iteration, untouched.progress().iteration);
        assert_eq!(
            bits(&tried.surface().unwrap()),
            bits(&untouched.surface().unwrap())
        );
        assert_eq!(bits(&run(&mut tried)), bits(&run(&mut untouched)));
    }
}

#[test]
fn restarts_are_the_same_on_every_run() {
    let field = field(7);
    let runs: Vec<_> = [3, 1000]
        .into_iter()
        .map(|work| {
            let mut solver = solved(&field, &options(1e5));
            solver.restart(&options(2e5)).unwrap();
            while solver.advance(work).unwrap() == Status::Running {}
            bits(&solver.surface().unwrap())
        })
        .collect();
    assert_eq!(runs[0], runs[1]);
}

#[test]
fn in_the_middle_of_a_solve() {
    let field = field(8);
    for work in [1, 30, 60, 100, 150] {
        let mut solver = Solver::new(&field, &options(1e5)).unwrap();
        solver.advance(work).unwrap();
        solver.restart(&options(2e5)).unwrap();
        let warm = run(&mut solver);
        agree(&warm, &fit(&field, &options(2e5)).unwrap(), &field);
    }
    // Between two parts.
    let split = cut(&field, |x, _| (x - 0.3).abs() > 0.03);
    let mut solver = Solver::new(&split, &options(1e5)).unwrap();
    while solver.surface().unwrap().report().levels.len() < 2 {
        solver.advance(20).unwrap();
    }
    solver.cancel();
    solver.restart(&options(2e5)).unwrap();
    agree(
        &run(&mut solver),
        &fit(&split, &options(2e5)).unwrap(),
        &split,
    );
}

#[test]
fn a_warm_start_saves_work() {
    let field = field(9);
    let options = Options::paper();
    let mut solver = solved(&field, &options.lambda(1e6));
    solver.restart(&options.lambda(1.2e6)).unwrap();
    let warm = run(&mut solver);
    let cold = fit(&field, &options.lambda(1.2e6)).unwrap();
    let work = |s: &Surface| {
        let levels = s.report().levels.iter();
        levels
            .map(|level| level.interior * level.cg_iterations)
            .sum::<usize>()
    };
    assert!(work(&warm) < work(&cold), "{} {}", work(&warm), work(&cold));
}

/// ADMM iterations, those on coarse lattices by their share of the vertices.
fn iterations(surface: &Surface) -> f64 {
    let levels = &surface.report().levels;
    let finest = levels.last().unwrap().interior as f64;
    let work = levels
        .iter()
        .map(|l| l.iterations as f64 * l.interior as f64 / finest);
    work.sum()
}

/// However a slider is dragged: what comes after the last step takes about as long as a fresh solve,
/// or less. Iterations count in fives.
#[test]
fn overtaken_restarts_do_not_slow_the_last_one_down() {
    let ramp = |steps: i32, factor: f64| (1..=steps).map(move |k| factor.powi(k)).collect();
    let drags: [Vec<f64>; 6] = [
        ramp(12, 1.25),
        ramp(12, 0.8),
        ramp(24, 1.04),
        ramp(24, 0.96),
        (1..12)
            .map(|k| if k % 2 == 0 { 2.5 } else { 0.5 })
            .collect(),
        (0..12)
            .map(|k| 10f64.powf(2.0 * f64::from(k).sin()))
            .collect(),
    ];
    for (seed, lambda, gap) in [(10, 1e4, 0.01), (11, 1e6, 0.01), (12, 1e5, 1e-3)] {
        let field = field(seed);
        let other = noisy(&field, 0.001, 30);
        let smaller = cut(&field, |x, y| x < 0.8 || y > 0.5);
        let options = |factor: f64| Options::paper().lambda(lambda * factor).gap(gap);
        let start = solved(&field, &options(1.0));
        for drag in &drags {
            let last = options(*drag.last().unwrap());
            let fresh = iterations(&fit(&field, &last).unwrap());
            for steps in [0, 1, 40] {
                let mut solver = start.clone();
                for (k, factor) in drag.iter().enumerate() {
                    match k % 7 {
                        3 => solver.restart_with(&other, &options(*factor)).unwrap(),
                        5 => solver.restart_with(&smaller, &options(*factor)).unwrap(),
                        _ => solver.restart_with(&field, &options(*factor)).unwrap(),
                    }
                    if steps > 0 {
                        solver.advance(steps).unwrap();
                    }
                }
                solver.restart_with(&field, &last).unwrap();
                let found = iterations(&run(&mut solver));
                assert!(
                    found <= 1.3 * fresh + 5.0,
                    "{found} instead of {fresh} at {last:?}, {steps} steps each"
                );
            }
        }
    }
}

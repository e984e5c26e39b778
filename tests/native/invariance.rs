//! What must not change the surface, or must change it in a known way.

use crate::native::common::{cut, max_difference, noisy, rms_difference, unit_square};
use developable::{
    Heightfield, Lambda, Lattice, Normalization, Options, Schedule, StopReason, Surface, fit,
};

fn solve(field: &Heightfield, lambda: impl Into<Lambda>, gap: f64) -> Surface {
    fit(field, &Options::paper().lambda(lambda).gap(gap)).unwrap()
}

fn waves(x: f64, y: f64) -> f64 {
    0.1 * (7.0 * x).sin() * (6.0 * y).cos() + 0.3 * (x + 0.5 * y - 0.8).abs()
}

fn map(field: &Heightfield, f: impl Fn(f64, f64, f64) -> f64) -> Heightfield {
    let lattice = *field.lattice();
    let heights = (0..lattice.len()).map(|i| {
        let [x, y] = lattice.position(i / lattice.cols(), i % lattice.cols());
        f(x, y, field.heights()[i])
    });
    Heightfield::new(lattice, heights.collect()).unwrap()
}

#[test]
fn affine_input_comes_back_unchanged() {
    for [a, b, c] in [
        [0.0, 0.0, 0.0],
        [0.0, 0.0, 1e4],
        [0.7, -1.3, 0.2],
        [1e3, 2e3, -5.0],
    ] {
        let plane = unit_square(40, |x, y| a * x + b * y + c);
        for schedule in [Schedule::Default, Schedule::Paper] {
            let surface = fit(&plane, &Options::paper().schedule(schedule)).unwrap();
            assert_eq!(surface.report().stop_reason, StopReason::Rounding);
            let size = a.abs() + b.abs() + c.abs();
            assert!(max_difference(&plane, surface.heightfield()) <= 1e-13 * size);
        }
    }
}

#[test]
fn adding_an_affine_function_adds_it_to_the_output() {
    let field = noisy(&unit_square(30, waves), 0.02, 1);
    let tilt = |x: f64, y: f64, z: f64| z + 40.0 * x - 25.0 * y + 1e3;
    let plain = solve(&field, Lambda::Medium, 1e-3);
    let tilted = solve(&map(&field, tilt), Lambda::Medium, 1e-3);
    assert_eq!(plain.report().iterations, tilted.report().iterations);
    let expected = map(plain.heightfield(), tilt);
    assert!(max_difference(&expected, tilted.heightfield()) < 1e-9);
}

#[test]
fn units_of_length_do_not_matter() {
    let field = noisy(&unit_square(30, waves), 0.02, 2);
    let millimetres = Heightfield::new(
        Lattice::new(
            field.lattice().rows(),
            field.lattice().cols(),
            field.lattice().spacing() * 210.0,
        )
        .unwrap()
        .with_origin([-4e3, 9e3])
        .unwrap(),
        field.heights().iter().map(|z| 210.0 * z).collect(),
    )
    .unwrap();
    let a = solve(&field, Lambda::Medium, 1e-3);
    let b = solve(&millimetres, Lambda::Medium, 1e-3);
    assert_eq!(a.report().iterations, b.report().iterations);
    for (a, b) in a
        .heightfield()
        .heights()
        .iter()
        .zip(b.heightfield().heights())
    {
        assert!((210.0 * a - b).abs() < 1e-8);
    }
}

/// A vertex's axial coordinates and its index in the lattice.
type Cell = ((isize, isize), usize);

/// Hexagon of `radius` cells about the middle of a square lattice.
fn hexagon(radius: isize) -> (Lattice, Vec<Cell>) {
    let side = 2 * radius as usize + 3;
    let lattice = Lattice::new(side, side + 2, 1.0 / side as f64).unwrap();
    let middle = radius + 1;
    let mut cells = Vec::new();
    for q in -radius..=radius {
        for r in -radius..=radius {
            if (q + r).abs() <= radius {
                // Going down one row along SE is +1 in r; SE keeps the column on odd rows.
                let row = middle + r;
                let even_rows_passed = (row.div_euclid(2) + row.rem_euclid(2))
                    - (middle.div_euclid(2) + middle.rem_euclid(2));
                let col = middle + q + even_rows_passed;
                cells.push(((q, r), lattice.index(row as usize, col as usize)));
            }
        }
    }
    (lattice, cells)
}

#[test]
fn turning_the_input_by_sixty_degrees_turns_the_output() {
    let (lattice, cells) = hexagon(14);
    let index = |q, r| cells.iter().find(|(c, _)| *c == (q, r)).unwrap().1;
    let position = |i: usize| lattice.position(i / lattice.cols(), i % lattice.cols());
    let [cx, cy] = position(index(0, 0));

    // The turn (q, r) → (−r, q + r) really is one by 60° about the middle.
    let turn: Vec<(usize, usize)> = cells
        .iter()
        .map(|((q, r), i)| (*i, index(-r, q + r)))
        .collect();
    for (from, to) in &turn {
        let ([x, y], [u, v]) = (position(*from), position(*to));
        let (sin, cos) = (-60f64.to_radians()).sin_cos();
        assert!((cos * (x - cx) - sin * (y - cy) - (u - cx)).abs() < 1e-12);
        assert!((sin * (x - cx) + cos * (y - cy) - (v - cy)).abs() < 1e-12);
    }

    let mut noise = crate::native::common::Random::new(3);
    let mut heights = vec![f64::NAN; lattice.len()];
    let mut turned = heights.clone();
    for (from, to) in &turn {
        let [x, y] = position(*from);
        heights[*from] = waves(x, y) + 0.02 * noise.sample();
        turned[*to] = heights[*from];
    }
    let plain = solve(
        &Heightfield::new(lattice, heights).unwrap(),
        Lambda::Medium,
        1e-8,
    );
    let turned = solve(
        &Heightfield::new(lattice, turned).unwrap(),
        Lambda::Medium,
        1e-8,
    );
    // The bounding box is not the same for both, but that of a hexagon turned by 60° is.
    let error = turn
        .iter()
        .map(|(from, to)| {
            (plain.heightfield().heights()[*from] - turned.heightfield().heights()[*to]).abs()
        })
        .fold(0.0, f64::max);
    assert!(error < 2e-5, "{error}");
    let objectives = (plain.report().objective, turned.report().objective);
    assert!(
        (objectives.0 / objectives.1 - 1.0).abs() < 2e-8,
        "{objectives:?}"
    );
}

#[test]
fn a_clean_cylinder_keeps_its_shape_in_every_orientation() {
    // The exact energy's optimum for big λ moves a cylinder of radius 1 only near its ends.
    for degrees in [0, 17, 30, 45, 60, 90, 133] {
        let (sin, cos) = f64::from(degrees).to_radians().sin_cos();
        let cylinder = unit_square(50, |x, y| {
            let across = (x - 0.5) * cos + (y - 0.5) * sin;
            (1.0 - across * across).sqrt()
        });
        let surface = solve(&cylinder, Lambda::Big, 1e-4);
        let worst = max_difference(&cylinder, surface.heightfield());
        let rms = rms_difference(&cylinder, surface.heightfield());
        // Height range of the cylinder over the square is 0.13 to 0.29.
        assert!(worst < 2e-3 && rms < 3e-4, "{degrees}°: {worst} {rms}");
    }
}

#[test]
fn refining_the_lattice_changes_the_surface_less_each_time() {
    // Every second column of every second row of a lattice is the lattice of twice the spacing.
    let dome = |x: f64, y: f64| 0.4 * (-6.0 * ((x - 0.5).powi(2) + (y - 0.45).powi(2))).exp();
    let surfaces: Vec<Surface> = [16usize, 32, 64]
        .into_iter()
        .map(|n| {
            let lattice = Lattice::new(n + 1, n + 2, 1.0 / n as f64).unwrap();
            let field = Heightfield::from_fn(lattice, |x, y| dome(x, y + 0.9)).unwrap();
            let options = Options::paper()
                .lambda(1e5)
                .gap(1e-4)
                .normalization(Normalization::Off);
            fit(&field, &options).unwrap()
        })
        .collect();
    let change = |coarse: &Surface, fine: &Surface| {
        let (a, b) = (coarse.heightfield(), fine.heightfield());
        let mut squares = Vec::new();
        for row in 0..a.lattice().rows() {
            for col in 1..a.lattice().cols() {
                let (r, c) = (2 * row, 2 * col - row % 2);
                if r < b.lattice().rows() && c < b.lattice().cols() {
                    let ([x, y], [u, v]) =
                        (a.lattice().position(row, col), b.lattice().position(r, c));
                    assert!((x - u).abs() < 1e-12 && (y - v).abs() < 1e-12);
                    squares.push((a.height(row, col) - b.height(r, c)).powi(2));
                }
            }
        }
        (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
    };
    let first = change(&surfaces[0], &surfaces[1]);
    let second = change(&surfaces[1], &surfaces[2]);
    assert!(second < 0.7 * first, "{first} then {second}");
}

#[test]
fn the_division_into_steps_changes_nothing() {
    let field = cut(&noisy(&unit_square(60, waves), 0.02, 4), |x, y| {
        (x - 0.4).hypot(y - 0.5) > 0.1
    });
    for schedule in [Schedule::Default, Schedule::Paper] {
        let options = Options::paper().schedule(schedule).max_iterations(60);
        let whole = fit(&field, &options).unwrap();
        for work in [1, 7, 1000] {
            let mut solver = developable::Solver::new(&field, &options).unwrap();
            while solver.advance(work).unwrap() == developable::Status::Running {}
            let parts = solver.surface().unwrap();
            assert_eq!(parts.report().cg_iterations, whole.report().cg_iterations);
            // Bit for bit, NaNs included.
            let bits = |s: &Surface| -> Vec<u64> {
                s.heightfield()
                    .heights()
                    .iter()
                    .map(|z| z.to_bits())
                    .collect()
            };
            assert_eq!(bits(&parts), bits(&whole));
        }
    }
}

#[test]
fn the_best_iterate_and_the_best_bound_are_kept() {
    // So small a λ makes ADMM's own objective rise in between.
    let field = noisy(&unit_square(20, waves), 0.05, 6);
    let options = Options::paper().lambda(300.0).gap(1e-10);
    let mut solver = developable::Solver::new(&field, &options.max_iterations(400)).unwrap();
    let mut last = solver.progress();
    while solver.advance(1).unwrap() == developable::Status::Running {
        let now = solver.progress();
        assert!(now.objective <= last.objective, "{last:?} then {now:?}");
        assert!(now.dual_bound >= last.dual_bound, "{last:?} then {now:?}");
        assert!(now.dual_bound <= now.objective);
        last = now;
    }
}

#[test]
fn a_cancelled_solve_returns_its_best_iterate() {
    let field = noisy(&unit_square(40, waves), 0.02, 5);
    let options = Options::paper().gap(1e-9);
    let mut calls = 0;
    let mut last = f64::NAN;
    let surface = developable::fit_with(&field, &options, |progress| {
        calls += 1;
        last = progress.objective;
        if calls == 5 {
            std::ops::ControlFlow::Break(())
        } else {
            std::ops::ControlFlow::Continue(())
        }
    })
    .unwrap();
    let report = surface.report();
    assert_eq!((calls, report.stop_reason), (5, StopReason::Cancelled));
    assert_eq!(report.objective, last);
    assert!(
        !report.is_certified(1e-9) && report.gap < Some(1.0),
        "{report:?}"
    );
    assert!(
        surface
            .heightfield()
            .heights()
            .iter()
            .all(|z| z.is_finite())
    );

    // Never worse than the input, on whatever level it ends.
    let field = noisy(&unit_square(80, waves), 0.002, 7);
    for (lambda, work) in [(1e9, 1), (1e9, 60), (1e6, 1), (1e3, 1)] {
        let options = Options::paper().lambda(lambda).gap(1e-9);
        let mut solver = developable::Solver::new(&field, &options).unwrap();
        let _ = solver.advance(work).unwrap();
        let on_coarse = solver.progress().level > 0;
        assert!(on_coarse || work > 1);
        solver.cancel();
        let report = solver.surface().unwrap().report().clone();
        let once = fit(&field, &options.max_iterations(1))
            .unwrap()
            .report()
            .clone();
        let input = developable::HessianOperator::new(&developable::Domain::new(&field).unwrap())
            .apply(field.heights())
            .iter()
            .map(|h| h.nuclear_norm())
            .sum::<f64>()
            / report.scale;
        assert!(
            report.objective <= input * (1.0 + 1e-9),
            "{report:?} {input}"
        );
        assert!(once.objective <= input * (1.0 + 1e-9), "{once:?} {input}");
        assert!(report.dual_bound <= report.objective);
    }

    // Before the first iteration that is the input itself.
    let field = noisy(&unit_square(40, waves), 0.02, 5);
    let options = Options::paper().gap(1e-9);
    let mut solver = developable::Solver::new(&field, &options).unwrap();
    solver.cancel();
    let surface = solver.surface().unwrap();
    assert_eq!(surface.report().stop_reason, StopReason::Cancelled);
    // Corners that no stencil touches are extrapolated all the same.
    let domain = developable::Domain::new(&field).unwrap();
    for row in 0..field.lattice().rows() {
        for col in 0..field.lattice().cols() {
            let moved = (surface.heightfield().height(row, col) - field.height(row, col)).abs();
            assert!(moved < 1e-13 || !domain.role(row, col).is_active());
        }
    }
}

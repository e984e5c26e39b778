//! How much one step of a solve does: whoever waits for it waits no longer than that.

use developable::{Example, ExampleOptions, Options, Solver, Status};

#[test]
fn finer_lattices_and_searches_for_a_bound_are_begun_and_pursued_in_steps_of_their_own() {
    let sample = Example::Roof.generate(&ExampleOptions::default()).unwrap();
    let field = sample.input.to_lattice(None).unwrap();
    let mut solver = Solver::new(&field, &Options::paper().gap(1e-3)).unwrap();
    // The coarser lattices are made one at a time, before there is any iteration.
    let mut prepared = 0;
    while solver.progress().level < 2 {
        assert_eq!(solver.advance(1).unwrap(), Status::Running);
        assert_eq!(solver.progress().cg_iterations, 0);
        prepared += 1;
    }
    let levels = solver.progress().level;
    assert!(prepared > levels, "{prepared} steps for {levels} levels");
    let (mut entries, mut looks) = (0, 0);
    let mut before = solver.progress();
    while solver.advance(1).unwrap() == Status::Running {
        let now = solver.progress();
        let steps = [
            now.iteration - before.iteration,
            now.cg_iterations - before.cg_iterations,
        ];
        assert!(steps[0] <= 1 && steps[1] <= 1, "{steps:?}");
        if now.level != before.level {
            assert_eq!(now.level + 1, before.level);
            assert_eq!(steps, [0, 0], "a level is entered, and nothing else");
            entries += 1;
        } else if steps == [0, 0] {
            looks += 1;
        }
        before = now;
    }
    assert_eq!(entries, levels);
    assert!(
        looks > 1,
        "begun in one step and pursued in others, not in {looks}"
    );
}

#[test]
fn before_the_first_iteration_the_surface_is_the_input() {
    let sample = Example::Roof.generate(&ExampleOptions::default()).unwrap();
    let field = sample.input.to_lattice(None).unwrap();
    let mut solver = Solver::new(&field, &Options::paper()).unwrap();
    let surface = solver.surface().unwrap();
    let pairs = surface.heightfield().heights().iter().zip(field.heights());
    // But for the few vertices that no stencil touches, which are restored.
    let other = pairs.filter(|(a, b)| (*a - *b).abs() > 1e-12).count();
    assert_eq!(other, surface.report().omitted);
    assert_eq!(surface.report().fidelity, 0.0);
    while solver.progress().iteration == 0 {
        solver.advance(1).unwrap();
    }
    let begun = solver.surface().unwrap();
    assert!(begun.report().objective < surface.report().objective);
}

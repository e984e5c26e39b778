//! One meaning for each option: what is given changes itself alone.

use crate::native::common::{noisy, unit_square};
use developable::{
    Energy, Heightfield, Input, Lambda, Lattice, MeshOptions, Options, Report, Schedule, fit,
};

/// A roof with a round ridge, and noise.
fn scan() -> Heightfield {
    let roof = unit_square(40, |x, y| 0.3 - 0.4 * (x - 0.5).hypot(0.05) + 0.05 * y);
    noisy(&roof, 0.004, 11)
}

/// Pins of a tent, free everywhere else.
fn design() -> Input {
    let lattice = Lattice::new(20, 20, 0.05).unwrap();
    let mut pins = vec![f64::NAN; lattice.len()];
    for (row, col, height) in [
        (1, 1, 0.0),
        (1, 18, 0.0),
        (18, 1, 0.0),
        (18, 18, 0.0),
        (10, 9, 0.3),
    ] {
        pins[lattice.index(row, col)] = height;
    }
    Input::design(Heightfield::new(lattice, pins).unwrap(), None).unwrap()
}

fn report(options: Options) -> Report {
    fit(scan(), &options).unwrap().report().clone()
}

/// λ, the energy and its parameters: what a solve minimises.
fn minimised(report: &Report) -> (f64, Energy, [f64; 3]) {
    let huber = report.huber.unwrap();
    let parameters = [huber.bend_radius, huber.flatness, huber.crease_radius];
    (report.lambda, report.energy, parameters)
}

#[test]
fn an_option_changes_no_other() {
    let plain = report(Options::default());
    assert!(plain.lambda_choice.is_some());
    let (lambda, energy, parameters) = minimised(&plain);
    assert_eq!(energy, Energy::Huber);
    let [bend_radius, flatness, crease_radius] = parameters;
    let alone = Options::default();
    for same in [
        alone.lambda(Lambda::Auto),
        alone.energy(Energy::Huber),
        alone.schedule(Schedule::Paper),
        alone.gap(0.1),
        alone.max_iterations(40),
        alone.crease_passes(1),
        alone.reweighting(0),
        alone.bend_radius(bend_radius),
        alone.flatness(flatness),
        alone.crease_radius(crease_radius),
    ] {
        let found = minimised(&report(same));
        assert_eq!(found, (lambda, energy, parameters), "{same:?}");
    }
    let given = [
        (alone.bend_radius(0.33), [0.33, flatness, crease_radius]),
        (alone.flatness(0.77), [bend_radius, 0.77, crease_radius]),
        (alone.crease_radius(0.03), [bend_radius, flatness, 0.03]),
    ];
    for (options, parameters) in given {
        let found = minimised(&report(options));
        assert_eq!(found, (lambda, energy, parameters), "{options:?}");
    }
    let at = report(alone.lambda(3e5));
    assert_eq!((at.lambda, at.energy), (3e5, Energy::Huber));
}

#[test]
fn the_paper_has_a_name() {
    let paper = report(Options::paper());
    assert_eq!((paper.lambda, paper.energy), (1e6, Energy::Nuclear));
    assert!(paper.huber.is_none() && paper.lambda_choice.is_none());
}

#[test]
fn a_design_has_the_papers_energy_unless_another_one_is_given() {
    let solve = |options: &Options| fit(design(), options).unwrap().report().clone();
    let plain = solve(&Options::default());
    assert_eq!((plain.lambda, plain.energy), (1e6, Energy::Nuclear));
    assert_eq!(
        solve(&Options::default().energy(Energy::Huber)).energy,
        Energy::Huber
    );
    assert_eq!(
        solve(&Options::default().lambda(1e4)).energy,
        Energy::Nuclear
    );
}

#[test]
fn options_without_an_effect_are_refused_by_name() {
    let name = |options: Options| fit(scan(), &options).unwrap_err().to_string();
    let nuclear = Options::default().energy(Energy::Nuclear);
    for (options, option) in [
        (nuclear.flatness(0.3), "flatness"),
        (nuclear.bend_radius(0.1), "bend_radius"),
        (nuclear.crease_radius(0.1), "crease_radius"),
        (nuclear.crease_passes(2), "crease_passes"),
        (Options::default().reweighting(1), "reweighting"),
        (
            Options::default().schedule(Schedule::Paper).gap(0.01),
            "gap",
        ),
        (Options::default().tie_break(0.01), "tie_break"),
    ] {
        assert!(name(options).contains(option), "{options:?}");
    }
    let error = fit(design(), &Options::default().flatness(0.3)).unwrap_err();
    assert!(error.to_string().contains("flatness"));
    assert!(fit(design(), &Options::default().tie_break(0.02)).is_ok());
    assert!(MeshOptions::default().crease_passes(2).validate().is_ok());
}

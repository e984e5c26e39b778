//! Surfaces through heights that must be met exactly.

use crate::native::common::conic::Instance;
use crate::native::common::{Random, bumps, cut, max_difference, noisy, unit_square};
use developable::{Energy, Error, Heightfield, Input, Lattice, Options, StopReason, fit};
use proptest::prelude::*;

/// Whether a vertex is among the outer `width` rows and columns.
fn rim(lattice: &Lattice, width: usize) -> impl Fn(usize, usize) -> bool {
    let (rows, cols) = (lattice.rows(), lattice.cols());
    move |r, c| r.min(c).min(rows - 1 - r).min(cols - 1 - c) < width
}

/// The heights where `held` says so, NaN elsewhere.
fn constraints(field: &Heightfield, held: impl Fn(usize, usize) -> bool) -> Heightfield {
    let lattice = *field.lattice();
    let heights = (0..lattice.len()).map(|i| {
        let (row, col) = (i / lattice.cols(), i % lattice.cols());
        if held(row, col) {
            field.heights()[i]
        } else {
            f64::NAN
        }
    });
    Heightfield::new(lattice, heights.collect()).unwrap()
}

#[test]
fn a_rim() {
    let field = unit_square(12, bumps);
    for energy in [
        Energy::Nuclear,
        Energy::Frobenius,
        Energy::SquaredNuclear,
        Energy::SecondFormOfInput,
    ] {
        let instance = Instance::design(&field, 1e6, rim(field.lattice(), 1)).energy(energy);
        let report = instance.check();
        assert_eq!(report.free, 144);
    }
}

#[test]
fn scattered_points_and_a_hole() {
    let field = cut(&unit_square(14, bumps), |x, y| {
        (x - 0.45).hypot(y - 0.55) > 0.2
    });
    for tie_break in [0.01, 1.0] {
        let mut instance = Instance::design(&field, 1e6, |r, c| (5 * r + 7 * c) % 23 == 0);
        instance.tie_break = tie_break;
        instance.gap = 1e-5;
        instance.check();
    }
}

#[test]
fn constraints_among_heights_to_stay_close_to() {
    let mut instance = Instance::new(&noisy(&unit_square(13, bumps), 0.02, 3), 1e5);
    for held in instance.constrained.iter_mut().step_by(11) {
        *held = true;
    }
    let report = instance.check();
    assert!(report.constrained > 15 && report.free == 0);
    for weight in instance.confidence.iter_mut().step_by(3) {
        *weight = 0.0;
    }
    assert!(instance.check().free > 20);
}

/// The tie break makes the energy larger by no more than what it costs at the
/// optimum without one.
#[test]
fn the_tie_break_costs_what_it_weighs() {
    let field = unit_square(12, bumps);
    let mut instance = Instance::design(&field, 1e6, rim(field.lattice(), 1));
    let report = instance.check();
    let tie_break = instance.tie_break;
    instance.tie_break = 1e-9;
    let pure = instance.optimum();
    instance.tie_break = tie_break;
    let [cost, norms] = instance.terms(&pure.heights);
    assert!(report.nuclear_norm >= norms * (1.0 - 1e-7));
    assert!(report.objective <= (norms + cost) * (1.0 + 1e-7));
    assert!(cost < 1e-3 * norms, "{cost} of {norms}");
}

#[test]
fn points_of_a_plane_span_it() {
    let plane = unit_square(30, |x, y| 3.0 * x - 2.0 * y + 7.0);
    let mid = plane.lattice().rows() / 2;
    for held in [
        [(2, 3), (mid, 20), (mid + 5, 4)],
        [(0, 0), (0, 30), (mid, 1)],
    ] {
        let points = constraints(&plane, |r, c| held.contains(&(r, c)));
        let surface = fit(Input::design(points, None).unwrap(), &Options::paper()).unwrap();
        let worst = max_difference(&plane, surface.heightfield());
        assert!(worst < 1e-9, "{worst:e} {:?}", surface.report());
        assert_eq!(surface.report().stop_reason, StopReason::Rounding);
    }
}

/// Where heights and slopes at the rim are those of a concave developable surface whose
/// rulings run from rim to rim, it is the only concave surface there, and no other bends less.
#[test]
fn the_rims_of_cylinders_and_cones_give_them_back() {
    type Shape = fn(f64, f64) -> f64;
    let shapes: [(&str, Shape); 3] = [
        ("cylinder", |x, _| (1.0 - (x - 0.5).powi(2)).sqrt()),
        ("oblique cylinder", |x, y| {
            (1.0 - (0.8 * x + 0.6 * y - 0.7).powi(2)).sqrt()
        }),
        ("cone", |x, y| -0.6 * (x + 0.3).hypot(y - 0.4)),
    ];
    for (name, f) in shapes {
        for n in [25, 50] {
            let truth = unit_square(n, f);
            let band = constraints(&truth, rim(truth.lattice(), 2));
            let options = Options::paper().gap(1e-3);
            let surface = fit(Input::design(band, None).unwrap(), &options).unwrap();
            assert!(surface.report().is_certified(1e-3));
            let worst = max_difference(&truth, surface.heightfield());
            assert!(worst < 3e-4, "{name}: {worst:e}");
        }
    }
}

#[test]
fn what_is_not_held_is_named() {
    let lattice = Lattice::new(9, 11, 0.3).unwrap();
    let all = (1, 1, 7 * 9);
    let name = |held: &[(usize, usize)], shape: Option<&[u8]>| {
        let mut heights = vec![f64::NAN; lattice.len()];
        for (row, col) in held {
            heights[lattice.index(*row, *col)] = 1.0;
        }
        let points = Heightfield::new(lattice, heights).unwrap();
        let error = fit(Input::design(points, shape).unwrap(), &Options::paper()).err();
        match error? {
            Error::Underdetermined { row, col, vertices } => Some((row, col, vertices)),
            other => panic!("{other}"),
        }
    };
    assert_eq!(name(&[], None), Some(all));
    assert_eq!(name(&[(2, 2)], None), Some(all));
    assert_eq!(name(&[(2, 2), (6, 3)], None), Some(all));
    // Along a row, along SE, straight down.
    assert_eq!(name(&[(2, 2), (2, 3), (2, 8)], None), Some(all));
    assert_eq!(name(&[(2, 2), (3, 3), (4, 3), (5, 4)], None), Some(all));
    assert_eq!(name(&[(2, 2), (4, 2), (6, 2)], None), Some(all));
    assert_eq!(name(&[(2, 2), (4, 2), (6, 3)], None), None);
    // No stencil touches the corner (0, 0): it holds nothing.
    assert_eq!(name(&[(0, 0), (4, 2), (6, 3)], None), Some(all));

    // Two islands, columns 0 to 4 and 6 to 10; only the first is held.
    let islands: Vec<u8> = (0..lattice.len()).map(|i| u8::from(i % 11 != 5)).collect();
    let first = [(2, 1), (4, 3), (6, 1)];
    assert_eq!(name(&first, Some(&islands)), Some((1, 7, 7 * 3)));
    // What lies in between does not count.
    let between = [(2, 5), (3, 5), (6, 5)];
    assert_eq!(
        name(&[first, between].concat(), Some(&islands)),
        Some((1, 7, 7 * 3))
    );
    assert_eq!(
        name(&[first, [(2, 8), (3, 8), (6, 9)]].concat(), Some(&islands)),
        None
    );

    // The same where there are heights that nobody trusts.
    let input = Input::new(Heightfield::new(lattice, vec![0.0; lattice.len()]).unwrap())
        .with_confidence(
            (0..lattice.len())
                .map(|i| f64::from(i as u8 % 11 / 9))
                .collect(),
        )
        .unwrap();
    assert!(fit(input.clone(), &Options::paper()).is_ok());
    let untrusted = input.with_confidence(vec![0.0; lattice.len()]).unwrap();
    assert_eq!(
        fit(untrusted, &Options::paper()).unwrap_err().code(),
        "UNDERDETERMINED"
    );
}

#[test]
fn constraints_outside_of_the_shape_are_ignored() {
    let field = unit_square(20, bumps);
    let lattice = *field.lattice();
    let shape: Vec<u8> = (0..lattice.len())
        .map(|i| u8::from((3..15).contains(&(i % lattice.cols()))))
        .collect();
    let solve = |held: &dyn Fn(usize, usize) -> bool| {
        let input = Input::design(constraints(&field, held), Some(&shape)).unwrap();
        fit(input, &Options::paper()).unwrap()
    };
    let inside = solve(&|r, c| (3..15).contains(&c) && (r + 2 * c) % 7 == 0);
    let everywhere = solve(&|r, c| (r + 2 * c) % 7 == 0);
    let bits = |s: &developable::Surface| -> Vec<u64> {
        s.heightfield()
            .heights()
            .iter()
            .map(|z| z.to_bits())
            .collect()
    };
    assert_eq!(bits(&inside), bits(&everywhere));
    assert_eq!(inside.report().constrained, everywhere.report().constrained);
    for (i, z) in inside.heightfield().heights().iter().enumerate() {
        assert_eq!(z.is_nan(), shape[i] == 0);
    }
}

#[test]
fn coarse_levels_end_at_the_same_optimum() {
    let field = unit_square(44, bumps);
    let mut instance = Instance::design(&field, 1e6, rim(field.lattice(), 1));
    instance.gap = 1e-4;
    let report = instance.check();
    assert!(report.levels.len() > 1);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]

    /// No surface that meets the constraints has an energy below the bound.
    #[test]
    fn the_bound_is_below_every_feasible_surface(
        seed in 0u64..1000, share in 2usize..9, trust in 0usize..3, lambda in 1e2..1e6f64,
        holes in prop::collection::vec(0usize..80, 0..6), kind in 0usize..3,
    ) {
        let lattice = Lattice::new(8, 10, 0.1).unwrap();
        let mut noise = Random::new(seed);
        let mut heights: Vec<f64> = (0..80).map(|_| noise.sample()).collect();
        for hole in holes {
            heights[hole] = f64::NAN;
        }
        let field = Heightfield::new(lattice, heights).unwrap();
        let mut instance = Instance::new(&field, lambda);
        instance.energy = [Energy::Nuclear, Energy::Frobenius, Energy::SquaredNuclear][kind];
        for i in 0..80 {
            instance.constrained[i] = noise.sample() < 2.0 / share as f64 - 1.0;
            instance.confidence[i] = match trust {
                0 => 1.0,
                1 => noise.sample().max(0.0),
                _ => 0.0,
            };
        }
        let options = instance.options().gap(0.05).max_iterations(300);
        let surface = match fit(instance.input(), &options) {
            Err(Error::Underdetermined { .. } | Error::NoInterior { .. }) => return Ok(()),
            other => other.unwrap(),
        };
        prop_assume!(instance.plate().is_some());
        let report = surface.report();
        let best = surface.heightfield().heights();
        prop_assert!(report.dual_bound <= report.objective);
        for size in [0.0, 1e-3, 1e-2, 0.1, 1.0] {
            let moved: Vec<f64> = (0..80)
                .map(|i| if instance.constrained[i] { best[i] } else { best[i] + size * noise.sample() })
                .collect();
            let [fidelity, norms] = instance.terms(&moved);
            prop_assert!(report.dual_bound <= (fidelity + norms) * (1.0 + 1e-9));
        }
        for i in (0..80).filter(|i| instance.constrained[*i]) {
            prop_assert_eq!(best[i].to_bits(), field.heights()[i].to_bits());
        }
    }
}

//! The energies against an independent conic solver, and what makes each what it is.

use crate::native::common::conic::Instance;
use crate::native::common::{bumps, max_difference, noisy, ring, unit_square};
use developable::{Energy, Options, StopReason, fit};

fn check(energy: Energy, lambdas: [f64; 3]) {
    for (seed, lambda) in lambdas.into_iter().enumerate() {
        let report = Instance::new(&ring(14, 20 + seed as u64), lambda)
            .energy(energy)
            .check();
        assert_eq!(report.energy, energy);
    }
}

#[test]
fn the_frobenius_norm() {
    check(Energy::Frobenius, [3e3, 1e5, 1e6]);
}

#[test]
fn the_squared_nuclear_norm() {
    // Where Hessians are far above 1 their squares need a larger λ to compare with.
    check(Energy::SquaredNuclear, [1e4, 1e6, 1e8]);
}

#[test]
fn the_second_fundamental_form_with_the_normals_of_the_input() {
    check(Energy::SecondFormOfInput, [3e3, 1e5, 1e6]);
}

/// What the second fundamental form with its own normals stops at is the optimum of
/// the convex energy with those normals kept.
#[test]
fn the_second_fundamental_form_is_consistent_with_itself() {
    for lambda in [1e4, 1e5] {
        let mut instance = Instance::new(&ring(14, 30), lambda).energy(Energy::SecondForm);
        instance.gap = 1e-4;
        let surface = instance.solve();
        let (heights, report) = (surface.heightfield().heights(), surface.report());
        assert_eq!(report.stop_reason, StopReason::Gap, "{report:?}");
        let factors = instance.normals(heights);
        let [fidelity, norms] = instance.terms_with(heights, &factors);
        let exact = instance.optimum_with(&factors);
        let excess = (fidelity + norms) / exact.objective - 1.0;
        assert!((-1e-8..1.1e-4).contains(&excess), "{excess:e}");
        assert!(((fidelity + norms) / report.objective - 1.0).abs() < 1e-7);
        assert!(report.dual_bound <= exact.objective * (1.0 + 1e-8));
    }
}

/// Paper, Fig. 7: the three are hard to tell apart. Of all sizes in a box of side 1.
#[test]
fn the_second_fundamental_form_changes_little() {
    let field = noisy(&unit_square(50, bumps), 0.01, 31);
    let [plain, input, own] = [
        Energy::Nuclear,
        Energy::SecondFormOfInput,
        Energy::SecondForm,
    ]
    .map(|energy| fit(&field, &Options::paper().energy(energy).gap(1e-3)).unwrap());
    for other in [&plain, &input] {
        let distance = max_difference(own.heightfield(), other.heightfield());
        assert!(distance > 1e-6 && distance < 0.01, "{distance}");
    }
}

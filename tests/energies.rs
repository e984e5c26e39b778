//! The energies against an independent conic solver, and what makes each what it is.
#![cfg(not(target_arch = "wasm32"))]

mod common;

use common::conic::Instance;
use common::{cut, max_difference, noisy, unit_square};
use developable::{Energy, Heightfield, Lambda, Options, StopReason, fit};

fn bumps(x: f64, y: f64) -> f64 {
    0.15 * (5.0 * x + 1.0).sin() * (4.0 * y).cos() + 0.4 * (x - 0.4).abs()
}

/// Noise over bumps, a hole in the middle of them.
fn ring(cols: usize, seed: u64) -> Heightfield {
    cut(&noisy(&unit_square(cols, bumps), 0.02, seed), |x, y| {
        (x - 0.45).hypot(y - 0.55) > 0.17
    })
}

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

//! Surfaces through heights that must be met exactly.
#![cfg(not(target_arch = "wasm32"))]

mod common;

use common::conic::Instance;
use common::{cut, max_difference, noisy, unit_square};
use developable::{Energy, Error, Heightfield, Input, Lattice, Options, Surface, fit};

fn bumps(x: f64, y: f64) -> f64 {
    0.15 * (5.0 * x + 1.0).sin() * (4.0 * y).cos() + 0.2 * (x - 0.4).abs()
}

#[test]
fn a_rim() {
    for energy in [Energy::Nuclear, Energy::Frobenius, Energy::SquaredNuclear] {
        let field = unit_square(12, bumps);
        let (rows, cols) = (field.lattice().rows(), field.lattice().cols());
        let rim = |r: usize, c: usize| r == 0 || c == 0 || r + 1 == rows || c + 1 == cols;
        let instance = Instance::design(&field, 1e6, rim).energy(energy);
        let start = std::time::Instant::now();
        let report = instance.check();
        eprintln!("{energy:?} {:?} {report:?}", start.elapsed());
    }
}

#[test]
fn scattered_points_and_a_hole() {
    let field = cut(&unit_square(14, bumps), |x, y| (x - 0.45).hypot(y - 0.55) > 0.2);
    for tie_break in [1e-4, 0.01, 1.0] {
        let mut instance = Instance::design(&field, 1e6, |r, c| (5 * r + 7 * c) % 23 == 0);
        instance.tie_break = tie_break;
        let start = std::time::Instant::now();
        let report = instance.check();
        eprintln!("{tie_break:?} {:?} {report:?}", start.elapsed());
    }
}

#[test]
fn constraints_among_heights_to_stay_close_to() {
    let mut instance = Instance::new(&noisy(&unit_square(13, bumps), 0.02, 3), 1e5);
    for i in (0..instance.constrained.len()).step_by(11) {
        instance.constrained[i] = true;
    }
    let report = instance.check();
    assert!(report.constrained > 15 && report.free == 0);
    for weight in instance.confidence.iter_mut().step_by(3) {
        *weight = 0.0;
    }
    assert!(instance.check().free > 20);
}

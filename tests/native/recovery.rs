//! Noise goes, the shape stays: output against ground truth.

use crate::common::{noisy, rms_difference, unit_square};
use developable::{Heightfield, Lambda, Options, fit};

/// RMS angle between the unit normals of two fields, in radians, over the
/// vertices with all neighbours.
fn normal_error(a: &Heightfield, b: &Heightfield) -> f64 {
    let lattice = a.lattice();
    let normal = |field: &Heightfield, row: usize, col: usize| {
        let ring: Option<Vec<f64>> = lattice
            .neighbours(row, col)
            .into_iter()
            .map(|n| n.map(|(r, c)| field.height(r, c)))
            .collect();
        let z: [f64; 6] = ring?.try_into().ok()?;
        let h = lattice.spacing();
        let gx = (z[3] - z[2] + 2.0 * (z[1] - z[0]) + z[5] - z[4]) / (6.0 * h);
        let gy = (z[2] + z[3] - z[4] - z[5]) / (2.0 * 3f64.sqrt() * h);
        Some(nalgebra::Vector3::new(-gx, -gy, 1.0).normalize())
    };
    let mut squares = Vec::new();
    for row in 0..lattice.rows() {
        for col in 0..lattice.cols() {
            if let (Some(m), Some(n)) = (normal(a, row, col), normal(b, row, col)) {
                squares.push(m.angle(&n).powi(2));
            }
        }
    }
    (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
}

/// Asserts that the solve brings heights and normals closer to the truth by these factors.
fn check(name: &str, truth: &Heightfield, amplitude: f64, heights: f64, normals: f64) {
    let input = noisy(truth, amplitude, 11);
    let surface = fit(&input, &Options::paper().lambda(Lambda::Small)).unwrap();
    let output = surface.heightfield();
    let height_gain = rms_difference(&input, truth) / rms_difference(output, truth);
    let normal_gain = normal_error(&input, truth) / normal_error(output, truth);
    assert!(
        height_gain > heights && normal_gain > normals,
        "{name}: heights {height_gain:.2} times closer, normals {normal_gain:.2} times"
    );
}

#[test]
fn noisy_cylinder() {
    let truth = unit_square(80, |x, y| (1.0 - (0.8 * x + 0.6 * y - 0.7).powi(2)).sqrt());
    check("cylinder", &truth, 0.01, 3.0, 15.0);
}

#[test]
fn noisy_cone() {
    let truth = unit_square(80, |x, y| 1.0 - 0.6 * (x + 0.2).hypot(y - 0.5));
    check("cone", &truth, 0.01, 3.0, 15.0);
}

#[test]
fn noisy_roof_with_creases() {
    let truth = unit_square(80, |x, y| {
        let ridge = 0.5 - 0.7 * (x - 0.5).abs();
        let barrel = (0.49 - (y - 0.5).powi(2)).sqrt() - 0.25;
        ridge.max(barrel)
    });
    check("roof", &truth, 0.01, 2.0, 5.0);
}

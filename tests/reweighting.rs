//! Reweighted passes take back what the energy does to large curvatures.
#![cfg(not(target_arch = "wasm32"))]

mod common;

use common::{noisy, unit_square};
use developable::{Domain, Heightfield, HessianOperator, Options, fit};

/// Mean of the curvature relative to the truth's, and its RMS error relative to that,
/// at vertices away from the border.
fn curvature(field: &Heightfield, truth: impl Fn(f64, f64) -> f64) -> [f64; 2] {
    let domain = Domain::new(field).unwrap();
    let operator = HessianOperator::new(&domain);
    let hessians = operator.apply(field.heights());
    let (mut sum, mut expected, mut squares, mut n) = (0.0, 0.0, 0.0, 0.0);
    for ((row, col), hessian) in operator.vertices().zip(hessians) {
        let [x, y] = field.lattice().position(row, col);
        if x.min(y).min(1.0 - x).min(1.0 - y) > 0.15 {
            let [a, b] = hessian.eigenvalues();
            let largest = if a.abs() > b.abs() { a } else { b };
            sum += largest;
            expected += truth(x, y);
            squares += (largest - truth(x, y)).powi(2);
            n += 1.0;
        }
    }
    let mean: f64 = expected / n;
    [sum / expected, (squares / n).sqrt() / mean.abs()]
}

#[test]
fn measure() {
    for radius in [0.8f64, 1.5] {
        let across = |x: f64, y: f64| 0.8 * (x - 0.5) + 0.6 * (y - 0.5);
        let bend = |x: f64, y: f64| {
            -radius.powi(2) / (radius * radius - across(x, y).powi(2)).powf(1.5)
        };
        for cols in [60, 100, 150] {
            let truth = unit_square(cols, |x, y| (radius * radius - across(x, y).powi(2)).sqrt());
            let (low, high) = truth.heights().iter().fold((9f64, -9f64), |(l, h), z| (l.min(*z), h.max(*z)));
            for noise in [0.01, 0.02] {
                let input = noisy(&truth, 3f64.sqrt() * noise * (high - low), 3);
                for lambda in [1e5, 1e6] {
                    let mut line = format!("R {radius} n {cols} noise {noise} λ {lambda:e}:");
                    for passes in [0, 1, 2, 3, 5] {
                        let options = Options::default().lambda(lambda).reweighting(passes).gap(1e-3);
                        let surface = fit(&input, &options).unwrap();
                        let [mean, rms] = curvature(surface.heightfield(), bend);
                        let h = common::rms_difference(&truth, surface.heightfield()) / (high - low);
                        line += &format!("  {passes}: {mean:.3} {rms:.3} h{:.2}‰ it{}", 1e3 * h, surface.report().iterations);
                    }
                    println!("{line}");
                }
            }
        }
    }
}

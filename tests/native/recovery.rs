//! Noise goes, the shape stays: output against ground truth.

use crate::native::common::{noisy, rms_difference, unit_square};
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

/// The input with each height replaced by the mean of those within a radius, in spacings.
fn averaged(input: &Heightfield, radius: f64) -> Heightfield {
    let lattice = input.lattice();
    let reach = radius.ceil() as usize * 2;
    let places: Vec<[f64; 2]> = (0..lattice.len())
        .map(|i| lattice.position(i / lattice.cols(), i % lattice.cols()))
        .collect();
    let mean = |i: usize| {
        let (row, col) = (i / lattice.cols(), i % lattice.cols());
        let (mut sum, mut count) = (0.0, 0.0);
        for r in row.saturating_sub(reach)..(row + reach + 1).min(lattice.rows()) {
            for c in col.saturating_sub(reach)..(col + reach + 1).min(lattice.cols()) {
                let [dx, dy] = [0, 1].map(|k| places[lattice.index(r, c)][k] - places[i][k]);
                let z = input.height(r, c);
                if dx.hypot(dy) <= radius * lattice.spacing() && z.is_finite() {
                    sum += z;
                    count += 1.0;
                }
            }
        }
        if input.heights()[i].is_nan() {
            f64::NAN
        } else {
            sum / count
        }
    };
    Heightfield::new(*lattice, (0..lattice.len()).map(mean).collect()).unwrap()
}

/// Asserts that the solve is closer to the truth, in heights and in normals, than any moving average of the input: for
/// each of the two the radius is the best there is, found with the truth, which the solve does not know.
fn check(name: &str, truth: &Heightfield, amplitude: f64) {
    let input = noisy(truth, amplitude, 11);
    let surface = fit(&input, &Options::paper().lambda(Lambda::Small)).unwrap();
    let errors = |field: &Heightfield| [rms_difference(field, truth), normal_error(field, truth)];
    let found = errors(surface.heightfield());
    let averages: Vec<_> = (1..=8)
        .map(|radius| errors(&averaged(&input, f64::from(radius))))
        .collect();
    for (k, what) in ["heights", "normals"].into_iter().enumerate() {
        let best = averages
            .iter()
            .map(|errors| errors[k])
            .fold(f64::INFINITY, f64::min);
        println!(
            "{name}: {what} are off by {:.2e}, averages by {best:.2e}",
            found[k]
        );
        assert!(
            found[k] < best,
            "{name}: {what} are off by {}, averages by {best}",
            found[k]
        );
    }
}

#[test]
fn noisy_cylinder() {
    let truth = unit_square(80, |x, y| (1.0 - (0.8 * x + 0.6 * y - 0.7).powi(2)).sqrt());
    check("cylinder", &truth, 0.01);
}

#[test]
fn noisy_cone() {
    let truth = unit_square(80, |x, y| 1.0 - 0.6 * (x + 0.2).hypot(y - 0.5));
    check("cone", &truth, 0.01);
}

#[test]
fn noisy_roof_with_creases() {
    let truth = unit_square(80, |x, y| {
        let ridge = 0.5 - 0.7 * (x - 0.5).abs();
        let barrel = (0.49 - (y - 0.5).powi(2)).sqrt() - 0.25;
        ridge.max(barrel)
    });
    check("roof", &truth, 0.01);
}

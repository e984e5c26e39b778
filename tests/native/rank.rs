//! Surfaces whose Hessians have rank one where the energy asks for it, at the default gap.

use crate::native::common::{noisy, unit_square};
use developable::analysis::Curvatures;
use developable::{
    Domain, Energy, Heightfield, HessianOperator, Normalization, Options, Role, Surface, fit,
};

fn cones(x: f64, y: f64) -> f64 {
    let cone = |a: f64, b: f64, slope: f64| 0.5 - slope * (x - a).hypot(y - b);
    cone(0.3, 0.35, 0.6).max(cone(0.75, 0.7, 0.8))
}

fn wave(x: f64, y: f64) -> f64 {
    0.08 * (8.0 * (0.9 * x + 0.4 * y)).sin()
}

fn median_kappa2(surface: &Surface) -> f64 {
    let curvatures = Curvatures::new(surface.heightfield()).unwrap();
    let mut sizes: Vec<f64> = curvatures.kappa2.iter().map(|k| k.abs()).collect();
    sizes.retain(|k| k.is_finite());
    sizes.sort_by(f64::total_cmp);
    sizes[sizes.len() / 2]
}

/// The nuclear norm's energy of a surface, by the definition.
fn objective(input: &Heightfield, surface: &Heightfield, lambda: f64) -> f64 {
    let domain = Domain::new(surface).unwrap();
    let lattice = input.lattice();
    let mut squares = 0.0;
    for row in 0..lattice.rows() {
        for col in 0..lattice.cols() {
            if matches!(domain.role(row, col), Role::Interior | Role::Boundary) {
                squares += (input.height(row, col) - surface.height(row, col)).powi(2);
            }
        }
    }
    let hessians = HessianOperator::new(&domain).apply(surface.heights());
    let norms: f64 = hessians.iter().map(|h| h.nuclear_norm()).sum();
    lambda * squares + norms
}

/// That takes the iterations several times as long. Without, it is seven times as large here.
#[test]
fn the_smaller_curvature_is_about_as_small_as_at_a_tenth_of_the_gap() {
    for shape in [cones, wave] {
        let input = noisy(&unit_square(90, shape), 0.008, 5);
        for energy in [Energy::Nuclear, Energy::Huber] {
            let options = Options::paper()
                .energy(energy)
                .lambda(1e5)
                .normalization(Normalization::Off);
            let rough = fit(&input, &options).unwrap();
            let fine = fit(&input, &options.gap(1e-3)).unwrap();
            let [a, b] = [&rough, &fine].map(median_kappa2);
            assert!(a < 2.5 * b, "{energy:?}: {a} beside {b}");
            let [a, b] = [&rough, &fine].map(|surface| surface.report().cg_iterations);
            assert!(a < b, "{energy:?}: {a} beside {b}");
        }
    }
}

#[test]
fn the_certificate_is_that_of_the_surface_that_is_given() {
    let input = noisy(&unit_square(70, wave), 0.01, 6);
    let options = Options::paper()
        .lambda(3e4)
        .normalization(Normalization::Off);
    let surface = fit(&input, &options).unwrap();
    let report = surface.report();
    let found = objective(&input, surface.heightfield(), 3e4);
    assert!(
        (report.objective / found - 1.0).abs() < 1e-9,
        "{found} {report:?}"
    );
    assert!(report.gap.unwrap() <= 0.01);
    // A bound for the rest: the optimum itself, all but exactly.
    let best = fit(&input, &options.gap(1e-6)).unwrap();
    assert!(report.dual_bound <= best.report().objective);
    assert!(report.objective <= 1.01 * best.report().objective);
}

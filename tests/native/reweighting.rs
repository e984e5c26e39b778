//! Reweighted passes take back what the energy does to creases.

use crate::native::common::{noisy, rms_difference, unit_square};
use developable::{
    Domain, Heightfield, HessianOperator, Lambda, Normalization, Options, StopReason, fit,
};

fn roof(x: f64, y: f64) -> f64 {
    let ridge = 0.5 - 0.7 * (x - 0.5).abs();
    let barrel = (0.49 - (y - 0.5).powi(2)).sqrt() - 0.25;
    ridge.max(barrel)
}

#[test]
fn creases_come_closer_to_the_truth() {
    let truth = unit_square(60, roof);
    for (amplitude, factor) in [(0.004, 1.8), (0.008, 1.2)] {
        let input = noisy(&truth, amplitude, 3);
        let error = |passes: usize| {
            let options = Options::paper().lambda(Lambda::Small).reweighting(passes);
            let surface = fit(&input, &options).unwrap();
            let report = surface.report();
            assert_eq!(
                (report.reweighting, report.stop_reason),
                (passes, StopReason::Gap)
            );
            assert!(report.is_certified(0.01));
            rms_difference(&truth, surface.heightfield())
        };
        let errors = [0, 1, 2].map(error);
        assert!(
            errors[0] > factor * errors[1] && errors[0] > factor * errors[2],
            "{errors:?}"
        );
    }
}

#[test]
fn the_curvature_of_a_cylinder_comes_closer_to_the_truth() {
    let truth = unit_square(80, |x, _| (0.64 - (x - 0.5).powi(2)).sqrt());
    let input = noisy(&truth, 0.004, 5);
    // Mean of the curvature across, away from the border, relative to the truth's.
    let bend = |field: &Heightfield| {
        let hessians = HessianOperator::new(&Domain::new(field).unwrap()).apply(field.heights());
        let inside = |i: &usize| {
            let [x, y] = field
                .lattice()
                .position(i / field.lattice().cols(), i % field.lattice().cols());
            (0.1..0.9).contains(&x) && (0.1..0.9).contains(&y)
        };
        let across = (0..hessians.len())
            .filter(inside)
            .map(|i| hessians[i].entries()[0]);
        across.sum::<f64>()
    };
    let missing = |passes: usize| {
        let options = Options::paper().lambda(1e4).reweighting(passes);
        let options = options.normalization(Normalization::Off);
        1.0 - bend(fit(&input, &options).unwrap().heightfield()) / bend(&truth)
    };
    let errors = [0, 1, 2].map(missing);
    // Measured: 0.33, 0.27, 0.25.
    assert!(errors[0] > 0.2, "{errors:?}");
    assert!(
        errors[1] < 0.88 * errors[0] && errors[2] < 0.88 * errors[0],
        "{errors:?}"
    );
    assert!(errors[1] > 0.0 && errors[2] > 0.0, "{errors:?}");
}

#[test]
fn planes_have_nothing_to_reweight() {
    let plane = unit_square(30, |x, y| 2.0 * x - y);
    let surface = fit(&plane, &Options::paper().reweighting(3)).unwrap();
    assert_eq!(surface.report().stop_reason, StopReason::Rounding);
    assert_eq!(surface.report().reweighting, 0);
}

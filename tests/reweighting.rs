//! Reweighted passes take back what the energy does to creases.
#![cfg(not(target_arch = "wasm32"))]

mod common;

use common::{noisy, rms_difference, unit_square};
use developable::{Lambda, Options, StopReason, fit};

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
            let options = Options::default().lambda(Lambda::Small).reweighting(passes);
            let surface = fit(&input, &options).unwrap();
            let report = surface.report();
            assert_eq!(
                (report.reweighting, report.stop_reason),
                (passes, StopReason::Gap)
            );
            assert!(report.gap <= 0.01);
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
fn planes_have_nothing_to_reweight() {
    let plane = unit_square(30, |x, y| 2.0 * x - y);
    let surface = fit(&plane, &Options::default().reweighting(3)).unwrap();
    assert_eq!(surface.report().stop_reason, StopReason::Rounding);
    assert_eq!(surface.report().reweighting, 0);
}

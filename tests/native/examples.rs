//! The examples as users get them: options, noise, names.

use developable::{Example, ExampleOptions, Sample};

fn generate(example: Example, size: usize, noise: f64, seed: u32) -> Sample {
    example
        .generate(&ExampleOptions { size, noise, seed })
        .unwrap()
}

/// Noise at the pixels that have data.
fn noise(sample: &Sample) -> Vec<f64> {
    let pairs = sample.input.values().iter().zip(sample.truth.values());
    pairs
        .filter(|(a, _)| a.is_finite())
        .map(|(a, b)| a - b)
        .collect()
}

fn range(values: &[f64]) -> f64 {
    let valid = || values.iter().copied().filter(|v| v.is_finite());
    valid().fold(f64::MIN, f64::max) - valid().fold(f64::MAX, f64::min)
}

#[test]
fn the_longer_side_has_the_stated_size_and_length_1() {
    for example in Example::ALL {
        for size in [8, 51, 200] {
            let Sample { input, truth, .. } = generate(example, size, 0.02, 1);
            assert_eq!(truth.width().max(truth.height()), size, "{example:?}");
            assert_eq!(truth.pixel_size(), 1.0 / size as f64);
            assert_eq!(input.pixel_size(), truth.pixel_size());
            assert_eq!(
                (input.width(), input.height()),
                (truth.width(), truth.height())
            );
            for (a, b) in input.values().iter().zip(truth.values()) {
                assert_eq!(a.is_nan(), b.is_nan());
            }
            let relief = range(truth.values());
            assert!((0.1..0.6).contains(&relief), "{example:?}: {relief}");
        }
    }
    let page = generate(Example::Page, 297, 0.0, 1).truth;
    assert_eq!((page.width(), page.height()), (210, 297));
}

#[test]
fn noise_has_the_stated_deviation_and_depends_on_the_seed_only() {
    for example in Example::ALL {
        assert!(
            noise(&generate(example, 60, 0.0, 3))
                .iter()
                .all(|v| *v == 0.0)
        );
        let sample = generate(example, 200, 0.05, 3);
        assert!(
            generate(example, 200, 0.05, 3)
                .input
                .values()
                .iter()
                .zip(sample.input.values())
                .all(|(a, b)| a.to_bits() == b.to_bits())
        );
        assert_ne!(noise(&generate(example, 200, 0.05, 4)), noise(&sample));
        let noise = noise(&sample);
        let n = noise.len() as f64;
        let mean = noise.iter().sum::<f64>() / n;
        let moment = |k| noise.iter().map(|v| (v - mean).powi(k)).sum::<f64>() / n;
        let deviation = 0.05 * range(sample.truth.values());
        assert!(
            mean.abs() < 4.0 * deviation / n.sqrt(),
            "{example:?}: mean {mean}"
        );
        assert!(
            (moment(2).sqrt() / deviation - 1.0).abs() < 0.03,
            "{example:?}"
        );
        assert!(
            (moment(4) / moment(2).powi(2) - 3.0).abs() < 0.3,
            "{example:?}: not Gaussian"
        );
    }
}

#[test]
fn outlines_leave_room_in_the_image() {
    for example in [Example::Cone, Example::Oloid, Example::Page] {
        let truth = generate(example, 200, 0.0, 1).truth;
        let (width, height) = (truth.width(), truth.height());
        let border = (0..width * height).filter(|i| {
            let (row, col) = (i / width, i % width);
            row == 0 || row == height - 1 || col == 0 || col == width - 1
        });
        assert!(
            border.map(|i| truth.values()[i]).all(f64::is_nan),
            "{example:?}"
        );
        let valid = truth.values().iter().filter(|z| z.is_finite()).count();
        assert!(
            2 * valid > width * height,
            "{example:?} fills more than half of the image"
        );
    }
    for example in [Example::Cylinder, Example::Roof, Example::House] {
        assert!(
            generate(example, 200, 0.0, 1)
                .truth
                .values()
                .iter()
                .all(|z| z.is_finite())
        );
    }
}

#[test]
fn names_go_both_ways_and_bad_options_are_refused() {
    for example in Example::ALL {
        assert_eq!(example.name().parse(), Ok(example));
    }
    let error = "Cone".parse::<Example>().unwrap_err();
    assert_eq!(error.code(), "OPTION");
    assert!(error.to_string().contains("`cone`"));
    let code = |size, noise| {
        Example::Cone
            .generate(&ExampleOptions {
                size,
                noise,
                seed: 0,
            })
            .unwrap_err()
            .code()
    };
    assert_eq!(code(7, 0.0), "OPTION");
    assert_eq!(code(4097, 0.0), "OPTION");
    for noise in [-0.1, f64::NAN, f64::INFINITY, 1e308 * 10.0] {
        assert_eq!(code(20, noise), "OPTION");
    }
    assert_eq!(code(20, f64::MAX), "NOT_FINITE");
}

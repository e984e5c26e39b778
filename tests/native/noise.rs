//! λ from the data.

use crate::native::common::{Random, cut, noisy, rms_difference, unit_square};
use developable::{
    Bridging, Energy, HeightImage, Heightfield, Input, Lambda, LambdaReason, Lattice, Options,
    Report, Solver, Status, Tolerance, fit,
};

/// Two faces and a smooth bend.
fn scene(x: f64, y: f64) -> f64 {
    (0.3 * x).max(0.4 * (1.0 - x)) + 0.1 * (4.0 * y).sin()
}

fn auto() -> Options {
    Options::paper().lambda(Lambda::Auto)
}

fn with_noise(truth: &Heightfield, sigma: f64, seed: u64) -> Heightfield {
    let mut noise = Random::new(seed);
    let heights = truth
        .heights()
        .iter()
        .map(|z| z + sigma * noise.sum_of_twelve());
    Heightfield::new(*truth.lattice(), heights.collect()).unwrap()
}

fn solve(input: impl Into<Input>, options: &Options) -> (Heightfield, Report) {
    let surface = fit(input, options).unwrap();
    let report = surface.report().clone();
    (surface.into_heightfield(), report)
}

#[test]
fn it_is_about_as_close_as_the_best_and_follows_the_noise() {
    let truth = unit_square(70, scene);
    for energy in [Energy::Nuclear, Energy::Huber] {
        for sigma in [0.002, 0.02] {
            let input = with_noise(&truth, sigma, 5);
            let (surface, report) = solve(&input, &auto().energy(energy));
            let choice = report.lambda_choice.unwrap();
            let reason = match energy {
                Energy::Huber => LambdaReason::Prediction,
                _ => LambdaReason::Noise,
            };
            assert_eq!(choice.reason, reason, "{choice:?}");
            let ratio = choice.residual_ratio.unwrap();
            assert!(
                (ratio - 1.0).abs() < 0.1 && choice.raises == 0,
                "{choice:?}"
            );
            assert!(
                (choice.sigma.unwrap() / sigma - 1.0).abs() < 0.08,
                "{choice:?}"
            );
            assert!(report.is_certified(0.01));
            let best = (6..14).map(|k| {
                let options = auto().energy(energy).lambda(10f64.powf(0.5 * f64::from(k)));
                rms_difference(&truth, &solve(&input, &options).0)
            });
            let best = best.fold(f64::INFINITY, f64::min);
            let own = rms_difference(&truth, &surface);
            assert!(own < 1.5 * best, "{energy:?} {sigma}: {own} {best}");
        }
    }
}

/// The same heights in other units, and in steps of other lengths, give the same.
#[test]
fn it_depends_on_neither_units_nor_steps() {
    let truth = unit_square(50, scene);
    let input = with_noise(&truth, 0.005, 6);
    let options = auto().energy(Energy::Huber);
    let (_, report) = solve(&input, &options);
    let lattice = Lattice::new(truth.lattice().rows(), truth.lattice().cols(), 20.0).unwrap();
    let large = input.heights().iter().map(|z| 1000.0 * z).collect();
    let (_, scaled) = solve(Heightfield::new(lattice, large).unwrap(), &options);
    assert!((scaled.lambda / report.lambda - 1.0).abs() < 1e-6);
    let [a, b] = [&report, &scaled].map(|r| r.lambda_choice.unwrap().sigma.unwrap());
    assert!((b / a - 1000.0).abs() < 1e-6, "{a} {b}");
    let mut solver = Solver::new(&input, &options).unwrap();
    let mut iterations = 0;
    while solver.advance(3).unwrap() == Status::Running {
        assert!(solver.progress().iteration >= iterations);
        iterations = solver.progress().iteration;
    }
    let stepped = solver.surface().unwrap();
    assert_eq!(stepped.report().lambda, report.lambda);
    assert_eq!(stepped.report().objective, report.objective);
    assert_eq!(stepped.report().huber, report.huber);
}

#[test]
fn a_search_that_is_cancelled_leaves_the_input() {
    let input = with_noise(&unit_square(50, scene), 0.005, 6);
    let mut solver = Solver::new(&input, &auto().energy(Energy::Huber)).unwrap();
    solver.advance(1).unwrap();
    let progress = solver.progress();
    assert!(
        progress.level > 0 && progress.gap.is_none_or(|gap| gap == 1.0),
        "{progress:?}"
    );
    assert!(progress.objective > 0.0);
    solver.cancel();
    let surface = solver.surface().unwrap();
    let both = surface.heightfield().heights().iter().zip(input.heights());
    let changed = both.filter(|(a, b)| a != b).count();
    assert_eq!(changed, surface.report().omitted);
    // And can be begun anew.
    solver.restart(&auto().energy(Energy::Huber)).unwrap();
    while solver.advance(50).unwrap() == Status::Running {}
    assert!(solver.surface().unwrap().report().is_certified(0.01));
}

#[test]
fn holes_dead_pixels_parts_and_confidence() {
    let sigma = 0.005;
    let full = unit_square(90, scene);
    let whole = with_noise(&full, sigma, 7);
    let random = std::cell::RefCell::new(Random::new(3));
    // Two parts, a hole in one of them, and every tenth height missing.
    let torn = cut(&whole, |x, y| {
        (x - 0.55).abs() > 0.06
            && (x - 0.3).hypot(y - 0.5) > 0.1
            && random.borrow_mut().sample() < 0.8
    });
    let (surface, report) = solve(&torn, &auto().energy(Energy::Huber));
    let choice = report.lambda_choice.unwrap();
    assert!(report.components >= 2 && report.bridged > 100, "{report:?}");
    assert_eq!(choice.reason, LambdaReason::Prediction);
    assert!(
        (choice.sigma.unwrap() / sigma - 1.0).abs() < 0.15,
        "{choice:?}"
    );
    assert!(rms_difference(&full, &surface) < 0.5 * sigma);
    // A confidence is a factor of λ: half of it is made up for.
    let (_, plain) = solve(&whole, &auto());
    let half = Input::new(whole.clone()).with_confidence(vec![0.5; whole.heights().len()]);
    let (_, weighted) = solve(half.unwrap(), &auto());
    let ratio = weighted.lambda / plain.lambda;
    assert!((ratio - 2.0).abs() < 1e-6, "{ratio}");
}

/// Where there is nothing to choose by, it is said so.
#[test]
fn inputs_without_noise_end_sensibly() {
    let reason = |field: Heightfield| {
        let (surface, report) = solve(&field, &auto().energy(Energy::Huber));
        assert!(surface.heights().iter().all(|z| z.is_finite()));
        (report.lambda_choice.unwrap().reason, report.lambda)
    };
    let flat = unit_square(40, |_, _| 3.0);
    assert_eq!(reason(flat), (LambdaReason::NoNoise, 1e7));
    let plane = unit_square(40, |x, y| 0.3 * x - y);
    assert_eq!(reason(plane), (LambdaReason::NoNoise, 1e7));
    let tent = unit_square(40, |x, y| x.min(y));
    assert_eq!(reason(tent), (LambdaReason::NoNoise, 1e7));
    let few = noisy(&unit_square(5, |x, y| x * y), 0.01, 1);
    assert_eq!(reason(few), (LambdaReason::Unknown, 1e6));
    // Too few to hold some out.
    let some = noisy(&unit_square(11, |x, y| x * y), 0.01, 1);
    assert_eq!(reason(some).0, LambdaReason::Noise);
    // Nothing but constraints.
    let lattice = Lattice::new(30, 30, 1.0).unwrap();
    let points = |i: usize| {
        if i.is_multiple_of(37) {
            (i % 7) as f64
        } else {
            f64::NAN
        }
    };
    let points = Heightfield::new(lattice, (0..900).map(points).collect()).unwrap();
    let design = Input::design(points, None).unwrap();
    let (_, report) = solve(design, &auto());
    assert_eq!(report.lambda_choice.unwrap().reason, LambdaReason::Unknown);
}

#[test]
fn quantised_heights_are_told_by_their_step() {
    let truth = unit_square(80, scene);
    let step = 0.004;
    let heights = truth.heights().iter().map(|z| (z / step).round() * step);
    let input = Heightfield::new(*truth.lattice(), heights.collect()).unwrap();
    let (surface, report) = solve(&input, &auto().energy(Energy::Huber));
    let choice = report.lambda_choice.unwrap();
    assert!(
        (choice.step.unwrap() / step - 1.0).abs() < 1e-6,
        "{choice:?}"
    );
    assert!((choice.sigma.unwrap() / (step / 12f64.sqrt()) - 1.0).abs() < 1e-6);
    let error = |field: &Heightfield| rms_difference(&truth, field);
    assert!(
        error(&surface) < 0.6 * error(&input),
        "{} {}",
        error(&surface),
        error(&input)
    );
}

/// Ripples so tight that the λ of the noise flattens them: with a larger λ the result is as near as the input.
#[test]
fn lambda_is_raised_where_the_noise_does_not_explain_the_residual() {
    let truth = unit_square(80, |x, y| 0.02 * (40.0 * (0.9 * x + 0.4 * y)).sin());
    let input = with_noise(&truth, 1.2e-4, 8);
    let (surface, report) = solve(&input, &Options::default());
    let choice = report.lambda_choice.unwrap();
    assert!(choice.raises > 0, "{choice:?}");
    assert!(choice.residual_ratio.unwrap() < 2.0, "{choice:?}");
    let [own, raw] = [&surface, &input].map(|field| rms_difference(&truth, field));
    assert!(own < 1.05 * raw, "{own} {raw} {choice:?}");
}

/// Noise as depth cameras smooth it: white noise after means over the six neighbours, four times.
fn with_smooth_noise(truth: &Heightfield, sigma: f64, seed: u64) -> Heightfield {
    let lattice = *truth.lattice();
    let mut noise = Random::new(seed);
    let mut values: Vec<f64> = (0..lattice.len()).map(|_| noise.sum_of_twelve()).collect();
    for _ in 0..4 {
        let old = values.clone();
        for (i, value) in values.iter_mut().enumerate() {
            let ring = lattice.neighbours(i / lattice.cols(), i % lattice.cols());
            let around = ring.into_iter().flatten();
            let around = around.map(|(row, col)| old[lattice.index(row, col)]);
            let (sum, count) = around.fold((old[i], 1.0), |(sum, n), z| (sum + z, n + 1.0));
            *value = sum / count;
        }
    }
    let size = (values.iter().map(|z| z * z).sum::<f64>() / values.len() as f64).sqrt();
    let heights = truth.heights().iter().zip(values);
    let heights = heights.map(|(z, n)| z + sigma * n / size);
    Heightfield::new(lattice, heights.collect()).unwrap()
}

/// Folds that are as narrow as ten vertices look like noise from afar. They stay, and what is farther off than the input
/// is said to be.
#[test]
fn narrow_folds_stay_in_smooth_noise() {
    let folds = |x: f64, y: f64| {
        let u = 0.88 * (x - 0.5) + 0.48 * (y - 0.5);
        0.155 * ((u / 0.31).rem_euclid(1.0) - 0.5).abs()
    };
    let truth = unit_square(80, folds);
    for (share, seed) in [(0.01, 5), (0.02, 6)] {
        let input = with_smooth_noise(&truth, share * 0.0775, seed);
        let (surface, report) = solve(&input, &Options::default());
        let choice = report.lambda_choice.unwrap();
        let [own, raw] = [&surface, &input].map(|field| rms_difference(&truth, field));
        assert!(own < 0.95 * raw, "{own} {raw} {choice:?}");
        assert!(!choice.residual_exceeds_noise, "{choice:?}");
    }
}

/// Steps are no surface like paper. λ is raised until the treads between them are clean; only the edges of the steps are rounded.
#[test]
fn stairs_are_not_flattened_into_a_ramp() {
    let (height, depth) = (0.06, 0.15);
    let tread = |x: f64, y: f64| (x + 0.3 * y) / depth;
    let truth = unit_square(80, |x, y| height * tread(x, y).floor());
    let input = with_smooth_noise(&truth, 0.005 * 0.48, 7);
    let (surface, report) = solve(&input, &Options::default());
    let whole = rms_difference(&truth, &surface);
    assert!(whole < 0.2 * height, "{whole} {:?}", report.lambda_choice);
    // Two vertices and more from the edges of the steps.
    let treads = unit_square(80, |x, y| match tread(x, y).rem_euclid(1.0) {
        0.2..0.8 => height * tread(x, y).floor(),
        _ => f64::NAN,
    });
    let [own, raw] = [&surface, &input].map(|field| rms_difference(&treads, field));
    assert!(own < 0.8 * raw, "{own} {raw} {:?}", report.lambda_choice);
}

/// An image of two heights is a block on a table, not the rounding of a smooth surface.
#[test]
fn two_levels_are_a_shape() {
    let block = |x: f64, y: f64| match (x - 0.5).abs() < 0.25 && (y - 0.45).abs() < 0.2 {
        true => 0.2,
        false => 0.0,
    };
    let truth = unit_square(60, block);
    let (surface, report) = solve(&truth, &Options::default());
    let off = rms_difference(&truth, &surface);
    assert!(off < 0.002, "{off} {:?}", report.lambda_choice);
}

/// Noise of a scanner that moves: smooth along rows, independent from row to row. Its σ is found too small, which is no
/// reason to raise λ.
#[test]
fn the_noise_of_scan_lines_is_not_returned_as_the_surface() {
    let cone = |x: f64, y: f64| 0.5 - 0.6 * (x - 0.4).hypot(y + 0.2);
    let roof = |x: f64, y: f64| 0.4 * (x + 0.3 * y - 0.6).abs();
    for (scene, seed) in [(cone as fn(f64, f64) -> f64, 12), (roof, 13)] {
        let truth = unit_square(80, scene);
        let lattice = *truth.lattice();
        let mut noise = Random::new(seed);
        let mut run = 0.0;
        // An autoregressive process along each row: neighbours' correlation is 0.9.
        let values = truth.heights().iter().enumerate().map(|(vertex, z)| {
            let fresh = noise.sum_of_twelve();
            run = match vertex % lattice.cols() {
                0 => fresh,
                _ => 0.9 * run + 0.19f64.sqrt() * fresh,
            };
            z + 0.004 * run
        });
        let input = Heightfield::new(lattice, values.collect()).unwrap();
        let (surface, report) = solve(&input, &Options::default());
        let [own, raw] = [&surface, &input].map(|field| rms_difference(&truth, field));
        assert!(own < 0.6 * raw, "{own} {raw} {:?}", report.lambda_choice);
    }
}

/// Noise with long tails, and noise that grows fourfold with the distance from the camera, are smoothed as other noise is.
#[test]
fn long_tails_and_growing_noise_do_not_raise_lambda() {
    let truth = unit_square(80, scene);
    let mut noise = Random::new(14);
    // The difference of two exponentially distributed numbers has Laplace's distribution.
    let mut laplace = || {
        let [a, b] = [(); 2].map(|()| (noise.sample() + 1.0).max(1e-9) / 2.0);
        0.002 * (a / b).ln()
    };
    let tails = truth.heights().iter().map(|z| z + laplace());
    let tails = Heightfield::new(*truth.lattice(), tails.collect()).unwrap();
    let mut noise = Random::new(15);
    let growing = truth.heights().iter().map(|z| {
        let farness = 1.0 + 3.0 * (0.5 - z).clamp(0.0, 0.5) / 0.5;
        z + 0.002 * farness * noise.sum_of_twelve()
    });
    let growing = Heightfield::new(*truth.lattice(), growing.collect()).unwrap();
    for input in [tails, growing] {
        let (surface, report) = solve(&input, &Options::default());
        let choice = report.lambda_choice.unwrap();
        assert_eq!(choice.raises, 0, "{choice:?}");
        let [own, raw] = [&surface, &input].map(|field| rms_difference(&truth, field));
        assert!(own < 0.35 * raw, "{own} {raw} {choice:?}");
    }
}

/// A sphere bends both ways everywhere, as noise does, but alike from place to place.
#[test]
fn a_sphere_with_little_noise_is_no_noise() {
    let sphere = |x: f64, y: f64| (0.6 - (x - 0.5).powi(2) - (y - 0.5).powi(2)).sqrt();
    let truth = unit_square(80, sphere);
    let sigma = 1e-4;
    let input = with_noise(&truth, sigma, 9);
    let (surface, report) = solve(&input, &Options::default());
    let choice = report.lambda_choice.unwrap();
    assert_eq!(choice.correlation_length, 0.0, "{choice:?}");
    assert!(
        (choice.sigma.unwrap() / sigma - 1.0).abs() < 0.3,
        "{choice:?}"
    );
    assert!(rms_difference(&truth, &surface) < 2.0 * sigma);
}

/// Pixels' noise is smaller between neighbours after resampling to the lattice, which is no reason to follow it.
#[test]
fn the_noise_of_pixels_is_not_returned_as_the_surface() {
    let side = 90;
    let sigma = 5e-3;
    let mut noise = Random::new(11);
    let at = |i: usize| {
        let [x, y] = [i % side, i / side].map(|k| k as f64 / side as f64);
        scene(x, y)
    };
    let on_lattice = |values: Vec<f64>| {
        let image = HeightImage::new(side, side, values).unwrap();
        image
            .with_pixel_size(1.0 / side as f64)
            .unwrap()
            .to_lattice(None)
            .unwrap()
    };
    let truth = on_lattice((0..side * side).map(at).collect());
    let noisy = (0..side * side).map(|i| at(i) + sigma * noise.sum_of_twelve());
    let input = on_lattice(noisy.collect());
    let (surface, _) = solve(&input, &Options::default());
    let [own, raw] = [&surface, &input].map(|field| rms_difference(&truth, field));
    assert!(own < 0.5 * raw, "{own} {raw}");
}

/// Single impulses are no reason to raise λ: with them it is raised no more often than without.
#[test]
fn impulses_do_not_raise_lambda() {
    let truth = unit_square(80, scene);
    let plain = with_noise(&truth, 2e-3, 10);
    let mut heights = plain.heights().to_vec();
    heights.iter_mut().step_by(97).for_each(|z| *z += 0.1);
    let input = Heightfield::new(*truth.lattice(), heights).unwrap();
    let choice = |input: &Heightfield| {
        let (_, report) = solve(input, &Options::default());
        report.lambda_choice.unwrap()
    };
    let [with, without] = [choice(&input), choice(&plain)];
    assert!(with.raises <= without.raises, "{with:?} {without:?}");
}

/// A fractal terrain is alike at every scale, as smooth noise is up to one. It keeps within the tolerance, which is reported.
#[test]
fn terrain_without_noise_is_not_flattened() {
    let mut random = Random::new(21);
    let waves: Vec<[f64; 4]> = (0..150)
        .map(|_| {
            let frequency = 40f64.powf(0.5 * (random.sample() + 1.0));
            let turn = std::f64::consts::PI * random.sample();
            let phase = std::f64::consts::PI * random.sample();
            [
                frequency * turn.cos(),
                frequency * turn.sin(),
                phase,
                0.04 / frequency,
            ]
        })
        .collect();
    let height = |x: f64, y: f64| -> f64 {
        let wave =
            |[a, b, p, size]: &[f64; 4]| size * (std::f64::consts::TAU * (a * x + b * y) + p).sin();
        waves.iter().map(wave).sum()
    };
    let truth = unit_square(64, height);
    let (surface, report) = solve(&truth, &Options::default());
    let heights = truth.heights().iter();
    let [low, high] = heights.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], z| {
        [low.min(*z), high.max(*z)]
    });
    let choice = report.lambda_choice.unwrap();
    let tolerance = choice.tolerance.unwrap();
    assert!(
        (tolerance / (high - low) - 0.002).abs() < 1e-9,
        "{choice:?}"
    );
    assert!(
        rms_difference(&truth, &surface) <= 1.02 * tolerance,
        "{choice:?}"
    );
    assert!(choice.ambiguous, "{choice:?}");
    // What a camera has measured has noise.
    let measured = Input::new(truth).measured_by_camera();
    let (_, report) = solve(measured, &Options::default());
    let choice = report.lambda_choice.unwrap();
    assert!(!choice.ambiguous, "{choice:?}");
    assert_eq!(choice.tolerance, None, "{choice:?}");
}

/// The smallest λ within the distance is found: the surface is neither farther off nor much nearer.
#[test]
fn a_tolerance_is_used_up_and_kept() {
    let truth = unit_square(64, |x, y| 0.1 * (7.0 * x).sin() * (5.0 * y).cos());
    for (tolerance, distance) in [
        (Tolerance::Share(0.02), 0.004),
        (Tolerance::Distance(0.001), 0.001),
    ] {
        let (surface, report) = solve(&truth, &Options::default().tolerance(tolerance));
        let choice = report.lambda_choice.unwrap();
        assert_eq!(choice.reason, LambdaReason::Tolerance);
        let off = rms_difference(&truth, &surface);
        assert!(
            (0.5..=1.02).contains(&(off / distance)),
            "{off} {distance} {choice:?}"
        );
    }
    let both = Options::default().tolerance(0.1).lambda(1e5);
    assert_eq!(both.validate().unwrap_err().code(), "OPTION");
    assert_eq!("0.5%".parse(), Ok(Tolerance::Share(0.005)));
    assert!("-1".parse::<Tolerance>().is_err() && "none".parse::<Tolerance>().is_err());
}

/// Impulses inside of an image are holes: the surface is about as near as without them.
#[test]
fn impulses_are_no_data() {
    const SIZE: usize = 64;
    let image = |share: f64| {
        let mut noise = Random::new(23);
        let pixel = |i: usize| {
            let [x, y] = [i % SIZE, i / SIZE].map(|k| k as f64 / SIZE as f64);
            let height = scene(x, y) + 0.002 * noise.sum_of_twelve();
            let [kind, value] = [noise.sample(), noise.sample()];
            let is_inside = [x, y].iter().all(|place| (0.04..0.95).contains(place));
            match is_inside && kind < 2.0 * share - 1.0 {
                true => height + 0.3 * value.signum(),
                false => height,
            }
        };
        HeightImage::new(SIZE, SIZE, (0..SIZE * SIZE).map(pixel).collect())
            .unwrap()
            .with_pixel_size(1.0 / SIZE as f64)
            .unwrap()
    };
    let surface = |share: f64| {
        let repaired = image(share).repaired().unwrap();
        let bridged = repaired.bridged(Bridging::default()).unwrap();
        let input = Input::from_bridged(&bridged, None).unwrap();
        solve(input, &Options::default()).0
    };
    let lattice = *surface(0.0).lattice();
    let truth = Heightfield::from_fn(lattice, |x, y| {
        // Pixel (0, 0) is at the top left, half a pixel inside.
        let half = 0.5 / SIZE as f64;
        scene(x - half, 1.0 - half - y)
    });
    let truth = truth.unwrap();
    let [clean, spoilt] = [0.0, 0.03].map(|share| rms_difference(&truth, &surface(share)));
    assert!(spoilt < 1.3 * clean, "{clean} {spoilt}");
}

/// Pixels by themselves show of the offsets of rows or columns only what changes from line to line; surfaces leave the rest of them
/// behind. Without [`HeightImage::repaired`] it is not known that lines are offset.
#[test]
fn surfaces_tell_offsets_of_lines_from_the_shape() {
    const SIZE: usize = 64;
    let shape = |x: f64, y: f64| scene(0.7 * x + 0.4 * y, y);
    let mut errors = [[0.0; 2]; 2];
    for (is_rows, seed) in (1..4).flat_map(|seed| [(true, seed), (false, seed)]) {
        let mut noise = Random::new(seed);
        let offsets: Vec<f64> = (0..SIZE).map(|_| 0.02 * noise.sum_of_twelve()).collect();
        let pixel = |i: usize| {
            let [col, row] = [i % SIZE, i / SIZE];
            let [x, y] = [col, SIZE - 1 - row].map(|k| (k as f64 + 0.5) / SIZE as f64);
            shape(x, y) + 0.003 * noise.sum_of_twelve() + offsets[if is_rows { row } else { col }]
        };
        let image = |values| {
            let image = HeightImage::new(SIZE, SIZE, values).unwrap();
            image.with_pixel_size(1.0 / SIZE as f64).unwrap()
        };
        let repaired = image((0..SIZE * SIZE).map(pixel).collect());
        let repaired = repaired.repaired().unwrap();
        let [plain, input] = [&image(repaired.values().to_vec()), &repaired].map(|image| {
            Input::from_bridged(&image.bridged(Bridging::default()).unwrap(), None).unwrap()
        });
        let truth = Heightfield::from_fn(*input.field().lattice(), shape).unwrap();
        // With a λ that is given the heights stay as they are.
        let given = [&plain, &input].map(|input| solve(input.clone(), &auto().lambda(1e5)).0);
        assert_eq!(rms_difference(&given[0], &given[1]), 0.0, "{is_rows}");
        let [(plain, told), (levelled, report)] =
            [plain, input].map(|input| solve(input, &Options::default()));
        let told = told.lambda_choice.unwrap();
        assert!(!told.offset_rows && !told.offset_columns);
        let told = report.lambda_choice.unwrap();
        assert_eq!([told.offset_rows, told.offset_columns], [is_rows, !is_rows]);
        // Heights and slopes of the whole are not known from offset lines.
        let step_error = |surface: Heightfield| {
            let lattice = *truth.lattice();
            let [down, right] = if is_rows { [2, 0] } else { [0, 1] };
            let error = |row, col| surface.height(row, col) - truth.height(row, col);
            let rows = 0..lattice.rows() - down;
            let steps = rows.flat_map(|row| (0..lattice.cols() - right).map(move |col| [row, col]));
            let step = |[row, col]: [usize; 2]| error(row + down, col + right) - error(row, col);
            let squares: Vec<f64> = (steps.map(|at| step(at).powi(2)))
                .filter(|square| square.is_finite())
                .collect();
            (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
        };
        let sums = errors[usize::from(is_rows)].iter_mut();
        (sums.zip([plain, levelled])).for_each(|(sum, surface)| *sum += step_error(surface));
    }
    for [plain, levelled] in errors {
        assert!(levelled < 0.75 * plain, "{plain} {levelled}");
    }
}

/// The image of [`scene`], of `size` pixels, with normal noise of standard deviation 1 after a Gaussian blur of `blur` pixels,
/// times `sigma`.
fn noisy_image([width, height]: [usize; 2], sigma: f64, blur: f64, seed: u64) -> HeightImage {
    const MARGIN: usize = 12;
    let mut noise = Random::new(seed);
    let [wide, high] = [width, height].map(|side| side + 2 * MARGIN);
    let white: Vec<f64> = (0..wide * high).map(|_| noise.sum_of_twelve()).collect();
    let weight = |k: usize| {
        let d = k as f64 - MARGIN as f64;
        match blur > 0.0 {
            true => (-0.5 * d * d / (blur * blur)).exp(),
            false => f64::from(d == 0.0),
        }
    };
    let weights: Vec<f64> = (0..=2 * MARGIN).map(weight).collect();
    let norm: f64 = weights.iter().map(|w| w * w).sum();
    let along = |values: &[f64], start: usize, step: usize| -> f64 {
        let terms = weights.iter().enumerate();
        terms.map(|(k, w)| w * values[start + k * step]).sum()
    };
    let rows: Vec<f64> = (0..high * width)
        .map(|i| along(&white, i / width * wide + i % width, 1))
        .collect();
    let pixel = |i: usize| {
        let [x, y] = [i % width, i / width].map(|k| k as f64 / width as f64);
        scene(x, y) + sigma / norm * along(&rows, i, width)
    };
    HeightImage::new(width, height, (0..width * height).map(pixel).collect())
        .unwrap()
        .with_pixel_size(1.0 / width as f64)
        .unwrap()
}

/// What is reported of an image's noise is that of its pixels, although vertices between them have a mean of several.
#[test]
fn the_noise_of_an_image_is_that_of_its_pixels() {
    let check = |size: [usize; 2], sigma: f64, blur: f64, spacing: f64, tolerance: f64| {
        let image = noisy_image(size, sigma, blur, 3 + size[0] as u64);
        let bridged = image.bridged(Bridging::default()).unwrap();
        let input = Input::from_bridged(&bridged, Some(spacing * image.pixel_size())).unwrap();
        let start = Solver::new(input, &Options::default()).unwrap();
        let choice = start.surface().unwrap().report().lambda_choice.unwrap();
        let [found, length] = [
            choice.sigma.unwrap() / sigma,
            choice.correlation_length / image.pixel_size(),
        ];
        let told = format!("{size:?} {sigma} {blur} {spacing}: {found} {length}");
        assert!((found - 1.0).abs() < tolerance, "{told}");
        assert!((length - blur).abs() < 0.3, "{told}");
    };
    for size in [[64, 64], [150, 100], [300, 200]] {
        for sigma in [5e-4, 5e-3, 3e-2] {
            check(size, sigma, 0.0, 1.0, 0.08);
        }
    }
    for sigma in [5e-3, 3e-2] {
        for spacing in [0.5, 2.0] {
            check([150, 100], sigma, 0.0, spacing, 0.08);
        }
        check([150, 100], sigma, 1.0, 0.5, 0.15);
        for blur in [1.0, 2.0] {
            check([300, 200], sigma, blur, 1.0, 0.12);
        }
    }
}

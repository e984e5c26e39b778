//! What a report says is true, on whatever input: every certificate is checked against energies that
//! are computed here, by plain loops, and against surfaces that might be better.

use crate::native::common::{Random, noisy, unit_square};
use developable::{
    Bridging, Energy, Error, HeightImage, Heightfield, Input, Lattice, Normalization, Options,
    Report, Solver, Status, StopReason, Surface, fit,
};
use proptest::prelude::*;

/// A problem as its caller states it.
#[derive(Debug, Clone)]
struct Case {
    field: Heightfield,
    /// Empty: 1 everywhere.
    weights: Vec<f64>,
    options: Options,
    lambda: f64,
    gap: f64,
    energy: Energy,
}

impl Case {
    fn input(&self) -> Result<Input, Error> {
        let input = Input::new(self.field.clone()).with_bridging(Bridging::Off)?;
        match self.weights.is_empty() {
            true => Ok(input),
            false => input.with_confidence(self.weights.clone()),
        }
    }

    fn valid(&self, row: isize, col: isize) -> Option<usize> {
        let lattice = self.field.lattice();
        let inside = (0..lattice.rows() as isize).contains(&row)
            && (0..lattice.cols() as isize).contains(&col);
        let i = || row as usize * lattice.cols() + col as usize;
        (inside && !self.field.heights()[i()].is_nan()).then(i)
    }

    /// The six neighbours of each interior vertex: W, E, NW, NE, SW, SE.
    fn rings(&self) -> Vec<(usize, [usize; 6])> {
        let lattice = self.field.lattice();
        let mut rings = Vec::new();
        for row in 0..lattice.rows() as isize {
            let o = 1 - row % 2;
            for col in 0..lattice.cols() as isize {
                let at = [
                    (row, col - 1),
                    (row, col + 1),
                    (row - 1, col + o - 1),
                    (row - 1, col + o),
                    (row + 1, col + o - 1),
                    (row + 1, col + o),
                ];
                let ring: Option<Vec<usize>> = at.iter().map(|(r, c)| self.valid(*r, *c)).collect();
                if let (Some(centre), Some(ring)) = (self.valid(row, col), ring) {
                    rings.push((centre, ring.try_into().unwrap()));
                }
            }
        }
        rings
    }

    fn active(&self, rings: &[(usize, [usize; 6])]) -> Vec<usize> {
        let mut active: Vec<usize> = rings
            .iter()
            .flat_map(|(centre, ring)| ring.iter().chain([centre]).copied())
            .collect();
        active.sort_unstable();
        active.dedup();
        active
    }

    /// The energy of heights in the input's units, at a scale.
    fn energy_of(&self, z: &[f64], scale: f64) -> f64 {
        let rings = self.rings();
        let h = scale * self.field.lattice().spacing();
        let mut sum = 0.0;
        for i in self.active(&rings) {
            let weight = self.weights.get(i).copied().unwrap_or(1.0);
            let offset = scale * (z[i] - self.field.heights()[i]);
            sum += self.lambda * weight * offset * offset;
        }
        for (centre, ring) in rings {
            let [w, e, nw, ne, sw, se] = ring.map(|i| scale * (z[i] - z[centre]));
            let xx = (w + e) / (h * h);
            let yy = (2.0 * (nw + ne + sw + se) - (w + e)) / (3.0 * h * h);
            let xy = (ne - nw + sw - se) / (3f64.sqrt() * h * h);
            let nuclear = (xx + yy).abs().max((xx - yy).hypot(2.0 * xy));
            sum += match self.energy {
                Energy::Frobenius => (xx * xx + 2.0 * xy * xy + yy * yy).sqrt(),
                Energy::SquaredNuclear => nuclear * nuclear,
                _ => nuclear,
            };
        }
        sum
    }

    /// What rounding errors of the heights may do to an energy: each is off by an epsilon of the
    /// largest, and so a Hessian by some of them over h².
    fn rounding(&self, scale: f64) -> f64 {
        let rings = self.rings();
        let h = scale * self.field.lattice().spacing();
        let largest = self.active(&rings).iter().fold(0.0f64, |m, i| {
            m.max((scale * self.field.heights()[*i]).abs())
        });
        let norm = 64.0 * f64::EPSILON * largest / (h * h);
        let heights = 4.0 * f64::EPSILON * largest;
        rings.len() as f64
            * match self.energy {
                Energy::SquaredNuclear => norm * (norm + 64.0 * largest / (h * h)),
                _ => norm,
            }
            + self.lambda * 1e6 * heights * heights
    }

    /// The plane next to the input.
    fn plane(&self) -> Vec<f64> {
        let lattice = self.field.lattice();
        let rings = self.rings();
        let active = self.active(&rings);
        let place = |i: usize| {
            let [x, y] = lattice.position(i / lattice.cols(), i % lattice.cols());
            [1.0, x / lattice.spacing(), y / lattice.spacing()]
        };
        let mut m = [[0.0; 4]; 3];
        for i in &active {
            let (p, w) = (place(*i), self.weights.get(*i).copied().unwrap_or(1.0));
            for j in 0..3 {
                (0..3).for_each(|k| m[j][k] += w * p[j] * p[k]);
                m[j][3] += w * p[j] * self.field.heights()[*i];
            }
        }
        // Gauss and Jordan, with pivots.
        for j in 0..3 {
            let best = (j..3).max_by(|a, b| m[*a][j].abs().total_cmp(&m[*b][j].abs()));
            m.swap(j, best.unwrap());
            for k in (0..3).filter(|k| *k != j) {
                let f = m[k][j] / m[j][j];
                (0..4).for_each(|l| m[k][l] -= f * m[j][l]);
            }
        }
        let slope = [0, 1, 2].map(|j| m[j][3] / m[j][j]);
        let at = |i: usize| (0..3).map(|k| slope[k] * place(i)[k]).sum();
        (0..lattice.len()).map(at).collect()
    }

    /// The input, averaged with its neighbours so many times.
    fn smoothed(&self, passes: usize) -> Vec<f64> {
        let rings = self.rings();
        let mut z = self.field.heights().to_vec();
        for _ in 0..passes {
            let old = z.clone();
            for (centre, ring) in &rings {
                z[*centre] = ring.iter().map(|i| old[*i] / 12.0).sum::<f64>() + 0.5 * old[*centre];
            }
        }
        z
    }
}

fn finite(report: &Report) -> bool {
    let seconds = report.seconds;
    [
        report.objective,
        report.fidelity,
        report.nuclear_norm,
        report.dual_bound,
        report.gap.unwrap_or(0.0),
        report.lambda,
        report.rho,
        report.scale,
        seconds.total,
        seconds.setup,
        seconds.certificate,
    ]
    .iter()
    .all(|figure| figure.is_finite())
}

/// Everything that a report claims.
fn check(case: &Case, surface: &Surface) {
    let report = surface.report();
    assert!(finite(report), "{report:?}");
    assert_eq!(report.objective, report.fidelity + report.nuclear_norm);
    match report.stop_reason {
        StopReason::Gap => assert!(report.is_certified(case.gap), "{report:?}"),
        StopReason::Rounding => assert_eq!(report.gap, None, "{report:?}"),
        _ => (),
    }
    if let Some(gap) = report.gap {
        let expected = 1.0 - report.dual_bound / report.objective;
        assert!((gap - expected.max(0.0)).abs() < 1e-9, "{report:?}");
    }
    let heights = surface.heightfield().heights();
    for (i, (z, given)) in heights.iter().zip(case.field.heights()).enumerate() {
        // What is out of the solve's reach and has no height that means anything has none.
        let nothing = given.is_nan() || case.weights.get(i).is_some_and(|w| *w < 1e-6);
        assert!(z.is_finite() || z.is_nan() && nothing);
    }
    let rounding = case.rounding(report.scale);
    let least = report.dual_bound * (1.0 - 1e-9) - rounding;
    assert!(report.objective >= least, "{report:?}");
    // Of free vertices nothing is known here of what they are drawn to.
    if case.weights.iter().any(|w| *w < 1e-6) {
        return;
    }
    let found = case.energy_of(heights, report.scale);
    assert!(
        (found - report.objective).abs() <= 1e-6 * report.objective + rounding,
        "{found:e}: {report:?}"
    );
    let candidates = [
        case.field.heights().to_vec(),
        case.plane(),
        case.smoothed(1),
        case.smoothed(20),
    ];
    for z in candidates {
        let other = case.energy_of(&z, report.scale);
        assert!(
            other >= least || other.is_nan(),
            "{other:e} is less: {report:?}"
        );
        // The best plane and the input are within everyone's reach.
        if report.stop_reason == StopReason::Rounding {
            assert!(
                report.objective <= other * (1.0 + 1e-9) + rounding,
                "{other:e}: {report:?}"
            );
        }
    }
}

fn case() -> impl Strategy<Value = Case> {
    let shape = (5usize..22, 5usize..22, 0u64..1000);
    let kind = (0u8..5, 0u8..5, 0.0..0.3f64);
    let scales = (-300.0..300.0f64, -6.0..3.0f64, any::<bool>(), 0u8..4);
    let options = (-12.0..15.0f64, -5.0..-0.3f64, 0u8..3, any::<bool>());
    (shape, kind, scales, options).prop_map(
        |((rows, cols, seed), (kind, weights, holes), (size, aspect, usual, power), options)| {
            let (lambda, gap, energy, normalize) = options;
            let mut noise = Random::new(seed);
            // Half of all cases are of ordinary size.
            let spacing = if usual { 0.1 } else { 10f64.powf(size) };
            let height = if power == 0 {
                10f64.powf(-size)
            } else {
                spacing * 10f64.powf(aspect)
            };
            let lattice = Lattice::new(rows, cols, spacing).unwrap();
            let heights = (0..lattice.len()).map(|i| {
                let (x, y) = ((i % cols) as f64 / 10.0, (i / cols) as f64 / 10.0);
                let smooth = match kind {
                    0 => 0.0,
                    1 => 3.0 * x - y + 100.0,
                    2 => (x - 1.0).abs() - 0.3 * y,
                    3 => (2.0 * x).sin() * y.cos(),
                    _ => 0.02 * noise.sample(),
                };
                let rough = if seed % 3 == 0 {
                    0.0
                } else {
                    0.01 * noise.sample()
                };
                let hole = noise.sample().abs() < holes && seed % 2 == 0;
                if hole {
                    f64::NAN
                } else {
                    height * (smooth + rough)
                }
            });
            let heights: Vec<f64> = heights.collect();
            let weights = match weights {
                0 => heights
                    .iter()
                    .map(|_| 10f64.powf(6.0 * noise.sample()))
                    .collect(),
                1 => heights
                    .iter()
                    .map(|_| 10f64.powf(2.0 * noise.sample()))
                    .collect(),
                2 => heights
                    .iter()
                    .map(|_| f64::from(noise.sample() > 0.0))
                    .collect(),
                _ => Vec::new(),
            };
            let (lambda, gap) = (10f64.powf(lambda), 10f64.powf(gap));
            let energy =
                [Energy::Nuclear, Energy::Frobenius, Energy::SquaredNuclear][energy as usize];
            let normalization = match normalize {
                true => Normalization::UnitSquare,
                false => Normalization::Off,
            };
            Case {
                field: Heightfield::new(lattice, heights).unwrap(),
                weights,
                options: Options::paper()
                    .lambda(lambda)
                    .gap(gap)
                    .energy(energy)
                    .normalization(normalization)
                    .max_iterations(150),
                lambda,
                gap,
                energy,
            }
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]
    #[test]
    fn reports_are_true(case in case()) {
        match case.input().and_then(|input| fit(input, &case.options)) {
            Ok(surface) => check(&case, &surface),
            Err(error) => prop_assert!(
                ["NO_INTERIOR", "UNDERDETERMINED", "OVERFLOW", "UNDERFLOW"].contains(&error.code()),
                "{error}"
            ),
        }
    }
}

/// Noisy, and nothing special.
fn bumps(cols: usize) -> Heightfield {
    let wave = |x: f64, y: f64| 0.15 * (5.0 * x + 1.0).sin() * (4.0 * y).cos();
    noisy(&unit_square(cols, wave), 0.02, 7)
}

fn plain(field: Heightfield, lambda: f64) -> Case {
    Case {
        field,
        weights: Vec::new(),
        options: Options::paper().lambda(lambda).max_iterations(2000),
        lambda,
        gap: 0.01,
        energy: Energy::Nuclear,
    }
}

/// On a lattice with slits, inexact steps once diverged, and NaN was certified.
#[test]
fn a_surface_in_strips_is_certified_or_not() {
    let mut noise = Random::new(3);
    let heights = (0..120 * 120).map(|i| {
        let (x, y) = (i % 120, i / 120);
        let height = (x as f64 / 10.0).sin() + 0.05 * noise.sample();
        if x % 4 < 3 || y < 4 { height } else { f64::NAN }
    });
    let image = HeightImage::new(120, 120, heights.collect()).unwrap();
    let case = plain(image.to_lattice(None).unwrap(), 1e6);
    let surface = fit(case.input().unwrap(), &case.options).unwrap();
    check(&case, &surface);
    assert_eq!(surface.report().stop_reason, StopReason::Gap);
}

/// From where only the best plane pays to where only the input does.
#[test]
fn every_lambda_ends_soon() {
    for field in [bumps(100), bumps(40)] {
        for exponent in [-12, -9, -6, -3, -1, 0, 1, 2, 3, 5, 8, 12, 15] {
            let case = plain(field.clone(), 10f64.powi(exponent));
            let surface = fit(case.input().unwrap(), &case.options).unwrap();
            check(&case, &surface);
            let report = surface.report();
            let done = matches!(report.stop_reason, StopReason::Gap | StopReason::Rounding);
            assert!(done && report.iterations <= 400, "1e{exponent}: {report:?}");
            // Its nuclear norm is 0, whatever rounding makes of it.
            let plane = case.plane();
            let squares = case.active(&case.rings()).into_iter().map(|i| {
                let offset = report.scale * (plane[i] - case.field.heights()[i]);
                offset * offset
            });
            let plane = case.lambda * squares.sum::<f64>();
            assert!(
                report.objective <= 1.01 * plane,
                "1e{exponent}: {plane:e} {report:?}"
            );
            assert!(
                report.dual_bound >= 0.9 * report.objective.min(plane),
                "{report:?}"
            );
        }
    }
}

#[test]
fn affine_inputs_have_no_gap_to_speak_of() {
    for height in [0.0, 1.0, 1e9] {
        let field = unit_square(20, |x, y| height * (1.0 + x - 2.0 * y));
        let case = plain(field, 1e6);
        let surface = fit(case.input().unwrap(), &case.options).unwrap();
        check(&case, &surface);
        let report = surface.report();
        assert_eq!(
            (report.stop_reason, report.gap),
            (StopReason::Rounding, None)
        );
        let mut solver = Solver::new(case.input().unwrap(), &case.options).unwrap();
        while solver.advance(100).unwrap() == Status::Running {}
        assert_eq!(solver.progress().gap, None);
    }
}

/// Confidences from next to nothing to next to everything, with the same range on either side of a
/// border, in turns, at one vertex and at random.
#[test]
fn every_range_of_confidences_ends_soon() {
    let field = bumps(50);
    let (n, cols) = (field.lattice().len(), field.lattice().cols());
    let mut noise = Random::new(5);
    let random: Vec<f64> = (0..n).map(|_| 10f64.powf(6.0 * noise.sample())).collect();
    let mut patterns = vec![random];
    for [a, b] in [
        [1e-6, 1.0],
        [1e6, 1.0],
        [1e-6, 1e6],
        [1e-3, 1.0],
        [0.0, 1e6],
    ] {
        let choose = |first: &dyn Fn(usize) -> bool| -> Vec<f64> {
            (0..n).map(|i| if first(i) { a } else { b }).collect()
        };
        patterns.push(choose(&|i| i % cols > 17 && i / cols > 20));
        patterns.push(choose(&|i| i % 2 == 0));
        patterns.push(choose(&|i| i == 1000));
    }
    for lambda in [1e-12, 1.0, 1e6, 1e15] {
        for weights in &patterns {
            let mut case = plain(field.clone(), lambda);
            case.weights = weights.clone();
            let surface = fit(case.input().unwrap(), &case.options).unwrap();
            check(&case, &surface);
            let report = surface.report();
            let done = matches!(report.stop_reason, StopReason::Gap | StopReason::Rounding);
            assert!(done && report.iterations <= 600, "{lambda:e}: {report:?}");
        }
    }
}

#[test]
fn confidences_out_of_range_are_named() {
    let field = bumps(20);
    let weights = |last: f64| {
        let mut weights = vec![1.0; field.lattice().len()];
        weights[7] = last;
        Input::new(field.clone()).with_confidence(weights)
    };
    for bad in [1e40, 1.1e6, -1.0] {
        assert_eq!(weights(bad).unwrap_err().code(), "OPTION");
    }
    // As if there were none.
    let [tiny, none] = [1e-300, 0.0].map(|w| fit(weights(w).unwrap(), &Options::paper()).unwrap());
    assert_eq!(tiny.report().objective, none.report().objective);
    assert_eq!(tiny.report().free, 1);
}

#[test]
fn what_double_precision_cannot_hold_is_an_error() {
    let of = |spacing: f64, height: f64| {
        let field = bumps(20);
        let lattice =
            Lattice::new(field.lattice().rows(), field.lattice().cols(), spacing).unwrap();
        let heights = field.heights().iter().map(|z| height * z).collect();
        Heightfield::new(lattice, heights).unwrap()
    };
    let code = |spacing, height| fit(of(spacing, height), &Options::paper()).map_err(|e| e.code());
    for (spacing, height) in [(1e-200, 1.0), (1.0, 1e200), (1e-320, 1.0), (1e-5, 1e305)] {
        assert_eq!(
            code(spacing, height).unwrap_err(),
            "OVERFLOW",
            "{spacing:e} {height:e}"
        );
    }
    for (spacing, height) in [(1e298, 1.0), (1.0, 1e-200), (1.0, 1e-310), (1e300, 1e-300)] {
        assert_eq!(
            code(spacing, height).unwrap_err(),
            "UNDERFLOW",
            "{spacing:e} {height:e}"
        );
    }
    // Units alone are nothing.
    let usual = code(0.05, 1.0).unwrap();
    for unit in [1e-290, 1e-150, 1e150, 1e290] {
        let surface = code(0.05 * unit, unit).unwrap();
        assert!((surface.report().objective / usual.report().objective - 1.0).abs() < 1e-9);
        for (a, b) in surface
            .heightfield()
            .heights()
            .iter()
            .zip(usual.heightfield().heights())
        {
            assert!((a / unit - b).abs() < 1e-9);
        }
    }
}

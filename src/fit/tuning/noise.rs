//! How large the noise of heights is.

use super::correlated_noise::CorrelatedNoise;
use super::curvature_scales::{DISC_RADII, Disc, curvature_scales};
use crate::error::Result;
use crate::fit::input::Input;
use crate::math::statistics::{MAD_TO_SIGMA, median};

/// Least number of samples that say anything about noise.
const MIN_NOISE_SAMPLES: usize = 50;

/// Least number of vertices, along a line, that share a value of noise that counts as correlated. Resampling alone makes
/// noise alike from one vertex to the next by less.
const MIN_CORRELATED_VERTICES: f64 = 1.5;

/// Largest share of different heights among all at which steps of quantisation are looked for.
const MAX_DISTINCT_HEIGHTS: f64 = 0.25;

/// Relative difference up to which heights count as equal when steps are looked for.
const EQUAL_HEIGHT_TOLERANCE: f64 = 1e-3;

/// The noise of an input.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Noise {
    /// Standard deviation, in the user's units.
    pub sigma: f64,
    /// Standard deviation of the Gaussian blur that makes such noise of white noise, in the user's units; 0 for noise
    /// that is independent from vertex to vertex.
    pub correlation_length: f64,
    /// Number of times that four vertices are averaged to one until noise is independent from vertex to vertex.
    pub merged: usize,
    /// `σ h √A`, in the user's units squared, times the confidence of what it was measured at, where `A` vertices share a
    /// value of the noise. In normalised coordinates `8` over it is about the best λ.
    pub product: f64,
    /// The step of quantised heights, if noise is no larger than what that makes.
    pub step: Option<f64>,
    /// Whether the noise is alike over distances at which the shape bends, so that the two could not be told apart.
    pub ambiguous: bool,
}

impl Noise {
    /// The noise of an input; `None` if it has too few heights.
    ///
    /// # Errors
    /// Out of memory.
    pub(crate) fn from_input(input: &Input) -> Result<Option<Self>> {
        let Some(white) = ring_noise(input) else {
            return Ok(None);
        };
        let trust = largest_trust(input);
        let spacing = input.field.lattice().spacing();
        let step = step(input).filter(|step| step / 12f64.sqrt() > white);
        let mut noise = Noise {
            sigma: step.map_or(white, |step| step / 12f64.sqrt()),
            correlation_length: 0.0,
            merged: 0,
            product: 0.0,
            step,
            ambiguous: false,
        };
        let mut shared = 1.0;
        if let Some(step) = step {
            // Heights that are rounded alike have errors that are alike. The square root is by experience.
            let width = plateau(input, step);
            shared = width.sqrt();
            noise.merged = width.log2().round() as usize;
        } else if let Some(found) = correlated_noise(input)? {
            shared = found.shared_vertices.sqrt();
            noise.sigma = found.sigma;
            noise.correlation_length = found.length * spacing;
            noise.merged = shared.log2().round() as usize;
            noise.ambiguous = found.ambiguous;
        }
        noise.product = trust * noise.sigma * spacing * shared;
        Ok(Some(noise))
    }
}

/// Noise that several vertices share; `None` where it is independent from vertex to vertex.
fn correlated_noise(input: &Input) -> Result<Option<CorrelatedNoise>> {
    let discs: Vec<Disc> = DISC_RADII.into_iter().filter_map(Disc::new).collect();
    let scales = curvature_scales(input, &discs)?;
    let found = CorrelatedNoise::from_scales(&scales, &discs);
    let least = MIN_CORRELATED_VERTICES * MIN_CORRELATED_VERTICES;
    Ok(found.filter(|noise| noise.shared_vertices >= least))
}

/// What rings of six neighbours have in excess of any quadratic: the sum of their heights with
/// alternating signs.
fn ring_noise(input: &Input) -> Option<f64> {
    let found = median_of_rings(input, |_, [w, e, nw, ne, sw, se]| {
        (w - nw) + (ne - e) + (se - sw)
    })?;
    Some(MAD_TO_SIGMA * found / 6f64.sqrt())
}

/// The median of absolute values at rings of six neighbours, so that creases do not count.
fn median_of_rings(input: &Input, value: impl Fn(f64, [f64; 6]) -> f64) -> Option<f64> {
    let lattice = input.field.lattice();
    let least = MIN_SAMPLE_CONFIDENCE * largest_trust(input);
    let sample = |vertex| sample(input, vertex, least);
    let mut samples = Vec::new();
    for row in 0..lattice.rows() {
        for col in 0..lattice.cols() {
            let ring = lattice
                .neighbours(row, col)
                .map(|n| n.map_or(f64::NAN, |(row, col)| sample(lattice.index(row, col))));
            let value = value(sample(lattice.index(row, col)), ring);
            if value.is_finite() {
                samples.push(value.abs());
            }
        }
    }
    if samples.len() < MIN_NOISE_SAMPLES {
        return None;
    }
    median(&mut samples)
}

/// Least confidence of a sample, as a share of the largest: bridged vertices have less.
const MIN_SAMPLE_CONFIDENCE: f64 = 0.5;

fn largest_trust(input: &Input) -> f64 {
    match input.confidence.is_empty() {
        true => 1.0,
        false => (0..input.field.lattice().len())
            .filter(|v| !input.is_constrained(*v) && !input.field.heights()[*v].is_nan())
            .map(|v| input.weight(v))
            .fold(0.0, f64::max),
    }
}

/// A height of at least some confidence; NaN where there is none, or one that was made up.
fn sample(input: &Input, vertex: usize, least: f64) -> f64 {
    let weight = input.weight(vertex);
    if input.is_constrained(vertex) || weight < least || weight == 0.0 {
        return f64::NAN;
    }
    input.field.heights()[vertex]
}

/// The step that all heights are multiples of, from some height on, if many are the same.
fn step(input: &Input) -> Option<f64> {
    let least = MIN_SAMPLE_CONFIDENCE * largest_trust(input);
    let samples = (0..input.field.lattice().len()).map(|v| sample(input, v, least));
    let mut heights: Vec<f64> = samples.filter(|z| z.is_finite()).collect();
    let count = heights.len();
    heights.sort_unstable_by(f64::total_cmp);
    let size = heights.first()?.abs().max(heights.last()?.abs());
    let rounding = 16.0 * f64::EPSILON * size;
    heights.dedup_by(|a, b| *a - *b <= rounding);
    if heights.len() < 2 || heights.len() as f64 > MAX_DISTINCT_HEIGHTS * count as f64 {
        return None;
    }
    let gaps = heights.windows(2).map(|pair| pair[1] - pair[0]);
    let step = gaps.clone().fold(f64::INFINITY, f64::min);
    let multiple =
        |gap: f64| (gap / step - (gap / step).round()).abs() <= EQUAL_HEIGHT_TOLERANCE * gap / step;
    gaps.into_iter().all(multiple).then_some(step)
}

/// About how many vertices in a row are rounded to the same step.
fn plateau(input: &Input, step: f64) -> f64 {
    let lattice = input.field.lattice();
    let least = MIN_SAMPLE_CONFIDENCE * largest_trust(input);
    let (mut sum, mut count) = (0.0, 0.0);
    for row in 0..lattice.rows() {
        for col in 1..lattice.cols() {
            let [a, b] = [col - 1, col].map(|col| sample(input, lattice.index(row, col), least));
            let rise = (a - b).abs() / step;
            if rise.is_finite() {
                sum += rise.min(1.0);
                count += 1.0;
            }
        }
    }
    (count / f64::max(sum, 1.0)).max(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::heights::heightfield::Heightfield;
    use crate::lattice::hexagonal::Lattice;

    fn lattice() -> Lattice {
        Lattice::covering([0.0, 0.0], [1.0, 1.0], 0.01).unwrap()
    }

    /// Uniform in −√3..√3, which is a standard deviation of 1.
    fn white(seed: u64) -> Vec<f64> {
        let mut random = oorandom::Rand64::new(u128::from(seed));
        (0..lattice().len())
            .map(|_| 12f64.sqrt() * (random.rand_float() - 0.5))
            .collect()
    }

    fn roof(sigma: f64, noise: &[f64]) -> Heightfield {
        let truth = |x: f64, y: f64| 0.3 * (x - 0.4).abs() + 0.2 * (3.0 * y).sin();
        let truth = Heightfield::from_fn(lattice(), truth).unwrap();
        let heights = truth
            .heights()
            .iter()
            .zip(noise)
            .map(|(z, n)| z + sigma * n);
        Heightfield::new(lattice(), heights.collect()).unwrap()
    }

    #[test]
    fn white_noise_is_measured_beside_bends_and_creases() {
        for sigma in [1e-4, 1e-3, 1e-2] {
            let noise = Noise::from_input(&roof(sigma, &white(3)).into()).unwrap().unwrap();
            assert!(
                (noise.sigma / sigma - 1.0).abs() < 0.06,
                "{sigma}: {noise:?}"
            );
            assert_eq!((noise.merged, noise.step), (0, None), "{sigma}");
            assert_eq!(noise.product, noise.sigma * 0.01);
        }
    }

    #[test]
    fn correlated_noise_counts_for_more() {
        let lattice = lattice();
        let mut noise = white(5);
        for _ in 0..3 {
            let old = noise.clone();
            for (i, value) in noise.iter_mut().enumerate() {
                let ring = lattice.neighbours(i / lattice.cols(), i % lattice.cols());
                let ring = ring
                    .into_iter()
                    .flatten()
                    .map(|(r, c)| old[lattice.index(r, c)]);
                let (sum, count) = ring.fold((2.0 * old[i], 2.0), |(s, n), z| (s + z, n + 1.0));
                *value = sum / count;
            }
        }
        let noise = Noise::from_input(&roof(1e-2, &noise).into()).unwrap().unwrap();
        // Smoothing leaves the mean over large areas as it is, and so `σh` there.
        assert!(noise.merged > 0, "{noise:?}");
        assert!((0.4..1.3).contains(&(noise.product / 1e-4)), "{noise:?}");
    }

    /// As a depth camera's is that rounds: over so many vertices, behind small noise that is rough.
    fn smooth(vertices: f64, rough: f64) -> Vec<f64> {
        let lattice = lattice();
        let reach = (3.0 * vertices).ceil() as isize;
        let kernel = |d: isize| (-0.5 * (d as f64 / vertices).powi(2)).exp();
        let along = |noise: &[f64], rows: isize, cols: isize| -> Vec<f64> {
            let size = [lattice.rows() as isize, lattice.cols() as isize];
            let at = |i: usize, d: isize| {
                let row = i as isize / size[1] + d * rows;
                let col = i as isize % size[1] + d * cols;
                noise[(row.rem_euclid(size[0]) * size[1] + col.rem_euclid(size[1])) as usize]
            };
            let sum = |i| (-reach..=reach).map(|d| kernel(d) * at(i, d)).sum();
            (0..noise.len()).map(sum).collect()
        };
        let noise = along(&along(&white(8), 1, 0), 0, 1);
        let size = (noise.iter().map(|n| n * n).sum::<f64>() / noise.len() as f64).sqrt();
        noise
            .iter()
            .zip(white(9))
            .map(|(n, w)| n / size + rough * w)
            .collect()
    }

    #[test]
    fn smooth_noise_is_seen_behind_rough_noise() {
        let (sigma, vertices) = (1e-2, 3.0);
        let field = roof(sigma, &smooth(vertices, 0.03));
        let noise = Noise::from_input(&field.into()).unwrap().unwrap();
        assert_eq!(noise.merged, 3, "{noise:?}");
        // No more than it has, and more than rough noise a tenth of its size.
        assert!((0.3..1.1).contains(&(noise.sigma / sigma)), "{noise:?}");
        // Nor is it lost where what is rougher goes over to it little by little.
        let (own, beside) = (smooth(vertices, 0.0), smooth(1.0, 0.0));
        let both = own
            .iter()
            .zip(beside.iter().rev())
            .map(|(n, m)| n + 0.3 * m);
        let field = roof(sigma, &both.collect::<Vec<_>>());
        let noise = Noise::from_input(&field.into()).unwrap().unwrap();
        assert_eq!(noise.merged, 3, "{noise:?}");
        assert!((0.3..1.1).contains(&(noise.sigma / sigma)), "{noise:?}");
        // A shape that shows behind rough noise alike is none.
        let [rough, shape] = [3e-4, 0.028];
        let wave = |x: f64, _: f64| shape * (8.0 * x).sin();
        let wave = Heightfield::from_fn(lattice(), wave).unwrap();
        let heights = wave.heights().iter().zip(smooth(0.7, 0.0));
        let heights = heights.map(|(z, n)| z + rough * n).collect();
        let field = Heightfield::new(lattice(), heights).unwrap();
        let noise = Noise::from_input(&field.into()).unwrap().unwrap();
        assert!(noise.merged < 3 && noise.sigma < 3.0 * rough, "{noise:?}");
    }

    #[test]
    fn steps_are_recognised() {
        let step = 0.02;
        let smooth = roof(0.0, &white(1));
        let heights = smooth
            .heights()
            .iter()
            .map(|z| 1.0 + (z / step).round() * step);
        let field = Heightfield::new(lattice(), heights.collect()).unwrap();
        let noise = Noise::from_input(&field.into()).unwrap().unwrap();
        assert!((noise.step.unwrap() / step - 1.0).abs() < 1e-9, "{noise:?}");
        assert!((noise.sigma / (step / 12f64.sqrt()) - 1.0).abs() < 1e-6);
        // Noise that is larger than the step is what counts.
        let rough = roof(0.05, &white(2));
        let heights = rough.heights().iter().map(|z| (z / step).round() * step);
        let field = Heightfield::new(lattice(), heights.collect()).unwrap();
        let noise = Noise::from_input(&field.into()).unwrap().unwrap();
        assert!(
            noise.step.is_none() && (noise.sigma / 0.05 - 1.0).abs() < 0.1,
            "{noise:?}"
        );
    }

    #[test]
    fn constant_and_tiny_inputs_have_none() {
        let flat = Heightfield::from_fn(lattice(), |_, _| 0.0).unwrap();
        assert_eq!(Noise::from_input(&flat.into()).unwrap().unwrap().sigma, 0.0);
        let tiny = Heightfield::from_fn(Lattice::new(3, 3, 1.0).unwrap(), |x, _| x).unwrap();
        assert_eq!(Noise::from_input(&tiny.into()).unwrap(), None);
    }
}

//! How large the noise of heights is.

use super::merge::merge;
use crate::error::Result;
use crate::fit::input::Input;
use crate::lattice::stencil::Quadratic;
use crate::math::statistics::{MAD_TO_SIGMA, median};

/// The same of the smaller principal curvature, at a spacing of 1, for noise of standard deviation 1 that is
/// independent from vertex to vertex.
const SMALLER_BEND: f64 = 0.93;

/// Least number of samples that say anything about noise.
const MIN_NOISE_SAMPLES: usize = 50;

/// Most merging for correlated noise.
const MOST_MERGED: usize = 2;

/// Least and largest factor by which `σh` of correlated noise grows from one merging to the next. Noise that
/// is independent from vertex to vertex has `σh` as before. What grows by more than the largest each time is
/// no noise but the surface's own shape, which grows by up to 16; where that comes in later, noise ends where
/// it grows least.
const CORRELATED_GROWTH_RANGE: [f64; 2] = [1.3, 5.0];

/// Factor by which growth rises where noise is smooth over several vertices: it shows late, behind what is
/// rougher and smaller, such as rounding or the edges of pixels.
const SMOOTH_NOISE_RISE: f64 = 1.1;

/// Least growth on each lattice where noise is smooth on all of them.
const MIN_SMOOTH_NOISE_GROWTH: f64 = 3.0;

/// Largest growth of noise that is still smooth.
const MAX_SMOOTH_NOISE_GROWTH: f64 = 12.0;

/// Least share of curvature that bends both ways at which what grows so is noise: a developable surface does not bend
/// both ways.
const BOTH_WAYS: f64 = 0.75;

/// Largest share of different heights among all at which steps of quantisation are looked for.
const MAX_DISTINCT_HEIGHTS: f64 = 0.25;

/// Relative difference up to which heights count as equal when steps are looked for.
const EQUAL_HEIGHT_TOLERANCE: f64 = 1e-3;

/// The noise of an input.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Noise {
    /// Standard deviation, in the user's units.
    pub sigma: f64,
    /// How often vertices are merged, four into one, until noise is independent from vertex to vertex.
    pub merged: usize,
    /// `σh` there, in the user's units squared, times the confidence of what it was measured at. In
    /// normalised coordinates `8` over it is about the best λ.
    pub product: f64,
    /// The step of quantised heights, if noise is no larger than what that makes.
    pub step: Option<f64>,
}

impl Noise {
    /// Nothing where there is too little to tell from.
    pub(crate) fn of(input: &Input) -> Result<Option<Self>> {
        let trust = largest_trust(input);
        let Some(own) = ring_noise(input) else {
            return Ok(None);
        };
        let step = step(input).filter(|step| step / 12f64.sqrt() > own);
        let sigma = step.map_or(own, |step| step / 12f64.sqrt());
        let mut spacing = input.field.lattice().spacing();
        let mut noise = Noise {
            sigma,
            merged: 0,
            product: trust * sigma * spacing,
            step,
        };
        if let Some(step) = step {
            // Heights that are rounded alike are off alike; the square root is by experience.
            let width = plateau(input, step);
            noise.product *= width.sqrt();
            noise.merged = width.log2().round() as usize;
            return Ok(Some(noise));
        }
        let [least, most] = CORRELATED_GROWTH_RANGE;
        let mut merged = merge(input)?;
        let mut last = noise;
        let mut slowest = most;
        let mut grown = Vec::new();
        for count in 1..=MOST_MERGED + 1 {
            spacing *= 2.0;
            let Some(found) = ring_noise(&merged) else {
                break;
            };
            let next = Noise {
                sigma: noise.sigma.max(found),
                merged: count,
                product: trust * found * spacing,
                step,
            };
            let growth = next.product / last.product;
            if growth <= least || growth.is_nan() {
                return Ok(Some(last));
            }
            grown.push(growth);
            if count > MOST_MERGED
                && shows_late(&grown)
                && bend_noise(&merged) > Some(BOTH_WAYS * found)
            {
                return Ok(Some(next));
            }
            if growth < slowest && count <= MOST_MERGED {
                (noise, slowest) = (next, growth);
            }
            last = next;
            merged = merge(&merged)?;
        }
        if noise.merged > 0 {
            // Not all of it is seen there yet.
            noise.product *= slowest.sqrt();
        }
        Ok(Some(noise))
    }
}

/// Whether noise shows on the lattices merged last, behind what grows slowly on those before or as much.
fn shows_late(growth: &[f64]) -> bool {
    let (first, later) = (growth[0], &growth[1..]);
    let fastest = later.iter().copied().fold(0.0, f64::max);
    let rises = fastest > SMOOTH_NOISE_RISE * first
        && (CORRELATED_GROWTH_RANGE[1]..MAX_SMOOTH_NOISE_GROWTH).contains(&fastest);
    rises
        || (growth.iter())
            .all(|growth| (MIN_SMOOTH_NOISE_GROWTH..CORRELATED_GROWTH_RANGE[1]).contains(growth))
}

/// What rings of six neighbours have in excess of any quadratic: the sum of their heights with
/// alternating signs.
fn ring_noise(input: &Input) -> Option<f64> {
    let found = median_of_rings(input, |_, [w, e, nw, ne, sw, se]| {
        (w - nw) + (ne - e) + (se - sw)
    })?;
    Some(MAD_TO_SIGMA * found / 6f64.sqrt())
}

/// The same by how far surfaces bend both ways: the smaller principal curvature. Of a developable surface it
/// is noise's alone, however smooth that is.
fn bend_noise(input: &Input) -> Option<f64> {
    let found = median_of_rings(input, |centre, ring| {
        let [a, b] = Quadratic::fit(centre, ring, 1.0).hessian.eigenvalues();
        a.abs().min(b.abs())
    })?;
    Some(found / SMALLER_BEND)
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
            let noise = Noise::of(&roof(sigma, &white(3)).into()).unwrap().unwrap();
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
        let noise = Noise::of(&roof(1e-2, &noise).into()).unwrap().unwrap();
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
        let noise = Noise::of(&field.into()).unwrap().unwrap();
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
        let noise = Noise::of(&field.into()).unwrap().unwrap();
        assert_eq!(noise.merged, 3, "{noise:?}");
        assert!((0.3..1.1).contains(&(noise.sigma / sigma)), "{noise:?}");
        // A shape that shows behind rough noise alike is none.
        let [rough, shape] = [3e-4, 0.028];
        let wave = |x: f64, _: f64| shape * (8.0 * x).sin();
        let wave = Heightfield::from_fn(lattice(), wave).unwrap();
        let heights = wave.heights().iter().zip(smooth(0.7, 0.0));
        let heights = heights.map(|(z, n)| z + rough * n).collect();
        let field = Heightfield::new(lattice(), heights).unwrap();
        let noise = Noise::of(&field.into()).unwrap().unwrap();
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
        let noise = Noise::of(&field.into()).unwrap().unwrap();
        assert!((noise.step.unwrap() / step - 1.0).abs() < 1e-9, "{noise:?}");
        assert!((noise.sigma / (step / 12f64.sqrt()) - 1.0).abs() < 1e-6);
        // Noise that is larger than the step is what counts.
        let rough = roof(0.05, &white(2));
        let heights = rough.heights().iter().map(|z| (z / step).round() * step);
        let field = Heightfield::new(lattice(), heights.collect()).unwrap();
        let noise = Noise::of(&field.into()).unwrap().unwrap();
        assert!(
            noise.step.is_none() && (noise.sigma / 0.05 - 1.0).abs() < 0.1,
            "{noise:?}"
        );
    }

    #[test]
    fn constant_and_tiny_inputs_have_none() {
        let flat = Heightfield::from_fn(lattice(), |_, _| 0.0).unwrap();
        assert_eq!(Noise::of(&flat.into()).unwrap().unwrap().sigma, 0.0);
        let tiny = Heightfield::from_fn(Lattice::new(3, 3, 1.0).unwrap(), |x, _| x).unwrap();
        assert_eq!(Noise::of(&tiny.into()).unwrap(), None);
    }
}

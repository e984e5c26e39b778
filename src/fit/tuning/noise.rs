//! Estimation of the noise of heights: standard deviation, correlation length and quantisation step.

use super::correlated_noise::CorrelatedNoise;
use super::curvature_scales::{DISC_RADII, Disc, curvature_scales};
use super::trust::{largest_trust, least_trust, sample};
use crate::error::Result;
use crate::fit::input::Input;
use crate::heights::pixel_noise::quantisation_step;
use crate::math::fork;
use crate::math::statistics::{MAD_TO_SIGMA, median};

/// Minimum number of rings of six neighbours, or of vertices of a mesh, from which noise is estimated, and of heights that are held
/// out; with fewer there is no estimate.
pub(crate) const MIN_NOISE_SAMPLES: usize = 50;

/// Minimum ratio of the noise estimated from large discs to that from rings of six neighbours at which noise counts as
/// correlated. Bends of the shape beside white noise raise it to 1.8 (`benches/scenes.md`, One constant at a time).
const MIN_CORRELATED_RATIO: f64 = 2.5;

/// Minimum product `σ √A` of noise, as a share of the height range; what is less, smooth bends of a shape have, too
/// (`benches/scenes.md`, One constant at a time).
pub(super) const MIN_NOISE_SHARE: f64 = 3e-4;

/// Share of the standard deviation of independent pixels that is left between them, where heights are bilinear: the mean of
/// the squared weights is 4/9.
const BILINEAR_SIGMA: f64 = 2.0 / 3.0;

/// Noise of an input's heights: size, correlation and quantisation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Noise {
    /// Standard deviation of the noise of the input, be it a lattice or an image, in the user's unit of height.
    pub sigma: f64,
    /// Standard deviation of the noise at the vertices of the lattice.
    pub vertex_sigma: f64,
    /// Standard deviation of white noise on the lattice that is alike over large areas: `σ √A`, where `A` vertices share one
    /// independent value of the noise.
    pub white_equivalent: f64,
    /// Correlation length, in the user's unit of length: the standard deviation of the Gaussian blur that makes such
    /// noise of white noise; 0 for noise that is independent from one pixel or vertex to the next.
    pub correlation_length: f64,
    /// `σ √A h` times the largest confidence, in the user's unit squared, where `h` is the spacing. In normalised coordinates
    /// the best λ is about `8 / product`.
    pub product: f64,
    /// Quantisation step of the heights, in the user's units; `None` if they are not quantised, or their noise
    /// exceeds the rounding error of such a step, `step/√12`.
    pub step: Option<f64>,
}

impl Noise {
    /// Estimates the noise of an input; `None` if it has too few heights. `is_rough_noise` says that what is rough is noise, however
    /// large it is, and no shape.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub(crate) fn from_input(input: &Input, is_rough_noise: bool) -> Result<Option<Self>> {
        let Some(rings) = ring_noise(input) else {
            return Ok(None);
        };
        let spacing = input.field.lattice().spacing();
        let step = match input.pixel_noise {
            Some(pixels) => pixels.step,
            None => quantisation_step(input.field.heights()),
        };
        // Independent noise of pixels is smaller between them, and shared by neighbouring vertices.
        let [sigma, vertex_sigma, white] = match input.pixel_noise {
            None => [rings; 3],
            Some(pixels) => {
                let pixels_per_vertex = 0.75f64.powf(0.25) * spacing / pixels.pixel_size;
                let white = (1.0 / pixels_per_vertex).max(BILINEAR_SIGMA);
                [1.0, BILINEAR_SIGMA, white].map(|share| share * pixels.sigma)
            }
        };
        let rounding = step.map_or(0.0, |step| step / 12f64.sqrt());
        let is_rounding = rounding > sigma;
        let [sigma, vertex_sigma, white] =
            [sigma, vertex_sigma, white].map(|sigma: f64| sigma.max(rounding));
        let mut noise = Noise {
            sigma,
            vertex_sigma,
            white_equivalent: white,
            correlation_length: 0.0,
            product: 0.0,
            step: step.filter(|_| is_rounding),
        };
        if let Some(found) = correlated_noise(input, is_rough_noise)? {
            let root = found.white_equivalent;
            if found.is_anisotropic || root >= MIN_CORRELATED_RATIO * white {
                noise.sigma = found.sigma;
                noise.vertex_sigma = found.sigma;
                noise.white_equivalent = root;
                noise.correlation_length = found.length * spacing;
            }
        }
        noise.product = largest_trust(input) * noise.white_equivalent * spacing;
        Ok(Some(noise))
    }

    pub(crate) fn is_correlated(&self) -> bool {
        self.correlation_length > 0.0
    }
}

/// Estimates correlated noise of an input; `None` if a shape hides it.
fn correlated_noise(input: &Input, is_rough_noise: bool) -> Result<Option<CorrelatedNoise>> {
    let discs: Vec<Disc> = DISC_RADII.into_iter().filter_map(Disc::new).collect();
    let scales = curvature_scales(input, &discs)?;
    let found = CorrelatedNoise::from_scales(&scales, &discs, is_rough_noise);
    Ok(found)
}

/// Difference between the highest and the lowest height of an input.
pub(super) fn height_range(input: &Input) -> f64 {
    let heights = input.field.heights().iter().filter(|z| z.is_finite());
    let [low, high] = heights.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], z| {
        [low.min(*z), high.max(*z)]
    });
    (high - low).max(0.0)
}

/// Range of evenly distributed heights with the standard deviation of those of an input.
pub(super) fn height_spread(input: &Input) -> f64 {
    let heights = || input.field.heights().iter().filter(|z| z.is_finite());
    let count = heights().count() as f64;
    let mean = heights().sum::<f64>() / count;
    let variance = heights().map(|z| (z - mean).powi(2)).sum::<f64>() / count;
    (12.0 * variance).sqrt()
}

/// Estimates the standard deviation of white noise from rings of six neighbours: the sum of a ring's heights with
/// alternating signs is 0 for every quadratic. The median over all rings discards creases. `None` if there are fewer
/// than [`MIN_NOISE_SAMPLES`] rings.
fn ring_noise(input: &Input) -> Option<f64> {
    let lattice = input.field.lattice();
    let least = least_trust(input);
    let mut samples = vec![Vec::new(); lattice.rows()];
    fork::for_each(&mut samples, |row, samples| {
        for col in 0..lattice.cols() {
            if sample(input, lattice.index(row, col), least).is_nan() {
                continue;
            }
            let [w, e, nw, ne, sw, se] = lattice.neighbours(row, col).map(|neighbour| {
                neighbour.map_or(f64::NAN, |(row, col)| {
                    sample(input, lattice.index(row, col), least)
                })
            });
            let excess = (w - nw) + (ne - e) + (se - sw);
            if excess.is_finite() {
                samples.push(excess.abs());
            }
        }
    });
    let mut samples = samples.concat();
    if samples.len() < MIN_NOISE_SAMPLES {
        return None;
    }
    Some(MAD_TO_SIGMA * median(&mut samples)? / 6f64.sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Options;
    use crate::fit::options::Lambda;
    use crate::fit::tuning::closed_form::{InputStatistics, initial_options};
    use crate::heights::heightfield::Heightfield;
    use crate::lattice::hexagonal::Lattice;

    fn lattice() -> Lattice {
        Lattice::covering([0.0, 0.0], [1.0, 1.0], 0.01).unwrap()
    }

    fn white(seed: u64) -> Vec<f64> {
        white_on(&lattice(), seed)
    }

    /// Uniform in −√3..√3, which is a standard deviation of 1.
    fn white_on(lattice: &Lattice, seed: u64) -> Vec<f64> {
        let mut random = oorandom::Rand64::new(u128::from(seed));
        (0..lattice.len())
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

    fn noise_of(field: Heightfield) -> Noise {
        Noise::from_input(&field.into(), false).unwrap().unwrap()
    }

    fn noise_of_depths(field: Heightfield) -> Noise {
        let input = Input::new(field).measured_by_camera();
        Noise::from_input(&input, input.is_measured)
            .unwrap()
            .unwrap()
    }

    /// Heights whose second differences grow with a power of their distance, as those of terrains do: sums of blurred noise whose sizes grow
    /// with a power of their blurs.
    #[test]
    fn a_terrain_that_is_alike_at_every_scale_has_little_noise() {
        let lattice = Lattice::covering([0.0, 0.0], [3.0, 3.0], 0.01).unwrap();
        let mut heights = vec![0.0; lattice.len()];
        for (octave, blur) in [1.0, 2.0, 4.0, 8.0, 16.0, 32.0].into_iter().enumerate() {
            let noise = blurred_on(&lattice, octave as u64, [blur; 2]);
            (heights.iter_mut().zip(noise)).for_each(|(z, n)| *z += blur.powf(1.2) * n);
        }
        let field = Heightfield::new(lattice, heights).unwrap();
        let options = Options::default().lambda(Lambda::Medium);
        let given = InputStatistics::of(&field.clone().into(), &options).unwrap();
        let [noise, of_camera] = [noise_of(field.clone()), noise_of_depths(field)];
        assert!(noise.sigma < 5.0, "{noise:?}");
        // The largest discs alone show smooth noise that is ten times as large.
        assert!(of_camera.sigma > 20.0, "{of_camera:?}");
        // Beside a λ that is given these make the penalty flatter.
        assert_eq!(given.noise, Some(of_camera));
    }

    #[test]
    fn white_noise_is_measured_beside_bends_and_creases() {
        for sigma in [1e-4, 1e-3, 1e-2] {
            let noise = noise_of(roof(sigma, &white(3)));
            assert!(
                (noise.sigma / sigma - 1.0).abs() < 0.06,
                "{sigma}: {noise:?}"
            );
            assert_eq!(
                (noise.correlation_length, noise.step),
                (0.0, None),
                "{sigma}"
            );
            assert_eq!(noise.product, noise.sigma * 0.01);
        }
    }

    fn blurred(seed: u64, blur: [f64; 2]) -> Vec<f64> {
        blurred_on(&lattice(), seed, blur)
    }

    /// Noise of variance 1: white noise after a Gaussian blur along rows and across them, in spacings.
    fn blurred_on(lattice: &Lattice, seed: u64, [along, across]: [f64; 2]) -> Vec<f64> {
        let size = [lattice.rows() as isize, lattice.cols() as isize];
        let pass = |noise: &[f64], blur: f64, [down, right]: [isize; 2]| -> Vec<f64> {
            let reach = (3.5 * blur).ceil() as isize;
            let kernel = |step: isize| (-0.5 * (step as f64 / blur.max(1e-9)).powi(2)).exp();
            let at = |i: usize, step: isize| {
                let row = i as isize / size[1] + step * down;
                let col = i as isize % size[1] + step * right;
                noise[(row.rem_euclid(size[0]) * size[1] + col.rem_euclid(size[1])) as usize]
            };
            let sum = |i| {
                (-reach..=reach)
                    .map(|step| kernel(step) * at(i, step))
                    .sum()
            };
            (0..noise.len()).map(sum).collect()
        };
        let rows_apart = 0.75f64.sqrt();
        let noise = pass(
            &pass(&white_on(lattice, seed), along, [0, 1]),
            across / rows_apart,
            [1, 0],
        );
        let size = (noise.iter().map(|n| n * n).sum::<f64>() / noise.len() as f64).sqrt();
        noise.iter().map(|n| n / size).collect()
    }

    /// `√A` of blurred noise: the sum of its correlations, `2√π` times the blur for each axis over the area of a cell.
    fn shared_root(blur: [f64; 2]) -> f64 {
        let along_axis = |blur: f64| (2.0 * std::f64::consts::PI.sqrt() * blur).max(1.0).sqrt();
        blur.map(along_axis).iter().product()
    }

    /// The roof's bends show in discs of more than eight spacings, which have 232 vertices for six coefficients, so that no more
    /// noise is counted than what 39 vertices share.
    #[test]
    fn blurred_noise_has_its_size_and_its_length() {
        let shown = (232.0 / 6f64).sqrt();
        for blur in [1.0, 1.6, 2.5] {
            for seed in [3, 5] {
                let field = roof(1e-2, &blurred(seed, [blur; 2]));
                let noise = noise_of(field);
                let length = noise.correlation_length / 0.01;
                assert!((0.9..1.25).contains(&(length / blur)), "{blur} {noise:?}");
                assert!(
                    (0.85..1.15).contains(&(noise.sigma / 1e-2)),
                    "{blur} {noise:?}"
                );
                let shared = shared_root([blur; 2]);
                let product = noise.product / 1e-4;
                assert!(product < 1.2 * shared, "{blur} {product} {noise:?}");
                assert!(
                    product > 0.7 * shared.min(shown),
                    "{blur} {product} {noise:?}"
                );
            }
        }
    }

    /// Few large discs fit into a lattice, and their medians are uncertain: no draw of the noise is taken for far larger
    /// or smaller than it is.
    #[test]
    fn no_draw_of_smooth_noise_is_far_off() {
        let cone = |x: f64, y: f64, slope: f64| 0.5 - slope * x.hypot(y);
        let cones = |x: f64, y: f64| cone(x - 0.3, y - 0.35, 0.6).max(cone(x - 0.75, y - 0.7, 0.8));
        let truth = Heightfield::from_fn(lattice(), cones).unwrap();
        let sigma = 0.035;
        for seed in 0..100 {
            let heights = truth.heights().iter().zip(blurred(seed, [1.0; 2]));
            let heights = heights.map(|(z, n)| z + sigma * n).collect();
            let field = Heightfield::new(lattice(), heights).unwrap();
            let noise = noise_of(field);
            let product = noise.product / (sigma * 0.01 * shared_root([1.0; 2]));
            assert!((0.5..2.0).contains(&product), "{seed} {product}");
        }
    }

    /// Scan lines: each line is smooth, and has little to do with the next.
    #[test]
    fn noise_of_scan_lines_is_seen() {
        for blur in [[3.0, 0.0], [0.0, 3.0], [4.0, 1.0]] {
            let field = roof(1e-2, &blurred(7, blur));
            let noise = noise_of(field);
            let product = noise.product / (1e-4 * shared_root(blur));
            assert!(
                (0.5..2.5).contains(&product),
                "{blur:?} {product} {noise:?}"
            );
        }
    }

    /// A depth camera rounds as well: the noise that counts is the smooth one, though the other is rougher.
    #[test]
    fn smooth_noise_is_seen_behind_rough_noise() {
        let rough = white(9);
        for (blur, share) in [(1.6, 0.03), (2.5, 0.03), (2.5, 0.1)] {
            let smooth = blurred(8, [blur; 2]);
            let both: Vec<f64> = smooth
                .iter()
                .zip(&rough)
                .map(|(n, w)| n + share * w)
                .collect();
            let noise = noise_of_depths(roof(1e-2, &both));
            let product = noise.product / (1e-4 * shared_root([blur; 2]));
            assert!(
                (0.5..1.8).contains(&product),
                "{blur} {share} {product} {noise:?}"
            );
        }
    }

    /// Noise is measured where heights are trusted, though most of them are hardly trusted.
    #[test]
    fn noise_is_that_of_trusted_heights() {
        let noise = white(7);
        let cols = lattice().cols();
        let is_trusted = |vertex: usize| lattice().position(vertex / cols, vertex % cols)[0] > 0.7;
        let [trusted, other] = [0.005, 0.05];
        let heights = noise.iter().enumerate();
        let heights = heights.map(|(i, n)| {
            if is_trusted(i) {
                trusted * n
            } else {
                other * n
            }
        });
        let field = Heightfield::new(lattice(), heights.collect()).unwrap();
        let confidence = (0..lattice().len()).map(|i| if is_trusted(i) { 1.0 } else { 0.01 });
        let input = Input::new(field)
            .with_confidence(confidence.collect())
            .unwrap();
        let found = Noise::from_input(&input, input.is_measured)
            .unwrap()
            .unwrap();
        assert!((found.sigma / trusted - 1.0).abs() < 0.1, "{found:?}");
        assert_eq!(found.correlation_length, 0.0);
    }

    /// Depths in whole millimetres, on a lattice finer than the camera's pixels: the rounding is smooth over a pixel, and hides
    /// in the smallest discs the noise that is smooth over several.
    #[test]
    fn smooth_noise_is_seen_behind_less_smooth_noise() {
        for (blur, rough, seed) in [(4.0, 0.1, 8), (4.0, 0.06, 11), (4.0, 0.06, 12)] {
            let noise = blurred(seed, [blur; 2]);
            let rough_noise = blurred(seed + 50, [1.0; 2]);
            let both: Vec<f64> = (noise.iter().zip(&rough_noise))
                .map(|(smooth, rounding)| smooth + rough * rounding)
                .collect();
            let found = noise_of_depths(roof(1e-2, &both));
            let length = found.correlation_length / 0.01;
            assert!(
                (0.5..2.0).contains(&(found.sigma / 1e-2)),
                "{blur} {found:?}"
            );
            assert!((0.5..2.0).contains(&(length / blur)), "{blur} {found:?}");
        }
    }

    /// Noise that is small for a slope from 0 to 1 is not told from the shape of a plain with one summit of that height.
    #[test]
    fn a_summit_does_not_make_noise_of_a_terrain() {
        let slope = |x: f64, _: f64| x;
        let summit = |x: f64, y: f64| (1.0 - 8.0 * (x - 0.5).hypot(y - 0.5)).max(0.0);
        let is_ambiguous = |shape: fn(f64, f64) -> f64| {
            let shape = Heightfield::from_fn(lattice(), shape).unwrap();
            let heights = shape.heights().iter().zip(blurred(4, [1.6; 2]));
            let heights = heights.map(|(z, n)| z + 0.025 * n).collect();
            let field = Heightfield::new(lattice(), heights).unwrap();
            let options = Options::default();
            let statistics = InputStatistics::of(&field.into(), &options).unwrap();
            initial_options(&options, statistics).1.ambiguous
        };
        assert!(!is_ambiguous(slope) && is_ambiguous(summit));
    }

    /// Smooth bends are no noise, whether they stand alone or behind small noise.
    #[test]
    fn shapes_are_no_noise() {
        for rough in [0.0, 3e-4] {
            let wave = |x: f64, _: f64| 0.028 * (8.0 * x).sin();
            let wave = Heightfield::from_fn(lattice(), wave).unwrap();
            let heights = wave.heights().iter().zip(white(6));
            let heights = heights.map(|(z, n)| z + rough * n).collect();
            let field = Heightfield::new(lattice(), heights).unwrap();
            let noise = noise_of(field);
            assert!(
                noise.correlation_length == 0.0 && noise.sigma < 1.1 * rough + 1e-5,
                "{rough} {noise:?}"
            );
        }
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
        let noise = noise_of(field);
        assert!((noise.step.unwrap() / step - 1.0).abs() < 1e-9, "{noise:?}");
        assert!((noise.sigma / (step / 12f64.sqrt()) - 1.0).abs() < 1e-6);
        // Noise that is larger than the step is what counts.
        let rough = roof(0.05, &white(2));
        let heights = rough.heights().iter().map(|z| (z / step).round() * step);
        let field = Heightfield::new(lattice(), heights.collect()).unwrap();
        let noise = noise_of(field);
        assert!(
            noise.step.is_none() && (noise.sigma / 0.05 - 1.0).abs() < 0.1,
            "{noise:?}"
        );
    }

    #[test]
    fn constant_and_tiny_inputs_have_none() {
        let flat = Heightfield::from_fn(lattice(), |_, _| 0.0).unwrap();
        assert_eq!(noise_of(flat).sigma, 0.0);
        let tiny = Heightfield::from_fn(Lattice::new(3, 3, 1.0).unwrap(), |x, _| x).unwrap();
        assert_eq!(Noise::from_input(&tiny.into(), false).unwrap(), None);
    }
}

//! Validation of a penalty by heights that its surface does not know: of several solves, the one whose surface is nearest to these
//! is the best one.
//!
//! The difference between such a height and the surface is the sum of the height's noise and the surface's error. If the two
//! are independent, the expected square is smallest for the surface nearest to the truth, whatever energy it minimises.
//! Noise that is independent from vertex to vertex is unknown to a surface from which the heights are held out. Of noise that
//! neighbours share a surface knows as much, so that a draw of it is added to all heights and taken from them: with as much noise the
//! sum is independent of the difference (data thinning, or the coupled bootstrap; Oliveira, Lei and Tibshirani, 2021).

use oorandom::Rand64;

use super::correlated_noise::blurred_by_means;
use super::curvature_scales::{offsets_within, position, stepped};
use super::noise::{MIN_NOISE_SAMPLES, Noise};
use super::trust::{least_trust, sample};
use crate::error::{Result, try_filled};
use crate::fit::input::Input;
use crate::heights::heightfield::Heightfield;
use crate::lattice::hexagonal::Lattice;

/// Number of classes that the vertices are divided into, one of which is held out. No class has two neighbouring
/// vertices (`benches/scenes.md`, One constant at a time).
const HELD_OUT_CLASSES: usize = 3;

/// Confidence of the mean of the six neighbours that replaces a held-out height, as a share of the largest confidence:
/// large enough that the solve converges fast, too small to change its surface
/// (`benches/scenes.md`, One constant at a time).
const SYNTHETIC_CONFIDENCE_SHARE: f64 = 0.01;

/// Reach of the Gaussian blur by which correlated noise is drawn, in its standard deviations.
const BLUR_REACH: f64 = 3.0;

/// Input of the surfaces that are compared, and heights whose noise it does not have.
#[derive(Debug, Clone)]
pub(crate) struct Validation {
    pub input: Input,
    /// Share of λ that suits the noise of this input, which is larger where a draw was added to it.
    pub lambda_factor: f64,
    /// Vertex index, height and confidence of each of the heights.
    samples: Vec<(usize, f64, f64)>,
}

impl Validation {
    /// Holds out a third of the heights; `None` if fewer than [`MIN_NOISE_SAMPLES`] vertices qualify. A vertex qualifies if
    /// noise is measured from it and it has six known neighbours.
    pub(crate) fn by_held_out_heights(input: &Input) -> Result<Option<Self>> {
        let lattice = *input.field.lattice();
        let mut heights = try_filled("held-out heights", lattice.len(), 0.0)?;
        heights.copy_from_slice(input.field.heights());
        let mut confidence = try_filled("held-out confidence", lattice.len(), 0.0)?;
        for (vertex, value) in confidence.iter_mut().enumerate() {
            *value = input.trust(vertex);
        }
        let largest = confidence.iter().copied().fold(0.0, f64::max);
        let least = least_trust(input);
        let mut samples = Vec::new();
        for row in 0..lattice.rows() {
            for col in (0..lattice.cols()).filter(|col| class_of(row, *col) == 0) {
                let vertex = lattice.index(row, col);
                let known = |v: usize| input.is_given(v) && heights[v].is_finite();
                if sample(input, vertex, least).is_nan() {
                    continue;
                }
                let ring = lattice.neighbours(row, col).map(|n| {
                    n.map(|(row, col)| lattice.index(row, col))
                        .filter(|v| known(*v))
                });
                let [Some(a), Some(b), Some(c), Some(d), Some(e), Some(f)] = ring else {
                    continue;
                };
                samples.push((vertex, heights[vertex], input.weight(vertex)));
                heights[vertex] = [a, b, c, d, e, f].map(|v| heights[v]).iter().sum::<f64>() / 6.0;
                confidence[vertex] = SYNTHETIC_CONFIDENCE_SHARE * largest;
            }
        }
        if samples.len() < MIN_NOISE_SAMPLES {
            return Ok(None);
        }
        let mut input = input.clone();
        input.field = Heightfield::new(lattice, heights)?;
        Ok(Some(Validation {
            input: input.with_confidence(confidence)?,
            lambda_factor: 1.0,
            samples,
        }))
    }

    /// Adds a draw of correlated noise to the heights, and takes it from those that validate; `None` if fewer than
    /// [`MIN_NOISE_SAMPLES`] vertices qualify. `spacings` is the spacing of the input's lattice in those of the lattice whose
    /// noise is known.
    pub(crate) fn by_thinning(input: &Input, noise: Noise, spacings: f64) -> Result<Option<Self>> {
        let lattice = *input.field.lattice();
        let draw = correlated_draw(&lattice, noise, spacings)?;
        let mut heights = try_filled("thinned heights", lattice.len(), 0.0)?;
        heights.copy_from_slice(input.field.heights());
        let least = least_trust(input);
        let mut samples = Vec::new();
        for vertex in (0..lattice.len()).filter(|vertex| !input.is_constrained(*vertex)) {
            if !sample(input, vertex, least).is_nan() {
                let height = heights[vertex] - draw[vertex];
                samples.push((vertex, height, input.weight(vertex)));
            }
            heights[vertex] += draw[vertex];
        }
        if samples.len() < MIN_NOISE_SAMPLES {
            return Ok(None);
        }
        let mut input = input.clone();
        input.field = Heightfield::new(lattice, heights)?;
        Ok(Some(Validation {
            input,
            lambda_factor: 0.5f64.sqrt(),
            samples,
        }))
    }

    /// Squared differences between a surface and the heights that validate it, weighted by their confidence: their sum.
    pub(crate) fn squared_error(&self, surface: &Heightfield) -> f64 {
        let squares = self.samples.iter().map(|(vertex, height, weight)| {
            let miss = surface.heights()[*vertex] - height;
            weight * miss * miss
        });
        squares.sum()
    }
}

/// Draws correlated noise for the vertices of a lattice that was coarsened by means over four vertices: uniform white noise after a
/// Gaussian blur.
fn correlated_draw(lattice: &Lattice, noise: Noise, spacings: f64) -> Result<Vec<f64>> {
    let length = noise.correlation_length * spacings / lattice.spacing();
    let [blur, share] = blurred_by_means(length, spacings);
    let reach = (BLUR_REACH * blur).ceil() as usize;
    let kernel = offsets_within(reach).into_iter().map(|offset| {
        let [x, y] = position(offset);
        (offset, (-0.5 * (x * x + y * y) / (blur * blur)).exp())
    });
    let kernel: Vec<_> = kernel.collect();
    let squares: f64 = kernel.iter().map(|(_, weight)| weight * weight).sum();
    // The standard deviation of uniform noise between -1/2 and 1/2 is 1/√12.
    let unit = noise.sigma * share * (12.0 / squares).sqrt();
    // An even margin, so that rows keep their parity.
    let margin = reach.next_multiple_of(2);
    let [rows, cols] = [lattice.rows(), lattice.cols()].map(|count| count + 2 * margin);
    let mut white = try_filled("white noise", rows * cols, 0.0)?;
    let mut random = Rand64::new(1);
    white.fill_with(|| random.rand_float() - 0.5);
    let mut draw = try_filled("drawn noise", lattice.len(), 0.0)?;
    for (vertex, drawn) in draw.iter_mut().enumerate() {
        let [row, col] = [vertex / lattice.cols(), vertex % lattice.cols()];
        let [row, col] = [row, col].map(|index| (index + margin) as isize);
        let blurred = kernel.iter().map(|(offset, weight)| {
            let (row, col) = stepped(row, col, *offset);
            weight * white[row as usize * cols + col as usize]
        });
        *drawn = unit * blurred.sum::<f64>();
    }
    Ok(draw)
}

/// Returns the class, from 0 to 2, of a vertex in cross-validation. Neighbouring vertices are in different classes.
fn class_of(row: usize, col: usize) -> usize {
    (row / 2 + row + col) % HELD_OUT_CLASSES
}

#[cfg(test)]
mod tests {
    use super::*;

    const NOISE: Noise = Noise {
        sigma: 0.2,
        vertex_sigma: 0.2,
        white_equivalent: 1.0,
        correlation_length: 1.5,
        product: 1.0,
        step: None,
    };

    /// Noise of correlation length ℓ has the correlation `exp(−d²/4ℓ²)` at the distance `d`.
    #[test]
    fn drawn_noise_has_its_size_and_correlation() {
        let lattice = Lattice::new(150, 151, 1.0).unwrap();
        let drawn = correlated_draw(&lattice, NOISE, 1.0).unwrap();
        let mean_of = |pairs: &[(f64, f64)]| {
            pairs.iter().map(|(a, b)| a * b).sum::<f64>() / pairs.len() as f64
        };
        let pairs = |[rows, cols]: [usize; 2]| -> Vec<(f64, f64)> {
            let at = |row: usize, col: usize| drawn[lattice.index(row, col)];
            (0..150 - rows)
                .flat_map(|row| (0..151 - cols).map(move |col| (row, col)))
                .map(|(row, col)| (at(row, col), at(row + rows, col + cols)))
                .collect()
        };
        let variance = mean_of(&pairs([0, 0]));
        assert!(
            (variance.sqrt() / NOISE.sigma - 1.0).abs() < 0.05,
            "{variance}"
        );
        for (offset, distance) in [([0, 1], 1.0), ([0, 3], 3.0), ([2, 0], 3f64.sqrt())] {
            let correlation = mean_of(&pairs(offset)) / variance;
            let known = (-distance * distance / (4.0 * 1.5 * 1.5)).exp();
            assert!(
                (correlation - known).abs() < 0.05,
                "{offset:?} {correlation} {known}"
            );
        }
    }

    /// The heights that validate have twice the variance of the noise about the truth, and four times about the thinned heights, as if
    /// both noises were independent.
    #[test]
    fn a_surface_that_follows_correlated_noise_is_farther_off() {
        let lattice = Lattice::new(150, 151, 1.0).unwrap();
        let truth = Heightfield::from_fn(lattice, |x, y| (0.1 * x).sin() + 0.02 * y).unwrap();
        let wide = Lattice::new(150, 191, 1.0).unwrap();
        let other = correlated_draw(&wide, NOISE, 1.0).unwrap();
        let noisy = (truth.heights().iter().enumerate())
            .map(|(vertex, z)| z + other[wide.index(vertex / 151, 40 + vertex % 151)]);
        let field = Heightfield::new(lattice, noisy.collect()).unwrap();
        let validation = Validation::by_thinning(&Input::new(field), NOISE, 1.0);
        let validation = validation.unwrap().unwrap();
        let variance = |surface: &Heightfield| {
            validation.squared_error(surface) / validation.samples.len() as f64
        };
        let unit = NOISE.sigma.powi(2);
        assert!((variance(&truth) / unit - 2.0).abs() < 0.2);
        assert!((variance(&validation.input.field) / unit - 4.0).abs() < 0.4);
    }

    #[test]
    fn a_third_of_the_inner_vertices_is_held_out_and_no_two_neighbours() {
        let lattice = Lattice::new(30, 31, 1.0).unwrap();
        let field = Heightfield::from_fn(lattice, |x, y| x * y).unwrap();
        let held_out = Validation::by_held_out_heights(&Input::new(field))
            .unwrap()
            .unwrap();
        let is_out = |v: usize| held_out.samples.iter().any(|sample| sample.0 == v);
        for &(vertex, ..) in &held_out.samples {
            let ring = lattice.neighbours(vertex / 31, vertex % 31);
            let ring: Vec<_> = ring.into_iter().flatten().collect();
            assert_eq!(ring.len(), 6);
            assert!(
                !ring
                    .iter()
                    .any(|(row, col)| is_out(lattice.index(*row, *col)))
            );
        }
        let inner = 28 * 29;
        assert!(
            held_out.samples.len().abs_diff(inner / 3) <= 15,
            "{}",
            held_out.samples.len()
        );
    }
}

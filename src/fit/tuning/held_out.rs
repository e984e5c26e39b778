//! Cross-validation by held-out heights: of several solves without them, the one that predicts them best is the best
//! one.
//!
//! The difference between a held-out height and its prediction is the sum of the height's noise and the prediction's
//! error. If the two are independent, the expected square is smallest for the surface nearest to the truth, whatever
//! energy it minimises. They are independent only if noise is independent from vertex to vertex.

use super::noise::MIN_NOISE_SAMPLES;
use super::trust::{least_trust, sample};
use crate::error::{Result, try_filled};
use crate::fit::input::Input;
use crate::heights::heightfield::Heightfield;

/// Number of classes that the vertices are divided into, one of which is held out. No class has two neighbouring
/// vertices (`benches/scenes.md`, One constant at a time).
const HELD_OUT_CLASSES: usize = 3;

/// Confidence of the mean of the six neighbours that replaces a held-out height, as a share of the largest confidence:
/// large enough that the solve converges fast, too small to change its surface
/// (`benches/scenes.md`, One constant at a time).
const SYNTHETIC_CONFIDENCE_SHARE: f64 = 0.01;

/// Input without the heights that are held out, and these heights.
#[derive(Debug, Clone)]
pub(crate) struct HeldOut {
    pub input: Input,
    /// Vertex index, height and confidence of each held-out height.
    samples: Vec<(usize, f64, f64)>,
}

impl HeldOut {
    /// Holds out a third of the heights; `None` if fewer than [`MIN_NOISE_SAMPLES`] vertices qualify. A vertex qualifies if
    /// noise is measured from it and it has six known neighbours.
    pub(crate) fn from_input(input: &Input) -> Result<Option<Self>> {
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
        let input = input.with_confidence(confidence)?;
        Ok(Some(HeldOut { input, samples }))
    }

    /// Squared differences between a surface and the held-out heights, weighted by the heights' confidence: their sum.
    pub(crate) fn squared_error(&self, surface: &Heightfield) -> f64 {
        let squares = self.samples.iter().map(|(vertex, height, weight)| {
            let miss = surface.heights()[*vertex] - height;
            weight * miss * miss
        });
        squares.sum()
    }
}

/// Returns the class, from 0 to 2, of a vertex in cross-validation. Neighbouring vertices are in different classes.
fn class_of(row: usize, col: usize) -> usize {
    (row / 2 + row + col) % HELD_OUT_CLASSES
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lattice::hexagonal::Lattice;

    #[test]
    fn a_third_of_the_inner_vertices_is_held_out_and_no_two_neighbours() {
        let lattice = Lattice::new(30, 31, 1.0).unwrap();
        let field = Heightfield::from_fn(lattice, |x, y| x * y).unwrap();
        let held_out = HeldOut::from_input(&Input::new(field)).unwrap().unwrap();
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

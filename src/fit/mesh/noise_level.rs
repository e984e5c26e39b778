//! Estimate of the noise of a mesh's vertices.

use nalgebra::Vector6;

use super::geometry::{Frame, Point};
use super::topology::Topology;
use crate::math::least_squares::LeastSquares;
use crate::math::statistics::{MAD_TO_SIGMA, median};

/// Minimum number of vertices from which the noise of a mesh is estimated.
const MIN_NOISE_SAMPLES: usize = 50;

/// Maximum number of vertices from which the noise of a mesh is estimated: more do not make the estimate better.
const MAX_NOISE_SAMPLES: usize = 20_000;

/// Estimates the standard deviation of a mesh's noise along the normals of the base, from the median distance of a vertex
/// to the quadratic fitted to those around it, so that creases do not count; `None` if there are too few samples.
/// Positions across the normals are those given, because smoothing moves irregular vertices along the surface.
pub(super) fn noise(
    topology: &Topology,
    base: &[Point],
    frames: &[Frame],
    noisy: &[Point],
) -> Option<f64> {
    let inside = topology.vertices_inside();
    let step = inside.clone().count().div_ceil(MAX_NOISE_SAMPLES).max(1);
    let mut second = Vec::new();
    let mut samples = Vec::new();
    for vertex in inside.step_by(step) {
        let frame = &frames[vertex];
        let off = |other: usize| frame.normal.dot(&(noisy[other] - base[vertex]));
        topology.second_ring(vertex, &mut second);
        let all = topology
            .around(vertex)
            .iter()
            .chain(&second)
            .map(|other| *other as usize);
        let scale = topology.mean_edge_length(base, vertex);
        let mut quadratic = LeastSquares::<6>::new();
        for other in all {
            let [x, y, _] = frame.coordinates((noisy[other] - noisy[vertex]) / scale);
            let q = Vector6::new(1.0, x, y, x * x, x * y, y * y);
            quadratic.add(&q, [off(other)], 1.0);
        }
        // The variance of the prediction, in units of the noise's, is the constant term's entry of the inverse.
        let Some(inverse) = quadratic.factor().map(|factor| factor.inverse()) else {
            continue;
        };
        let predicted = (inverse * quadratic.right)[0];
        let sample = (off(vertex) - predicted).abs() / (1.0 + inverse[(0, 0)]).sqrt();
        if sample.is_finite() {
            samples.push(sample);
        }
    }
    if samples.len() < MIN_NOISE_SAMPLES {
        return None;
    }
    Some(MAD_TO_SIGMA * median(&mut samples)?)
}

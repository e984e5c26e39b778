//! Estimate of the noise of a mesh's vertices, and of the smoothing that it asks for.

use nalgebra::Vector6;

use super::base::first_base;
use super::geometry::{Frame, Point, areas};
use super::input::MeshInput;
use super::linearisation::hexagonal_spacing;
use super::topology::Topology;
use crate::fit::tuning::noise::MIN_NOISE_SAMPLES;
use crate::math::least_squares::LeastSquares;
use crate::math::statistics::{MAD_TO_SIGMA, median};

/// Maximum number of vertices from which the noise of a mesh is estimated: more do not make the estimate better.
const MAX_NOISE_SAMPLES: usize = 20_000;

/// Largest noise, in spacings, at which vertices are taken to be, across the normals, where they are given: more of it, as along a
/// scanner's view, is itself across the normals (`benches/whole.md`, Noise of several spacings).
const MAX_PLACE_NOISE_SPACINGS: f64 = 0.5;

/// Maximum number of times that the base is smoothed as usual (`benches/whole.md`, Noise of several spacings).
const MAX_BASE_REPEATS: usize = 64;

/// Noise of a mesh's vertices, as the base of the first linearisation shows it.
pub(super) struct MeshNoise {
    /// Standard deviation along the normals; `None` if it is not known.
    pub sigma: Option<f64>,
    /// Spacing of a hexagonal lattice of as many vertices.
    pub spacing: f64,
    /// Number of times that the base is smoothed as usual: at least as many as the noise has spacings, since of noise that is
    /// larger the normals of the base are random, and λ, which follows from what is left, keeps all of it.
    pub base_repeats: usize,
}

impl MeshNoise {
    /// Measures the noise of a mesh, which is 0 where the mesh `is_exact`.
    pub(super) fn of(given: &MeshInput, is_exact: bool) -> Self {
        let mut base_repeats = 1;
        loop {
            let (base, frames) = first_base(given, base_repeats);
            let spacing = mean_spacing(&given.topology, &base);
            let by = |places| noise(&given.topology, &base, &frames, &given.noisy, places);
            // Smoothing moves irregular vertices along the surface, which counts where the noise is small.
            let sigma = match is_exact {
                true => Some(0.0),
                false => match by(&given.noisy) {
                    Some(sigma) if sigma > MAX_PLACE_NOISE_SPACINGS * spacing => by(&base),
                    sigma => sigma,
                },
            };
            let is_smooth = sigma.is_none_or(|sigma| sigma <= base_repeats as f64 * spacing);
            if is_smooth || base_repeats >= MAX_BASE_REPEATS {
                return MeshNoise {
                    sigma,
                    spacing,
                    base_repeats,
                };
            }
            base_repeats *= 2;
        }
    }
}

/// Computes the spacing of a hexagonal lattice whose vertices have the mean area of those inside, or of all if none is.
pub(super) fn mean_spacing(topology: &Topology, x: &[Point]) -> f64 {
    let own = areas(topology, x);
    let mut inside: Vec<usize> = topology.vertices_inside().collect();
    if inside.is_empty() {
        inside.extend(0..own.len());
    }
    let total: f64 = inside.iter().map(|vertex| own[*vertex]).sum();
    hexagonal_spacing(total / inside.len() as f64)
}

/// Estimates the standard deviation of a mesh's noise along the normals of the base, from the median distance of a vertex
/// to the quadratic fitted to those around it, so that creases do not count; `None` if there are too few samples.
/// `places` are the vertices' positions across the normals.
fn noise(
    topology: &Topology,
    base: &[Point],
    frames: &[Frame],
    noisy: &[Point],
    places: &[Point],
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
            let [x, y, _] = frame.coordinates((places[other] - places[vertex]) / scale);
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

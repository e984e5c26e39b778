//! What is done to true heights, the same on every run.

use std::fmt;

use developable::Heightfield;

/// Sizes are shares of the height range.
#[derive(Debug, Clone, Copy)]
pub enum Noise {
    /// Independent from vertex to vertex.
    White(f64),
    /// Smoothed over about a cell, as that of depth cameras is.
    Correlated(f64),
    /// Rounded to one of many levels, which are so far apart.
    Voxels(f64),
}

impl fmt::Display for Noise {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Noise::White(share) => write!(f, "white, {} %", 100.0 * share),
            Noise::Correlated(share) => write!(f, "correlated, {} %", 100.0 * share),
            Noise::Voxels(share) => write!(f, "voxels, {} %", 100.0 * share),
        }
    }
}

/// Where the levels lie, as a share of the step: no plane that a scene is made of lies in one.
const LEVEL: f64 = 0.37;

/// How often correlated noise is averaged with its neighbours'.
const SMOOTHING: usize = 4;

impl Noise {
    /// Standard deviation.
    pub fn sigma(self, truth: &Heightfield) -> f64 {
        match self {
            Noise::White(share) | Noise::Correlated(share) => share * range(truth),
            Noise::Voxels(share) => share * range(truth) / 12f64.sqrt(),
        }
    }

    pub fn add_to(self, truth: &Heightfield) -> developable::Result<Heightfield> {
        let lattice = *truth.lattice();
        let sigma = self.sigma(truth);
        let heights = truth.heights().iter();
        let heights = match self {
            Noise::Voxels(share) => {
                let step = share * range(truth);
                heights
                    .map(|z| ((z / step + LEVEL).round() - LEVEL) * step)
                    .collect()
            }
            Noise::White(_) => {
                let noise = normal(lattice.len());
                heights.zip(noise).map(|(z, n)| z + sigma * n).collect()
            }
            Noise::Correlated(_) => {
                let mut noise = normal(lattice.len());
                for _ in 0..SMOOTHING {
                    smooth(truth, &mut noise);
                }
                let squares: f64 = noise.iter().map(|n| n * n).sum();
                let factor = sigma / (squares / noise.len() as f64).sqrt();
                heights.zip(noise).map(|(z, n)| z + factor * n).collect()
            }
        };
        Heightfield::new(lattice, heights)
    }
}

/// Of a plane, too, something.
fn range(truth: &Heightfield) -> f64 {
    let valid = || truth.heights().iter().filter(|z| !z.is_nan());
    let highest = valid().fold(f64::NEG_INFINITY, |a, b| a.max(*b));
    let lowest = valid().fold(f64::INFINITY, |a, b| a.min(*b));
    (highest - lowest).max(0.05)
}

/// Normally distributed numbers: the Box–Muller transform of a linear congruential generator's.
fn normal(count: usize) -> Vec<f64> {
    let mut state: u64 = 82;
    let mut uniform = || {
        state = state
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        ((state >> 11) as f64 + 0.5) / (1u64 << 53) as f64
    };
    // The first ones are much alike for seeds that are.
    (0..10).for_each(|_| {
        uniform();
    });
    let mut next = || {
        let radius = (-2.0 * uniform().ln()).sqrt();
        radius * (std::f64::consts::TAU * uniform()).cos()
    };
    (0..count).map(|_| next()).collect()
}

/// The mean over each vertex (weight 2) and its neighbours.
fn smooth(field: &Heightfield, values: &mut [f64]) {
    let lattice = field.lattice();
    let old = values.to_vec();
    for (i, value) in values.iter_mut().enumerate() {
        let ring = lattice.neighbours(i / lattice.cols(), i % lattice.cols());
        let ring = ring
            .into_iter()
            .flatten()
            .map(|(row, col)| old[lattice.index(row, col)]);
        let (sum, weight) = ring.fold((2.0 * old[i], 2.0), |(s, n), x| (s + x, n + 1.0));
        *value = sum / weight;
    }
}

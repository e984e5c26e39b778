//! What several integration tests share.
#![allow(dead_code)] // each test uses a part of it

pub mod conic;
#[cfg(feature = "formats")]
pub mod files;
pub mod irregular;

use developable::{Heightfield, Lattice};

/// Reproducible random numbers, by a 64-bit linear congruential generator, whose upper bits are good enough.
pub struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Self {
        Random(seed)
    }

    /// For seeds that are next to each other, whose first numbers would be alike.
    pub fn spread(seed: u64) -> Self {
        Random(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15).wrapping_add(1))
    }

    /// A random number of at most as many bits.
    pub fn bits(&mut self, count: u32) -> u64 {
        self.0 = self
            .0
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        self.0 >> (u64::BITS - count)
    }

    /// Uniform from 0 to 1, exclusive.
    pub fn uniform(&mut self) -> f64 {
        self.bits(53) as f64 / (1u64 << 53) as f64
    }

    /// Uniform from −1 to 1.
    pub fn sample(&mut self) -> f64 {
        2.0 * self.uniform() - 1.0
    }

    /// Nearly normally distributed, of variance 1, by the central limit theorem.
    pub fn sum_of_twelve(&mut self) -> f64 {
        (0..12).map(|_| self.sample()).sum::<f64>() / 2.0
    }

    /// Normally distributed, of variance 1.
    pub fn normal(&mut self) -> f64 {
        (-2.0 * (1.0 - self.uniform()).ln()).sqrt() * (std::f64::consts::TAU * self.uniform()).cos()
    }
}

/// The lattice over the unit square with about `cols` columns, centred heights from `f`.
pub fn unit_square(cols: usize, f: impl Fn(f64, f64) -> f64) -> Heightfield {
    let lattice = Lattice::covering([0.0, 0.0], [1.0, 1.0], 1.0 / cols as f64).unwrap();
    Heightfield::from_fn(lattice, f).unwrap()
}

/// The field with noise of the given amplitude.
pub fn noisy(field: &Heightfield, amplitude: f64, seed: u64) -> Heightfield {
    let mut noise = Random::new(seed);
    let heights = field.heights().iter();
    let heights = heights.map(|z| z + amplitude * noise.sample()).collect();
    Heightfield::new(*field.lattice(), heights).unwrap()
}

/// The field without the vertices where `keep` is false.
pub fn cut(field: &Heightfield, keep: impl Fn(f64, f64) -> bool) -> Heightfield {
    let lattice = *field.lattice();
    let heights = field.heights().iter().enumerate().map(|(i, height)| {
        let [x, y] = lattice.position(i / lattice.cols(), i % lattice.cols());
        if keep(x, y) { *height } else { f64::NAN }
    });
    Heightfield::new(lattice, heights.collect()).unwrap()
}

/// Bumps with a crease.
pub fn bumps(x: f64, y: f64) -> f64 {
    0.15 * (5.0 * x + 1.0).sin() * (4.0 * y).cos() + 0.2 * (x - 0.4).abs()
}

/// Noise over bumps with a sharper crease, a hole in the middle of them.
pub fn ring(cols: usize, seed: u64) -> Heightfield {
    let sharper = |x: f64, y: f64| bumps(x, y) + 0.2 * (x - 0.4).abs();
    cut(&noisy(&unit_square(cols, sharper), 0.02, seed), |x, y| {
        (x - 0.45).hypot(y - 0.55) > 0.17
    })
}

/// Largest absolute difference where both have a height.
pub fn max_difference(a: &Heightfield, b: &Heightfield) -> f64 {
    let pairs = a.heights().iter().zip(b.heights());
    pairs
        .filter(|(a, b)| !a.is_nan() && !b.is_nan())
        .map(|(a, b)| (a - b).abs())
        .fold(0.0, f64::max)
}

/// Root mean square of the difference where both have a height.
pub fn rms_difference(a: &Heightfield, b: &Heightfield) -> f64 {
    let pairs = a.heights().iter().zip(b.heights());
    let squares: Vec<f64> = pairs
        .filter(|(a, b)| !a.is_nan() && !b.is_nan())
        .map(|(a, b)| (a - b).powi(2))
        .collect();
    (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
}

/// A place, and where what is there belongs.
pub type Pair = ([f64; 2], [f64; 2]);

/// The root of the mean square of what is left of the distances between pairs after turning, scaling and
/// shifting the first ones: regression of complex numbers.
pub fn similarity(pairs: &[Pair]) -> f64 {
    let n = pairs.len() as f64;
    let (mut from, mut to) = ([0.0; 2], [0.0; 2]);
    for (p, q) in pairs {
        for k in 0..2 {
            from[k] += p[k] / n;
            to[k] += q[k] / n;
        }
    }
    let (mut re, mut im, mut pp, mut qq) = (0.0, 0.0, 0.0, 0.0);
    for (p, q) in pairs {
        let [a, b] = [p[0] - from[0], p[1] - from[1]];
        let [c, d] = [q[0] - to[0], q[1] - to[1]];
        re += a * c + b * d;
        im += a * d - b * c;
        pp += a * a + b * b;
        qq += c * c + d * d;
    }
    ((qq - (re * re + im * im) / pp).max(0.0) / n).sqrt()
}

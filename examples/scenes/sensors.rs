//! What sensors do to the pixels of a height image, the same on every run.

use std::f64::consts::PI;

use oorandom::Rand64;

/// Names of the sensors' faults; shares are of the height range.
pub const NAMES: [&str; 17] = [
    "white 0.3 %",
    "white 1 %",
    "white 3 %",
    "kinect",
    "blurred 1.6",
    "blurred 2.5",
    "blurred 4",
    "lines",
    "rows",
    "interlaced",
    "impulses and dropouts",
    "8 bit",
    "JPEG",
    "flying pixels",
    "saturated",
    "missing blocks",
    "stitched",
];

/// Square image of heights, in rows.
struct Pixels {
    size: usize,
    random: Rand64,
    range: f64,
}

/// Adds a fault to the true heights of a square image; a missing height is NaN.
pub fn spoil(name: &str, truth: &[f64], seed: u64) -> Vec<f64> {
    let known = || truth.iter().copied();
    let [low, high] = [
        known().fold(f64::INFINITY, f64::min),
        known().fold(f64::NEG_INFINITY, f64::max),
    ];
    let mut pixels = Pixels {
        size: truth.len().isqrt(),
        random: Rand64::new(u128::from(seed) + 17),
        range: high - low,
    };
    let (size, range) = (pixels.size, pixels.range);
    let mut z = truth.to_vec();
    match name {
        "white 0.3 %" => pixels.add_white(&mut z, 0.003),
        "white 1 %" => pixels.add_white(&mut z, 0.01),
        "white 3 %" => pixels.add_white(&mut z, 0.03),
        "kinect" => {
            for height in &mut z {
                let depth = 1.0 + 1.5 * (high - *height) / range;
                // Disparity in steps of a thousandth, with noise.
                let disparity = 1.0 / depth + 0.002 * pixels.normal();
                let disparity = (1000.0 * disparity).round() / 1000.0;
                *height = high - range * (1.0 / disparity - 1.0) / 1.5;
            }
        }
        "blurred 1.6" => pixels.add_blurred(&mut z, [1.6, 1.6]),
        "blurred 2.5" => pixels.add_blurred(&mut z, [2.5, 2.5]),
        "blurred 4" => pixels.add_blurred(&mut z, [4.0, 4.0]),
        "lines" => pixels.add_blurred(&mut z, [3.0, 0.0]),
        "rows" => {
            pixels.add_white(&mut z, 0.001);
            for row in z.chunks_mut(size) {
                let offset = 0.01 * range * pixels.normal();
                row.iter_mut().for_each(|height| *height += offset);
            }
        }
        "interlaced" => {
            pixels.add_white(&mut z, 0.003);
            for row in z.chunks_mut(size).skip(1).step_by(2) {
                row.iter_mut().for_each(|height| *height += 0.01 * range);
            }
        }
        "impulses and dropouts" => {
            pixels.add_white(&mut z, 0.003);
            for height in &mut z {
                let [kind, value] = [(); 2].map(|()| pixels.random.rand_float());
                match kind {
                    kind if kind < 0.02 => *height = low + range * (1.6 * value - 0.3),
                    kind if kind < 0.12 => *height = f64::NAN,
                    _ => (),
                }
            }
        }
        "8 bit" => z.iter_mut().for_each(|height| {
            *height = low + range * (255.0 * (*height - low) / range).round() / 255.0
        }),
        "JPEG" => jpeg(&mut z, size, low, range),
        "flying pixels" => {
            pixels.add_white(&mut z, 0.003);
            let noisy = z.clone();
            for row in 1..size - 1 {
                for col in 1..size - 1 {
                    let at = row * size + col;
                    let other =
                        [at - 1, at + 1, at - size, at + size]
                            .into_iter()
                            .max_by(|a, b| {
                                f64::total_cmp(
                                    &(truth[*a] - truth[at]).abs(),
                                    &(truth[*b] - truth[at]).abs(),
                                )
                            });
                    let other = other.unwrap_or(at);
                    if (truth[other] - truth[at]).abs() > 0.1 * range
                        && pixels.random.rand_float() < 0.5
                    {
                        let share = pixels.random.rand_float();
                        z[at] = noisy[at] + share * (noisy[other] - noisy[at]);
                    }
                }
            }
        }
        "saturated" => {
            pixels.add_white(&mut z, 0.003);
            let top = high - 0.06 * range;
            z.iter_mut().for_each(|height| *height = height.min(top));
        }
        "missing blocks" => {
            pixels.add_white(&mut z, 0.01);
            for _ in 0..6 {
                let [row, col] =
                    [(); 2].map(|()| pixels.random.rand_range(0..size as u64 - 8) as usize);
                for (r, c) in (0..8).flat_map(|r| (0..8).map(move |c| (r, c))) {
                    z[(row + r) * size + col + c] = f64::NAN;
                }
            }
        }
        _ => {
            let mut loud = truth.to_vec();
            pixels.add_white(&mut z, 0.003);
            pixels.add_white(&mut loud, 0.01);
            for (i, height) in z.iter_mut().enumerate() {
                if i % size >= size / 2 {
                    *height = loud[i] + 0.005 * range;
                }
            }
        }
    }
    z
}

impl Pixels {
    fn normal(&mut self) -> f64 {
        let [a, b] = [(); 2].map(|()| self.random.rand_float().max(1e-300));
        (-2.0 * a.ln()).sqrt() * (2.0 * PI * b).cos()
    }

    fn add_white(&mut self, z: &mut [f64], share: f64) {
        for height in z {
            *height += share * self.range * self.normal();
        }
    }

    /// White noise after a Gaussian blur along rows and across them, of 1 %.
    fn add_blurred(&mut self, z: &mut [f64], [along, across]: [f64; 2]) {
        let size = self.size as isize;
        let white: Vec<f64> = z.iter().map(|_| self.normal()).collect();
        let pass = |values: &[f64], blur: f64, [down, right]: [isize; 2]| -> Vec<f64> {
            let reach = (3.5 * blur).ceil() as isize;
            let weight = |step: isize| (-0.5 * (step as f64 / blur.max(1e-9)).powi(2)).exp();
            let at = |i: isize, step: isize| {
                let [row, col] = [(i / size + step * down), (i % size + step * right)]
                    .map(|k| k.rem_euclid(size));
                values[(row * size + col) as usize]
            };
            let sum = |i| {
                (-reach..=reach)
                    .map(|step| weight(step) * at(i, step))
                    .sum()
            };
            (0..size * size).map(sum).collect()
        };
        let noise = pass(&pass(&white, along, [0, 1]), across, [1, 0]);
        let rms = (noise.iter().map(|n| n * n).sum::<f64>() / noise.len() as f64).sqrt();
        z.iter_mut()
            .zip(noise)
            .for_each(|(z, n)| *z += 0.01 * self.range * n / rms);
    }
}

/// Rounds to 8 bits, and the coefficients of tiles of 8 × 8 pixels as JPEG does at a quality of 85.
fn jpeg(z: &mut [f64], size: usize, low: f64, range: f64) {
    let scale = |u: usize| if u == 0 { (1.0f64 / 8.0).sqrt() } else { 0.5 };
    let wave = |x: usize, u: usize| scale(u) * (PI * (2 * x + 1) as f64 * u as f64 / 16.0).cos();
    // The standard table grows about as 12 + 7 (u + v); a quality of 85 takes three tenths of it.
    let step = |u: usize, v: usize| (0.3 * (12.0 + 7.0 * (u + v) as f64)).round();
    let byte = |height: f64| (255.0 * (height - low) / range).round();
    for (top, left) in (0..size / 8).flat_map(|r| (0..size / 8).map(move |c| (8 * r, 8 * c))) {
        let index = |r: usize, c: usize| (top + r) * size + left + c;
        let cells = || (0..8).flat_map(|a| (0..8).map(move |b| (a, b)));
        let mut coefficients = [[0.0; 8]; 8];
        for (u, v) in cells() {
            let sum: f64 = cells()
                .map(|(r, c)| byte(z[index(r, c)]) * wave(r, u) * wave(c, v))
                .sum();
            coefficients[u][v] = (sum / step(u, v)).round() * step(u, v);
        }
        for (r, c) in cells() {
            let sum: f64 = cells()
                .map(|(u, v)| coefficients[u][v] * wave(r, u) * wave(c, v))
                .sum();
            z[index(r, c)] = low + range * sum.round().clamp(0.0, 255.0) / 255.0;
        }
    }
}

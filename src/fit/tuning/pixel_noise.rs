//! Noise of an image's pixels, from that of the heights that were resampled from them.
//!
//! A vertex between pixels has a mean of their heights, so that its noise is smaller and smoother. What that does to noise
//! of the covariance `σ² exp(−d²/4ℓ²)` follows from the weights of the bilinear interpolation, whose two axes are
//! independent.

use super::noise::{Noise, ring_noise};
use crate::error::Result;
use crate::fit::input::Input;
use crate::heights::heightfield::HeightImage;

/// Number of rows and columns of pixels of white noise by which the noise of rings is calibrated, to 1 %.
const CALIBRATION_PIXELS: usize = 120;

/// Seed of the white noise by which the noise of rings is calibrated.
const CALIBRATION_SEED: u128 = 1;

/// Range of spacings, in pixels, at which the noise of rings is calibrated: vertices farther apart share no pixels, and
/// closer ones have no noise that rings show.
const CALIBRATED_SPACINGS: [f64; 2] = [0.4, 2.5];

/// Noise of an image that was resampled to the lattice.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PixelNoise {
    /// Standard deviation of the pixels' noise, in the user's unit of height.
    pub sigma: f64,
    /// Correlation length of the pixels' noise, in the user's unit of length.
    pub correlation_length: f64,
    /// Standard deviation of the vertices' noise, in the user's unit of height.
    pub vertex_sigma: f64,
}

impl PixelNoise {
    /// The noise of pixels of the given size, of which the resampled heights of `input` have `noise`.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub(crate) fn of(input: &Input, noise: &Noise, pixel_size: f64) -> Result<Self> {
        let spacing = input.field.lattice().spacing() / pixel_size;
        let blur = mean_blur(spacing);
        if !noise.is_correlated() {
            let shown = white_ring_noise(spacing)?;
            let sigma = noise.sigma / shown;
            return Ok(PixelNoise {
                sigma,
                correlation_length: 0.0,
                vertex_sigma: sigma * vertex_share(blur, 0.0),
            });
        }
        let length = noise.correlation_length / pixel_size;
        let length = (length * length - (blur[0] + blur[1]) / 2.0)
            .max(0.0)
            .sqrt();
        Ok(PixelNoise {
            sigma: noise.sigma / vertex_share(blur, length),
            correlation_length: length * pixel_size,
            vertex_sigma: noise.sigma,
        })
    }
}

/// Noise that rings of six vertices show of white noise of pixels with standard deviation 1; `spacing` is in pixels.
fn white_ring_noise(spacing: f64) -> Result<f64> {
    let [least, largest] = CALIBRATED_SPACINGS;
    let mut random = oorandom::Rand64::new(CALIBRATION_SEED);
    // A sum of twelve uniform values is nearly normal, with a variance of 1.
    let mut normal = || (0..12).map(|_| random.rand_float() - 0.5).sum::<f64>();
    let pixels = (0..CALIBRATION_PIXELS.pow(2)).map(|_| normal()).collect();
    let image = HeightImage::new(CALIBRATION_PIXELS, CALIBRATION_PIXELS, pixels)?;
    let field = image.to_lattice(Some(spacing.clamp(least, largest)))?;
    Ok(ring_noise(&Input::new(field)).unwrap_or(1.0))
}

/// Mean of `f (1 − f)` over a lattice's columns and rows, where `f` is the position of a vertex between two pixels: the
/// variance of the positions of the pixels from which it has its height, in squares of a pixel.
fn mean_blur(spacing: f64) -> [f64; 2] {
    let mean = |step: f64| {
        let places = (0..CALIBRATION_PIXELS).map(|k| (k as f64 * step).fract());
        places.map(|f| f * (1.0 - f)).sum::<f64>() / CALIBRATION_PIXELS as f64
    };
    // Every other row lies half a spacing aside.
    [mean(0.5 * spacing), mean(0.75f64.sqrt() * spacing)]
}

/// Standard deviation of the vertices' noise, where that of the pixels is 1 and the correlation length is in pixels.
fn vertex_share(blur: [f64; 2], length: f64) -> f64 {
    let neighbours = if length > 0.0 {
        (-0.25 / (length * length)).exp()
    } else {
        0.0
    };
    blur.map(|blur| 1.0 - 2.0 * blur * (1.0 - neighbours))
        .into_iter()
        .product::<f64>()
        .sqrt()
}

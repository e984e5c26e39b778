//! Height images of the examples, with and without noise.

use std::f64::consts::TAU;

use super::example::Example;
use super::shapes::Shape;
use crate::error::{Error, Result, try_filled};
use crate::heights::heightfield::HeightImage;

impl Example {
    /// Generates height images of the example, with and without noise.
    ///
    /// The noise is Gaussian, independent from pixel to pixel and the same for
    /// the same seed on every machine, but for rounding.
    /// Costs `O(size²)`.
    ///
    /// # Errors
    /// [`Error::Option`] unless `size` is 8 to 4096 and `noise` finite and not negative.
    pub fn generate(self, options: &ExampleOptions) -> Result<Sample> {
        let &ExampleOptions { size, noise, seed } = options;
        if !(8..=4096).contains(&size) {
            return Err(Error::option("size", size, "must be from 8 to 4096 pixels"));
        }
        if !(noise.is_finite() && noise >= 0.0) {
            return Err(Error::option(
                "noise",
                noise,
                "must be a finite number, 0 or above",
            ));
        }
        let truth = self.truth(size)?;
        let range = range(truth.values());
        let mut gauss = Gauss::new(seed);
        let mut values = try_filled("height image", truth.values().len(), f64::NAN)?;
        for (noisy, z) in values.iter_mut().zip(truth.values()) {
            *noisy = z + noise * range * gauss.next();
        }
        let input = HeightImage::new(truth.width(), truth.height(), values)?
            .with_pixel_size(truth.pixel_size())?;
        Ok(Sample { input, truth })
    }

    fn truth(self, size: usize) -> Result<HeightImage> {
        let shape = Shape::of(self);
        let pixel_size = 1.0 / size as f64;
        let [width, height] = shape
            .extent
            .map(|side| (side * size as f64).round() as usize);
        let mut values = try_filled("height image", width * height, f64::NAN)?;
        for (i, z) in values.iter_mut().enumerate() {
            // Positions from the middle of the image, so that symmetries are exact.
            let x = (i % width) as f64 - 0.5 * (width - 1) as f64;
            let y = 0.5 * (height - 1) as f64 - (i / width) as f64;
            *z = (shape.height)(x * pixel_size, y * pixel_size);
        }
        HeightImage::new(width, height, values)?.with_pixel_size(pixel_size)
    }
}

/// Options for generating an [`Example`]: size and noise.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Deserialize),
    serde(default, rename_all = "camelCase", deny_unknown_fields)
)]
pub struct ExampleOptions {
    /// Number of pixels along the image's longer side, 8 to 4096. Default 200.
    pub size: usize,
    /// Standard deviation of the noise, as a share of the example's height range. Default 0.02.
    pub noise: f64,
    /// Seed of the random numbers for the noise. Default 1.
    pub seed: u32,
}

impl Default for ExampleOptions {
    fn default() -> Self {
        ExampleOptions {
            size: 200,
            noise: 0.02,
            seed: 1,
        }
    }
}

/// Heights of a generated [`Example`]: with noise, and exact. The longer side of the images is 1 in the unit of pixel
/// size and heights.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Sample {
    /// Noisy heights; NaN outside of the shape.
    pub input: HeightImage,
    /// Exact heights at the same pixels.
    pub truth: HeightImage,
}

/// Range of the values without NaN: maximum minus minimum.
fn range(values: &[f64]) -> f64 {
    let valid = || values.iter().copied().filter(|z| !z.is_nan());
    valid().fold(f64::NEG_INFINITY, f64::max) - valid().fold(f64::INFINITY, f64::min)
}

/// Generator of normally distributed random numbers: Box–Muller transform of uniform numbers from a PCG generator.
struct Gauss {
    random: oorandom::Rand32,
    spare: Option<f64>,
}

impl Gauss {
    fn new(seed: u32) -> Self {
        Gauss {
            random: oorandom::Rand32::new(seed.into()),
            spare: None,
        }
    }

    fn next(&mut self) -> f64 {
        if let Some(spare) = self.spare.take() {
            return spare;
        }
        // Strictly between 0 and 1, so that the logarithm is finite.
        let mut uniform = || (f64::from(self.random.rand_u32()) + 0.5) / 4_294_967_296.0;
        let radius = (-2.0 * uniform().ln()).sqrt();
        let (sin, cos) = (TAU * uniform()).sin_cos();
        self.spare = Some(radius * sin);
        radius * cos
    }
}

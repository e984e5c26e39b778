//! Cleaning of flat pages for reading: even light on white paper, and black and white for print.
//!
//! [`PageLight`] estimates the light on the paper and divides it out; [`binarise`] decides for each pixel between ink
//! and paper. [`clean`] does both in one image.

mod binarisation;
mod fill;
mod page_light;
mod paper;

pub use binarisation::binarise;
pub use page_light::{LightEstimator, PageLight};

use crate::error::{Result, check_photo, try_filled};

/// What happens to the light on a flat page.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(rename = "LightTreatment", rename_all = "camelCase")
)]
pub enum Light {
    /// The light is evened: paper becomes white, shadows and the lamp's colour disappear, colours of print stay.
    #[default]
    Even,
    /// The light stays as it was photographed.
    Keep,
}

/// Options of cleaning a flat page.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
pub struct CleaningOptions {
    /// What happens to the light. Default: it is evened.
    pub light: Light,
    /// Whether the page becomes black and white, for print; the light is evened before. Default: false.
    pub ink: bool,
}

impl CleaningOptions {
    /// Sets what happens to the light, and returns the options.
    pub fn light(self, light: Light) -> Self {
        CleaningOptions { light, ..self }
    }

    /// Sets whether the page becomes black and white, and returns the options.
    pub fn ink(self, ink: bool) -> Self {
        CleaningOptions { ink, ..self }
    }

    /// Whether the light on the page has to be estimated.
    pub fn needs_light(&self) -> bool {
        self.ink || self.light == Light::Even
    }
}

/// Cleans a flat page in place and returns what happened to its light. `rgba` has four bytes for each pixel, row by row
/// from the top; transparent pixels are no part of the page. A page that is dark or not mostly paper keeps its light. Costs
/// `O(pixels)`.
///
/// # Errors
/// [`Error::Shape`](crate::Error::Shape) if there are not `4 · width · height` bytes,
/// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
pub fn clean(
    width: usize,
    height: usize,
    rgba: &mut [u8],
    options: &CleaningOptions,
) -> Result<Light> {
    check_photo("flat page", height, width, rgba.len() / 4)?;
    if !options.needs_light() {
        return Ok(Light::Keep);
    }
    let line = 4 * width;
    let mut estimator = LightEstimator::new(width, height)?;
    for (row, pixels) in rgba.chunks_exact(line).enumerate() {
        estimator.add_row(row, pixels);
    }
    let light = estimator.finish();
    for (row, pixels) in rgba.chunks_exact_mut(line).enumerate() {
        light.apply(row, pixels);
    }
    if options.ink {
        let mut plane = try_filled("flat page", width * height, 0)?;
        for (value, pixel) in plane.iter_mut().zip(rgba.as_chunks().0) {
            *value = light.luminance(pixel);
        }
        binarise(width, height, &mut plane)?;
        for (value, pixel) in plane.iter().zip(rgba.as_chunks_mut::<4>().0) {
            pixel[..3].fill(*value);
        }
    }
    Ok(light.kind())
}

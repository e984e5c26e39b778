//! A wasm crate of one's own: `wasm-pack build` makes an npm package of it, `wasm-pack test --node` runs its test.

use developable::{HeightImage, Options, fit};
use wasm_bindgen::prelude::*;

/// Heights of the piecewise-developable surface that fits an image of heights, row by row.
///
/// # Errors
/// What [`fit`] refuses, as a JavaScript `Error`.
#[wasm_bindgen]
pub fn smooth(width: usize, height: usize, heights: Vec<f64>) -> Result<Vec<f64>, JsError> {
    let image = HeightImage::new(width, height, heights)?;
    let surface = fit(&image.to_lattice(None)?, &Options::default())?;
    Ok(surface.heightfield().to_image(&image)?.values().to_vec())
}

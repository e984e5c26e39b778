//! Example surfaces with known shape, generated for JavaScript.

use js_sys::Float64Array;
use serde::Serialize;
use serde_wasm_bindgen::{preserve, to_value};
use wasm_bindgen::prelude::*;

use super::results::ImageOutput;
use developable::{Example, ExampleOptions};
use developable_wasm::Result;
use developable_wasm::options::read;

/// A generated example: a height image with noise, and the true heights.
#[derive(Serialize)]
struct ExampleOutput {
    /// The height image with noise, to be fitted.
    input: ImageOutput,
    /// Heights of the surface without noise at the same pixels, row by row.
    #[serde(with = "preserve")]
    truth: Float64Array,
}

/// Generates an example surface by its name; returns JavaScript's `Example` object.
#[wasm_bindgen]
pub fn example(name: &str, options: JsValue) -> Result<JsValue> {
    let settings: ExampleOptions = read(&options)?;
    let sample = name.parse::<Example>()?.generate(&settings)?;
    Ok(to_value(&ExampleOutput {
        input: ImageOutput::from(&sample.input),
        truth: sample.truth.values().into(),
    })?)
}

//! The procedural examples.

use js_sys::Float64Array;
use serde::Serialize;
use serde_wasm_bindgen::{preserve, to_value};
use wasm_bindgen::prelude::*;

use super::results::ImageOutput;
use developable::{Example, ExampleOptions};
use developable_wasm::Result;
use developable_wasm::options::{entries, option, unknown};

/// `Example` of `types.d.ts`.
#[derive(Serialize)]
struct ExampleOutput {
    input: ImageOutput,
    #[serde(with = "preserve")]
    truth: Float64Array,
}

/// One of the examples.
#[wasm_bindgen]
pub fn example(name: JsValue, options: JsValue) -> Result<JsValue> {
    let name: String = option("example", name, "must be the name of an example")?;
    let mut settings = ExampleOptions::default();
    for (name, value) in entries(&options)? {
        match name.as_str() {
            "size" => settings.size = option("size", value, "must be a whole number")?,
            "noise" => settings.noise = option("noise", value, "must be a number")?,
            "seed" => {
                settings.seed = option("seed", value, "must be a whole number below 2^32")?;
            }
            _ => return Err(unknown(&name, "size, noise and seed")),
        }
    }
    let sample = name.parse::<Example>()?.generate(&settings)?;
    Ok(to_value(&ExampleOutput {
        input: ImageOutput::from(&sample.input),
        truth: sample.truth.values().into(),
    })?)
}

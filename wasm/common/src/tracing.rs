//! How rulings are traced, as options say.

use wasm_bindgen::prelude::*;

use super::Result;
use super::options::option;
use developable::rulings::TraceOptions;

/// The names of these options.
pub const TRACING: &str = "separation, confidence, crease";

/// Takes the option, if it is one of these.
pub fn take_tracing(wanted: &mut TraceOptions, name: &str, value: &JsValue) -> Result<bool> {
    const NUMBER: &str = "must be a number";
    *wanted = match name {
        "separation" => wanted.separation(option("separation", value.clone(), NUMBER)?),
        "confidence" => wanted.confidence(option("confidence", value.clone(), NUMBER)?),
        "crease" => wanted.crease(option("crease", value.clone(), NUMBER)?),
        _ => return Ok(false),
    };
    Ok(true)
}

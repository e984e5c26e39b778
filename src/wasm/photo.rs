//! Photos, and what they show, in.

use js_sys::Uint8Array;
use serde::Deserialize;
use serde_wasm_bindgen::preserve;
use wasm_bindgen::prelude::*;

use super::Result;
use super::options::option;
use crate::dewarp::Extent;

/// `Photo` of `types.d.ts`, as `asPhoto` makes it.
#[derive(Deserialize)]
pub(super) struct PhotoInput {
    pub(super) width: usize,
    pub(super) height: usize,
    #[serde(with = "preserve")]
    pub(super) data: Uint8Array,
}

/// The option `extent`.
pub(super) fn extent_from(value: JsValue) -> Result<Extent> {
    let requirement = "must be four numbers: left, bottom, right, top";
    let [left, bottom, right, top] = option("extent", value, requirement)?;
    Ok(Extent {
        min: [left, bottom],
        max: [right, top],
    })
}

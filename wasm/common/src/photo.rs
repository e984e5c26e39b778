//! Photos, and the part of the plane they show, read from JavaScript objects.

use js_sys::Uint8Array;
use serde::Deserialize;
use serde_wasm_bindgen::{from_value, preserve};
use wasm_bindgen::prelude::*;

use super::Result;
use super::bytes::copied;
use developable::Error;
use developable::dewarp::{Extent, Photo};

/// A photo, read from JavaScript's `Photo` object, as the function `asPhoto` in `pkg/` has checked it.
#[derive(Deserialize)]
struct PhotoInput {
    width: usize,
    height: usize,
    #[serde(with = "preserve")]
    data: Uint8Array,
}

/// Pixels of a photo as RGBA bytes, copied to the wasm module's memory.
pub struct Pixels {
    width: usize,
    height: usize,
    rgba: Vec<u8>,
}

impl Pixels {
    pub fn new(photo: JsValue) -> Result<Self> {
        let PhotoInput {
            width,
            height,
            data,
        } = from_value(photo)?;
        Ok(Pixels {
            width,
            height,
            rgba: copied(&data)?,
        })
    }

    pub fn photo(&self) -> Result<Photo<'_>> {
        Ok(Photo::new(self.width, self.height, &self.rgba)?)
    }
}

/// Makes an extent of the option `extent`: the left, bottom, right and top side of the rectangle of the plane that a photo
/// shows.
pub fn extent_from(sides: [f64; 4]) -> Result<Extent> {
    let [left, bottom, right, top] = sides;
    let has_area = left < right && bottom < top;
    if !has_area || sides.iter().any(|side| !side.is_finite()) {
        let requirement = "must be four numbers: left, bottom, right and top, left less than right and bottom less than top";
        return Err(Error::option("extent", sides, requirement).into());
    }
    Ok(Extent {
        min: [left, bottom],
        max: [right, top],
    })
}

//! Height images and heightfields read from JavaScript objects with typed arrays.

use js_sys::{Float32Array, Float64Array, Uint8Array};
use serde::Deserialize;
use serde_wasm_bindgen::preserve;
use wasm_bindgen::prelude::*;

use super::Result;
use developable::Error;
use developable::HeightImage;
use developable::Heightfield;
use developable::Lattice;
use developable::checks::{check_shape, try_filled};
use developable::files::images::Georeference;

/// Fields of JavaScript's `HeightImage` object that every call reads; a solve reads further ones.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct ImageInput {
    pub width: usize,
    pub height: usize,
    #[serde(default, with = "preserve")]
    pub data: JsValue,
    #[serde(default, with = "preserve")]
    pub mask: JsValue,
    pub no_data: Option<f64>,
    pub pixel_size: Option<f64>,
    height_scale: Option<f64>,
    pub georeference: Option<Georeference>,
}

impl ImageInput {
    pub fn into_image(self) -> Result<HeightImage> {
        self.heights("height image", &self.data)
    }

    /// Converts values at the pixels to heights in units of length, by the height scale; NaN outside of the mask.
    /// `what` names the values in errors.
    pub fn heights(&self, what: &'static str, data: &JsValue) -> Result<HeightImage> {
        let values = values(what, self.height, self.width, data, self.no_data)?;
        Ok(self
            .image(what, values)?
            .scaled(self.height_scale.unwrap_or(1.0))?)
    }

    /// Makes an image of values of any kind at the pixels, with NaN outside of the mask. `what` names the values in
    /// errors.
    pub fn image(&self, what: &'static str, values: Vec<f64>) -> Result<HeightImage> {
        let image = HeightImage::new(self.width, self.height, values)
            .and_then(|image| image.with_pixel_size(self.pixel_size.unwrap_or(1.0)))
            .map_err(|error| about(what, error))?;
        Ok(match bytes(&self.mask) {
            Some(mask) => image.masked(&mask)?,
            None => image,
        })
    }
}

/// Fields of JavaScript's `Heightfield` object that every call reads; a solve reads further ones.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct LatticeInput {
    pub rows: usize,
    pub cols: usize,
    spacing: f64,
    #[serde(default, with = "preserve")]
    pub heights: JsValue,
    origin: Option<[f64; 2]>,
    #[serde(default, with = "preserve")]
    pub mask: JsValue,
    no_data: Option<f64>,
}

impl LatticeInput {
    pub fn into_heightfield(self) -> Result<Heightfield> {
        self.heights("heightfield", &self.heights)
    }

    /// Reads heights at the lattice's vertices from a typed array; NaN outside of the mask. `what` names them in
    /// errors.
    pub fn heights(&self, what: &'static str, data: &JsValue) -> Result<Heightfield> {
        self.field(
            what,
            values(what, self.rows, self.cols, data, self.no_data)?,
        )
    }

    /// Makes a field of values of any kind at the lattice's vertices, with NaN outside of the mask. `what` names the
    /// values in errors.
    pub fn field(&self, what: &'static str, values: Vec<f64>) -> Result<Heightfield> {
        let lattice = Lattice::new(self.rows, self.cols, self.spacing)?
            .with_origin(self.origin.unwrap_or_default())?;
        let field = Heightfield::new(lattice, values).map_err(|error| about(what, error))?;
        Ok(match bytes(&self.mask) {
            Some(mask) => field.masked(&mask)?,
            None => field,
        })
    }
}

/// Replaces the name of the values in an error about a value that is not finite by the name that the caller knows.
fn about(name: &'static str, mut error: Error) -> Error {
    if let Error::NotFinite { what, .. } = &mut error {
        *what = name;
    }
    error
}

/// Copies a typed array of any kind of numbers, `rows` by `cols`, with NaN in place of `no_data`. The number `no_data`
/// is rounded to the array's type first, since -9999.9 is another number in 32 bits. The size is checked before
/// anything is allocated.
pub fn values(
    what: &'static str,
    rows: usize,
    cols: usize,
    data: &JsValue,
    no_data: Option<f64>,
) -> Result<Vec<f64>> {
    let short = data.is_instance_of::<Float32Array>();
    let no_data = no_data.map(|v| if short { f64::from(v as f32) } else { v });
    let data = match data.dyn_ref::<Float64Array>() {
        Some(data) => data.clone(),
        None => Float64Array::new(data),
    };
    let found = data.length() as usize;
    check_shape(what, rows, cols, found)?;
    let mut values = try_filled(what, found, 0.0)?;
    data.copy_to(&mut values);
    if let Some(no_data) = no_data {
        for value in values.iter_mut().filter(|value| **value == no_data) {
            *value = f64::NAN;
        }
    }
    Ok(values)
}

pub fn bytes(array: &JsValue) -> Option<Vec<u8>> {
    array.dyn_ref::<Uint8Array>().map(Uint8Array::to_vec)
}

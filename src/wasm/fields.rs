//! Heights in and out: plain JS objects around typed arrays.

use js_sys::{Float64Array, Uint8Array};
use serde::Deserialize;
use serde_wasm_bindgen::preserve;
use wasm_bindgen::prelude::*;

use super::{Failure, Result};
use crate::error::{Error, checked_cells, try_filled};
use crate::heightfield::{HeightImage, Heightfield};
use crate::lattice::Lattice;

/// `HeightImage` of `types.d.ts`.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct ImageInput {
    width: usize,
    height: usize,
    #[serde(with = "preserve")]
    data: JsValue,
    #[serde(default, with = "preserve")]
    mask: JsValue,
    no_data: Option<f64>,
    pixel_size: Option<f64>,
    height_scale: Option<f64>,
}

impl ImageInput {
    pub(super) fn into_image(self) -> Result<HeightImage> {
        let values = values(
            "height image",
            self.height,
            self.width,
            &self.data,
            self.no_data,
        )?;
        let mut image = HeightImage::new(self.width, self.height, values)?;
        if let Some(mask) = mask(&self.mask) {
            image = image.masked(&mask)?;
        }
        if let Some(scale) = self.height_scale {
            image = image.scaled(scale)?;
        }
        Ok(image.with_pixel_size(self.pixel_size.unwrap_or(1.0))?)
    }
}

/// `Heightfield` of `types.d.ts`.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct LatticeInput {
    rows: usize,
    cols: usize,
    spacing: f64,
    #[serde(with = "preserve")]
    heights: JsValue,
    origin: Option<[f64; 2]>,
    #[serde(default, with = "preserve")]
    mask: JsValue,
    no_data: Option<f64>,
}

impl LatticeInput {
    pub(super) fn into_heightfield(self) -> Result<Heightfield> {
        let lattice = Lattice::new(self.rows, self.cols, self.spacing)?
            .with_origin(self.origin.unwrap_or_default())?;
        let values = values(
            "heightfield",
            self.rows,
            self.cols,
            &self.heights,
            self.no_data,
        )?;
        let mut field = Heightfield::new(lattice, values)?;
        if let Some(mask) = mask(&self.mask) {
            field = field.masked(&mask)?;
        }
        Ok(field)
    }
}

/// A copy of a typed array of any kind, with NaN for `no_data`. The size is
/// checked before anything is allocated.
fn values(
    what: &'static str,
    rows: usize,
    cols: usize,
    data: &JsValue,
    no_data: Option<f64>,
) -> Result<Vec<f64>> {
    let data = match data.dyn_ref::<Float64Array>() {
        Some(data) => data.clone(),
        None => Float64Array::new(data),
    };
    let expected = checked_cells(what, rows, cols)?;
    let found = data.length() as usize;
    if found != expected {
        return Err(Failure::from(Error::Shape {
            what,
            rows,
            cols,
            expected,
            found,
        }));
    }
    let mut values = try_filled(what, found, 0.0)?;
    data.copy_to(&mut values);
    if let Some(no_data) = no_data {
        for value in values.iter_mut().filter(|value| **value == no_data) {
            *value = f64::NAN;
        }
    }
    Ok(values)
}

fn mask(mask: &JsValue) -> Option<Vec<u8>> {
    mask.dyn_ref::<Uint8Array>().map(Uint8Array::to_vec)
}

//! Options of reading an image file, from JavaScript, and the file's contents, to JavaScript.

use js_sys::{Float64Array, Uint8ClampedArray};
use serde::{Deserialize, Serialize};
use serde_wasm_bindgen::{preserve, to_value};
use wasm_bindgen::prelude::*;

use super::{Failure, Result};
use developable::files::Assumption;
use developable::files::images::{Decoded, Format, Georeference, PhotoFile};

/// Options of reading an image file: JavaScript's `ReadOptions` object.
#[derive(Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub struct ReadOptions {
    format: Option<String>,
    pub array: Option<String>,
    /// Whether values that nobody would measure are no data.
    assume_no_data: bool,
}

impl Default for ReadOptions {
    fn default() -> Self {
        ReadOptions {
            format: None,
            array: None,
            assume_no_data: true,
        }
    }
}

impl ReadOptions {
    /// Returns the format that the options name, if they do.
    pub fn format(&self) -> Result<Option<Format>> {
        Ok(self.format.as_deref().map(str::parse).transpose()?)
    }

    /// Returns an error if the options name an array, for file formats without named arrays.
    pub fn without_array(&self) -> Result<()> {
        match self.array {
            Some(_) => Err(Failure::option(
                "the option `array` is for NPZ files, and this is none",
            )),
            None => Ok(()),
        }
    }
}

/// Contents of an image file with heights, written as JavaScript's `ReadResult` object.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct ReadOutput {
    format: &'static str,
    width: usize,
    height: usize,
    #[serde(with = "preserve")]
    data: Float64Array,
    pixel_size: f64,
    #[serde(with = "preserve")]
    unit: JsValue,
    height_scale: f64,
    data_type: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    georeference: Option<Georeference>,
    assumptions: Vec<Assumption>,
}

pub fn output(mut file: Decoded, options: &ReadOptions) -> Result<JsValue> {
    if options.assume_no_data {
        file.assume_no_data();
    }
    Ok(to_value(&ReadOutput {
        format: file.format.name(),
        width: file.width,
        height: file.height,
        data: file.values.as_slice().into(),
        pixel_size: file.pixel_size,
        unit: file.unit.map_or(JsValue::NULL, |unit| unit.symbol().into()),
        height_scale: file.height_scale,
        data_type: file.data_type,
        georeference: file.georeference,
        assumptions: file.assumptions,
    })?)
}

/// A photo, written as JavaScript's `Photo` object.
#[derive(Serialize)]
struct PhotoOutput<'a> {
    width: usize,
    height: usize,
    #[serde(with = "preserve")]
    data: Uint8ClampedArray,
    #[serde(skip_serializing_if = "Option::is_none")]
    film35: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    orientation: Option<u16>,
    assumptions: &'a [Assumption],
}

pub fn photo_output(photo: &PhotoFile) -> Result<JsValue> {
    Ok(to_value(&PhotoOutput {
        width: photo.width,
        height: photo.height,
        data: photo.rgba.as_slice().into(),
        film35: photo.film35,
        orientation: (photo.orientation != 1).then_some(photo.orientation),
        assumptions: &photo.assumptions,
    })?)
}

//! Image files: options of reading one, its contents, and writing one.

use js_sys::{Float64Array, Uint8Array, Uint8ClampedArray};
use serde::{Deserialize, Serialize, Serializer};
use serde_wasm_bindgen::{preserve, to_value};
use wasm_bindgen::prelude::*;

use super::Result;
use super::fields::ImageInput;
use developable::HeightImage;
use developable::files::images::{
    DecodeOptions, Decoded, DepthEvidence, Format, Georeference, PhotoFile,
};
use developable::files::{Assumption, Unit};

/// Options of reading an image file: JavaScript's `ReadOptions` object.
#[derive(Deserialize, Default)]
#[serde(default, rename_all = "camelCase")]
pub struct ReadOptions {
    format: Option<String>,
    array: Option<String>,
    name: String,
    pixel_size: Option<f64>,
    no_data: Option<f64>,
    assume_no_data: Option<bool>,
}

impl ReadOptions {
    /// Returns the format that the options name, if they do.
    pub fn format(&self) -> Result<Option<Format>> {
        Ok(self.format.as_deref().map(str::parse).transpose()?)
    }

    /// Returns the options of the decoder.
    pub fn decoding(self) -> DecodeOptions {
        let mut options = DecodeOptions::default();
        options.assume_no_data = self.assume_no_data.unwrap_or(options.assume_no_data);
        (options.array, options.name) = (self.array, self.name);
        (options.pixel_size, options.no_data) = (self.pixel_size, self.no_data);
        options
    }
}

/// A height image as read from a file. If the file stores integers and no scale, `heightScale` is a suggestion.
#[derive(Serialize)]
#[serde(rename = "ReadResult", rename_all = "camelCase")]
struct ReadOutput {
    /// Format of the file.
    format: Format,
    /// Number of pixels in a row.
    width: usize,
    /// Number of rows of pixels.
    height: usize,
    /// Values as stored, plus `offset / heightScale` if the file states an offset: row by row, the top row first; NaN where there is no data.
    #[serde(with = "preserve")]
    data: Float64Array,
    /// Side length of a pixel. Where the file does not state it, it is 1, or another value if the surface would be far too flat or
    /// too steep with 1, which `assumptions` says.
    pixel_size: f64,
    /// Unit of `pixelSize`: millimetres for a resolution that a TIFF file states, metres for a map; `null` if it is not known.
    unit: Nullable<Unit>,
    /// Factor from values to heights, in the unit of `pixelSize`.
    height_scale: f64,
    /// Type of number that the file stores: `'u8'`, `'u16'`, `'f32'`, `'f64'` and so on.
    data_type: &'static str,
    /// Whether the values are depths of a camera.
    depths: DepthEvidence,
    /// Unit that the values have if they are depths of a camera: millimetres for integers and large floats, else metres.
    depth_unit: Unit,
    /// Where the pixels lie on a map; absent unless the file is a GeoTIFF.
    #[serde(skip_serializing_if = "Option::is_none")]
    georeference: Option<Georeference>,
    /// What the reader assumed because the file does not say it.
    assumptions: Vec<Assumption>,
}

pub fn output(file: Decoded) -> Result<JsValue> {
    Ok(to_value(&ReadOutput {
        format: file.format,
        width: file.width,
        height: file.height,
        data: file.values.as_slice().into(),
        pixel_size: file.pixel_size,
        unit: Nullable(file.unit),
        height_scale: file.height_scale,
        data_type: file.data_type,
        depths: file.depths,
        depth_unit: file.depth_unit,
        georeference: file.georeference,
        assumptions: file.assumptions,
    })?)
}

/// A value that JavaScript gets as `null` if there is none.
struct Nullable<T>(Option<T>);

impl<T: Serialize> Serialize for Nullable<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error> {
        match &self.0 {
            Some(value) => value.serialize(serializer),
            None => preserve::serialize(&JsValue::NULL, serializer),
        }
    }
}

/// A photo decoded from a file: RGBA bytes, upright.
#[derive(Serialize)]
#[serde(rename = "DecodedPhoto")]
struct PhotoOutput<'a> {
    /// Number of pixels in a row.
    width: usize,
    /// Number of rows of pixels.
    height: usize,
    /// `4 * width * height` RGBA bytes, row by row, the top row first.
    #[serde(with = "preserve")]
    data: Uint8ClampedArray,
    /// Focal length of the camera in millimetres, as for film of 36 by 24 mm; absent if the Exif data do not state it or the photo was cropped.
    #[serde(skip_serializing_if = "Option::is_none")]
    film35: Option<f64>,
    /// Orientation by which the photo was turned upright, as Exif numbers it from 2 to 8 (6: by 90 degrees clockwise, 3: by 180, 8: by 270); absent if it was stored upright.
    #[serde(skip_serializing_if = "Option::is_none")]
    orientation: Option<u16>,
    /// What the reader assumed because the file does not say it.
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

/// Writes JavaScript's height image by a function of the library.
pub fn written(
    mut image: ImageInput,
    format: &str,
    write: impl FnOnce(&HeightImage, Format, Option<&Georeference>) -> developable::Result<Vec<u8>>,
) -> Result<Uint8Array> {
    let map = image.georeference.take();
    let file = write(&image.into_image()?, format.parse()?, map.as_ref())?;
    Ok(file.as_slice().into())
}

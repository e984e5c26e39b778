//! Reading and writing of TIFF, EXR and other files of height images.

use js_sys::Uint8Array;
use serde::Serialize;
use serde_wasm_bindgen::{from_value, to_value};
use wasm_bindgen::prelude::*;

use developable::files::images::{Format, announced, decode_other_photo, extended, npz_arrays};
use developable_wasm::Result;
use developable_wasm::bytes::copied;
use developable_wasm::fields::ImageInput;
use developable_wasm::file::{ReadOptions, output, photo_output, written};
use developable_wasm::options::read;

/// Decodes a file of heights of any format except PNG and NPY; returns JavaScript's `ReadResult` object.
#[wasm_bindgen(js_name = readImage)]
pub fn read_image(bytes: &Uint8Array, options: JsValue) -> Result<JsValue> {
    let options: ReadOptions = read(&options)?;
    let file = copied(bytes)?;
    let format = announced(&file, options.format()?)?;
    output(extended::decode(&file, format, &options.decoding())?)
}

/// Decodes a WebP, GIF, BMP or TIFF file to a photo; returns JavaScript's `Photo` object.
#[wasm_bindgen(js_name = readImagePhoto)]
pub fn read_image_photo(bytes: &Uint8Array) -> Result<JsValue> {
    let file = copied(bytes)?;
    photo_output(&decode_other_photo(&file)?)
}

/// An array of an NPZ file.
#[derive(Serialize)]
#[serde(rename = "NpzArray", rename_all = "camelCase")]
struct ArrayOutput {
    /// Name of the array.
    name: String,
    /// Lengths of the array's dimensions.
    shape: Vec<f64>,
    /// Type of number, such as `'f32'`; NumPy's own name for a type that is no number.
    data_type: String,
    /// Whether it may be an image of heights: rows and columns of numbers, more than the matrix of a camera has.
    may_be_image: bool,
}

/// Lists the arrays of an NPZ file: names, shapes and types.
#[wasm_bindgen(js_name = npzArrays)]
pub fn arrays(bytes: &Uint8Array) -> Result<JsValue> {
    let file = copied(bytes)?;
    announced(&file, Some(Format::Npz))?;
    let arrays: Vec<_> = npz_arrays(&file)?
        .into_iter()
        .map(|array| ArrayOutput {
            name: array.name,
            shape: array.shape.into_iter().map(|n| n as f64).collect(),
            data_type: array.data_type,
            may_be_image: array.may_be_image,
        })
        .collect();
    Ok(to_value(&arrays)?)
}

/// Writes heights to a file of a format other than PNG and NPY. The georeference says the size of pixels where the image does not.
#[wasm_bindgen(js_name = writeImage)]
pub fn write_image(image: JsValue, format: &str) -> Result<Uint8Array> {
    let mut input = from_value::<ImageInput>(image)?;
    if let (Some(map), None) = (&input.georeference, input.pixel_size) {
        input.pixel_size = Some(map.pixel_size((input.width, input.height)));
    }
    written(input, format, extended::write)
}

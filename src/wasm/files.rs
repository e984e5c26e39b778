//! Files from and to bytes.

use js_sys::{Float64Array, Uint8Array, Uint8ClampedArray};
use serde::Serialize;
use serde_wasm_bindgen::{from_value, preserve, to_value};
use wasm_bindgen::prelude::*;

use super::Result;
use super::fields::{ImageInput, LatticeInput};
use super::options::{entries, option, unknown};
use crate::dewarp::Photo;
use crate::error::try_filled;
use crate::formats::{
    Format, decode, decode_photo, write_npy, write_obj, write_obj_in, write_photo, write_png,
};

/// `ReadResult` of `types.d.ts`.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct ReadOutput {
    format: &'static str,
    width: usize,
    height: usize,
    #[serde(with = "preserve")]
    data: Float64Array,
    pixel_size: f64,
    height_scale: f64,
    data_type: &'static str,
}

/// Decodes a PNG or NPY file.
#[wasm_bindgen]
pub fn read(bytes: &Uint8Array, options: JsValue) -> Result<JsValue> {
    let mut format = None;
    for (name, value) in entries(&options)? {
        match name.as_str() {
            "format" => {
                let name: String = option("format", value, "must be `png` or `npy`")?;
                format = Some(name.parse::<Format>()?);
            }
            _ => return Err(unknown(&name, "format")),
        }
    }
    let mut file = try_filled("file", bytes.length() as usize, 0)?;
    bytes.copy_to(&mut file);
    let file = decode(&file, format)?;
    Ok(to_value(&ReadOutput {
        format: file.format.name(),
        width: file.width,
        height: file.height,
        data: file.values.as_slice().into(),
        pixel_size: file.pixel_size,
        height_scale: file.height_scale,
        data_type: file.data_type,
    })?)
}

/// NPY file of an image's heights.
#[wasm_bindgen(js_name = writeImageNpy)]
pub fn write_image_npy(image: JsValue) -> Result<Uint8Array> {
    let image = from_value::<ImageInput>(image)?.into_image()?;
    let file = write_npy(image.height(), image.width(), image.values())?;
    Ok(file.as_slice().into())
}

/// NPY file of lattice heights.
#[wasm_bindgen(js_name = writeLatticeNpy)]
pub fn write_lattice_npy(field: JsValue) -> Result<Uint8Array> {
    let field = from_value::<LatticeInput>(field)?.into_heightfield()?;
    let lattice = field.lattice();
    let file = write_npy(lattice.rows(), lattice.cols(), field.heights())?;
    Ok(file.as_slice().into())
}

/// 16-bit PNG file of an image's heights.
#[wasm_bindgen(js_name = writePng)]
pub fn write_png_file(image: JsValue) -> Result<Uint8Array> {
    let image = from_value::<ImageInput>(image)?.into_image()?;
    Ok(write_png(&image)?.as_slice().into())
}

/// OBJ mesh of lattice heights, in the axes of their frame.
#[wasm_bindgen(js_name = writeObj)]
pub fn write_obj_file(field: JsValue) -> Result<Uint8Array> {
    let input = from_value::<LatticeInput>(field)?;
    let frame = input.frame;
    let field = input.into_heightfield()?;
    let file = match frame {
        Some(frame) => write_obj_in(&field, &frame.into())?,
        None => write_obj(&field)?,
    };
    Ok(file.as_slice().into())
}

/// `Photo` of `types.d.ts` on its way out.
#[derive(Serialize)]
struct PhotoOutput {
    width: usize,
    height: usize,
    #[serde(with = "preserve")]
    data: Uint8ClampedArray,
}

/// Decodes a PNG file with colours.
#[wasm_bindgen(js_name = readPhoto)]
pub fn read_photo(bytes: &Uint8Array) -> Result<JsValue> {
    let mut file = try_filled("file", bytes.length() as usize, 0)?;
    bytes.copy_to(&mut file);
    let photo = decode_photo(&file)?;
    Ok(to_value(&PhotoOutput {
        width: photo.width,
        height: photo.height,
        data: photo.rgba.as_slice().into(),
    })?)
}

/// 8-bit RGBA PNG file.
#[wasm_bindgen(js_name = writePhoto)]
pub fn write_photo_file(width: usize, height: usize, rgba: &Uint8Array) -> Result<Uint8Array> {
    let mut bytes = try_filled("photo", rgba.length() as usize, 0)?;
    rgba.copy_to(&mut bytes);
    let file = write_photo(&Photo::new(width, height, &bytes)?)?;
    Ok(file.as_slice().into())
}

//! PNG, NPY and OBJ from and to bytes.

use js_sys::{Uint8Array, Uint8ClampedArray};
use serde::Serialize;
use serde_wasm_bindgen::{from_value, preserve, to_value};
use wasm_bindgen::prelude::*;

use super::Result;
use super::bytes::copied;
use super::fields::{ImageInput, LatticeInput};
use super::file::{ReadOptions, output};
use super::triangulation::mesh_of;
use crate::dewarp::Photo;
use crate::formats::{decode, decode_photo, write_npy, write_obj_mesh, write_photo, write_png};

/// Decodes a PNG or NPY file.
#[wasm_bindgen]
pub fn read(bytes: &Uint8Array, options: JsValue) -> Result<JsValue> {
    let options = ReadOptions::new(&options)?;
    options.without_array()?;
    output(decode(&copied(bytes)?, options.format)?)
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
    Ok(write_obj_mesh(&mesh_of(field)?)?.as_slice().into())
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
    let photo = decode_photo(&copied(bytes)?)?;
    Ok(to_value(&PhotoOutput {
        width: photo.width,
        height: photo.height,
        data: photo.rgba.as_slice().into(),
    })?)
}

/// 8-bit RGBA PNG file.
#[wasm_bindgen(js_name = writePhoto)]
pub fn write_photo_file(width: usize, height: usize, rgba: &Uint8Array) -> Result<Uint8Array> {
    let file = write_photo(&Photo::new(width, height, &copied(rgba)?)?)?;
    Ok(file.as_slice().into())
}

//! PNG, NPY and OBJ from and to bytes.

use js_sys::Uint8Array;
use serde_wasm_bindgen::from_value;
use wasm_bindgen::prelude::*;

use super::Result;
use super::bytes::copied;
use super::fields::{ImageInput, LatticeInput};
use super::file::{ReadOptions, output};
use super::triangulation::mesh_of;
use crate::formats::{decode, write_npy, write_obj_mesh, write_png};

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

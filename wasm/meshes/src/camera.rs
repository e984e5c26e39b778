//! Depth cameras.

use serde_wasm_bindgen::from_value;
use wasm_bindgen::prelude::*;

use super::mesh_output;
use developable_wasm::Result;
use developable_wasm::camera::intrinsics;
use developable_wasm::fields::{ImageInput, values};

/// What a depth camera has seen, as a mesh.
#[wasm_bindgen(js_name = backProject)]
pub fn back_project(image: JsValue, camera: JsValue) -> Result<JsValue> {
    let camera = intrinsics(&camera)?;
    let image = from_value::<ImageInput>(image)?;
    let what = "depth image";
    // The camera's own scale counts, not the image's.
    let depths = values(what, image.height, image.width, &image.data, image.no_data)?;
    mesh_output(&camera.back_project(&image.image(what, depths)?)?)
}

//! Depth cameras.

use serde_wasm_bindgen::from_value;
use wasm_bindgen::prelude::*;

use super::mesh_output;
use developable::Error;
use developable::{Depth, Intrinsics};
use developable_wasm::fields::{ImageInput, values};
use developable_wasm::options::{entries, option, unknown};
use developable_wasm::{Failure, Result};

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

/// `Intrinsics` of `types.d.ts`.
fn intrinsics(camera: &JsValue) -> Result<Intrinsics> {
    let (mut found, mut scale, mut depth) = ([None; 4], 1.0, Depth::Planar);
    const NAMES: [&str; 4] = ["fx", "fy", "cx", "cy"];
    for (name, value) in entries(camera)? {
        if let Some(k) = NAMES.iter().position(|known| *known == name) {
            found[k] = Some(option(NAMES[k], value, "must be a number, in pixels")?);
            continue;
        }
        match name.as_str() {
            "depthScale" => {
                scale = option("depthScale", value, "must be a finite number above zero")?;
            }
            "depth" => depth = kind(value)?,
            _ => return Err(unknown(&name, "fx, fy, cx, cy, depthScale and depth")),
        }
    }
    let [Some(fx), Some(fy), Some(cx), Some(cy)] = found else {
        return Err(Failure::option(
            "a depth camera needs its focal lengths and centre in pixels: fx, fy, cx and cy",
        ));
    };
    Ok(Intrinsics {
        depth_scale: scale,
        depth,
        ..Intrinsics::new(fx, fy, cx, cy)
    })
}

fn kind(value: JsValue) -> Result<Depth> {
    let requirement = "must be `planar` or `ray`";
    let name: String = option("depth", value, requirement)?;
    match name.as_str() {
        "planar" => Ok(Depth::Planar),
        "ray" => Ok(Depth::Ray),
        _ => Err(Error::option("depth", name, requirement).into()),
    }
}

//! Cameras read from JavaScript objects.

use wasm_bindgen::prelude::*;

use super::options::{entries, option, unknown};
use super::{Failure, Result};
use developable::{Camera, Depth, Error, Intrinsics, Pose};

/// Reads the intrinsics of a depth camera from JavaScript's `Intrinsics` object; a pose (`rotation` or `translation`)
/// is an error.
pub fn intrinsics(camera: &JsValue) -> Result<Intrinsics> {
    let Camera { intrinsics, pose } = read(camera)?;
    if pose == Pose::default() {
        return Ok(intrinsics);
    }
    Err(Failure::option(
        "`rotation` and `translation` are for a photo's camera: depths are seen from where they are",
    ))
}

/// Reads a camera that takes photos, with its pose, from JavaScript's `PhotoCamera` object.
pub fn photo_camera(camera: &JsValue) -> Result<Camera> {
    read(camera)
}

/// Names of a camera's fields that are single numbers.
const NUMBER_FIELDS: [&str; 9] = ["fx", "fy", "cx", "cy", "k1", "k2", "p1", "p2", "k3"];
/// Names of all fields of a camera, for the error about an unknown one.
const FIELD_NAMES: &str = "fx, fy, cx, cy, width, height, k1, k2, p1, p2, k3, depthScale, depth, margin, rotation and translation";

fn read(camera: &JsValue) -> Result<Camera> {
    let mut found = [None; 9];
    let (mut width, mut height) = (None, None);
    let mut own = Camera::new(Intrinsics::new(1.0, 1.0, 0.0, 0.0));
    for (name, value) in entries(camera)? {
        if let Some(k) = NUMBER_FIELDS.iter().position(|known| *known == name) {
            found[k] = Some(option(NUMBER_FIELDS[k], value, "must be a number")?);
            continue;
        }
        let size = "must be a whole number of pixels";
        let Camera { intrinsics, pose } = &mut own;
        match name.as_str() {
            "width" => width = Some(option("width", value, size)?),
            "height" => height = Some(option("height", value, size)?),
            "depthScale" => {
                let requirement = "must be a finite number above zero";
                intrinsics.depth_scale = option("depthScale", value, requirement)?;
            }
            "depth" => intrinsics.depth = kind(value)?,
            "margin" => intrinsics.margin = option("margin", value, size)?,
            "rotation" => {
                pose.rotation = option("rotation", value, "must be three rows of three numbers")?
            }
            "translation" => {
                pose.translation = option("translation", value, "must be three numbers")?
            }
            _ => return Err(unknown(&name, FIELD_NAMES)),
        }
    }
    let [Some(fx), Some(fy), Some(cx), Some(cy), lens @ ..] = found else {
        return Err(Failure::option(
            "a camera needs its focal lengths and centre in pixels: fx, fy, cx and cy",
        ));
    };
    let [k1, k2, p1, p2, k3] = lens.map(|value| value.unwrap_or(0.0));
    let intrinsics = &mut own.intrinsics;
    [intrinsics.fx, intrinsics.fy, intrinsics.cx, intrinsics.cy] = [fx, fy, cx, cy];
    intrinsics.distortion = developable::Distortion { k1, k2, p1, p2, k3 };
    intrinsics.size = match (width, height) {
        (Some(width), Some(height)) => Some([width, height]),
        (None, None) => None,
        _ => {
            return Err(Failure::option(
                "a camera's `width` and `height` belong together: give both or neither",
            ));
        }
    };
    Ok(own)
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

//! Cameras read from JavaScript objects.

use serde::Deserialize;
use wasm_bindgen::prelude::*;

use super::options::read;
use super::{Failure, Result};
use developable::{Camera, Depth, Distortion, Intrinsics, Pose};

/// Reads the intrinsics of a depth camera from JavaScript's `Intrinsics` object; a pose (`rotation` or `translation`)
/// is an error.
pub fn intrinsics(camera: &JsValue) -> Result<Intrinsics> {
    let Camera { intrinsics, pose } = photo_camera(camera)?;
    if pose == Pose::default() {
        return Ok(intrinsics);
    }
    Err(Failure::option(
        "`rotation` and `translation` are for a photo's camera: depths are seen from where they are",
    ))
}

/// Numbers of a camera, read from JavaScript's `Intrinsics` or `PhotoCamera` object.
#[derive(Default, Deserialize)]
#[serde(default, rename_all = "camelCase")]
struct CameraInput {
    fx: Option<f64>,
    fy: Option<f64>,
    cx: Option<f64>,
    cy: Option<f64>,
    width: Option<usize>,
    height: Option<usize>,
    k1: f64,
    k2: f64,
    p1: f64,
    p2: f64,
    k3: f64,
    depth_scale: Option<f64>,
    depth: Depth,
    margin: Option<usize>,
    rotation: Option<[[f64; 3]; 3]>,
    translation: Option<[f64; 3]>,
}

/// Reads a camera that takes photos, with its pose, from JavaScript's `PhotoCamera` object.
pub fn photo_camera(camera: &JsValue) -> Result<Camera> {
    let input: CameraInput = read(camera)?;
    let (Some(fx), Some(fy), Some(cx), Some(cy)) = (input.fx, input.fy, input.cx, input.cy) else {
        return Err(Failure::option(
            "a camera needs its focal lengths and centre in pixels: fx, fy, cx and cy",
        ));
    };
    let CameraInput {
        k1, k2, p1, p2, k3, ..
    } = input;
    let mut intrinsics = Intrinsics::new(fx, fy, cx, cy);
    intrinsics.distortion = Distortion { k1, k2, p1, p2, k3 };
    intrinsics.depth_scale = input.depth_scale.unwrap_or(intrinsics.depth_scale);
    intrinsics.depth = input.depth;
    intrinsics.margin = input.margin.unwrap_or(intrinsics.margin);
    intrinsics.size = match (input.width, input.height) {
        (Some(width), Some(height)) => Some([width, height]),
        (None, None) => None,
        _ => {
            return Err(Failure::option(
                "a camera's `width` and `height` belong together: give both or neither",
            ));
        }
    };
    let own = Pose::default();
    Ok(Camera::new(intrinsics).at(Pose {
        rotation: input.rotation.unwrap_or(own.rotation),
        translation: input.translation.unwrap_or(own.translation),
    }))
}

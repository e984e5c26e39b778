//! Depth images made to meshes, and texture coordinates by a camera, for JavaScript.

use js_sys::Float32Array;
use serde::{Deserialize, Serialize};
use serde_wasm_bindgen::{from_value, preserve, to_value};
use wasm_bindgen::prelude::*;

use super::MeshOutput;
use developable::checks::check_count;
use developable::dewarp::Registration;
use developable::{Frame, HeightImage, Intrinsics, Region, Turn, resampled};
use developable_wasm::Result;
use developable_wasm::bytes::copied;
use developable_wasm::camera::{intrinsics, photo_camera};
use developable_wasm::fields::{ImageInput, LatticeInput, values};
use developable_wasm::frame::FrameFields;
use developable_wasm::options::read;

/// Back-projects a depth image to a mesh in space; returns JavaScript's `Mesh` object and the camera, rotated as the
/// option `turn` says.
#[wasm_bindgen(js_name = backProject)]
pub fn back_project(image: JsValue, camera: JsValue, options: JsValue) -> Result<JsValue> {
    let camera = intrinsics(&camera)?;
    let image = from_value::<ImageInput>(image)?;
    let what = "depth image";
    // The depth scale of the camera counts, not the height scale of the image.
    let depths = values(what, image.height, image.width, &image.data, image.no_data)?;
    let depths = image.image(what, depths)?;
    let known: DepthInput = read(&options)?;
    let stored = [depths.width(), depths.height()];
    let camera = known.turn.camera(&camera, stored);
    let mut depths = known.turn.image(&depths)?;
    let size = [depths.width(), depths.height()];
    let mut keep = vec![1u8; depths.values().len()];
    for flags in known.masks(&camera, &depths, stored)? {
        for (keep, flag) in keep.iter_mut().zip(flags) {
            *keep &= u8::from(flag != 0);
        }
    }
    let confidence = match &known.confidence {
        Some(weights) => {
            let floats = |data: &Float32Array| Ok(data.to_vec());
            let (data, own) = weights.turned("confidence", floats, known.turn)?;
            let weights = resampled("confidence", &data, own, size)?;
            let keep: Vec<u8> = weights
                .iter()
                .map(|weight| u8::from(*weight > 0.0))
                .collect();
            depths = depths.masked(&keep)?;
            Float32Array::from(weights.as_slice()).into()
        }
        None => JsValue::UNDEFINED,
    };
    let mut mesh = camera.back_project_within(&depths, &keep)?;
    if known.crop.is_some() {
        mesh = mesh.without_scraps()?;
    }
    Ok(to_value(&BackProjected {
        mesh: MeshOutput {
            confidence,
            ..MeshOutput::new(&mesh)
        },
        camera: Seen::new(&camera, size),
    })?)
}

/// Computes texture coordinates of a heightfield's vertices in a photo of a given width and height, by the camera that
/// took the photo. `frame` has the axes of the heightfield in those of the depth camera.
#[wasm_bindgen(js_name = cameraUvs)]
pub fn camera_uvs(
    field: JsValue,
    camera: JsValue,
    frame: JsValue,
    width: usize,
    height: usize,
) -> Result<Float32Array> {
    let frame = match frame.is_undefined() {
        true => Frame::default(),
        false => from_value::<FrameFields>(frame)?.into(),
    };
    let registration = Registration::Camera(photo_camera(&camera)?, frame);
    let field = from_value::<LatticeInput>(field)?.into_heightfield()?;
    let uvs = registration.uvs(&field, [width, height])?;
    Ok(uvs.as_flattened().into())
}

/// Mesh of a depth image, and the intrinsics of its camera after the quarter turn, as a JavaScript object.
#[derive(Serialize)]
struct BackProjected {
    mesh: MeshOutput,
    camera: Seen,
}

/// Those intrinsics of a depth camera that a quarter turn of its image changes, as a JavaScript object.
#[derive(Serialize)]
struct Seen {
    fx: f64,
    fy: f64,
    cx: f64,
    cy: f64,
    width: usize,
    height: usize,
    p1: f64,
    p2: f64,
}

impl Seen {
    fn new(camera: &Intrinsics, size: [usize; 2]) -> Self {
        let [width, height] = camera.size.unwrap_or(size);
        Seen {
            fx: camera.fx,
            fy: camera.fy,
            cx: camera.cx,
            cy: camera.cy,
            width,
            height,
            p1: camera.distortion.p1,
            p2: camera.distortion.p2,
        }
    }
}

/// Values at the pixels of an image, with its width and height.
#[derive(Deserialize)]
#[serde(expecting = "an image: { width, height, data }")]
struct PixelsInput {
    width: usize,
    height: usize,
    /// Values as a typed array, row by row; `undefined` where only the size counts.
    #[serde(default, with = "preserve")]
    data: JsValue,
}

impl PixelsInput {
    fn size(&self) -> [usize; 2] {
        [self.width, self.height]
    }

    /// Copies the values by `copy`, and turns them.
    fn turned<T: Copy, A: JsCast>(
        &self,
        what: &'static str,
        copy: impl Fn(&A) -> Result<Vec<T>>,
        turn: Turn,
    ) -> Result<(Vec<T>, [usize; 2])> {
        let data = copy(self.data.unchecked_ref())?;
        check_count(what, self.height, self.width, data.len())?;
        Ok(turn.values(&data, self.size())?)
    }
}

/// Options of back-projecting a depth image, read from JavaScript's `DepthOptions` object, as the function
/// `asDepthOptions` in `pkg/` has checked it.
#[derive(Default, Deserialize)]
#[serde(default)]
struct DepthInput {
    confidence: Option<PixelsInput>,
    mask: Option<PixelsInput>,
    crop: Option<Vec<[f64; 2]>>,
    photo: Option<PixelsInput>,
    #[serde(with = "preserve")]
    camera: JsValue,
    turn: Turn,
}

impl DepthInput {
    /// Computes the masks of the depth image that the options `mask` and `crop` ask for: 1 where a depth shows the
    /// wanted region. `stored` is the depth image's size before its rotation.
    fn masks(
        &self,
        camera: &Intrinsics,
        depths: &HeightImage,
        stored: [usize; 2],
    ) -> Result<Vec<Vec<u8>>> {
        let mut found = Vec::new();
        let photo = match self.camera.is_undefined() {
            true => None,
            false => Some(photo_camera(&self.camera)?),
        };
        let photo = photo.as_ref();
        if let Some(mask) = &self.mask {
            // A mask of the depths' own size applies to the depths, whatever the photo's camera has seen, and is
            // turned with them.
            let own = mask.size() == stored;
            let photo = photo.filter(|_| !own);
            let turn = if own { self.turn } else { Turn::None };
            let (data, size) = mask.turned("mask", copied, turn)?;
            found.push(camera.within(depths, &Region::Mask(size, &data), photo)?);
        }
        if let (Some(corners), Some(photographed)) = (&self.crop, &self.photo) {
            let region = Region::Polygon(photographed.size(), corners);
            found.push(camera.within(depths, &region, photo)?);
        }
        Ok(found)
    }
}

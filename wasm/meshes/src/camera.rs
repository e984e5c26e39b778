//! Depth images made to meshes, and texture coordinates by a camera, for JavaScript.

use js_sys::{Float32Array, Uint8Array};
use serde::{Deserialize, Serialize};
use serde_wasm_bindgen::{from_value, preserve, to_value};
use wasm_bindgen::prelude::*;

use super::MeshOutput;
use developable::checks::check_count;
use developable::dewarp::Registration;
use developable::{Camera, Error, Frame, HeightImage, Intrinsics, Region, Turn, resampled};
use developable_wasm::Result;
use developable_wasm::bytes::copied;
use developable_wasm::camera::{intrinsics, photo_camera};
use developable_wasm::fields::{ImageInput, LatticeInput, values};
use developable_wasm::frame::FrameFields;
use developable_wasm::options::{entries, option, unknown};

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
    let known = Known::read(&options)?;
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
        Some(Sized { size: own, data }) => {
            check_count("confidence", own[1], own[0], data.len())?;
            let (data, own) = known.turn.values(data, *own)?;
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

/// Requirement of the option `turn`, for its error.
const TURN_REQUIREMENT: &str = "must be 0, 90, 180 or 270 degrees";

/// Values at the pixels of an image, with its width and height.
struct Sized<T> {
    size: [usize; 2],
    data: Vec<T>,
}

#[derive(Deserialize)]
struct SizedInput {
    width: usize,
    height: usize,
    #[serde(default, with = "preserve")]
    data: JsValue,
}

impl<T> Sized<T> {
    fn read(
        name: &'static str,
        value: JsValue,
        list: impl FnOnce(JsValue) -> Result<Vec<T>>,
    ) -> Result<Self> {
        let requirement = "must be an image: { width, height, data }";
        let SizedInput {
            width,
            height,
            data,
        } = option(name, value, requirement)?;
        Ok(Sized {
            size: [width, height],
            data: list(data)?,
        })
    }
}

/// Options of back-projecting a depth image, read from JavaScript's `DepthOptions` object, as the function
/// `asDepthOptions` in `pkg/` has checked it.
#[derive(Default)]
struct Known {
    confidence: Option<Sized<f32>>,
    mask: Option<Sized<u8>>,
    crop: Option<Vec<[f64; 2]>>,
    photo: Option<[usize; 2]>,
    camera: Option<Camera>,
    turn: Turn,
}

impl Known {
    fn read(options: &JsValue) -> Result<Self> {
        let mut known = Known::default();
        for (name, value) in entries(options)? {
            match name.as_str() {
                "confidence" => {
                    let floats = |data: JsValue| Ok(data.unchecked_into::<Float32Array>().to_vec());
                    known.confidence = Some(Sized::read("confidence", value, floats)?);
                }
                "mask" => {
                    let flags = |data: JsValue| copied(data.unchecked_ref::<Uint8Array>());
                    known.mask = Some(Sized::read("mask", value, flags)?);
                }
                "crop" => {
                    known.crop = Some(option("crop", value, "must be a list of corners [x, y]")?);
                }
                "photo" => {
                    let whole: Sized<()> = Sized::read("photo", value, |_| Ok(Vec::new()))?;
                    known.photo = Some(whole.size);
                }
                "camera" => known.camera = Some(photo_camera(&value)?),
                "turn" => {
                    known.turn = match option::<u32>("turn", value.clone(), TURN_REQUIREMENT)? {
                        0 => Turn::None,
                        90 => Turn::Quarter,
                        180 => Turn::Half,
                        270 => Turn::ThreeQuarters,
                        other => return Err(Error::option("turn", other, TURN_REQUIREMENT).into()),
                    }
                }
                _ => {
                    let names = "confidence, mask, crop, photo, camera and turn";
                    return Err(unknown(&name, names));
                }
            }
        }
        Ok(known)
    }

    /// Computes the masks of the depth image that the options `mask` and `crop` ask for: 1 where a depth shows the
    /// wanted region. `stored` is the depth image's size before its rotation.
    fn masks(
        &self,
        camera: &Intrinsics,
        depths: &HeightImage,
        stored: [usize; 2],
    ) -> Result<Vec<Vec<u8>>> {
        let mut found = Vec::new();
        let photo = self.camera.as_ref();
        if let Some(Sized { size, data }) = &self.mask {
            // A mask of the depths' own size applies to the depths, whatever the photo's camera has seen, and is
            // turned with them.
            let own = *size == stored;
            let photo = photo.filter(|_| !own);
            let turn = if own { self.turn } else { Turn::None };
            check_count("mask", size[1], size[0], data.len())?;
            let (data, size) = turn.values(data, *size)?;
            found.push(camera.within(depths, &Region::Mask(size, &data), photo)?);
        }
        if let (Some(corners), Some(size)) = (&self.crop, self.photo) {
            let region = Region::Polygon(size, corners);
            found.push(camera.within(depths, &region, photo)?);
        }
        Ok(found)
    }
}

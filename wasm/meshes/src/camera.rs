//! Depth cameras.

use js_sys::{Float32Array, Uint8Array};
use serde::Deserialize;
use serde_wasm_bindgen::{from_value, preserve};
use wasm_bindgen::prelude::*;

use super::MeshOutput;
use developable::{Camera, HeightImage, Intrinsics, Region, resampled};
use developable_wasm::Result;
use developable_wasm::bytes::copied;
use developable_wasm::camera::{intrinsics, photo_camera};
use developable_wasm::fields::{ImageInput, values};
use developable_wasm::options::{entries, option, unknown};

/// What a depth camera has seen, as a mesh.
#[wasm_bindgen(js_name = backProject)]
pub fn back_project(image: JsValue, camera: JsValue, options: JsValue) -> Result<JsValue> {
    let camera = intrinsics(&camera)?;
    let image = from_value::<ImageInput>(image)?;
    let what = "depth image";
    // The camera's own scale counts, not the image's.
    let depths = values(what, image.height, image.width, &image.data, image.no_data)?;
    let mut depths = image.image(what, depths)?;
    let known = Known::read(&options)?;
    let size = [depths.width(), depths.height()];
    for flags in known.masks(&camera, &depths)? {
        depths = depths.masked(&flags)?;
    }
    let confidence = match &known.confidence {
        Some(Sized { size: own, data }) => {
            let weights = resampled("confidence", data, *own, size)?;
            let keep: Vec<u8> = weights
                .iter()
                .map(|weight| u8::from(*weight > 0.0))
                .collect();
            depths = depths.masked(&keep)?;
            Float32Array::from(weights.as_slice()).into()
        }
        None => JsValue::UNDEFINED,
    };
    let mesh = camera.back_project(&depths)?;
    Ok(serde_wasm_bindgen::to_value(&MeshOutput {
        confidence,
        ..MeshOutput::new(&mesh)
    })?)
}

/// Pixels of the depths that are taken beyond the part of the photo that is wanted, for the surface to go
/// on there.
const BEYOND: usize = 3;

/// Values at the pixels of an image.
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

/// `DepthOptions` of `types.d.ts`, as `asDepthOptions` makes them.
#[derive(Default)]
struct Known {
    confidence: Option<Sized<f32>>,
    mask: Option<Sized<u8>>,
    crop: Option<Vec<[f64; 2]>>,
    photo: Option<[usize; 2]>,
    camera: Option<Camera>,
}

impl Known {
    fn read(options: &JsValue) -> Result<Self> {
        let mut known = Known::default();
        let image = "must be an image: { width, height, data }";
        for (name, value) in entries(options)? {
            match name.as_str() {
                "confidence" => {
                    let SizedInput {
                        width,
                        height,
                        data,
                    } = option("confidence", value, image)?;
                    let data: Float32Array = data.unchecked_into();
                    let size = [width, height];
                    known.confidence = Some(Sized {
                        size,
                        data: data.to_vec(),
                    });
                }
                "mask" => {
                    let SizedInput {
                        width,
                        height,
                        data,
                    } = option("mask", value, image)?;
                    let data: Uint8Array = data.unchecked_into();
                    let size = [width, height];
                    known.mask = Some(Sized {
                        size,
                        data: copied(&data)?,
                    });
                }
                "crop" => {
                    known.crop = Some(option("crop", value, "must be a list of corners [x, y]")?);
                }
                "photo" => {
                    let SizedInput { width, height, .. } = option("photo", value, image)?;
                    known.photo = Some([width, height]);
                }
                "camera" => known.camera = Some(photo_camera(&value)?),
                _ => {
                    let names = "confidence, mask, crop, photo and camera";
                    return Err(unknown(&name, names));
                }
            }
        }
        Ok(known)
    }

    /// What the depths are to be within.
    fn masks(&self, camera: &Intrinsics, depths: &HeightImage) -> Result<Vec<Vec<u8>>> {
        let mut found = Vec::new();
        let photo = self.camera.as_ref();
        if let Some(Sized { size, data }) = &self.mask {
            // One at the depths' own size is about them, whatever the photo's camera has seen.
            let own = *size == [depths.width(), depths.height()];
            let photo = photo.filter(|_| !own);
            found.push(camera.within(depths, &Region::Mask(*size, data), photo, 0)?);
        }
        if let (Some(corners), Some(size)) = (&self.crop, self.photo) {
            let region = Region::Polygon(size, corners);
            found.push(camera.within(depths, &region, photo, BEYOND)?);
        }
        Ok(found)
    }
}

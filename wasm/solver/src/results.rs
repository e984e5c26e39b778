//! Results of the solver as plain JavaScript objects.

use js_sys::{Float64Array, Uint8Array};
use serde::{Serialize, Serializer};
use serde_wasm_bindgen::preserve;

use developable::HeightImage;
use developable::Report;

/// A fitted surface and the report, written as JavaScript's `Surface` object.
#[derive(Serialize)]
pub struct SurfaceOutput<'a> {
    pub rows: usize,
    pub cols: usize,
    pub spacing: f64,
    pub origin: [f64; 2],
    #[serde(with = "preserve")]
    pub heights: Float64Array,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub image: Option<ImageOutput>,
    pub report: &'a Report,
}

/// A height image that is a result, written as JavaScript's `HeightImage` object.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub struct ImageOutput {
    width: usize,
    height: usize,
    pixel_size: f64,
    #[serde(with = "preserve")]
    data: Float64Array,
}

impl From<&HeightImage> for ImageOutput {
    fn from(image: &HeightImage) -> Self {
        ImageOutput {
            width: image.width(),
            height: image.height(),
            pixel_size: image.pixel_size(),
            data: image.values().into(),
        }
    }
}

/// Detected occlusions, written as JavaScript's `DetectedOcclusions` object.
#[derive(Serialize)]
pub struct OcclusionsOutput {
    pub rows: usize,
    pub cols: usize,
    pub spacing: f64,
    pub origin: [f64; 2],
    #[serde(with = "preserve")]
    pub vertices: Uint8Array,
    #[serde(with = "preserve")]
    pub edges: Uint8Array,
    pub count: usize,
    #[serde(
        skip_serializing_if = "Option::is_none",
        serialize_with = "preserve_some"
    )]
    pub image: Option<Uint8Array>,
}

fn preserve_some<S: Serializer>(
    array: &Option<Uint8Array>,
    serializer: S,
) -> Result<S::Ok, S::Error> {
    match array {
        Some(array) => preserve::serialize(array, serializer),
        None => serializer.serialize_none(),
    }
}

//! Results as plain JS objects.

use js_sys::{Float64Array, Uint8Array};
use serde::{Serialize, Serializer};
use serde_wasm_bindgen::preserve;

use crate::HeightImage;
use crate::Report;

/// `Surface` of `types.d.ts`.
#[derive(Serialize)]
pub(super) struct SurfaceOutput<'a> {
    pub(super) rows: usize,
    pub(super) cols: usize,
    pub(super) spacing: f64,
    pub(super) origin: [f64; 2],
    #[serde(with = "preserve")]
    pub(super) heights: Float64Array,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) image: Option<ImageOutput>,
    pub(super) report: &'a Report,
}

/// A `HeightImage` of `types.d.ts` that is a result.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct ImageOutput {
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

/// `DetectedOcclusions` of `types.d.ts`.
#[derive(Serialize)]
pub(super) struct OcclusionsOutput {
    pub(super) rows: usize,
    pub(super) cols: usize,
    pub(super) spacing: f64,
    pub(super) origin: [f64; 2],
    #[serde(with = "preserve")]
    pub(super) vertices: Uint8Array,
    #[serde(with = "preserve")]
    pub(super) edges: Uint8Array,
    pub(super) count: usize,
    #[serde(
        skip_serializing_if = "Option::is_none",
        serialize_with = "preserve_some"
    )]
    pub(super) image: Option<Uint8Array>,
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

//! Results as plain JS objects.

use js_sys::Float64Array;
use serde::Serialize;
use serde_wasm_bindgen::preserve;

use crate::heightfield::HeightImage;
use crate::solver::Report;

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

//! Results of the solver as plain JavaScript objects.

use js_sys::{Float64Array, Uint8Array};
use serde::{Serialize, Serializer};
use serde_wasm_bindgen::preserve;

use developable::HeightImage;
use developable::Report;

/// Heights of a fitted surface on its hexagonal lattice, as in `Heightfield`, and the report on the fit.
#[derive(Serialize)]
#[serde(rename = "FittedHeights", rename_all = "camelCase")]
pub struct SurfaceOutput<'a> {
    /// Number of rows of the lattice.
    pub rows: usize,
    /// Number of columns of the lattice.
    pub cols: usize,
    /// Distance between neighbouring vertices of a row, in the surface's unit of length; rows are √3/2 of it apart.
    pub spacing: f64,
    /// Position `[x, y]` of the vertex in row 0, column 0, the upper left one; `y` points up. Odd rows are shifted to the left by half a `spacing`.
    pub origin: [f64; 2],
    /// `rows * cols` heights at the vertices, in the surface's unit of length, row by row, the top row first; NaN where the surface has no vertex.
    #[serde(with = "preserve")]
    pub heights: Float64Array,
    /// The surface at the pixels of the input, if that is an image.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub image: Option<ImageOutput>,
    /// Root mean square distance of `image` from the heights of the input, over the pixels that have both, in the surface's unit of length: what neither the lattice nor the fit has kept of them.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pixel_distance: Option<f64>,
    /// Report on the fit: what was solved, how well, and at what cost.
    pub report: &'a Report,
}

/// Heights of a surface at the pixels of an image.
#[derive(Serialize)]
#[serde(rename = "SurfaceImage", rename_all = "camelCase")]
pub struct ImageOutput {
    /// Number of pixels in a row.
    width: usize,
    /// Number of rows of pixels.
    height: usize,
    /// Side length of a pixel, in the surface's unit of length.
    pixel_size: f64,
    /// `width * height` heights at the pixels, row by row, the top row first: in the surface's unit of length, that is the input's steps times its `heightScale`; NaN where there is no surface.
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

/// Occlusions (jumps) that were detected in heights, at the vertices of a hexagonal lattice. As part of a heightfield, `vertices` can be given as `occlusions` and `edges` as `brokenEdges`.
#[derive(Serialize)]
#[serde(rename = "DetectedOcclusions")]
pub struct OcclusionsOutput {
    /// Number of rows of the lattice.
    pub rows: usize,
    /// Number of columns of the lattice.
    pub cols: usize,
    /// Distance between neighbouring vertices of a row, in the surface's unit of length; rows are √3/2 of it apart.
    pub spacing: f64,
    /// Position `[x, y]` of the vertex in row 0, column 0, the upper left one; `y` points up. Odd rows are shifted to the left by half a `spacing`.
    pub origin: [f64; 2],
    /// For each vertex, row by row, 1 if a solve would evaluate no Hessian there, else 0.
    #[serde(with = "preserve")]
    pub vertices: Uint8Array,
    /// Edges of the lattice across which the surface is torn, one byte for each vertex, row by row: bit 0 is the edge to the west, then east, north-west, north-east, south-west and south-east. `fit` takes it as `brokenEdges`.
    #[serde(with = "preserve")]
    pub edges: Uint8Array,
    /// Number of vertices whose flag is 1.
    pub count: usize,
    /// For an input that is an image: for each pixel, row by row, 1 if it has data and its nearest vertex has the flag 1 in `vertices`, else 0.
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

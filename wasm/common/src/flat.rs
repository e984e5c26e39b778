//! Flat images and their warp maps, in full and on a grid, as results for JavaScript.

use js_sys::{Float32Array, Uint8ClampedArray};
use serde::Serialize;
use serde_wasm_bindgen::preserve;

use super::Result;
use super::options::{Given, renamed};
use developable::checks::try_filled;
use developable::dewarp::{Photo, WarpGrid, WarpMap};

/// Number of rows of the flat image that are computed at a time and copied to JavaScript.
const BAND_ROWS: usize = 64;

/// Computes the flat image in JavaScript's memory, a band of rows at a time, so that the wasm module holds no copy of
/// it.
pub fn flat_image(map: &WarpMap, photo: &Photo<'_>) -> Result<Uint8ClampedArray> {
    let line = 4 * map.width();
    let image = Uint8ClampedArray::new_with_length((line * map.height()) as u32);
    let mut band = try_filled("flat image", line * BAND_ROWS.min(map.height()), 0)?;
    for start in (0..map.height()).step_by(BAND_ROWS) {
        let end = map.height().min(start + BAND_ROWS);
        let rgba = &mut band[..line * (end - start)];
        rgba.fill(0);
        map.image_rows(photo, start..end, rgba);
        let (from, to) = ((line * start) as u32, (line * end) as u32);
        image.subarray(from, to).copy_from(rgba);
    }
    Ok(image)
}

/// Options of a call that returns a warp map besides the flat image: whether in full, and whether on a grid.
pub struct MapOptions {
    map: bool,
    /// Maximum interpolation error between nodes of the warp grid, in pixels of the photo; `None` if no grid is wanted.
    grid: Option<f64>,
}

/// Default of the maximum interpolation error between nodes of a warp grid, in pixels of the photo.
const DEFAULT_GRID_TOLERANCE: f64 = 0.25;

/// Maximum number of nodes of a warp grid that is returned to JavaScript.
const MAX_GRID_NODES: usize = 40_000;

impl MapOptions {
    pub fn new(given: &mut Given) -> Self {
        let grid = given.value("grid");
        MapOptions {
            map: given.flag("map").unwrap_or(true),
            grid: match grid.as_bool() {
                Some(wanted) => wanted.then_some(DEFAULT_GRID_TOLERANCE),
                None => grid.as_f64(),
            },
        }
    }

    /// Places in the photo of all pixels of the flat image, as pairs of coordinates; empty unless the full map is
    /// wanted.
    pub fn places(&self, map: &WarpMap) -> Float32Array {
        let places = if self.map { map.places() } else { &[] };
        places.as_flattened().into()
    }

    pub fn grid(&self, map: &WarpMap) -> Result<Option<GridOutput>> {
        let found = (self.grid)
            .map(|tolerance| map.grid(tolerance, MAX_GRID_NODES))
            .transpose()
            .map_err(|error| renamed(error, "tolerance", "grid"))?;
        Ok(found.as_ref().map(GridOutput::new))
    }
}

/// A warp map on a grid, written as JavaScript's `WarpGrid` object.
#[derive(Serialize)]
pub struct GridOutput {
    columns: usize,
    rows: usize,
    step: [f64; 2],
    #[serde(with = "preserve")]
    places: Float32Array,
    rms: f64,
    maximum: f64,
}

impl GridOutput {
    fn new(grid: &WarpGrid) -> Self {
        GridOutput {
            columns: grid.columns,
            rows: grid.rows,
            step: grid.step,
            places: grid.places.as_flattened().into(),
            rms: grid.rms,
            maximum: grid.maximum,
        }
    }
}

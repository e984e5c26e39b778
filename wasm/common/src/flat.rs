//! Flat images and their warp maps, in full and on a grid, as results for JavaScript.

use std::ops::Range;

use js_sys::{Float32Array, Uint8ClampedArray};
use serde::{Deserialize, Serialize};
use serde_wasm_bindgen::preserve;

use super::Result;
use super::options::renamed;
use developable::checks::try_filled;
use developable::dewarp::{WarpGrid, WarpMap};
use developable::page::cleaning::{CleaningOptions, Light, LightEstimator, binarise};

/// Number of rows of the flat image that are computed at a time and copied to JavaScript.
const BAND_ROWS: usize = 64;

/// Computes a flat image of `width` by `height` pixels in JavaScript's memory, a band of rows at a time, so that the wasm
/// module holds no copy of it; cleans it as the options say, and returns what happened to its light. `image_rows` writes the
/// RGBA bytes of some rows, transparent before the call.
pub fn flat_image(
    [width, height]: [usize; 2],
    image_rows: impl Fn(Range<usize>, &mut [u8]) -> Result<()>,
    cleaning: &CleaningOptions,
) -> Result<(Uint8ClampedArray, Light)> {
    let line = 4 * width;
    let image = Uint8ClampedArray::new_with_length((line * height) as u32);
    let mut band = try_filled("flat image", line * BAND_ROWS.min(height), 0)?;
    let bands = || {
        (0..height)
            .step_by(BAND_ROWS)
            .map(|start| start..height.min(start + BAND_ROWS))
    };
    let place =
        |rows: &Range<usize>| image.subarray((line * rows.start) as u32, (line * rows.end) as u32);
    let mut estimator = match cleaning.needs_light() {
        true => Some(LightEstimator::new(width, height)?),
        false => None,
    };
    for rows in bands() {
        let rgba = &mut band[..line * rows.len()];
        rgba.fill(0);
        image_rows(rows.clone(), rgba)?;
        place(&rows).copy_from(rgba);
        if let Some(estimator) = &mut estimator {
            for (row, pixels) in rows.zip(rgba.chunks_exact(line)) {
                estimator.add_row(row, pixels);
            }
        }
    }
    let Some(light) = estimator.map(LightEstimator::finish) else {
        return Ok((image, Light::Keep));
    };
    let mut plane = try_filled(
        "flat image",
        if cleaning.ink { width * height } else { 0 },
        0,
    )?;
    for rows in bands() {
        let rgba = &mut band[..line * rows.len()];
        place(&rows).copy_to(rgba);
        for (row, pixels) in rows.clone().zip(rgba.chunks_exact_mut(line)) {
            light.apply(row, pixels);
        }
        if cleaning.ink {
            for (value, pixel) in plane[width * rows.start..]
                .iter_mut()
                .zip(rgba.as_chunks().0)
            {
                *value = light.luminance(pixel);
            }
        }
        place(&rows).copy_from(rgba);
    }
    if cleaning.ink {
        binarise(width, height, &mut plane)?;
        for rows in bands() {
            let rgba = &mut band[..line * rows.len()];
            place(&rows).copy_to(rgba);
            for (value, pixel) in plane[width * rows.start..]
                .iter()
                .zip(rgba.as_chunks_mut::<4>().0)
            {
                pixel[..3].fill(*value);
            }
            place(&rows).copy_from(rgba);
        }
    }
    Ok((image, light.kind()))
}

/// Options of cleaning the flat image.
#[derive(Default, Deserialize)]
#[serde(default)]
pub struct CleaningInput {
    light: Option<Light>,
    ink: bool,
}

impl CleaningInput {
    /// Returns the options of cleaning; `default` says what happens to the light where nothing is said of it.
    pub fn options(&self, default: Light) -> CleaningOptions {
        CleaningOptions::default()
            .light(self.light.unwrap_or(default))
            .ink(self.ink)
    }
}

/// Options of a call that returns a warp map besides the flat image: whether in full, and whether on a grid.
#[derive(Deserialize)]
#[serde(default)]
pub struct MapOptions {
    map: bool,
    grid: Grid,
}

/// Whether a warp grid is wanted, or the maximum interpolation error between its nodes, in pixels of the photo.
#[derive(Deserialize)]
#[serde(untagged, expecting = "expected true, false or a number")]
enum Grid {
    Wanted(bool),
    Tolerance(f64),
}

impl Default for MapOptions {
    fn default() -> Self {
        MapOptions {
            map: true,
            grid: Grid::Wanted(false),
        }
    }
}

/// Default of the maximum interpolation error between nodes of a warp grid, in pixels of the photo.
const DEFAULT_GRID_TOLERANCE: f64 = 0.25;

/// Maximum number of nodes of a warp grid that is returned to JavaScript.
const MAX_GRID_NODES: usize = 40_000;

impl MapOptions {
    /// Maximum interpolation error between nodes of the warp grid, in pixels of the photo; `None` if no grid is wanted.
    fn tolerance(&self) -> Option<f64> {
        match self.grid {
            Grid::Wanted(wanted) => wanted.then_some(DEFAULT_GRID_TOLERANCE),
            Grid::Tolerance(tolerance) => Some(tolerance),
        }
    }

    /// Whether a warp map is to be returned, in full or on a grid.
    pub fn any(&self) -> bool {
        self.map || self.tolerance().is_some()
    }

    /// Places in the photo of all pixels of the flat image, as pairs of coordinates; empty unless the full map is
    /// wanted.
    pub fn places(&self, map: Option<&WarpMap>) -> Float32Array {
        let places = map.filter(|_| self.map).map_or(&[][..], WarpMap::places);
        places.as_flattened().into()
    }

    /// The map on a grid, if that is wanted.
    pub fn grid(&self, map: Option<&WarpMap>) -> Result<Option<GridOutput>> {
        let found = (self.tolerance().zip(map))
            .map(|(tolerance, map)| map.grid(tolerance, MAX_GRID_NODES))
            .transpose()
            .map_err(|error| renamed(error, "tolerance", "grid"))?;
        Ok(found.as_ref().map(GridOutput::new))
    }
}

/// Warp map on a grid over the flat image, bilinear between its nodes. The node in column i of row j is at the pixel `(i * step[0], j * step[1])`, counted from the centre of the upper left one; the last node is at the lower right pixel.
#[derive(Serialize)]
#[serde(rename = "WarpGrid")]
pub struct GridOutput {
    /// Number of nodes in each row of the grid.
    columns: usize,
    /// Number of rows of the grid.
    rows: usize,
    /// Distance between neighbouring nodes to the right and down, in pixels of the flat image.
    step: [f64; 2],
    /// Place x, y of each node in the photo, in pixels, row by row; NaN where there is no sheet around the node. Nodes just outside of the sheet have an extrapolated place.
    #[serde(with = "preserve")]
    places: Float32Array,
    /// Root mean square error of the interpolation over the sheet, in pixels of the photo.
    rms: f64,
    /// Largest error of the interpolation over the sheet, in pixels of the photo. It is above the tolerance where 40000 nodes are not enough, as at sharp creases.
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

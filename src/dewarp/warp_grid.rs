//! Warp maps reduced to the nodes of a coarser grid, interpolated bilinearly in between.

use super::WarpMap;
use super::bilinear::bilinear;
use super::local_quadratic::LocalQuadratic;
use crate::error::{Error, Result, positive, try_filled};
use crate::math::lanes;

/// A warp map at the nodes of a grid over the flat image.
///
/// Node `[i, j]` is at the pixel `[i · step, j · step]`, `[0, 0]` being the centre of the upper left pixel and the last
/// node that of the lower right one; places in between are bilinear. The grid applies to flat images of any size, by
/// shares of the way from the first node to the last one.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct WarpGrid {
    /// Number of nodes in each row of the grid.
    pub columns: usize,
    /// Number of rows of the grid.
    pub rows: usize,
    /// Pixels of the flat image from one node to the next, along rows and along columns.
    pub step: [f64; 2],
    /// Places of the nodes in the photo, in pixels, row by row; NaN for nodes with no sheet around them. Nodes just
    /// beside the sheet have an extrapolated place, so that all of the sheet lies between nodes with places.
    pub places: Vec<[f32; 2]>,
    /// Root mean square error of the interpolated places against the full map, in pixels of the photo, over all pixels
    /// of the sheet.
    pub rms: f64,
    /// Maximum error of the interpolated places against the full map, in pixels of the photo.
    pub maximum: f64,
}

/// Number of cells along the longer side of the coarsest grid that is tried for a warp map.
const COARSEST_GRID_CELLS: f64 = 16.0;

/// Factor from one grid that is tried for a warp map to the next finer one, in the number of cells along a side.
const GRID_REFINEMENT_FACTOR: f64 = 1.4;

/// Maximum number of pixels at which the interpolation error of a tried grid is measured.
const MAX_MEASURED_PIXELS: usize = 200_000;

impl WarpMap {
    /// Reduces the map to the coarsest grid that is exact to `tolerance`, in pixels of the photo, or else to the finest
    /// one with at most `most` nodes: sheets with creases need many. Costs `O(pixels + nodes)`.
    ///
    /// # Errors
    /// [`Error::Option`] for a tolerance that is not positive and finite or less than 4 nodes,
    /// [`Error::OutOfMemory`].
    pub fn grid(&self, tolerance: f64, most: usize) -> Result<WarpGrid> {
        positive("tolerance", tolerance)?;
        if most < 4 {
            return Err(Error::option("most", most, "must be 4 nodes or more"));
        }
        let sides = [self.width(), self.height()].map(|n| (n - 1) as f64);
        let longer = sides[0].max(sides[1]).max(1.0);
        let shape =
            |cells: f64| sides.map(|side| ((side / longer * cells).ceil() as usize).max(1) + 1);
        let pixels = self.places().len();
        let mut cells = COARSEST_GRID_CELLS;
        while shape(cells)[0] * shape(cells)[1] > most && cells > 1.0 {
            cells /= GRID_REFINEMENT_FACTOR;
        }
        let mut grid = self.sampled(shape(cells))?;
        let stride = pixels / MAX_MEASURED_PIXELS + 1;
        loop {
            grid.measure(self, stride);
            cells *= GRID_REFINEMENT_FACTOR;
            let [columns, rows] = shape(cells);
            let enough = grid.maximum <= tolerance || cells > longer;
            if enough || columns * rows > most {
                break;
            }
            grid = self.sampled([columns, rows])?;
        }
        if stride > 1 {
            grid.measure(self, 1);
        }
        Ok(grid)
    }

    /// Samples the map at the nodes of a grid of given numbers of columns and rows; errors are not measured yet.
    fn sampled(&self, [columns, rows]: [usize; 2]) -> Result<WarpGrid> {
        let sides = [self.width(), self.height()].map(|n| (n - 1) as f64);
        let step = [
            sides[0] / (columns - 1) as f64,
            sides[1] / (rows - 1) as f64,
        ];
        let mut places = try_filled("warp grid", columns * rows, [f32::NAN; 2])?;
        for (i, place) in places.iter_mut().enumerate() {
            let node = [
                (i % columns) as f64 * step[0],
                (i / columns) as f64 * step[1],
            ];
            *place = match self.interpolate(node) {
                Some(place) => place.map(lanes::single),
                None => self.extrapolate(node, step).unwrap_or(*place),
            };
        }
        Ok(WarpGrid {
            columns,
            rows,
            step,
            places,
            rms: 0.0,
            maximum: 0.0,
        })
    }

    /// Interpolates the place in the photo bilinearly between pixels of the flat image; None unless all pixels with a
    /// weight have a place.
    pub(super) fn interpolate(&self, [x, y]: [f64; 2]) -> Option<[f64; 2]> {
        let [width, height] = [self.width(), self.height()];
        bilinear([x, y], [width, height], |i| self.places()[i].map(f64::from))
    }

    /// Extrapolates the place in the photo of a node beside the sheet, by a local quadratic; None if there is no sheet
    /// in the grid's cells around the node.
    fn extrapolate(&self, node: [f64; 2], step: [f64; 2]) -> Option<[f32; 2]> {
        let reach = step[0].max(step[1]);
        // Pixels in the four cells around the node.
        let range = |k: usize, size: usize| {
            let [low, high] = [-1.0, 1.0].map(|side| node[k] + side * step[k]);
            low.ceil().max(0.0) as usize..(high.floor() as usize + 1).min(size)
        };
        let mut near = ([0.0; 2], 0.0);
        for row in range(1, self.height()) {
            for col in range(0, self.width()) {
                if !self.places()[row * self.width() + col][0].is_nan() {
                    near.0[0] += col as f64;
                    near.0[1] += row as f64;
                    near.1 += 1.0;
                }
            }
        }
        if near.1 == 0.0 {
            return None;
        }
        let middle = near.0.map(|sum| sum / near.1);
        let fit = LocalQuadratic::new(self, middle, 1.5 * reach.max(2.0))?;
        Some(fit.at(node).map(lanes::single))
    }
}

impl WarpGrid {
    /// Interpolates the place in the photo of a pixel of the flat image, or of a point between pixels; None where there
    /// is no sheet nearby.
    pub fn at(&self, [x, y]: [f64; 2]) -> Option<[f64; 2]> {
        // A side of one pixel has nodes that coincide.
        let share = |v: f64, step: f64| if step > 0.0 { v / step } else { 0.0 };
        let node = [share(x, self.step[0]), share(y, self.step[1])];
        bilinear(node, [self.columns, self.rows], |i| {
            self.places[i].map(f64::from)
        })
    }

    /// Measures the grid's interpolation error against the full map at every `stride`-th pixel of each row.
    fn measure(&mut self, map: &WarpMap, stride: usize) {
        let (mut squares, mut maximum, mut count) = (0.0, 0.0f64, 0.0);
        for (row, places) in map.places().chunks_exact(map.width()).enumerate() {
            // Rows begin at different columns.
            for col in (row % stride..map.width()).step_by(stride) {
                let place = places[col];
                if place[0].is_nan() {
                    continue;
                }
                let square = match self.at([col as f64, row as f64]) {
                    Some([x, y]) => {
                        (x - f64::from(place[0])).powi(2) + (y - f64::from(place[1])).powi(2)
                    }
                    None => f64::INFINITY,
                };
                squares += square;
                maximum = maximum.max(square);
                count += 1.0;
            }
        }
        self.rms = (squares / f64::max(count, 1.0)).sqrt();
        self.maximum = maximum.sqrt();
    }
}

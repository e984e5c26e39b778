//! Warp maps in little room: places at the nodes of a grid, bilinear in between.

use super::WarpMap;
use super::local::Local;
use crate::error::{Error, Result, positive, try_filled};
use crate::math::lanes;

/// A warp map at the nodes of a grid over the flat image.
///
/// Node `[i, j]` is at the pixel `[i · step, j · step]`, `[0, 0]` being the centre of the upper left
/// pixel and the last one that of the lower right; in between places are bilinear. So it serves flat images of
/// any size: the share of the way from the first node to the last one is what counts.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct WarpGrid {
    /// Nodes along a row.
    pub columns: usize,
    /// Rows of nodes.
    pub rows: usize,
    /// Pixels of the flat image from one node to the next, along rows and along columns.
    pub step: [f64; 2],
    /// The nodes' places in the photo, row by row, NaN for those around which there is no sheet. Those just
    /// beside it have the place at which the map would go on, so that all the sheet lies between nodes
    /// with places.
    pub places: Vec<[f32; 2]>,
    /// How far its places are from those of the map, in pixels of the photo: root mean square over
    /// all pixels of the sheet.
    pub rms: f64,
    /// The same, at most.
    pub maximum: f64,
}

/// Cells along the longer side: how many to begin with, and how many more each time.
const COARSEST: f64 = 16.0;
const FINER: f64 = 1.4;

/// Pixels that are looked at to choose the step.
const LOOKS: usize = 200_000;

impl WarpMap {
    /// The map on the coarsest of some grids whose places are right to `tolerance`, in pixels of the
    /// photo, or on the last one that has no more than `most` nodes: creases take many.
    /// Costs `O(pixels + nodes)`.
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
        let mut cells = COARSEST;
        while shape(cells)[0] * shape(cells)[1] > most && cells > 1.0 {
            cells /= FINER;
        }
        let mut grid = self.sampled(shape(cells))?;
        let stride = pixels / LOOKS + 1;
        loop {
            grid.measure(self, stride);
            cells *= FINER;
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
            *place = match self.between(node) {
                Some(place) => place.map(lanes::single),
                None => self.beside(node, step).unwrap_or(*place),
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

    /// The place between four pixels that have one.
    pub(super) fn between(&self, [x, y]: [f64; 2]) -> Option<[f64; 2]> {
        let [width, height] = [self.width(), self.height()];
        bilinear([x, y], [width, height], |i| self.places()[i].map(f64::from))
    }

    /// Where the map would go on at a node, if there is sheet in the cells around it.
    fn beside(&self, node: [f64; 2], step: [f64; 2]) -> Option<[f32; 2]> {
        let reach = step[0].max(step[1]);
        // Only what lies in one of the four cells around is of use.
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
        let fit = Local::new(self, middle, 1.5 * reach.max(2.0))?;
        Some(fit.at(node).map(lanes::single))
    }
}

impl WarpGrid {
    /// The place at a pixel of the flat image, or between pixels. Nothing where there is no sheet near.
    pub fn at(&self, [x, y]: [f64; 2]) -> Option<[f64; 2]> {
        // A side of one pixel has nodes that coincide.
        let share = |v: f64, step: f64| if step > 0.0 { v / step } else { 0.0 };
        let node = [share(x, self.step[0]), share(y, self.step[1])];
        bilinear(node, [self.columns, self.rows], |i| {
            self.places[i].map(f64::from)
        })
    }

    fn measure(&mut self, map: &WarpMap, stride: usize) {
        let (mut squares, mut maximum, mut count) = (0.0, 0.0f64, 0.0);
        for (row, places) in map.places().chunks_exact(map.width()).enumerate() {
            // Other columns in each row.
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

/// Between four values of a field, where all of them are there.
fn bilinear(
    [x, y]: [f64; 2],
    [columns, rows]: [usize; 2],
    value: impl Fn(usize) -> [f64; 2],
) -> Option<[f64; 2]> {
    const SLACK: f64 = 1e-6;
    let [right, bottom] = [columns, rows].map(|n| (n - 1) as f64);
    if !((-SLACK..=right + SLACK).contains(&x) && (-SLACK..=bottom + SLACK).contains(&y)) {
        return None;
    }
    let cell = |v: f64, n: usize| (v.max(0.0) as usize).min(n.saturating_sub(2));
    let (col, row) = (cell(x, columns), cell(y, rows));
    let (fx, fy) = (x - col as f64, y - row as f64);
    let mut sum = [0.0; 2];
    for (dx, dy, weight) in [
        (0, 0, (1.0 - fx) * (1.0 - fy)),
        (1, 0, fx * (1.0 - fy)),
        (0, 1, (1.0 - fx) * fy),
        (1, 1, fx * fy),
    ] {
        // What has no weight need not be there.
        if weight.abs() > SLACK {
            let found = value((row + dy) * columns + col + dx);
            sum = [sum[0] + weight * found[0], sum[1] + weight * found[1]];
        }
    }
    (!sum[0].is_nan()).then_some(sum)
}

//! Table of the places in the photo that belong to a fine grid over a flat page.

use super::grid::{SheetGrid, node_shares};
use super::view::PhotoView;
use crate::dewarp::bilinear;
use crate::error::{Error, Result};
use crate::math::planar::{difference, polyline_length};

/// Number of table cells along each side of a cell of the sheet's grid: bilinear interpolation is exact to a hundredth
/// of a pixel then.
const CELLS_PER_GRID_CELL: usize = 6;

/// Places in the photo, in pixels, at the nodes of a grid over the flat page; interpolated bilinearly in between.
#[derive(Debug, Clone)]
pub(in crate::page) struct PlaceTable {
    /// Numbers of columns and rows of the nodes.
    nodes: [usize; 2],
    places: Vec<[f64; 2]>,
}

impl PlaceTable {
    /// Makes the table by projecting a sheet in space to the photo at each of the table's nodes.
    ///
    /// # Errors
    /// [`Error::Empty`] for a sheet that is not in front of the camera.
    pub(super) fn new(grid: &SheetGrid, view: &PhotoView) -> Result<Self> {
        let nodes = [grid.cols, grid.rows].map(|n| (n - 1) * CELLS_PER_GRID_CELL + 1);
        let places: Option<Vec<_>> = node_shares(nodes)
            .map(|share| {
                let seen = grid.camera.project(grid.smooth_at(share))?;
                Some(view.to_pixels(seen))
            })
            .collect();
        let places = places.ok_or(Error::Empty { what: "page" })?;
        Ok(PlaceTable { nodes, places })
    }

    /// Width and height of the page in the photo, in pixels, along the lines through its middle.
    pub fn seen_size(&self) -> [f64; 2] {
        let length = |count: usize, share: fn(f64) -> [f64; 2]| {
            let places = (0..count).map(|i| self.at(share(i as f64 / (count - 1) as f64)));
            polyline_length(&places.collect::<Vec<_>>())
        };
        [
            length(self.nodes[0], |along| [along, 0.5]),
            length(self.nodes[1], |along| [0.5, along]),
        ]
    }

    /// Numbers of columns and rows of the table's nodes.
    pub fn nodes(&self) -> [usize; 2] {
        self.nodes
    }

    /// Finds the place on the flat page, in shares of its width and height, that the photo shows at a pixel: from the nearest
    /// node of the sheet's grid in ever smaller steps to the nearest place. None if the pixel is not on the page.
    pub fn back_project(&self, pixel: [f64; 2]) -> Option<[f64; 2]> {
        let off = |share: [f64; 2]| {
            let [x, y] = difference(self.at(share), pixel);
            x * x + y * y
        };
        let nearest = |one: &[f64; 2], other: &[f64; 2]| off(*one).total_cmp(&off(*other));
        let grid = self.nodes.map(|n| (n - 1) / CELLS_PER_GRID_CELL + 1);
        let nodes = node_shares(grid).map(|share| (share, off(share)));
        let (mut best, _) = nodes.min_by(|(_, one), (_, other)| one.total_cmp(other))?;
        let mut step = grid.map(|nodes| 1.0 / (nodes - 1) as f64);
        while step[0] > f64::EPSILON {
            let around = (0..9).map(|k| {
                let sides = [k % 3, k / 3].map(|side| f64::from(side) - 1.0);
                [0, 1].map(|j| (best[j] + sides[j] * step[j]).clamp(0.0, 1.0))
            });
            let found = around
                .min_by(nearest)
                .filter(|found| off(*found) < off(best));
            match found {
                Some(found) => best = found,
                None => step = step.map(|step| 0.5 * step),
            }
        }
        // To one pixel: outside of the page the nearest place on it is farther away.
        (off(best) < 1.0).then_some(best)
    }

    /// Interpolates the place in the photo, in pixels, at shares of the page's width and height.
    #[inline]
    pub fn at(&self, share: [f64; 2]) -> [f64; 2] {
        let at = [0, 1].map(|k| share[k] * (self.nodes[k] - 1) as f64);
        bilinear(at, self.nodes, |i| self.places[i]).unwrap_or([f64::NAN; 2])
    }
}

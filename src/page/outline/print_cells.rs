//! Print in a photo, counted by cells, by which a page is known: all print lies on it.

use super::morphology::box_mean;
use super::tracing::Views;
use crate::math::planar::{polygon_area, polygon_contains};

/// Minimum difference of logarithmic colour between a pixel and the same pixel with print suppressed for it to count as
/// print.
const MIN_PRINT_CONTRAST: f32 = 0.2;

/// Half the side, in pixels of the reduced photo, of the square in which the share of print pixels is measured: a few lines
/// of text.
const PRINT_RADIUS: usize = 20;

/// Minimum share of print pixels in the square around a pixel for it to be text or a picture, and not a thin shadow
/// along an edge.
const MIN_PRINT_DENSITY: f32 = 0.15;

/// Distance, in pixels of the reduced photo, from print within which an edge pixel is the print's own edge, and none of a
/// page.
const PRINT_EDGE_RADIUS: usize = 4;

/// Side, in pixels of the reduced photo, of the square cells by which print is counted: a bar is as much print as a line of
/// text.
const CELL_PIXELS: usize = 16;

/// Minimum share of an outline's cells in which there is print: with less, a page cannot be known by it.
const MIN_PRINT_SHARE: f64 = 0.1;

/// Exponent of the share of all print that lies in an outline: a page contains all of it, and a tenth outside costs a third.
const PRINT_POWER: i32 = 4;

/// The print in a photo.
pub(super) struct PrintCells {
    /// Whether each pixel of the reduced photo is print among print, or beside it.
    at_print: Vec<bool>,
    /// Number of columns of the reduced photo.
    width: usize,
    /// Centres of the cells in which there is print, in pixels of the reduced photo.
    cells: Vec<[f64; 2]>,
}

impl PrintCells {
    /// Finds the print in a photo: what a closing suppresses, where there is more of it around.
    pub fn new(Views { raw, clean }: &Views) -> Self {
        let (width, height) = (raw.width, raw.height);
        let is_print = |i: usize| {
            (0..3).any(|k| clean.channels[k][i] - raw.channels[k][i] > MIN_PRINT_CONTRAST)
        };
        let print: Vec<bool> = (0..raw.len()).map(is_print).collect();
        let share_within = |radius: usize| {
            let mut share: Vec<f32> = print.iter().map(|p| f32::from(u8::from(*p))).collect();
            box_mean(&mut share, width, height, radius);
            share
        };
        let at_print: Vec<bool> = (share_within(PRINT_RADIUS).iter())
            .zip(share_within(PRINT_EDGE_RADIUS))
            .map(|(around, beside)| *around > MIN_PRINT_DENSITY && beside > 0.0)
            .collect();
        let [cols, rows] = [width, height].map(|n| n / CELL_PIXELS);
        let has_print = |cell: &usize| {
            let [x, y] = [cell % cols, cell / cols].map(|n| n * CELL_PIXELS);
            (0..CELL_PIXELS * CELL_PIXELS).any(|k| {
                let i = (y + k / CELL_PIXELS) * width + x + k % CELL_PIXELS;
                print[i] && at_print[i]
            })
        };
        let centre = |n: usize| (n as f64 + 0.5) * CELL_PIXELS as f64;
        let cells = (0..cols * rows)
            .filter(has_print)
            .map(|cell| [centre(cell % cols), centre(cell / cols)])
            .collect();
        PrintCells {
            at_print,
            width,
            cells,
        }
    }

    /// Whether a pixel of the reduced photo is print among print, or beside it.
    pub fn is_at_print(&self, [x, y]: [usize; 2]) -> bool {
        self.at_print[y * self.width + x]
    }

    /// Likeness to a page, from 0 to 1, of a region with the given corners, in pixels of the reduced photo, by the share of
    /// all print in it. 0 if there is hardly any.
    pub fn likeness(&self, corners: &[[f64; 2]; 4]) -> f64 {
        let inside = (self.cells.iter())
            .filter(|cell| polygon_contains(corners, **cell))
            .count();
        let area = polygon_area(corners).abs() / (CELL_PIXELS * CELL_PIXELS) as f64;
        if (inside as f64) < MIN_PRINT_SHARE * area {
            return 0.0;
        }
        (inside as f64 / self.cells.len().max(1) as f64).powi(PRINT_POWER)
    }
}

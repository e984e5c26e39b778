//! Print in a photo, by which a page is known: all print lies on it.

use super::edge_path::AVERAGING_RADIUS;
use super::morphology::box_mean;
use super::views::Views;
use crate::math::planar::polygon_contains;

/// Minimum difference of logarithmic colour between a pixel and the same pixel with print suppressed for it to count as
/// print.
/// Its row: `benches/page.md`, Constants of the outline.
const MIN_PRINT_CONTRAST: f32 = 0.1;

/// Minimum ratio of the smaller to the larger eigenvalue of the structure tensor at print: letters have strokes of all
/// directions, edges and folds of one.
/// Its row: `benches/page.md`, Constants of the outline.
const MIN_PRINT_ISOTROPY: f32 = 0.2;

/// Minimum smaller eigenvalue of the structure tensor at print, in squared logarithmic colour per pixel: crumpled paper has
/// less.
/// Its row: `benches/page.md`, Constants of the outline.
const MIN_PRINT_ENERGY: f32 = 5e-3;

/// The print in a photo.
pub(super) struct Print {
    /// Whether each pixel of the reduced photo is among letters.
    is_among_letters: Vec<bool>,
    /// Number of columns of the reduced photo.
    width: usize,
    /// Dark pixels of the reduced photo among letters.
    pub pixels: Vec<[f64; 2]>,
}

impl Print {
    /// Finds the print in a photo: dark marks where contrast of all directions is strong.
    pub fn new(Views { raw, clean }: &Views) -> Self {
        let (width, height) = (raw.width, raw.height);
        let mut tensor = [const { Vec::new() }; 3].map(|_: Vec<f32>| vec![0.0; raw.len()]);
        for plane in &raw.channels {
            for i in width + 1..raw.len() - width - 1 {
                let [x, y] = [1, width].map(|step| 0.5 * (plane[i + step] - plane[i - step]));
                for (entry, product) in tensor.iter_mut().zip([x * x, x * y, y * y]) {
                    entry[i] += product;
                }
            }
        }
        for entry in &mut tensor {
            // Over a few letters.
            box_mean(entry, width, height, AVERAGING_RADIUS);
        }
        let is_among_letters: Vec<bool> = (0..raw.len())
            .map(|i| {
                let [xx, xy, yy] = tensor.each_ref().map(|entry| entry[i]);
                let (mean, spread) = (0.5 * (xx + yy), (0.5 * (xx - yy)).hypot(xy));
                let (low, high) = (mean - spread, mean + spread);
                low > MIN_PRINT_ENERGY && low > MIN_PRINT_ISOTROPY * high
            })
            .collect();
        let is_dark = |i: usize| {
            (0..3).any(|k| clean.channels[k][i] - raw.channels[k][i] > MIN_PRINT_CONTRAST)
        };
        let pixels = (0..raw.len())
            .filter(|i| is_among_letters[*i] && is_dark(*i))
            .map(|i| [i % width, i / width].map(|at| at as f64))
            .collect();
        Print {
            is_among_letters,
            width,
            pixels,
        }
    }

    /// Whether a pixel of the reduced photo is among letters.
    pub fn is_among_letters(&self, [x, y]: [usize; 2]) -> bool {
        self.is_among_letters[y * self.width + x]
    }

    /// Share of all print that is in a region with the given corners, in pixels of the reduced photo.
    pub fn share_within(&self, corners: &[[f64; 2]; 4]) -> f64 {
        let inside = (self.pixels.iter()).filter(|pixel| polygon_contains(corners, **pixel));
        inside.count() as f64 / self.pixels.len().max(1) as f64
    }
}

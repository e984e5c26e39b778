//! Extrapolation of a warp map beyond the border of its sheet.

use super::WarpMap;
use super::local_quadratic::LocalQuadratic;
use crate::error::{Result, checked_cells, try_filled};
use crate::math::index::NO_INDEX;
use crate::math::lanes;

impl WarpMap {
    /// Adds `margin` pixels on each side of the flat image and extrapolates the sheet to all pixels within that
    /// distance: holes and bays are filled, and a saw-toothed border can be cut straight. Each new pixel is
    /// extrapolated from the sheet's nearest one, by the least-squares quadratic of the map around that one. Costs
    /// `O(pixels)`.
    ///
    /// # Errors
    /// [`Error::TooLarge`](crate::Error::TooLarge), [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub(super) fn with_continued_sheet(mut self, margin: usize) -> Result<Self> {
        let [width, height] = [self.width(), self.height()].map(|n| n + 2 * margin);
        checked_cells("flat image", height, width)?;
        self.frame([-(margin as isize); 2], [width, height])?;
        let nearest = nearest_sheet_pixels(&self)?;
        // One fit for all pixels that are extrapolated from the same cell.
        let cell = margin.div_ceil(2).max(1);
        let across = width.div_ceil(cell);
        let mut fits: Vec<Option<Option<LocalQuadratic>>> = Vec::new();
        fits.resize_with(across * height.div_ceil(cell), || None);
        let mut found = Vec::new();
        for (i, from) in nearest.iter().enumerate() {
            if *from == NO_INDEX || *from as usize == i {
                continue;
            }
            let pixel = |i: usize| [(i % width) as f64, (i / width) as f64];
            let (here, edge) = (pixel(i), pixel(*from as usize));
            let way = [here[0] - edge[0], here[1] - edge[1]];
            // Along rows and columns, so that a page's corners are as near as its sides.
            if way[0].abs().max(way[1].abs()) > margin as f64 {
                continue;
            }
            let [col, row] = edge.map(|v| v as usize / cell);
            let fit = fits[row * across + col].get_or_insert_with(|| {
                let middle = [col, row].map(|k| (k * cell) as f64 + 0.5 * cell as f64);
                LocalQuadratic::new(&self, middle, 4.0 * cell as f64)
            });
            let Some(fit) = fit else { continue };
            let (there, at_edge) = (fit.at(here), fit.at(edge));
            let place = self.places()[*from as usize];
            let place = [0, 1].map(|k| lanes::single(f64::from(place[k]) + there[k] - at_edge[k]));
            found.push((i, place));
        }
        for (i, place) in found {
            self.places_mut()[i] = place;
        }
        Ok(self)
    }
}

/// Finds for each pixel of the flat image the (nearly) nearest pixel that shows the sheet, by a distance transform;
/// returns pixel numbers, or [`NO_INDEX`] if there is no sheet. Two sweeps (P.-E. Danielsson, *Euclidean distance
/// mapping*, 1980).
fn nearest_sheet_pixels(map: &WarpMap) -> Result<Vec<u32>> {
    let (width, height) = (map.width(), map.height());
    let mut nearest = try_filled("flat image", width * height, NO_INDEX)?;
    for (i, place) in map.places().iter().enumerate() {
        if !place[0].is_nan() {
            nearest[i] = i as u32;
        }
    }
    let square = |from: usize, to: u32| {
        let to = to as usize;
        let way = [
            (from % width).abs_diff(to % width) as u64,
            (from / width).abs_diff(to / width) as u64,
        ];
        way[0] * way[0] + way[1] * way[1]
    };
    let take = |nearest: &mut [u32], i: usize, other: usize| {
        let candidate = nearest[other];
        let own = nearest[i];
        if candidate != NO_INDEX && (own == NO_INDEX || square(i, candidate) < square(i, own)) {
            nearest[i] = candidate;
        }
    };
    // Downwards, each row to the right and back; then upwards likewise.
    for pass in 0..2 {
        for step in 0..height {
            let row = if pass == 0 { step } else { height - 1 - step };
            let beside = match pass {
                0 => row.checked_sub(1),
                _ => (row + 1 < height).then_some(row + 1),
            };
            for col in 0..width {
                let i = row * width + col;
                // On the sheet nothing is nearer.
                if nearest[i] == i as u32 {
                    continue;
                }
                if let Some(beside) = beside {
                    for col in col.saturating_sub(1)..(col + 2).min(width) {
                        take(&mut nearest, i, beside * width + col);
                    }
                }
                if col > 0 {
                    take(&mut nearest, i, i - 1);
                }
            }
            for col in (0..width - 1).rev() {
                let i = row * width + col;
                if nearest[i] != i as u32 {
                    take(&mut nearest, i, i + 1);
                }
            }
        }
    }
    Ok(nearest)
}

//! A sheet continued beyond its border.

use super::WarpMap;
use super::local::Local;
use crate::error::{Result, checked_cells, try_filled};
use crate::math::lanes;

/// Marks a pixel from which no sheet was found.
const FAR: u32 = u32::MAX;

impl WarpMap {
    /// The map with `margin` pixels more on each side, in which the sheet goes on smoothly where there was
    /// none within so many pixels: holes and bays are filled, and a saw-toothed border has room to be cut
    /// straight. Each new pixel goes on from the sheet's nearest one, by the quadratic that fits the map
    /// around there best.
    pub(super) fn continued(self, margin: usize) -> Result<Self> {
        let [width, height] = [self.width(), self.height()].map(|n| n + 2 * margin);
        let mut map = self.padded(margin)?;
        let nearest = nearest(&map)?;
        // One fit for all pixels that go on from the same cell.
        let cell = (margin / 2).max(8);
        let across = width.div_ceil(cell);
        let mut fits: Vec<Option<Option<Local>>> = Vec::new();
        fits.resize_with(across * height.div_ceil(cell), || None);
        let mut found = Vec::new();
        for (i, from) in nearest.iter().enumerate() {
            if *from == FAR || *from as usize == i {
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
                Local::new(&map, middle, (2 * margin).max(16) as f64)
            });
            let Some(fit) = fit else { continue };
            let (there, at_edge) = (fit.at(here), fit.at(edge));
            let place = map.places()[*from as usize];
            let place = [0, 1].map(|k| lanes::single(f64::from(place[k]) + there[k] - at_edge[k]));
            found.push((i, place));
        }
        for (i, place) in found {
            map.places_mut()[i] = place;
        }
        Ok(map)
    }

    fn padded(self, margin: usize) -> Result<Self> {
        let [width, height] = [self.width(), self.height()].map(|n| n + 2 * margin);
        checked_cells("flat image", height, width)?;
        let mut places = try_filled("flat image", width * height, [f32::NAN; 2])?;
        for (row, line) in self.places().chunks_exact(self.width()).enumerate() {
            let start = (row + margin) * width + margin;
            places[start..start + line.len()].copy_from_slice(line);
        }
        let shift = margin as f64 / self.resolution();
        let corner = [self.corner()[0] - shift, self.corner()[1] + shift];
        Ok(WarpMap::of_places(
            [width, height],
            self.resolution(),
            corner,
            places,
        ))
    }
}

/// For each pixel the sheet's pixel that is (all but) nearest to it: itself on the sheet. In two sweeps each
/// takes over what its neighbours have found (P.-E. Danielsson, *Euclidean distance mapping*, 1980).
fn nearest(map: &WarpMap) -> Result<Vec<u32>> {
    let (width, height) = (map.width(), map.height());
    let mut nearest = try_filled("flat image", width * height, FAR)?;
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
        if candidate != FAR && (own == FAR || square(i, candidate) < square(i, own)) {
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

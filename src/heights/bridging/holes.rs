//! Search for narrow holes, in which a hexagon, or an octagon of pixels, does not fit.

use super::raster::Raster;
use crate::error::{Result, try_filled};

/// Finds the cells (vertices or pixels) of narrow holes: those without a height that are in no empty hexagon of
/// `width + 1` across (morphological closing; beyond the data everything counts as empty). For an even width such a
/// hexagon is a cell with all cells up to `width / 2` steps around it, for an odd one a triangle with the cells around
/// it. On pixels it is an octagon about one pixel, or about four.
pub(super) fn narrow(raster: &Raster, heights: &[f64], width: usize) -> Result<Vec<usize>> {
    let radius = width / 2;
    let filled: Vec<usize> = (0..raster.cells())
        .filter(|c| !heights[*c].is_nan())
        .collect();
    // Centres of wide holes: cells further than that from all heights.
    let near = reached(raster, filled, radius)?;
    let is_wide = |cell: usize| !near[cell];
    let offsets = [false, true].map(|odd| raster.pairs(odd));
    let middles = (0..raster.cells()).filter(|cell| {
        let rows = 1..raster.height - 1;
        let wide = is_wide(*cell) && rows.contains(&(cell / raster.stride));
        let pairs = &offsets[usize::from(raster.is_odd(*cell))];
        let wide_pair =
            |pair: &Vec<isize>| pair.iter().all(|o| is_wide(cell.wrapping_add_signed(*o)));
        wide && (width.is_multiple_of(2) || pairs.iter().any(wide_pair))
    });
    let open = reached(raster, middles.collect(), radius)?;
    Ok((0..raster.cells())
        .filter(|cell| heights[*cell].is_nan() && !open[*cell] && raster.is_inside(*cell))
        .collect())
}

/// Returns for each cell of the raster whether it can be reached from one of the `seeds` by at most `steps` steps
/// between neighbouring cells.
fn reached(raster: &Raster, seeds: Vec<usize>, steps: usize) -> Result<Vec<bool>> {
    let mut reached = try_filled("bridged holes", raster.cells(), false)?;
    for cell in &seeds {
        reached[*cell] = true;
    }
    let mut front = seeds;
    for k in 1..=steps {
        let offsets = raster.step_offsets(k);
        let mut next = Vec::new();
        for cell in front {
            // Cells at the outer border of the margin have no further neighbours.
            let (row, col) = (cell / raster.stride, cell % raster.stride);
            if row == 0 || row + 1 == raster.height || col == 0 || col + 1 == raster.stride {
                continue;
            }
            for offset in &offsets[row % 2] {
                let to = cell.wrapping_add_signed(*offset);
                if !reached[to] {
                    reached[to] = true;
                    next.push(to);
                }
            }
        }
        front = next;
    }
    Ok(reached)
}

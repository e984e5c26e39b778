//! Triangles that lie upside down, turned over again.

use super::pieces::{Name, Pieces, Point};
use crate::error::{Result, try_filled};

/// Rounds of repair, each of which reaches one triangle further around what is still flipped.
const ROUNDS: usize = 8;

/// Sweeps in each round.
const SWEEPS: usize = 40;

/// Where triangles are flipped, the vertices around them are put in the middle of their neighbours,
/// again and again: within an outline that is convex that leaves no triangle flipped (Tutte 1963).
/// Returns whether anything was changed.
pub(super) fn unflip(pieces: &Pieces, places: &mut [Point]) -> Result<bool> {
    let mut free = try_filled("unrolling", places.len(), false)?;
    let mut border = try_filled("unrolling", places.len(), false)?;
    for corner in pieces.border().flatten() {
        border[corner] = true;
    }
    for round in 0..ROUNDS {
        let flipped: Vec<Name> = (pieces.names())
            .filter(|name| is_flipped(pieces, *name, places))
            .collect();
        if flipped.is_empty() {
            return Ok(round > 0);
        }
        for name in flipped {
            for corner in pieces.corners(name) {
                free[corner] = true;
            }
        }
        let mut cells: Vec<usize> = (0..free.len()).filter(|cell| free[*cell]).collect();
        for cell in &cells {
            for corner in pieces.around(*cell).flat_map(|name| pieces.corners(name)) {
                free[corner] = true;
            }
        }
        cells = (0..free.len())
            .filter(|c| free[*c] && !border[*c])
            .collect();
        for _ in 0..SWEEPS {
            for cell in &cells {
                // Each neighbour is in two of the triangles around.
                let (mut sum, mut count) = (Point::default(), 0.0);
                for corner in pieces.around(*cell).flat_map(|name| pieces.corners(name)) {
                    if corner != *cell {
                        sum += places[corner];
                        count += 1.0;
                    }
                }
                places[*cell] = sum / count;
            }
        }
    }
    Ok(true)
}

fn is_flipped(pieces: &Pieces, name: Name, places: &[Point]) -> bool {
    let [a, b, c] = pieces.corners(name).map(|cell| places[cell]);
    ((b - a).conj() * (c - a)).im <= 0.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::unroll::grid::Grid;

    #[test]
    fn a_vertex_out_of_its_ring_is_put_back() {
        let grid = Grid::new(9, 9);
        let mut heights = vec![f64::NAN; grid.cells()];
        (0..9).for_each(|row| heights[grid.row(row)].fill(0.0));
        let pieces = Pieces::new(grid, &heights, |_| true).unwrap();
        let mut places = crate::unroll::layout::plan(grid).unwrap();
        assert!(!unflip(&pieces, &mut places).unwrap());
        let right = places.clone();
        places[grid.cell(4, 4)] += Point::new(1.4, 0.3);
        assert!(
            pieces
                .names()
                .any(|name| is_flipped(&pieces, name, &places))
        );
        assert!(unflip(&pieces, &mut places).unwrap());
        assert!(
            !pieces
                .names()
                .any(|name| is_flipped(&pieces, name, &places))
        );
        for (a, b) in pieces
            .border()
            .flatten()
            .map(|cell| (places[cell], right[cell]))
        {
            assert_eq!(a, b, "the border stays");
        }
    }
}

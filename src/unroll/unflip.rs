//! Repair of triangles that lie upside down.

use super::flat_triangle::Point;
use super::lattice_triangles::{LatticeTriangles, TriangleId};
use crate::error::{Result, try_filled};

/// Maximum number of rounds in which flipped triangles are repaired. Each round moves vertices one triangle further
/// around those that are still flipped.
const MAX_REPAIR_ROUNDS: usize = 8;

/// Number of smoothing sweeps in each round in which flipped triangles are repaired.
const SWEEPS_PER_ROUND: usize = 40;

/// Turns over the flipped triangles of a flat layout: moves the vertices around them to the means of their neighbours,
/// repeatedly, which leaves no triangle flipped inside a convex outline (Tutte 1963). Border vertices stay. Returns
/// whether any vertex was moved.
///
/// # Errors
/// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
pub(super) fn unflip_triangles(triangles: &LatticeTriangles, places: &mut [Point]) -> Result<bool> {
    let mut free = try_filled("unrolling", places.len(), false)?;
    let mut border = try_filled("unrolling", places.len(), false)?;
    for corner in triangles.border().flatten() {
        border[corner] = true;
    }
    for round in 0..MAX_REPAIR_ROUNDS {
        let flipped: Vec<TriangleId> = (triangles.ids())
            .filter(|id| is_flipped(triangles, *id, places))
            .collect();
        if flipped.is_empty() {
            return Ok(round > 0);
        }
        for id in flipped {
            for corner in triangles.corners(id) {
                free[corner] = true;
            }
        }
        let mut cells: Vec<usize> = (0..free.len()).filter(|cell| free[*cell]).collect();
        for cell in &cells {
            for corner in triangles.around(*cell).flat_map(|id| triangles.corners(id)) {
                free[corner] = true;
            }
        }
        cells = (0..free.len())
            .filter(|c| free[*c] && !border[*c])
            .collect();
        for _ in 0..SWEEPS_PER_ROUND {
            for cell in &cells {
                // Each neighbour is counted twice, as it belongs to two of the triangles around the vertex.
                let (mut sum, mut count) = (Point::default(), 0.0);
                for corner in triangles.around(*cell).flat_map(|id| triangles.corners(id)) {
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

fn is_flipped(triangles: &LatticeTriangles, id: TriangleId, places: &[Point]) -> bool {
    let [a, b, c] = triangles.corners(id).map(|cell| places[cell]);
    ((b - a).conj() * (c - a)).im <= 0.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::unroll::padded_lattice::PaddedLattice;

    #[test]
    fn a_vertex_out_of_its_ring_is_put_back() {
        let grid = PaddedLattice::new(9, 9);
        let mut heights = vec![f64::NAN; grid.cells()];
        (0..9).for_each(|row| heights[grid.row(row)].fill(0.0));
        let triangles = LatticeTriangles::new(grid, &heights, |_| true).unwrap();
        let mut places = crate::unroll::layout::plan_positions(grid).unwrap();
        assert!(!unflip_triangles(&triangles, &mut places).unwrap());
        let right = places.clone();
        places[grid.cell(4, 4)] += Point::new(1.4, 0.3);
        assert!(
            triangles
                .ids()
                .any(|id| is_flipped(&triangles, id, &places))
        );
        assert!(unflip_triangles(&triangles, &mut places).unwrap());
        assert!(
            !triangles
                .ids()
                .any(|id| is_flipped(&triangles, id, &places))
        );
        for (a, b) in triangles
            .border()
            .flatten()
            .map(|cell| (places[cell], right[cell]))
        {
            assert_eq!(a, b, "the border stays");
        }
    }
}

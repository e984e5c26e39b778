//! Repair of triangles that lie upside down.

use std::collections::BTreeMap;

use super::flat_triangle::Point;
use crate::error::{Result, try_filled};
use crate::math::index::NO_INDEX;
use crate::scene::half_edges::{half_edge_ends, twin_half_edges};

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
pub(super) fn unflip_triangles(triangles: &[[u32; 3]], places: &mut [Point]) -> Result<bool> {
    if !triangles.iter().any(|corners| is_flipped(corners, places)) {
        return Ok(false);
    }
    let mut is_border = try_filled("unrolling", places.len(), false)?;
    for side in border(triangles).flatten() {
        is_border[side as usize] = true;
    }
    let mut is_free = try_filled("unrolling", places.len(), false)?;
    for _ in 0..MAX_REPAIR_ROUNDS {
        let flipped = triangles
            .iter()
            .filter(|corners| is_flipped(corners, places));
        let mut is_done = true;
        for corner in flipped.flatten() {
            is_free[*corner as usize] = true;
            is_done = false;
        }
        if is_done {
            break;
        }
        let inner = is_free.clone();
        for corners in triangles
            .iter()
            .filter(|t| t.iter().any(|v| inner[*v as usize]))
        {
            corners.iter().for_each(|v| is_free[*v as usize] = true);
        }
        // The neighbours of each vertex that moves, each counted twice, as it belongs to two of the triangles around.
        let mut rings: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        for corners in triangles {
            let [a, b, c] = corners.map(|v| v as usize);
            for (vertex, beside) in [(a, [b, c]), (b, [c, a]), (c, [a, b])] {
                if is_free[vertex] && !is_border[vertex] {
                    rings.entry(vertex).or_default().extend(beside);
                }
            }
        }
        for _ in 0..SWEEPS_PER_ROUND {
            for (vertex, ring) in &rings {
                let sum: Point = ring.iter().map(|other| places[*other]).sum();
                places[*vertex] = sum / ring.len() as f64;
            }
        }
    }
    Ok(true)
}

/// Lists the edges of a mesh that have a triangle on one side only, each directed as in that triangle.
pub(crate) fn border(triangles: &[[u32; 3]]) -> impl Iterator<Item = [u32; 2]> + '_ {
    let twins = (0..).zip(twin_half_edges(triangles));
    let open = twins.filter(|(_, twin)| *twin == NO_INDEX);
    open.map(|(side, _)| half_edge_ends(triangles, side))
}

fn is_flipped(corners: &[u32; 3], places: &[Point]) -> bool {
    let [a, b, c] = corners.map(|v| places[v as usize]);
    ((b - a).conj() * (c - a)).im <= 0.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Frame, Heightfield, Lattice, Triangulation};

    #[test]
    fn a_vertex_out_of_its_ring_is_put_back() {
        let flat = Heightfield::from_fn(Lattice::new(9, 9, 1.0).unwrap(), |_, _| 0.0).unwrap();
        let mesh = Triangulation::new(&flat, &Frame::default()).unwrap();
        let all = mesh.triangles();
        let right: Vec<Point> = (mesh.positions().iter())
            .map(|[x, y, _]| Point::new(*x, *y))
            .collect();
        let mut places = right.clone();
        assert!(!unflip_triangles(all, &mut places).unwrap());
        places[4 * 9 + 4] += Point::new(1.4, 0.3);
        assert!(all.iter().any(|corners| is_flipped(corners, &places)));
        assert!(unflip_triangles(all, &mut places).unwrap());
        assert!(!all.iter().any(|corners| is_flipped(corners, &places)));
        for vertex in border(all).flatten().map(|v| v as usize) {
            assert_eq!(places[vertex], right[vertex], "the border stays");
        }
    }
}

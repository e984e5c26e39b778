//! The coarse lattice of twice the spacing: a sublattice whose vertex `(r, c)` is fine vertex `(2r, 2c − (r odd))`.
//! Every other fine vertex is the midpoint of a coarse edge.

use super::hexagonal::{Lattice, NEIGHBOUR_DIRECTIONS, Towards};
use crate::error::Result;

/// Returns the row and column of the fine vertex that has the position of a coarse vertex.
pub(crate) fn fine_vertex(row: usize, col: usize) -> (isize, isize) {
    (2 * row as isize, 2 * col as isize - (row % 2) as isize)
}

/// Returns the coarse vertices (row, column) that a fine vertex is interpolated from: both ends of the coarse edge
/// whose midpoint it is, or twice the coarse vertex at its own position.
pub(crate) fn parents(row: usize, col: usize) -> [(isize, isize); 2] {
    let (r, c) = (row as isize, col as isize);
    let coarse = |(r, c): (isize, isize)| {
        let half = r.div_euclid(2);
        let odd = half.rem_euclid(2);
        (r % 2 == 0 && (c + odd) % 2 == 0).then(|| (half, (c + odd).div_euclid(2)))
    };
    if let Some(vertex) = coarse((r, c)) {
        return [vertex, vertex];
    }
    let at = |towards: Towards| coarse(towards.step(r, c));
    let [w, e, nw, ne, sw, se] = NEIGHBOUR_DIRECTIONS.map(at);
    // Exactly one pair of opposite neighbours is coarse.
    match (w.zip(e), nw.zip(se), ne.zip(sw)) {
        (Some((a, b)), _, _) | (_, Some((a, b)), _) | (_, _, Some((a, b))) => [a, b],
        _ => [(-1, -1); 2],
    }
}

/// Makes the lattice of twice the spacing that covers the fine one.
pub(crate) fn coarse_lattice(fine: &Lattice) -> Result<Lattice> {
    Lattice::new(
        fine.rows().div_ceil(2),
        fine.cols() / 2 + 1,
        2.0 * fine.spacing(),
    )?
    .with_origin(fine.origin())
}

//! Half-edges of a triangle mesh, as numbers: half-edge `3 t + k` runs from corner `k` of triangle `t` to the next
//! corner.

use crate::math::index::NO_INDEX;

/// Start and end vertex of a half-edge.
pub(crate) fn half_edge_ends(triangles: &[[u32; 3]], half_edge: u32) -> [u32; 2] {
    let (triangle, k) = (&triangles[half_edge as usize / 3], half_edge as usize % 3);
    [triangle[k], triangle[(k + 1) % 3]]
}

/// Number of the next half-edge around the same triangle.
pub(crate) fn next_half_edge(half_edge: u32) -> u32 {
    match half_edge % 3 {
        2 => half_edge - 2,
        _ => half_edge + 1,
    }
}

/// Finds the twin of each half-edge: the half-edge of the neighbouring triangle with the same ends; [`NO_INDEX`] on the
/// border. At most two triangles may share an edge. Costs a sort of the half-edges.
pub(crate) fn twin_half_edges(triangles: &[[u32; 3]]) -> Vec<u32> {
    let half_edges = 0..3 * triangles.len() as u32;
    let mut sorted: Vec<(u32, u32, u32)> = half_edges
        .map(|half_edge| {
            let [a, b] = half_edge_ends(triangles, half_edge);
            (a.min(b), a.max(b), half_edge)
        })
        .collect();
    sorted.sort_unstable();
    let mut twins = vec![NO_INDEX; sorted.len()];
    for pair in sorted.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
        if let [(.., one), (.., other)] = pair {
            (twins[*one as usize], twins[*other as usize]) = (*other, *one);
        }
    }
    twins
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn twins_have_the_same_ends_and_borders_have_none() {
        // Two triangles of a square, and a third one that faces the other way.
        let triangles = [[0, 1, 2], [0, 2, 3], [2, 3, 4]];
        let twins = twin_half_edges(&triangles);
        let none = NO_INDEX;
        assert_eq!(twins, [none, none, 3, 2, 6, none, 4, none, none]);
        assert_eq!(half_edge_ends(&triangles, 4), [2, 3]);
        assert_eq!([3, 4, 5].map(next_half_edge), [4, 5, 3]);
    }
}

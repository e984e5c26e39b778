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
/// border, and where more than two triangles share an edge. Costs `O(half-edges + highest
/// number of a vertex)` on meshes whose vertices have few triangles.
pub(crate) fn twin_half_edges(triangles: &[[u32; 3]]) -> Vec<u32> {
    let half_edges = 0..3 * triangles.len() as u32;
    let ends = |half_edge: u32| {
        let [a, b] = half_edge_ends(triangles, half_edge);
        [a.min(b), a.max(b)]
    };
    // Half-edges in the order of the lower ones of their ends, by counting.
    let vertices = triangles.as_flattened().iter().max();
    let vertices = vertices.map_or(0, |vertex| *vertex as usize + 1);
    let mut next = vec![0u32; vertices + 1];
    for half_edge in half_edges.clone() {
        next[ends(half_edge)[0] as usize + 1] += 1;
    }
    for vertex in 0..vertices {
        next[vertex + 1] += next[vertex];
    }
    let mut sorted = vec![(0, 0); half_edges.len()];
    for half_edge in half_edges {
        let [low, high] = ends(half_edge);
        sorted[next[low as usize] as usize] = (high, half_edge);
        next[low as usize] += 1;
    }
    let mut twins = vec![NO_INDEX; sorted.len()];
    let mut start = 0;
    for end in &next[..vertices] {
        let at_vertex = &mut sorted[start..*end as usize];
        at_vertex.sort_unstable();
        for pair in at_vertex.chunk_by(|a, b| a.0 == b.0) {
            if let [(_, one), (_, other)] = pair {
                (twins[*one as usize], twins[*other as usize]) = (*other, *one);
            }
        }
        start = *end as usize;
    }
    twins
}

/// Next half-edge along the outline of a mesh that is cut open along some of its edges, after one on the outline; `is_cut` tells on
/// which half-edges there is an outline, all of the border among them.
pub(crate) fn next_on_outline(twins: &[u32], half_edge: u32, is_cut: impl Fn(u32) -> bool) -> u32 {
    let mut next = next_half_edge(half_edge);
    while !is_cut(next) {
        next = next_half_edge(twins[next as usize]);
    }
    next
}

/// The closed lines of half-edges around a mesh that is cut open along some of its edges, of which each has one of `half_edges`, or
/// several.
pub(crate) fn outlines(
    twins: &[u32],
    half_edges: impl IntoIterator<Item = u32>,
    is_cut: impl Fn(u32) -> bool,
) -> Vec<Vec<u32>> {
    let mut is_done = vec![false; twins.len()];
    let mut lines = Vec::new();
    for first in half_edges.into_iter().filter(|side| is_cut(*side)) {
        let (mut line, mut side) = (Vec::new(), first);
        while !std::mem::replace(&mut is_done[side as usize], true) {
            line.push(side);
            side = next_on_outline(twins, side, &is_cut);
        }
        if !line.is_empty() {
            lines.push(line);
        }
    }
    lines
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

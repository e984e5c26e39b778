//! Joins the edges of a mesh or lattice to polylines.

use std::collections::BTreeMap;

/// A polyline of consecutive edges of a mesh or lattice.
pub(crate) struct Chain {
    /// Vertices along the polyline; the last one is the first one if the polyline is closed.
    pub vertices: Vec<u32>,
    /// Numbers of the polyline's edges, as indices into the list of edges that was given.
    pub edges: Vec<usize>,
}

/// Joins edges to polylines, which end at vertices with one edge or more than two, and at each vertex for which `end`
/// is true. Costs `O(n log n)` for `n` edges.
pub(crate) fn chains(edges: &[[u32; 2]], end: impl Fn(u32) -> bool) -> Vec<Chain> {
    let mut at: BTreeMap<u32, Vec<usize>> = BTreeMap::new();
    for (number, ends) in edges.iter().enumerate() {
        for vertex in ends {
            at.entry(*vertex).or_default().push(number);
        }
    }
    let mut used = vec![false; edges.len()];
    let mut found = Vec::new();
    let ending = at.iter().filter(|(v, edges)| edges.len() != 2 || end(**v));
    let starts: Vec<u32> = ending.map(|(vertex, _)| *vertex).collect();
    // The edges left after all lines with ends form closed polylines.
    for start in starts.into_iter().chain(edges.iter().map(|[a, _]| *a)) {
        while let Some(first) = at[&start].iter().copied().find(|edge| !used[*edge]) {
            let mut chain = Chain {
                vertices: vec![start],
                edges: Vec::new(),
            };
            let (mut here, mut edge) = (start, first);
            loop {
                used[edge] = true;
                chain.edges.push(edge);
                let [a, b] = edges[edge];
                here = if a == here { b } else { a };
                chain.vertices.push(here);
                let on = at[&here].iter().copied().find(|edge| !used[*edge]);
                match on.filter(|_| at[&here].len() == 2 && !end(here)) {
                    Some(next) => edge = next,
                    None => break,
                }
            }
            found.push(chain);
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_end_where_others_meet_them_and_rings_close() {
        // A Y, and a triangle by itself.
        let edges = [[0, 1], [2, 1], [1, 3], [3, 4], [7, 8], [9, 8], [9, 7]];
        let found = chains(&edges, |_| false);
        let lines: Vec<&[u32]> = found.iter().map(|chain| &chain.vertices[..]).collect();
        assert_eq!(lines, [&[0, 1][..], &[1, 2], &[1, 3, 4], &[7, 8, 9, 7]]);
        assert_eq!(found[2].edges, [2, 3]);
        assert_eq!(chains(&edges, |vertex| vertex == 3).len(), 5);
    }
}

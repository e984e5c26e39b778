//! The neighbours of each vertex of a mesh, and the triangles around each.

use crate::error::{Result, try_filled};

/// Neighbours of each vertex, or triangles around each, in one array for all vertices.
#[derive(Debug, Clone, Default)]
pub(crate) struct Adjacency {
    /// Index of each vertex's first neighbour, and the number of all neighbours at the end.
    first: Vec<u32>,
    neighbours: Vec<u32>,
}

impl Adjacency {
    /// Makes the adjacency of a number of vertices from edges, each given once by its two ends. The neighbours of a
    /// vertex are in the order of the edges.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub(super) fn from_edges(
        vertices: usize,
        edges: impl Iterator<Item = [u32; 2]> + Clone,
    ) -> Result<Self> {
        Adjacency::from_pairs(vertices, edges.flat_map(|[a, b]| [(a, b), (b, a)]))
    }

    /// Makes the lists of a number of vertices from pairs of a vertex and what is beside it, which keep their order.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub(super) fn from_pairs(
        vertices: usize,
        pairs: impl Iterator<Item = (u32, u32)> + Clone,
    ) -> Result<Self> {
        let mut first = try_filled("vertices", vertices + 1, 0u32)?;
        for (vertex, _) in pairs.clone() {
            first[vertex as usize + 1] += 1;
        }
        for vertex in 0..vertices {
            first[vertex + 1] += first[vertex];
        }
        let mut next: Vec<u32> = first[..vertices].to_vec();
        let mut neighbours = try_filled("edges", first[vertices] as usize, 0)?;
        for (vertex, beside) in pairs {
            neighbours[next[vertex as usize] as usize] = beside;
            next[vertex as usize] += 1;
        }
        Ok(Adjacency { first, neighbours })
    }

    /// Returns the neighbours of a vertex.
    pub(crate) fn around(&self, vertex: usize) -> &[u32] {
        &self.neighbours[self.first[vertex] as usize..self.first[vertex + 1] as usize]
    }

    /// Finds the second ring of a vertex: its neighbours' neighbours that are no neighbours themselves. Writes them to
    /// `to`.
    pub(crate) fn second_ring(&self, vertex: usize, to: &mut Vec<u32>) {
        to.clear();
        self.add_second_ring(vertex, to, |_| true);
    }

    /// Appends those vertices of a vertex's second ring to `to` for which `is_wanted` holds.
    pub(super) fn add_second_ring(
        &self,
        vertex: usize,
        to: &mut Vec<u32>,
        is_wanted: impl Fn(u32) -> bool,
    ) {
        let ring = self.around(vertex);
        let start = to.len();
        for neighbour in ring {
            for other in self.around(*neighbour as usize) {
                let is_new = *other != vertex as u32
                    && !ring.contains(other)
                    && !to[start..].contains(other)
                    && is_wanted(*other);
                if is_new {
                    to.push(*other);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_second_ring_has_each_vertex_once_and_no_neighbours() {
        let edges = [
            [0, 1],
            [0, 2],
            [1, 2],
            [1, 3],
            [2, 3],
            [2, 4],
            [3, 4],
            [4, 5],
        ];
        let adjacency = Adjacency::from_edges(6, edges.into_iter()).unwrap();
        let mut ring = vec![7];
        adjacency.second_ring(0, &mut ring);
        assert_eq!(ring, [3, 4]);
        adjacency.add_second_ring(5, &mut ring, |other| other != 3);
        assert_eq!(ring, [3, 4, 2]);
    }
}

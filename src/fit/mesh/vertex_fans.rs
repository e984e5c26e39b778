//! The triangles around each vertex of a mesh.

use super::topology::Topology;

/// Triangles around each vertex of a mesh: their indices, in ascending order.
pub(super) struct VertexFans {
    first: Vec<u32>,
    triangles: Vec<u32>,
}

impl VertexFans {
    pub(super) fn new(topology: &Topology) -> VertexFans {
        let mut first = vec![0u32; topology.len() + 1];
        for corner in topology.triangles.as_flattened() {
            first[*corner as usize + 1] += 1;
        }
        for i in 0..topology.len() {
            first[i + 1] += first[i];
        }
        let mut next = first.clone();
        let mut triangles = vec![0; 3 * topology.triangles.len()];
        for (t, corners) in (0..).zip(&topology.triangles) {
            for corner in corners {
                triangles[next[*corner as usize] as usize] = t;
                next[*corner as usize] += 1;
            }
        }
        VertexFans { first, triangles }
    }

    /// Returns the indices of the triangles around a vertex.
    pub(super) fn around(&self, vertex: usize) -> &[u32] {
        &self.triangles[self.first[vertex] as usize..self.first[vertex + 1] as usize]
    }
}

//! The sides of creases: smooth parts of a surface, and vertices where these meet.

use super::geometry::Point;
use super::linear::NONE;
use super::topology::Topology;
use crate::error::Result;
use crate::scene::facets::Facets;

/// Sides that meet at less than this, in radians, do not say well where.
pub(super) const FOLD: f64 = 0.2;

/// The least share of the area that a side has.
const SHARE: f64 = 0.003;

/// Which sides of creases vertices are on.
pub(super) struct Sides {
    /// The one label of the triangles around a vertex, or [`NONE`].
    pub of: Vec<u32>,
    first: Vec<u32>,
    triangles: Vec<u32>,
    labels: Vec<u32>,
}

impl Sides {
    /// Of the surface `x`.
    ///
    /// # Errors
    /// Out of memory.
    pub(super) fn new(topology: &Topology, x: &[Point]) -> Result<Sides> {
        let facets = Facets::new(x.to_vec(), topology.triangles.clone())?;
        let labels = facets.parted(facets.usual_bend(), SHARE, FOLD)?;
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
        let mut sides = Sides {
            of: vec![NONE; topology.len()],
            first,
            triangles,
            labels,
        };
        for vertex in 0..topology.len() {
            if let [one] = sides.around(vertex)[..] {
                sides.of[vertex] = one;
            }
        }
        Ok(sides)
    }

    /// Whether a vertex with triangles is on a crease.
    pub(super) fn meet_at(&self, vertex: usize) -> bool {
        self.of[vertex] == NONE
    }

    pub(super) fn triangles(&self, vertex: usize) -> &[u32] {
        &self.triangles[self.first[vertex] as usize..self.first[vertex + 1] as usize]
    }

    /// The sides that a vertex is on.
    pub(super) fn around(&self, vertex: usize) -> Vec<u32> {
        let own = self.triangles(vertex).iter();
        let mut found: Vec<u32> = own.map(|t| self.labels[*t as usize]).collect();
        found.sort_unstable();
        found.dedup();
        found
    }
}

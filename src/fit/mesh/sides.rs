//! The sides of creases: smooth parts of a surface, and vertices where these meet.

use super::fans::Fans;
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
    pub fans: Fans,
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
        let mut sides = Sides {
            of: vec![NONE; topology.len()],
            fans: Fans::new(topology),
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

    /// The sides that a vertex is on.
    pub(super) fn around(&self, vertex: usize) -> Vec<u32> {
        let own = self.fans.around(vertex).iter();
        let mut found: Vec<u32> = own.map(|t| self.labels[*t as usize]).collect();
        found.sort_unstable();
        found.dedup();
        found
    }
}

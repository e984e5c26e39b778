//! The sides of creases: smooth parts of a surface, and vertices where these meet.

use super::geometry::Point;
use super::topology::Topology;
use super::vertex_fans::VertexFans;
use crate::error::Result;
use crate::math::index::NO_INDEX;
use crate::scene::facets::Facets;

/// Smallest angle between two sides of a crease, in radians, from which the place of their intersection is
/// determined well.
pub(super) const MIN_FOLD_ANGLE_RADIANS: f64 = 0.2;

/// Smallest area of a side of a crease, as a share of the area of the mesh.
const MIN_SIDE_AREA_SHARE: f64 = 0.003;

/// Which sides of creases vertices are on.
pub(super) struct SmoothRegions {
    /// The one label of the triangles around a vertex, or [`NO_INDEX`].
    pub of: Vec<u32>,
    pub vertex_fans: VertexFans,
    labels: Vec<u32>,
}

impl SmoothRegions {
    /// Of the surface `x`.
    ///
    /// # Errors
    /// Out of memory.
    pub(super) fn new(topology: &Topology, x: &[Point]) -> Result<SmoothRegions> {
        let facets = Facets::new(x.to_vec(), topology.triangles.clone())?;
        let labels = facets.parted(
            facets.usual_bend(),
            MIN_SIDE_AREA_SHARE,
            MIN_FOLD_ANGLE_RADIANS,
        )?;
        let mut sides = SmoothRegions {
            of: vec![NO_INDEX; topology.len()],
            vertex_fans: VertexFans::new(topology),
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
        self.of[vertex] == NO_INDEX
    }

    /// Whether a vertex has triangles of one side.
    pub(super) fn touch(&self, vertex: usize, side: u32) -> bool {
        let own = self.vertex_fans.around(vertex).iter();
        own.map(|t| self.labels[*t as usize]).any(|s| s == side)
    }

    /// The creases as curves: of each vertex on one the two beside it, where it is the only one there.
    pub(super) fn creases(&self, topology: &Topology) -> Vec<Option<[u32; 2]>> {
        let beside = |vertex: usize| {
            if !topology.inside[vertex] || !self.meet_at(vertex) {
                return None;
            }
            let own = self.vertex_fans.around(vertex);
            let folds = |other: &u32| {
                let both = own.iter().map(|t| *t as usize);
                let mut labels = both
                    .filter(|t| topology.triangles[*t].contains(other))
                    .map(|t| self.labels[t]);
                labels.next() != labels.next()
            };
            let mut ends = topology.around(vertex).iter().copied().filter(folds);
            match (ends.next(), ends.next(), ends.next()) {
                (Some(a), Some(b), None) => Some([a, b]),
                _ => None,
            }
        };
        (0..topology.len()).map(beside).collect()
    }

    /// The sides that a vertex is on.
    pub(super) fn around(&self, vertex: usize) -> Vec<u32> {
        let own = self.vertex_fans.around(vertex).iter();
        let mut found: Vec<u32> = own.map(|t| self.labels[*t as usize]).collect();
        found.sort_unstable();
        found.dedup();
        found
    }
}

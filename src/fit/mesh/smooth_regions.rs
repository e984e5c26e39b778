//! Smooth regions of a mesh, whose borders are its creases.

use super::geometry::Point;
use super::topology::Topology;
use super::vertex_fans::VertexFans;
use crate::error::Result;
use crate::math::index::NO_INDEX;
use crate::scene::facets::Facets;

/// Minimum angle between two sides of a crease, in radians, for which their intersection is well determined.
pub(super) const MIN_FOLD_ANGLE_RADIANS: f64 = 0.2;

/// Minimum area of a region, as a share of the area of the mesh.
const MIN_SIDE_AREA_SHARE: f64 = 0.003;

/// The smooth regions, and those that each vertex is in.
pub(super) struct SmoothRegions {
    /// Region of a vertex, or [`NO_INDEX`] where regions meet.
    pub region: Vec<u32>,
    pub vertex_fans: VertexFans,
    /// Region of each triangle.
    labels: Vec<u32>,
}

impl SmoothRegions {
    /// Finds the regions of the surface `x`.
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
            region: vec![NO_INDEX; topology.len()],
            vertex_fans: VertexFans::new(topology),
            labels,
        };
        for vertex in 0..topology.len() {
            if let [one] = sides.around(vertex)[..] {
                sides.region[vertex] = one;
            }
        }
        Ok(sides)
    }

    /// Whether regions meet at a vertex.
    pub(super) fn is_on_crease(&self, vertex: usize) -> bool {
        self.region[vertex] == NO_INDEX
    }

    /// Whether a vertex has triangles of a region.
    pub(super) fn touches(&self, vertex: usize, side: u32) -> bool {
        let own = self.vertex_fans.around(vertex).iter();
        own.map(|t| self.labels[*t as usize]).any(|s| s == side)
    }

    /// The creases as curves: the two vertices beside each one on a crease, where it is on no other one.
    pub(super) fn creases(&self, topology: &Topology) -> Vec<Option<[u32; 2]>> {
        let beside = |vertex: usize| {
            if !topology.inside[vertex] || !self.is_on_crease(vertex) {
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

    /// The regions that meet at a vertex.
    pub(super) fn around(&self, vertex: usize) -> Vec<u32> {
        let own = self.vertex_fans.around(vertex).iter();
        let mut found: Vec<u32> = own.map(|t| self.labels[*t as usize]).collect();
        found.sort_unstable();
        found.dedup();
        found
    }
}

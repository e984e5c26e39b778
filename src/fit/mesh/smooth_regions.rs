//! Smooth regions of a mesh, whose borders are its creases.

use super::adjacency::Adjacency;
use super::geometry::Point;
use super::topology::Topology;
use crate::error::Result;
use crate::math::index::NO_INDEX;
use crate::scene::facets::Facets;

/// Minimum angle between the two sides of a crease, in radians (`benches/whole.md`).
const MIN_FOLD_ANGLE_RADIANS: f64 = 0.2;

/// Minimum area of a smooth region, as a share of the area of the mesh (`benches/whole.md`).
const MIN_SIDE_AREA_SHARE: f64 = 0.003;

/// Smooth regions of a mesh, and the regions that meet at each vertex.
pub(super) struct SmoothRegions {
    /// Region that all triangles of a vertex belong to, or [`NO_INDEX`] where regions meet.
    pub region: Vec<u32>,
    /// Triangles around each vertex.
    fans: Adjacency,
    /// Region that each triangle belongs to.
    labels: Vec<u32>,
}

impl SmoothRegions {
    /// Finds the smooth regions of the surface with vertices at `x`.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub(super) fn new(topology: &Topology, x: &[Point]) -> Result<SmoothRegions> {
        let facets = Facets::new(x.to_vec(), topology.triangles.clone())?;
        let labels = facets.parted(
            facets.usual_bend(),
            MIN_SIDE_AREA_SHARE,
            MIN_FOLD_ANGLE_RADIANS,
        )?;
        let mut sides = SmoothRegions {
            region: vec![NO_INDEX; topology.len()],
            fans: topology.fans.clone(),
            labels,
        };
        for (vertex, region) in sides.region.iter_mut().enumerate() {
            let fan = sides.fans.around(vertex).iter();
            let mut labels = fan.map(|t| sides.labels[*t as usize]);
            if let Some(first) = labels.next()
                && labels.all(|label| label == first)
            {
                *region = first;
            }
        }
        Ok(sides)
    }

    /// Returns whether several smooth regions meet at a vertex, so that it is on a crease.
    pub(super) fn is_on_crease(&self, vertex: usize) -> bool {
        self.region[vertex] == NO_INDEX
    }

    /// Returns whether a vertex has triangles of the region `side`.
    pub(super) fn touches(&self, vertex: usize, side: u32) -> bool {
        let own = self.fans.around(vertex).iter();
        own.map(|t| self.labels[*t as usize]).any(|s| s == side)
    }

    /// Finds the creases as curves: for each vertex the two vertices beside it along its crease; `None` for a vertex on
    /// no crease or where several creases meet.
    pub(super) fn creases(&self, topology: &Topology) -> Vec<Option<[u32; 2]>> {
        let beside = |vertex: usize| {
            if !topology.inside[vertex] || !self.is_on_crease(vertex) {
                return None;
            }
            let own = self.fans.around(vertex);
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

    /// Returns the smooth regions that meet at a vertex, in ascending order.
    pub(super) fn around(&self, vertex: usize) -> Vec<u32> {
        let own = self.fans.around(vertex).iter();
        let mut found: Vec<u32> = own.map(|t| self.labels[*t as usize]).collect();
        found.sort_unstable();
        found.dedup();
        found
    }
}

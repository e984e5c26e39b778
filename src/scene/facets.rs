//! Segmentation of a triangle mesh into smooth parts, by the angles between its triangles.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use nalgebra::Vector3;

use crate::error::{Result, try_filled};
use crate::math::index::NO_INDEX;
use crate::math::statistics::median;
use crate::math::union_find::UnionFind;
use crate::scene::half_edges::{half_edge_ends, twin_half_edges};
use crate::scene::region_graph::RegionGraph;

/// Smallest and largest threshold, in radians, that separates angles between facets of a smooth part from those of
/// creases: facets that approximate a round shape fold by less than the maximum, and residual noise by less than the
/// minimum.
const CREASE_ANGLE_RANGE: [f64; 2] = [0.035, 0.35];

/// Maximum angle, in radians, between the strip of triangles into which noise turns a sharp crease and the parts on
/// either side.
const MAX_BLUNT_CREASE_ANGLE: f64 = 1.0;

/// Tolerance for rounding errors of angles between facets, in radians: smaller bends count as flat.
const FLATNESS_TOLERANCE: f64 = 1e-6;

/// Triangles of a mesh, with area, and angle and length of each edge.
pub(crate) struct Facets {
    pub places: Vec<Vector3<f64>>,
    pub triangles: Vec<[u32; 3]>,
    pub twins: Vec<u32>,
    /// Angle between the normals of the triangles on both sides of each half-edge, in radians.
    pub angles: Vec<f64>,
    pub lengths: Vec<f64>,
    pub areas: Vec<f64>,
}

impl Facets {
    pub fn new(places: Vec<Vector3<f64>>, triangles: Vec<[u32; 3]>) -> Result<Self> {
        let twins = twin_half_edges(&triangles);
        let mut normals = try_filled("patches", triangles.len(), Vector3::zeros())?;
        let mut areas = try_filled("patches", triangles.len(), 0.0)?;
        for (corners, (normal, area)) in triangles.iter().zip(normals.iter_mut().zip(&mut areas)) {
            let [a, b, c] = corners.map(|v| places[v as usize]);
            let cross: Vector3<f64> = (b - a).cross(&(c - a));
            *area = 0.5 * cross.norm();
            *normal = cross;
        }
        let mut angles = try_filled("patches", twins.len(), 0.0)?;
        let mut lengths = try_filled("patches", twins.len(), 0.0)?;
        for (side, twin) in twins.iter().enumerate() {
            let twin = *twin as usize;
            if twin < side {
                (lengths[side], angles[side]) = (lengths[twin], angles[twin]);
                continue;
            }
            let [a, b] = half_edge_ends(&triangles, side as u32).map(|v| places[v as usize]);
            lengths[side] = (b - a).norm();
            if twin < twins.len() {
                let [m, n] = [side, twin].map(|side| normals[side / 3]);
                angles[side] = m.cross(&n).norm().atan2(m.dot(&n));
            }
        }
        Ok(Facets {
            places,
            triangles,
            twins,
            angles,
            lengths,
            areas,
        })
    }

    /// Pairs of twin half-edges, each inner edge of the mesh once.
    pub fn pairs(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        let all = self.twins.iter().enumerate();
        all.filter(|(side, twin)| **twin != NO_INDEX && *side < **twin as usize)
            .map(|(side, twin)| (side, *twin as usize))
    }

    pub fn usual_bend(&self) -> f64 {
        let pairs = self.pairs().map(|(side, _)| self.angles[side]);
        let mut angles: Vec<f64> = pairs.filter(|angle| *angle > FLATNESS_TOLERANCE).collect();
        (6.0 * median(&mut angles).unwrap_or(0.0))
            .clamp(CREASE_ANGLE_RANGE[0], CREASE_ANGLE_RANGE[1])
    }

    /// Segments the mesh into smooth parts; returns the part's label for each triangle. Each part has at least the
    /// share `share` of the area, and folds towards each neighbour by at least `fold`, and half of `bend`, on average,
    /// in radians.
    ///
    /// The segmentation is by watersheds (Mangan and Whitaker 1999): the height of a triangle is the angle by which
    /// the surface bends around it, and basins are flooded until they meet. So a blunt crease, which is a strip of
    /// triangles between its sides, becomes no part of its own, and no part leaks into another one across a weak
    /// crease.
    pub fn parted(&self, bend: f64, share: f64, fold: f64) -> Result<Vec<u32>> {
        let fold = fold.max(0.5 * bend);
        let heights = self.heights();
        let mut labels = self.basins(&heights, 0.5 * bend)?;
        self.merge(&mut labels, fold);
        self.dissolve_small_parts(&mut labels, share);
        self.merge(&mut labels, fold);
        Ok(labels)
    }

    /// Mean angle along the edges of each triangle, in radians, weighted by length: the heights on which the watershed
    /// segmentation runs.
    fn heights(&self) -> Vec<f64> {
        let of = |t: usize| {
            let sides = 3 * t..3 * t + 3;
            let bent: f64 = sides
                .clone()
                .map(|s| self.lengths[s] * self.angles[s])
                .sum();
            bent / sides.map(|s| self.lengths[s]).sum::<f64>()
        };
        (0..self.triangles.len()).map(of).collect()
    }

    /// Labels the watershed basin of each triangle: each local minimum of `heights`, connected across edges of at most
    /// `bend`, is a basin, and the other triangles are flooded from the basins, across the lowest edges first.
    fn basins(&self, heights: &[f64], bend: f64) -> Result<Vec<u32>> {
        let mut sets = UnionFind::new("patches", heights.len())?;
        let around = |t: usize| {
            let sides = (3 * t..3 * t + 3).filter(|side| self.twins[*side] != NO_INDEX);
            sides.map(|side| (side, self.twins[side] as usize / 3))
        };
        // Vertices all of whose edges are at most `bend`; a strip that has none beside it is a part of its own.
        let count = 1 + self
            .triangles
            .as_flattened()
            .iter()
            .max()
            .map_or(0, |v| *v as usize);
        let mut smooth = try_filled("patches", count, true)?;
        for (side, _) in self.pairs().filter(|(side, _)| self.angles[*side] > bend) {
            for end in half_edge_ends(&self.triangles, side as u32) {
                smooth[end as usize] = false;
            }
        }
        let mut open = try_filled("patches", heights.len(), true)?;
        for t in 0..heights.len() {
            open[t] = around(t).any(|(side, other)| {
                let runs = self.angles[side] <= bend
                    || (self.angles[side] <= MAX_BLUNT_CREASE_ANGLE
                        && self.triangles[other].iter().any(|v| smooth[*v as usize]));
                // Flat parts differ by rounding errors only.
                runs && heights[other] < heights[t] - FLATNESS_TOLERANCE
            });
        }
        for (side, twin) in self.pairs() {
            let (a, b) = (side / 3, twin / 3);
            if !open[a] && !open[b] && self.angles[side] <= bend {
                sets.union(a as u32, b as u32);
            }
        }
        let mut labels: Vec<u32> = (0..heights.len() as u32).map(|t| sets.find(t)).collect();
        self.flood(&mut labels, open, |side| {
            heights[self.twins[side] as usize / 3].max(self.angles[side])
        });
        Ok(labels)
    }

    /// Gives triangles marked in `open` the label of a neighbour, across the half-edges with the smallest `way` first
    /// (priority flood).
    fn flood(&self, labels: &mut [u32], mut open: Vec<bool>, way: impl Fn(usize) -> f64) {
        // The bits of positive floats have their order.
        let mut queue = BinaryHeap::new();
        // A triangle is queued again only with a smaller way, because the smallest one gives it its label.
        let mut smallest = vec![(u64::MAX, NO_INDEX); labels.len()];
        let mut ways = |t: usize, open: &[bool], queue: &mut BinaryHeap<_>| {
            for side in 3 * t..3 * t + 3 {
                let twin = self.twins[side];
                if twin != NO_INDEX && open[twin as usize / 3] {
                    let key = (way(side).to_bits(), twin);
                    let smallest = &mut smallest[twin as usize / 3];
                    if key < *smallest {
                        *smallest = key;
                        queue.push(Reverse((key.0, twin, side as u32)));
                    }
                }
            }
        };
        for t in (0..labels.len()).filter(|t| !open[*t]) {
            ways(t, &open, &mut queue);
        }
        while let Some(Reverse((_, twin, side))) = queue.pop() {
            let to = twin as usize / 3;
            if std::mem::take(&mut open[to]) {
                labels[to] = labels[side as usize / 3];
                ways(to, &open, &mut queue);
            }
        }
    }

    /// Dissolves small parts: those below the share `share` of the area give each triangle to the neighbouring part
    /// towards which it bends least.
    fn dissolve_small_parts(&self, labels: &mut [u32], share: f64) {
        let mut areas = vec![0.0; labels.len()];
        for (label, area) in labels.iter().zip(&self.areas) {
            areas[*label as usize] += area;
        }
        let largest = areas.iter().copied().fold(0.0, f64::max);
        let least = largest.min(share * self.areas.iter().sum::<f64>());
        let open = labels.iter().map(|l| areas[*l as usize] < least).collect();
        self.flood(labels, open, |side| self.angles[side]);
    }

    /// Merges neighbouring parts that fold by less than `fold` on average, in radians, those that fold least first.
    fn merge(&self, labels: &mut [u32], fold: f64) {
        let mut graph = RegionGraph::new(labels.len(), fold, 0.0);
        for (side, twin) in self.pairs() {
            let [a, b] = [side, twin].map(|side| labels[side / 3]);
            if a != b {
                let length = self.lengths[side];
                graph.add_border(a, b, [length * self.angles[side], length]);
            }
        }
        graph.merge_flat();
        for label in labels {
            *label = graph.merged(*label);
        }
    }
}

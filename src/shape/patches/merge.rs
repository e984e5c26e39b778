//! Merges patches across borders that are no creases.
//!
//! A surface that was fitted to noise bends along few of its rulings and hardly in between, so
//! that it is segmented where there is no crease. A crease has a fold angle between the patches on either side, or a step.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BinaryHeap};

use super::bend_angles::{BendAngles, NORMAL_DISTANCE_VERTICES};
use super::patch::NO_PATCH;
use crate::heights::heightfield::Heightfield;
use crate::lattice::hexagonal::Towards;

/// Minimum ratio of a crease's fold angle to the angle by which the flatter of the two patches bends over the same
/// distance. Limits what is taken for a crease on surfaces that bend. Not tuned by measurements; `tests/native/patches.rs` has
/// the surfaces whose patches it must find. `benches/patterns.md` has what others give.
const MIN_FOLD_PER_BEND: f64 = 2.0;

/// Merges patches whose common border folds by less than `fold` radians on average, or hardly more than the patches
/// bend, the flattest border first, until there is none; then merges each patch of fewer than `min_vertices` with the
/// neighbour across its flattest border. Numbers the patches from 0 again.
pub(super) fn merge_patches(
    surface: &Heightfield,
    bend: &BendAngles,
    fold: f64,
    min_vertices: f64,
    labels: &mut [u32],
) {
    // Angles are measured again after patches have been merged, for then normals can be further from the border.
    loop {
        let mut graph = AdjacencyGraph::new(surface, bend, fold, labels);
        let merged = graph.merge_flat();
        graph.relabel(labels);
        if !merged {
            break;
        }
    }
    let mut graph = AdjacencyGraph::new(surface, bend, fold, labels);
    graph.merge_small(min_vertices);
    graph.relabel(labels);
    let mut numbers = BTreeMap::new();
    for label in labels.iter_mut().filter(|label| **label != NO_PATCH) {
        let next = numbers.len() as u32;
        *label = *numbers.entry(*label).or_insert(next);
    }
}

/// Sum of angles, in radians, and the number of these angles, from which their mean follows.
type AngleSum = (f64, f64);

/// Region adjacency graph: which patches have a common border, and by which angles the surface folds there.
struct AdjacencyGraph {
    /// Neighbours of each patch, each with the sum of the fold angles along the common border.
    neighbours: Vec<BTreeMap<u32, AngleSum>>,
    /// Number of vertices of each patch of the graph.
    sizes: Vec<usize>,
    /// For each patch the sum of its bend angles from vertex to vertex.
    bends: Vec<AngleSum>,
    /// Minimum fold angle along a border, in radians, that makes the border a crease.
    fold: f64,
    /// Number of the patch that each patch was merged into, or its own number.
    parents: Vec<u32>,
}

impl AdjacencyGraph {
    /// Builds the region adjacency graph of a segmentation.
    fn new(surface: &Heightfield, bend: &BendAngles, fold: f64, labels: &[u32]) -> Self {
        let lattice = surface.lattice();
        let patches = labels.iter().filter(|label| **label != NO_PATCH);
        let count = patches.max().map_or(0, |label| *label as usize + 1);
        let mut graph = AdjacencyGraph {
            neighbours: vec![BTreeMap::new(); count],
            sizes: vec![0; count],
            bends: vec![(0.0, 0.0); count],
            fold,
            parents: (0..count as u32).collect(),
        };
        for i in (0..labels.len()).filter(|i| labels[*i] != NO_PATCH) {
            graph.sizes[labels[i] as usize] += 1;
            if !bend.angle[i].is_nan() {
                let (sum, number) = &mut graph.bends[labels[i] as usize];
                *sum += bend.angle[i];
                *number += 1.0;
            }
            let (row, col) = (i / lattice.cols(), i % lattice.cols());
            for towards in [Towards::East, Towards::SouthWest, Towards::SouthEast] {
                let (r, c) = towards.step(row as isize, col as isize);
                if !lattice.contains(r, c) {
                    continue;
                }
                let k = lattice.index(r as usize, c as usize);
                let (a, b) = (labels[i], labels[k]);
                if b == NO_PATCH || a == b {
                    continue;
                }
                // Patches whose fold angle cannot be measured are not merged.
                if let Some(angle) = bend.difference(surface, labels, [i, k]) {
                    for (one, other) in [(a, b), (b, a)] {
                        let sums = graph.neighbours[one as usize].entry(other).or_default();
                        *sums = (sums.0 + angle, sums.1 + 1.0);
                    }
                }
            }
        }
        graph
    }

    /// Merges patches across borders that fold by too small an angle to be creases. Returns whether any were merged.
    fn merge_flat(&mut self) -> bool {
        let mut queue = BinaryHeap::new();
        for (a, neighbours) in self.neighbours.iter().enumerate() {
            for (b, sums) in neighbours.range(a as u32 + 1..) {
                queue.push(Reverse((self.sharpness(a as u32, *b, *sums), a as u32, *b)));
            }
        }
        let mut merged = false;
        while let Some(Reverse((sharpness, a, b))) = queue.pop() {
            if f64::from_bits(sharpness) >= 1.0 {
                break;
            }
            // A border that has changed was queued again with its new angle.
            let sums = self.neighbours[a as usize].get(&b);
            if sums.is_some_and(|sums| self.sharpness(a, b, *sums) == sharpness) {
                merged = true;
                let kept = self.merge(a, b);
                for (other, sums) in &self.neighbours[kept as usize] {
                    queue.push(Reverse((self.sharpness(kept, *other, *sums), kept, *other)));
                }
            }
        }
        merged
    }

    /// Merges each patch of fewer than a minimum number of vertices with the neighbour across its flattest border.
    fn merge_small(&mut self, min_vertices: f64) {
        let mut queue: BinaryHeap<_> = (self.sizes.iter().enumerate())
            .map(|(patch, size)| Reverse((*size, patch as u32)))
            .collect();
        while let Some(Reverse((size, patch))) = queue.pop() {
            if size as f64 >= min_vertices {
                break;
            }
            let alive = self.parents[patch as usize] == patch;
            if !alive || self.sizes[patch as usize] != size {
                continue;
            }
            let neighbours = self.neighbours[patch as usize].iter();
            let flattest = neighbours
                .min_by_key(|(other, sums)| self.sharpness(patch, **other, **sums))
                .map(|(other, _)| *other);
            if let Some(other) = flattest {
                let kept = self.merge(patch, other);
                queue.push(Reverse((self.sizes[kept as usize], kept)));
            }
        }
    }

    /// Computes the ratio of a border's mean fold angle to the minimum of a crease, as the bits of a positive float,
    /// which sort like the ratio itself.
    fn sharpness(&self, a: u32, b: u32, (sum, number): AngleSum) -> u64 {
        let bending = |patch: u32| {
            let (sum, number) = self.bends[patch as usize];
            if number > 0.0 { sum / number } else { 0.0 }
        };
        let distance = 2.0 * NORMAL_DISTANCE_VERTICES as f64;
        let own = MIN_FOLD_PER_BEND * distance * bending(a).min(bending(b));
        (sum / number / own.max(self.fold)).to_bits()
    }

    /// Merges two patches. Returns the number that is kept: that of the patch with more neighbours.
    fn merge(&mut self, a: u32, b: u32) -> u32 {
        let degree = |patch: u32| self.neighbours[patch as usize].len();
        let (kept, gone) = if degree(a) < degree(b) {
            (b, a)
        } else {
            (a, b)
        };
        self.parents[gone as usize] = kept;
        self.sizes[kept as usize] += self.sizes[gone as usize];
        let (sum, number) = self.bends[gone as usize];
        let all = &mut self.bends[kept as usize];
        *all = (all.0 + sum, all.1 + number);
        self.neighbours[kept as usize].remove(&gone);
        for (other, sums) in std::mem::take(&mut self.neighbours[gone as usize]) {
            if other == kept {
                continue;
            }
            self.neighbours[other as usize].remove(&gone);
            for (one, two) in [(kept, other), (other, kept)] {
                let all = self.neighbours[one as usize].entry(two).or_default();
                *all = (all.0 + sums.0, all.1 + sums.1);
            }
        }
        kept
    }

    /// Replaces the labels of merged patches by the number of the patch they were merged into.
    fn relabel(&self, labels: &mut [u32]) {
        for label in labels.iter_mut().filter(|label| **label != NO_PATCH) {
            while self.parents[*label as usize] != *label {
                *label = self.parents[*label as usize];
            }
        }
    }
}

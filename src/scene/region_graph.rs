//! Region adjacency graph: regions of a surface that are merged across the borders along which it folds least.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BinaryHeap};

/// Sum of angles, in radians, each times its weight, and the sum of the weights, from which their mean follows.
pub(crate) type AngleSum = [f64; 2];

/// The regions of a surface, numbered from 0, and the angles by which it folds along their borders.
pub(crate) struct RegionGraph {
    /// Neighbours of each region, each with the sum of the fold angles along the common border.
    neighbours: Vec<BTreeMap<u32, AngleSum>>,
    /// Size of each region.
    sizes: Vec<f64>,
    /// Sum of the angles by which each region bends over the distance across a border.
    bends: Vec<AngleSum>,
    /// Minimum fold angle of a border, in radians, and as a multiple of the angle by which the flatter of the two regions bends.
    fold: f64,
    fold_per_bend: f64,
    /// Number of the region that each region was merged into, or its own number.
    parents: Vec<u32>,
}

impl RegionGraph {
    /// Creates the graph of `count` regions without borders, which are merged unless they fold by `fold` radians and `fold_per_bend` times
    /// as much as they bend.
    pub(crate) fn new(count: usize, fold: f64, fold_per_bend: f64) -> Self {
        RegionGraph {
            neighbours: vec![BTreeMap::new(); count],
            sizes: vec![0.0; count],
            bends: vec![[0.0; 2]; count],
            fold,
            fold_per_bend,
            parents: (0..count as u32).collect(),
        }
    }

    /// Adds to the size of a region and to the angles by which it bends.
    pub(crate) fn add_member(&mut self, region: u32, size: f64, bend: AngleSum) {
        self.sizes[region as usize] += size;
        add(&mut self.bends[region as usize], bend);
    }

    /// Adds to the border of two regions.
    pub(crate) fn add_border(&mut self, a: u32, b: u32, fold: AngleSum) {
        for (one, other) in [(a, b), (b, a)] {
            add(
                self.neighbours[one as usize].entry(other).or_default(),
                fold,
            );
        }
    }

    /// Merges regions across borders that fold by too little, the flattest first. Returns whether any were merged.
    pub(crate) fn merge_flat(&mut self) -> bool {
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
                let (kept, inherited) = self.merge(a, b);
                let neighbours = &self.neighbours[kept as usize];
                // Where bends do not count, the other borders of the kept region fold as they did.
                let has_changed =
                    |other: &u32| self.fold_per_bend > 0.0 || inherited.contains_key(other);
                for (other, sums) in neighbours.iter().filter(|(other, _)| has_changed(other)) {
                    queue.push(Reverse((self.sharpness(kept, *other, *sums), kept, *other)));
                }
            }
        }
        merged
    }

    /// Merges each region that is smaller than a minimum with the neighbour across its flattest border, the smallest first.
    pub(crate) fn merge_small(&mut self, min_size: f64) {
        // The bits of positive floats have their order.
        let mut queue: BinaryHeap<_> = (self.sizes.iter().enumerate())
            .map(|(region, size)| Reverse((size.to_bits(), region as u32)))
            .collect();
        while let Some(Reverse((size, region))) = queue.pop() {
            if f64::from_bits(size) >= min_size {
                break;
            }
            let alive = self.parents[region as usize] == region;
            if !alive || self.sizes[region as usize].to_bits() != size {
                continue;
            }
            let neighbours = self.neighbours[region as usize].iter();
            let flattest = neighbours
                .min_by_key(|(other, sums)| self.sharpness(region, **other, **sums))
                .map(|(other, _)| *other);
            if let Some(other) = flattest {
                let (kept, _) = self.merge(region, other);
                queue.push(Reverse((self.sizes[kept as usize].to_bits(), kept)));
            }
        }
    }

    /// Returns the region that a region was merged into.
    pub(crate) fn merged(&self, mut region: u32) -> u32 {
        while self.parents[region as usize] != region {
            region = self.parents[region as usize];
        }
        region
    }

    /// Computes the ratio of a border's mean fold angle to the minimum, as the bits of a positive float.
    fn sharpness(&self, a: u32, b: u32, fold: AngleSum) -> u64 {
        let [one, other] = [a, b].map(|region| mean(self.bends[region as usize]));
        (mean(fold) / (self.fold_per_bend * one.min(other)).max(self.fold)).to_bits()
    }

    /// Merges two regions. Returns the number that is kept, that of the region with more neighbours, and the borders of the other one.
    fn merge(&mut self, a: u32, b: u32) -> (u32, BTreeMap<u32, AngleSum>) {
        let degree = |region: u32| self.neighbours[region as usize].len();
        let (kept, gone) = [(a, b), (b, a)][usize::from(degree(a) < degree(b))];
        self.parents[gone as usize] = kept;
        self.add_member(kept, self.sizes[gone as usize], self.bends[gone as usize]);
        self.neighbours[kept as usize].remove(&gone);
        let mut inherited = std::mem::take(&mut self.neighbours[gone as usize]);
        inherited.remove(&kept);
        for (other, sums) in &inherited {
            self.neighbours[*other as usize].remove(&gone);
            self.add_border(kept, *other, *sums);
        }
        (kept, inherited)
    }
}

fn add(sum: &mut AngleSum, more: AngleSum) {
    *sum = [sum[0] + more[0], sum[1] + more[1]];
}

fn mean([sum, weight]: AngleSum) -> f64 {
    if weight > 0.0 { sum / weight } else { 0.0 }
}

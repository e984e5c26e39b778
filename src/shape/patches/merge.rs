//! Patches that no fold parts become one.
//!
//! A surface that was solved from noise bends along few of its rulings and hardly in between, so
//! that bands run where there is no crease. What tells the two apart is the angle between what lies
//! on either side.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BinaryHeap};

use super::bend::{ASIDE, Bend};
use super::patch::NO_PATCH;
use crate::lattice::hexagonal::{Lattice, Towards};

/// A border between patches that bend by themselves is none unless it folds by as many times more
/// than either bends over the same distance.
const TIMES: f64 = 2.0;

/// Merges patches whose common border folds by less than `fold` on average, or hardly more than
/// they bend by themselves, the flattest border first, until there is none; then those of fewer than `least` vertices with the neighbour across
/// their flattest border. Numbers them from 0 again.
pub(super) fn merge(lattice: &Lattice, bend: &Bend, fold: f64, least: f64, labels: &mut [u32]) {
    // Angles are measured anew once patches have grown, for then they can be further from the line.
    loop {
        let mut map = Map::new(lattice, bend, fold, labels);
        let merged = map.merge_flat();
        map.relabel(labels);
        if !merged {
            break;
        }
    }
    let mut map = Map::new(lattice, bend, fold, labels);
    map.merge_small(least);
    map.relabel(labels);
    let mut numbers = BTreeMap::new();
    for label in labels.iter_mut().filter(|label| **label != NO_PATCH) {
        let next = numbers.len() as u32;
        *label = *numbers.entry(*label).or_insert(next);
    }
}

/// Angles along a border, summed, and their number.
type Sums = (f64, f64);

/// Which patches lie beside each other.
struct Map {
    /// Of each patch: its neighbours.
    beside: Vec<BTreeMap<u32, Sums>>,
    /// Its vertices.
    sizes: Vec<usize>,
    /// The angles by which it bends from vertex to vertex, and their number.
    bends: Vec<Sums>,
    /// The least angle of a border.
    fold: f64,
    /// The one it has become part of, or itself.
    parents: Vec<u32>,
}

impl Map {
    fn new(lattice: &Lattice, bend: &Bend, fold: f64, labels: &[u32]) -> Self {
        let patches = labels.iter().filter(|label| **label != NO_PATCH);
        let count = patches.max().map_or(0, |label| *label as usize + 1);
        let mut map = Map {
            beside: vec![BTreeMap::new(); count],
            sizes: vec![0; count],
            bends: vec![(0.0, 0.0); count],
            fold,
            parents: (0..count as u32).collect(),
        };
        for i in (0..labels.len()).filter(|i| labels[*i] != NO_PATCH) {
            map.sizes[labels[i] as usize] += 1;
            if !bend.angle[i].is_nan() {
                let (sum, number) = &mut map.bends[labels[i] as usize];
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
                // Where nothing can be measured there is no reason to merge.
                if let Some(angle) = bend.fold(lattice, labels, [i, k]) {
                    for (one, other) in [(a, b), (b, a)] {
                        let sums = map.beside[one as usize].entry(other).or_default();
                        *sums = (sums.0 + angle, sums.1 + 1.0);
                    }
                }
            }
        }
        map
    }

    /// Whether any were flat enough.
    fn merge_flat(&mut self) -> bool {
        let mut queue = BinaryHeap::new();
        for (a, beside) in self.beside.iter().enumerate() {
            for (b, sums) in beside.range(a as u32 + 1..) {
                queue.push(Reverse((self.sharpness(a as u32, *b, *sums), a as u32, *b)));
            }
        }
        let mut merged = false;
        while let Some(Reverse((sharpness, a, b))) = queue.pop() {
            if f64::from_bits(sharpness) >= 1.0 {
                break;
            }
            // What has changed since was put in the queue again.
            let sums = self.beside[a as usize].get(&b);
            if sums.is_some_and(|sums| self.sharpness(a, b, *sums) == sharpness) {
                merged = true;
                let kept = self.join(a, b);
                for (other, sums) in &self.beside[kept as usize] {
                    queue.push(Reverse((self.sharpness(kept, *other, *sums), kept, *other)));
                }
            }
        }
        merged
    }

    fn merge_small(&mut self, least: f64) {
        let mut queue: BinaryHeap<_> = (self.sizes.iter().enumerate())
            .map(|(patch, size)| Reverse((*size, patch as u32)))
            .collect();
        while let Some(Reverse((size, patch))) = queue.pop() {
            if size as f64 >= least {
                break;
            }
            let alive = self.parents[patch as usize] == patch;
            if !alive || self.sizes[patch as usize] != size {
                continue;
            }
            let beside = self.beside[patch as usize].iter();
            let flattest = beside
                .min_by_key(|(other, sums)| self.sharpness(patch, **other, **sums))
                .map(|(other, _)| *other);
            if let Some(other) = flattest {
                let kept = self.join(patch, other);
                queue.push(Reverse((self.sizes[kept as usize], kept)));
            }
        }
    }

    /// The mean angle along a border over what makes it one, as bits: positive floats are in their
    /// order.
    fn sharpness(&self, a: u32, b: u32, (sum, number): Sums) -> u64 {
        let bending = |patch: u32| {
            let (sum, number) = self.bends[patch as usize];
            if number > 0.0 { sum / number } else { 0.0 }
        };
        let distance = 2.0 * ASIDE as f64;
        let own = TIMES * distance * bending(a).min(bending(b));
        (sum / number / own.max(self.fold)).to_bits()
    }

    /// Makes two patches one and returns its number, that of the one with more neighbours.
    fn join(&mut self, a: u32, b: u32) -> u32 {
        let neighbours = |patch: u32| self.beside[patch as usize].len();
        let (kept, gone) = if neighbours(a) < neighbours(b) {
            (b, a)
        } else {
            (a, b)
        };
        self.parents[gone as usize] = kept;
        self.sizes[kept as usize] += self.sizes[gone as usize];
        let (sum, number) = self.bends[gone as usize];
        let all = &mut self.bends[kept as usize];
        *all = (all.0 + sum, all.1 + number);
        self.beside[kept as usize].remove(&gone);
        for (other, sums) in std::mem::take(&mut self.beside[gone as usize]) {
            if other == kept {
                continue;
            }
            self.beside[other as usize].remove(&gone);
            for (one, two) in [(kept, other), (other, kept)] {
                let all = self.beside[one as usize].entry(two).or_default();
                *all = (all.0 + sums.0, all.1 + sums.1);
            }
        }
        kept
    }

    fn relabel(&self, labels: &mut [u32]) {
        for label in labels.iter_mut().filter(|label| **label != NO_PATCH) {
            while self.parents[*label as usize] != *label {
                *label = self.parents[*label as usize];
            }
        }
    }
}

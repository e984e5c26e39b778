//! Disjoint sets of the numbers from 0 to some count (union-find).

use std::ops::Range;

use crate::error::{Result, try_filled};

/// Union-find structure with path halving. The representative of a set is its smallest number, so that the result
/// does not depend on the order in which sets are merged.
pub(crate) struct UnionFind {
    parents: Vec<u32>,
}

impl UnionFind {
    /// Makes the sets `{0}` to `{count − 1}` of one number each.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory), which names `what`.
    pub(crate) fn new(what: &'static str, count: usize) -> Result<Self> {
        let mut parents = try_filled(what, count, 0)?;
        for (i, parent) in parents.iter_mut().enumerate() {
            *parent = i as u32;
        }
        Ok(UnionFind { parents })
    }

    /// Returns the representative of the set that holds `member`: its smallest number.
    #[inline]
    pub(crate) fn find(&mut self, mut member: u32) -> u32 {
        while self.parents[member as usize] != member {
            let grandparent = self.parents[self.parents[member as usize] as usize];
            self.parents[member as usize] = grandparent;
            member = grandparent;
        }
        member
    }

    /// Merges the sets of two numbers.
    pub(crate) fn union(&mut self, a: u32, b: u32) {
        let (a, b) = (self.find(a), self.find(b));
        self.parents[a.max(b) as usize] = a.min(b);
    }

    /// Merges the set of `member` with the sets of a range of numbers. Faster than single calls of [`UnionFind::union`]
    /// where most of these numbers are in one set already.
    pub(crate) fn union_range(&mut self, member: usize, others: Range<usize>) {
        let mut root = self.find(member as u32);
        for other in others {
            if self.parents[other] != root {
                self.union(root, other as u32);
                root = self.find(root);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_representative_is_the_smallest_number_in_any_order() {
        // Sets of equal remainders modulo 3, merged upwards and downwards.
        for reversed in [false, true] {
            let mut sets = UnionFind::new("test", 30).unwrap();
            for i in 0..27 {
                let i = if reversed { 26 - i } else { i };
                sets.union(i + 3, i);
            }
            assert!((0..30).all(|i| sets.find(i) == i % 3));
        }
    }

    #[test]
    fn a_range_is_merged_with_one_set() {
        let mut sets = UnionFind::new("test", 10).unwrap();
        sets.union(5, 7);
        sets.union_range(8, 4..7);
        let representatives: Vec<u32> = (0..10).map(|i| sets.find(i)).collect();
        assert_eq!(representatives, [0, 1, 2, 3, 4, 4, 4, 4, 4, 9]);
    }
}

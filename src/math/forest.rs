//! Disjoint sets of numbers.

use std::ops::Range;

use crate::error::{Result, try_filled};

/// Each number on its own at first. The smallest one of a set is its root, so that the result does not
/// depend on the order in which sets are joined.
pub(crate) struct Forest {
    parents: Vec<u32>,
}

impl Forest {
    /// # Errors
    /// Out of memory for `what`.
    pub(crate) fn new(what: &'static str, count: usize) -> Result<Self> {
        let mut parents = try_filled(what, count, 0)?;
        for (i, parent) in parents.iter_mut().enumerate() {
            *parent = i as u32;
        }
        Ok(Forest { parents })
    }

    pub(crate) fn root(&mut self, mut member: u32) -> u32 {
        while self.parents[member as usize] != member {
            let above = self.parents[self.parents[member as usize] as usize];
            self.parents[member as usize] = above;
            member = above;
        }
        member
    }

    pub(crate) fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.root(a), self.root(b));
        self.parents[a.max(b) as usize] = a.min(b);
    }

    /// Joins a number with each of others, which mostly are with it already.
    pub(crate) fn join_all(&mut self, member: usize, others: Range<usize>) {
        let mut root = self.root(member as u32);
        for other in others {
            if self.parents[other] != root {
                self.join(root, other as u32);
                root = self.root(root);
            }
        }
    }
}

//! Segmentation of a lattice into parts: the part of each vertex, and the patch of each part.

use crate::lattice::hexagonal::Lattice;
use rustc_hash::FxHashMap;

/// Segmentation of a lattice into parts: the number of the part of each vertex, and of the patch that each part belongs
/// to. A patch that cannot lie flat in one piece is cut into several parts.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Labels {
    /// Number of the part (a patch or a piece of one) that each vertex of the lattice belongs to.
    pub of: Vec<u32>,
    /// Number of the patch from which each part was cut.
    pub origins: Vec<u32>,
}

impl Labels {
    pub(super) fn new(patches: &[u32], count: usize) -> Labels {
        Labels {
            of: patches.to_vec(),
            origins: (0..count as u32).collect(),
        }
    }

    /// Returns whether two parts are the same part or were cut from one patch, so that the surface is smooth across
    /// their common border.
    pub(super) fn are_one(&self, a: u32, b: u32) -> bool {
        let origin = |part: u32| self.origins.get(part as usize);
        a == b || (origin(a).is_some() && origin(a) == origin(b))
    }
}

/// Finds the connected components of some vertices of a lattice; two neighbours are connected where `joined` is true.
pub(super) fn connected_groups(
    lattice: &Lattice,
    vertices: impl Iterator<Item = usize>,
    joined: impl Fn(usize, usize) -> bool,
) -> Vec<Vec<usize>> {
    let order: Vec<usize> = vertices.collect();
    let mut seen: FxHashMap<usize, bool> = order.iter().map(|i| (*i, false)).collect();
    let mut groups = Vec::new();
    for first in order {
        if seen.insert(first, true) == Some(true) {
            continue;
        }
        let mut group = vec![first];
        let mut next = 0;
        while let Some(i) = group.get(next).copied() {
            next += 1;
            for k in lattice.around(i) {
                if let Some(seen) = seen.get_mut(&k)
                    && !*seen
                    && joined(i, k)
                {
                    *seen = true;
                    group.push(k);
                }
            }
        }
        groups.push(group);
    }
    groups
}

//! The patches of a net: facets, and strips of narrow facets that bend as one.

use rustc_hash::{FxHashMap, FxHashSet};

use super::net::Net;
use crate::error::{Error, Result};
use crate::math::index::NO_INDEX;
use crate::math::union_find::UnionFind;
use crate::scene::polyhedron::Polyhedron;

/// Largest ratio of the curvatures of neighbouring facets of a bend. `benches/patterns.md` has what others give.
const MAX_BEND_CURVATURE_RATIO: f64 = 3.0;

/// The patch of each facet: a facet alone, or neighbouring facets of one bend.
pub(super) struct FlatPatches {
    pub of: Vec<u32>,
    /// Area and vertices of each patch.
    pub areas: Vec<f64>,
}

impl FlatPatches {
    pub(super) fn new(solid: &Polyhedron, net: &Net) -> Result<FlatPatches> {
        let is_bent = bent_facets(solid);
        let mut forest = UnionFind::new("facets", solid.normals.len())?;
        // The folds of bends, in an order in which a bend is known as a path.
        let folds = solid.inner_sides().filter(|side| {
            net.is_closed(*side)
                && solid.is_step(*side)
                && [*side, solid.twins[*side as usize]]
                    .iter()
                    .all(|s| is_bent[solid.facet(*s) as usize])
        });
        let folds: Vec<[u32; 2]> = folds
            .map(|side| [side, solid.twins[side as usize]].map(|s| solid.facet(s)))
            .collect();
        folds.iter().for_each(|[a, b]| forest.union(*a, *b));
        // A bend all around is cut along one line, and both sides of a cut belong to different patches: it is halved.
        let mut halved: Vec<u32> = solid
            .inner_sides()
            .filter(|side| !net.is_closed(*side))
            .map(|side| [side, solid.twins[side as usize]].map(|s| forest.find(solid.facet(s))))
            .filter(|[a, b]| a == b)
            .map(|[a, _]| a)
            .collect();
        halved.sort_unstable();
        halved.dedup();
        let mut halves = UnionFind::new("facets", solid.normals.len())?;
        for own in folds.chunk_by(|a, b| a == b).map(|pair| pair[0]) {
            if halved.binary_search(&forest.find(own[0])).is_err() {
                halves.union(own[0], own[1]);
            }
        }
        for bend in halved {
            let half = first_half(&folds, solid, net, |facet| forest.find(facet) == bend);
            for [a, b] in &folds {
                if forest.find(*a) == bend && half.contains(a) == half.contains(b) {
                    halves.union(*a, *b);
                }
            }
        }
        // Patches by area, the largest first.
        let count = solid.normals.len();
        let mut sums = vec![0.0; count];
        for facet in 0..count {
            sums[halves.find(facet as u32) as usize] += solid.areas[facet];
        }
        let mut order: Vec<u32> = (0..count as u32)
            .filter(|f| halves.find(*f) == *f)
            .collect();
        order.sort_by(|a, b| {
            sums[*b as usize]
                .total_cmp(&sums[*a as usize])
                .then(a.cmp(b))
        });
        let mut numbers = vec![NO_INDEX; count];
        for (number, root) in (0u32..).zip(&order) {
            numbers[*root as usize] = number;
        }
        Ok(FlatPatches {
            of: (0..count as u32)
                .map(|f| numbers[halves.find(f) as usize])
                .collect(),
            areas: order.iter().map(|root| sums[*root as usize]).collect(),
        })
    }
}

impl FlatPatches {
    /// Pairs of facets on both sides of the edges between pairs of patches.
    pub(super) fn facets_between(
        &self,
        solid: &Polyhedron,
        pairs: &[[u32; 2]],
    ) -> Result<FxHashSet<[u32; 2]>> {
        let mut wanted: FxHashMap<[u32; 2], bool> = FxHashMap::default();
        for [a, b] in pairs {
            wanted.insert([*a.min(b), *a.max(b)], false);
        }
        let mut found = FxHashSet::default();
        for side in solid.inner_sides() {
            let mut facets = [side, solid.twins[side as usize]].map(|s| solid.facet(s));
            facets.sort_unstable();
            let mut patches = facets.map(|facet| self.of[facet as usize]);
            patches.sort_unstable();
            if let Some(is_found) = wanted.get_mut(&patches) {
                *is_found = true;
                found.insert(facets);
            }
        }
        match wanted.iter().find(|(_, is_found)| !**is_found) {
            None => Ok(found),
            Some(([a, b], _)) => Err(Error::Unsupported {
                format: "pattern",
                reason: format!("patches {} and {} have no edge in common", a + 1, b + 1),
            }),
        }
    }
}

/// Whether each facet is part of a bend: it meets two others at small angles of one sign and the rest at large ones, and is curved
/// about as one of the two. Lone facets may be any polyhedron's, and a face between two bends is far less curved than both.
fn bent_facets(solid: &Polyhedron) -> Vec<bool> {
    let steps = solid.bend_steps();
    let mut lengths = vec![0.0; steps.len()];
    for side in solid.inner_sides().filter(|side| solid.is_step(*side)) {
        for side in [side, solid.twins[side as usize]] {
            lengths[solid.facet(side) as usize] += solid.length(side);
        }
    }
    // A chord of a circle turns by half of the angles at its two ends, along its width.
    let curvature = |facet: usize| match steps[facet][..] {
        [(_, a), (_, b)] if a * b > 0.0 => (a + b) * lengths[facet] / solid.areas[facet],
        _ => 0.0,
    };
    let curvatures: Vec<f64> = (0..steps.len()).map(curvature).collect();
    let is_alike = |a: f64, b: f64| {
        a * b > 0.0 && a.abs().max(b.abs()) <= MAX_BEND_CURVATURE_RATIO * a.abs().min(b.abs())
    };
    (steps.iter().zip(&curvatures))
        .map(|(own, a)| {
            own.iter()
                .any(|(other, _)| is_alike(*a, curvatures[*other as usize]))
        })
        .collect()
}

/// The facets of a bend up to its middle, from one side of its cut on.
fn first_half(
    folds: &[[u32; 2]],
    solid: &Polyhedron,
    net: &Net,
    mut is_own: impl FnMut(u32) -> bool,
) -> Vec<u32> {
    let cut = solid.inner_sides().find(|side| {
        let both = [*side, solid.twins[*side as usize]].map(|s| solid.facet(s));
        !net.is_closed(*side) && both.iter().all(|facet| is_own(*facet))
    });
    let mut half: Vec<u32> = cut.map(|side| solid.facet(side)).into_iter().collect();
    let own: Vec<[u32; 2]> = folds.iter().copied().filter(|[a, _]| is_own(*a)).collect();
    let mut all: Vec<u32> = own.as_flattened().to_vec();
    all.sort_unstable();
    all.dedup();
    let mut next = 0;
    while let Some(facet) = half.get(next).copied() {
        next += 1;
        for [a, b] in &own {
            for (one, other) in [(a, b), (b, a)] {
                if *one == facet && !half.contains(other) && 2 * half.len() < all.len() {
                    half.push(*other);
                }
            }
        }
    }
    half
}

//! The patches of a net: facets, and strips of narrow facets that bend as one.

use rustc_hash::{FxHashMap, FxHashSet};

use super::net::Net;
use crate::error::{Error, Result};
use crate::math::index::NO_INDEX;
use crate::math::union_find::UnionFind;
use crate::scene::half_edges::half_edge_ends;
use crate::scene::polyhedron::{Place, Polyhedron};

/// Largest ratio of the curvatures of neighbouring facets of a bend. `benches/patterns.md` has what others give.
pub(super) const MAX_BEND_CURVATURE_RATIO: f64 = 3.0;

/// The patch of each facet: a facet alone, or neighbouring facets of one bend.
pub(super) struct FlatPatches {
    pub of: Vec<u32>,
    /// Area of each patch.
    pub areas: Vec<f64>,
    /// The bend that each facet is part of, by a facet of it: one or two patches. A facet alone is its own.
    pub bends: Vec<u32>,
    /// The facets on both sides of each facet that is part of a bend, beyond the lines along which it is: several where a hole
    /// divides a line.
    bent: Vec<Option<[Vec<u32>; 2]>>,
}

impl FlatPatches {
    pub(super) fn new(solid: &Polyhedron, net: &Net) -> Result<FlatPatches> {
        let bent = bent_facets(solid, net);
        let goes_on = |from, to| goes_on(&bent, from, to);
        let mut forest = UnionFind::new("facets", solid.normals.len())?;
        // The folds of bends, in an order in which a bend is known as a path.
        let folds = solid.inner_sides().filter(|side| net.is_closed(*side));
        let folds: Vec<[u32; 2]> = folds
            .map(|side| [side, solid.twins[side as usize]].map(|s| solid.facet(s)))
            .filter(|[a, b]| goes_on(*a, *b) && goes_on(*b, *a))
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
            bends: (0..count as u32).map(|f| forest.find(f)).collect(),
            bent,
        })
    }
}

impl FlatPatches {
    /// Whether a facet is part of a bend that goes on or ends at another facet.
    pub(super) fn goes_on(&self, from: u32, to: u32) -> bool {
        goes_on(&self.bent, from, to)
    }

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

fn goes_on(bent: &[Option<[Vec<u32>; 2]>], from: u32, to: u32) -> bool {
    let beyond = bent[from as usize].as_ref();
    beyond.is_some_and(|lines| lines.iter().any(|others| others.contains(&to)))
}

/// A line along which a facet meets others at a small angle.
struct Step {
    others: Vec<u32>,
    side: u32,
    angle: f64,
    length: f64,
    ends: Vec<u32>,
    is_closed: bool,
}

/// Whether two edges lie on one line.
fn are_in_line(solid: &Polyhedron, [one, other]: [u32; 2]) -> bool {
    let [a, b] = solid.ends(one);
    let away = |p: Place| (b - a).cross(&(p - a)).norm() / (b - a).norm();
    solid
        .ends(other)
        .into_iter()
        .all(|p| away(p) <= solid.rounding)
}

/// The two lines along which each facet that is part of a bend goes on, as the facets beyond them; `None` for other facets. Along both
/// it bends at a small angle of one sign, about as much as the facet beyond one of them: lone facets may be any polyhedron's, and a face
/// between two bends is far less curved than both. If it meets more than two facets at small angles, as a vase does above and
/// below, those are opposite sides, along which the sheet is folded rather than cut.
fn bent_facets(solid: &Polyhedron, net: &Net) -> Vec<Option<[Vec<u32>; 2]>> {
    let mut steps: Vec<Vec<Step>> = Vec::new();
    steps.resize_with(solid.normals.len(), Vec::new);
    for side in solid.inner_sides().filter(|side| solid.is_step(*side)) {
        let twin = solid.twins[side as usize];
        for (own, other) in [(side, twin), (twin, side)] {
            let (steps, other) = (&mut steps[solid.facet(own) as usize], solid.facet(other));
            let ends = half_edge_ends(&solid.triangles, own);
            let is_same = |step: &&mut Step| {
                step.others.contains(&other) || are_in_line(solid, [step.side, own])
            };
            match steps.iter_mut().find(is_same) {
                Some(step) => {
                    step.others.push(other);
                    step.length += solid.length(own);
                    step.ends.extend(ends);
                }
                None => steps.push(Step {
                    others: vec![other],
                    side: own,
                    angle: solid.angle(own),
                    length: solid.length(own),
                    ends: ends.to_vec(),
                    is_closed: net.is_closed(own),
                }),
            }
        }
    }
    // A chord of a circle turns by half of the angles at its two ends, along its width.
    let lines = |facet: usize| {
        let own = &steps[facet];
        let pairs = (0..own.len()).flat_map(|k| (0..k).map(move |j| [&own[j], &own[k]]));
        let is_opposite = |[a, b]: &[&Step; 2]| a.ends.iter().all(|v| !b.ends.contains(v));
        let mut pairs = pairs.filter(|pair| own.len() == 2 || is_opposite(pair));
        let folded = |pair: &[&Step; 2]| pair.iter().filter(|step| step.is_closed).count();
        let first = pairs.next()?;
        let [a, b] = pairs.fold(first, |best, pair| {
            if folded(&pair) > folded(&best) {
                pair
            } else {
                best
            }
        });
        let curvature = (a.angle + b.angle) * (a.length + b.length) / solid.areas[facet];
        (a.angle * b.angle > 0.0).then_some(([a, b], curvature))
    };
    let lines: Vec<Option<([&Step; 2], f64)>> = (0..steps.len()).map(lines).collect();
    let curvature = |facet: &u32| lines[*facet as usize].map_or(0.0, |(_, curvature)| curvature);
    let is_alike = |a: f64, b: f64| {
        a * b > 0.0 && a.abs().max(b.abs()) <= MAX_BEND_CURVATURE_RATIO * a.abs().min(b.abs())
    };
    let bent = lines.iter().map(|own| {
        let (beyond, own) = (*own)?;
        let is_along = |step: &Step| {
            step.others
                .iter()
                .any(|other| is_alike(own, curvature(other)))
        };
        let is_bent = beyond.iter().any(|step| is_along(step));
        is_bent.then(|| beyond.map(|step| step.others.clone()))
    });
    bent.collect()
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

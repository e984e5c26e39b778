//! Vertices at the border of a surface that do not belong to it.

use rustc_hash::FxHashMap;

use crate::heights::heightfield::Heightfield;
use crate::shape::patches::NO_PATCH;
use crate::shape::patches::extrapolate::extrapolated_height;

/// Maximum distance in height, in lattice spacings, of a vertex at the border from the quadratic through the other vertices of its
/// patch nearby. `benches/patterns.md` has what others give.
const MAX_LOOSE_SPACINGS: f64 = 2.0;

/// Maximum number of passes in which vertices at the border are taken out. `benches/patterns.md` has what others give.
const MAX_LOOSE_PASSES: usize = 4;

/// Takes vertices at the border from their patches that are far from what the other vertices of their patch say, the farthest
/// first. Returns the patches, and the number of vertices taken.
pub(super) fn without_loose(surface: &Heightfield, labels: &[u32]) -> (Vec<u32>, usize) {
    let lattice = surface.lattice();
    let mut labels = labels.to_vec();
    let mut taken = 0;
    for _ in 0..MAX_LOOSE_PASSES {
        let is_outer = |i: usize| {
            let inner = lattice.around(i).filter(|k| labels[*k] != NO_PATCH);
            labels[i] != NO_PATCH && inner.count() < 6
        };
        let mut away: FxHashMap<usize, f64> = FxHashMap::default();
        for i in (0..lattice.len()).filter(|i| is_outer(*i)) {
            let distance =
                (surface.heights()[i] - extrapolated_height(surface, &labels, labels[i], i)).abs();
            if distance > MAX_LOOSE_SPACINGS * lattice.spacing() {
                away.insert(i, distance);
            }
        }
        let is_farthest = |i: &usize| {
            lattice
                .around(*i)
                .all(|k| away.get(&k).is_none_or(|other| *other < away[i]))
        };
        let found: Vec<usize> = away.keys().copied().filter(is_farthest).collect();
        found.iter().for_each(|i| labels[*i] = NO_PATCH);
        taken += found.len();
        if found.is_empty() {
            break;
        }
    }
    (labels, taken)
}

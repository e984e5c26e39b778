//! Merges patches across borders that are no creases.
//!
//! A surface that was fitted to noise bends along few of its rulings and hardly in between, so
//! that it is segmented where there is no crease. A crease has a fold angle between the patches on either side, or a step.

use std::collections::BTreeMap;

use super::bend_angles::{BendAngles, NORMAL_DISTANCE_VERTICES};
use super::patch::NO_PATCH;
use crate::heights::heightfield::Heightfield;
use crate::lattice::hexagonal::Towards;
use crate::scene::region_graph::RegionGraph;

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
    let relabel = |graph: &RegionGraph, labels: &mut [u32]| {
        for label in labels.iter_mut().filter(|label| **label != NO_PATCH) {
            *label = graph.merged(*label);
        }
    };
    // Angles are measured again after patches have been merged, for then normals can be further from the border.
    loop {
        let mut graph = patch_graph(surface, bend, fold, labels);
        let merged = graph.merge_flat();
        relabel(&graph, labels);
        if !merged {
            break;
        }
    }
    let mut graph = patch_graph(surface, bend, fold, labels);
    graph.merge_small(min_vertices);
    relabel(&graph, labels);
    let mut numbers = BTreeMap::new();
    for label in labels.iter_mut().filter(|label| **label != NO_PATCH) {
        let next = numbers.len() as u32;
        *label = *numbers.entry(*label).or_insert(next);
    }
}

/// Builds the region adjacency graph of a segmentation: sizes are numbers of vertices.
fn patch_graph(surface: &Heightfield, bend: &BendAngles, fold: f64, labels: &[u32]) -> RegionGraph {
    let lattice = surface.lattice();
    let patches = labels.iter().filter(|label| **label != NO_PATCH);
    let count = patches.max().map_or(0, |label| *label as usize + 1);
    let distance = 2.0 * NORMAL_DISTANCE_VERTICES as f64;
    let mut graph = RegionGraph::new(count, fold, MIN_FOLD_PER_BEND * distance);
    for i in (0..labels.len()).filter(|i| labels[*i] != NO_PATCH) {
        let angle = Some(bend.angle[i]).filter(|angle| !angle.is_nan());
        graph.add_member(labels[i], 1.0, angle.map_or([0.0; 2], |angle| [angle, 1.0]));
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
                graph.add_border(a, b, [angle, 1.0]);
            }
        }
    }
    graph
}

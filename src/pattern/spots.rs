//! Finds a place for the label of each patch on a sheet.

use std::collections::VecDeque;

use super::outline::Layout;
use super::seam_graph::SeamGraph;
use super::sheets::Spot;
use crate::heights::heightfield::Heightfield;
use crate::shape::patches::NO_PATCH;

/// Finds for each patch a vertex for its label: the vertex that is the most lattice edges away from other patches and
/// from the surface's border; of several such vertices, the one nearest to the patch's centroid.
pub(super) fn label_spots(
    surface: &Heightfield,
    labels: &[u32],
    net: &SeamGraph,
    layout: &Layout,
) -> Vec<Spot> {
    let lattice = surface.lattice();
    let around = |i: usize| {
        lattice
            .neighbours(i / lattice.cols(), i % lattice.cols())
            .map(|n| n.map(|(row, col)| lattice.index(row, col)))
    };
    let mut steps = vec![u32::MAX; labels.len()];
    let mut queue = VecDeque::new();
    for i in (0..labels.len()).filter(|i| labels[*i] != NO_PATCH) {
        if (around(i).into_iter()).any(|k| k.is_none_or(|k| labels[k] != labels[i])) {
            steps[i] = 0;
            queue.push_back(i);
        }
    }
    while let Some(i) = queue.pop_front() {
        for k in around(i).into_iter().flatten() {
            if labels[k] != NO_PATCH && steps[k] == u32::MAX {
                steps[k] = steps[i] + 1;
                queue.push_back(k);
            }
        }
    }
    let position = |i: usize| lattice.position(i / lattice.cols(), i % lattice.cols());
    let mut middles = vec![([0.0; 2], 0.0); net.flat_patches.len()];
    for (i, label) in labels.iter().enumerate() {
        if let Some((sum, count)) = middles.get_mut(*label as usize) {
            let [x, y] = position(i);
            *sum = [sum[0] + x, sum[1] + y];
            *count += 1.0;
        }
    }
    // Compare by the number of edges first, then by the distance from the middle.
    let mut best = vec![(0u32, f64::INFINITY, usize::MAX); net.flat_patches.len()];
    for (i, label) in labels.iter().enumerate() {
        if let Some(found) = best.get_mut(*label as usize) {
            let ([x, y], count) = middles[*label as usize];
            let [px, py] = position(i);
            let away = (px - x / count).hypot(py - y / count);
            let better = steps[i] > found.0 || (steps[i] == found.0 && away < found.1);
            if found.2 == usize::MAX || better {
                *found = (steps[i], away, i);
            }
        }
    }
    let spot = |(patch, (steps, _, vertex)): (usize, (u32, f64, usize))| {
        let flat_patch = net.flat_patches[patch].as_ref();
        let place = flat_patch.map(|flat_patch| {
            let here = flat_patch.place([vertex / lattice.cols(), vertex % lattice.cols()]);
            layout.motions[patch].of(here)
        });
        Spot {
            patch: patch as u32,
            place: place.map_or([0.0; 2], |place| [place.re, place.im]),
            room: f64::from(steps) * lattice.row_spacing(),
        }
    };
    best.into_iter().enumerate().map(spot).collect()
}

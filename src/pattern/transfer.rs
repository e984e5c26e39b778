//! Labels, flat positions and folds of a surface transferred from the coarse lattice to the fine one.

use std::collections::{BTreeMap, VecDeque};

use super::assembly::AssembledSheets;
use super::coarse::{Coarse, on_coarse};
use super::flat_patch::{FlatPatch, MIN_CUT_VERTICES};
use super::labels::connected_groups;
use super::outline::Layout;
use super::parts::Parts;
use super::seam_graph::SeamGraph;
use crate::error::{Result, try_filled};
use crate::heights::heightfield::Heightfield;
use crate::lattice::coarsening::parents;
use crate::shape::patches::{NO_PATCH, Patches};

/// Transfers labels from the coarse lattice to the fine one: returns the part of each fine vertex, and the patch of
/// each part. Vertices left out on the coarse lattice join the part beside them and are tried again. Regions that
/// no coarse part reaches become parts of their own, unless they are too small to be cut, which are left out: such a
/// part would have no outline.
pub(super) fn transfer_labels(
    surface: &Heightfield,
    patches: &Patches,
    coarse: &Coarse,
    rough: &AssembledSheets,
) -> Result<(Vec<u32>, Vec<u32>)> {
    let fine = *surface.lattice();
    let lattice = *coarse.surface.lattice();
    let of = &rough.parts.labels.of;
    let origin =
        |part: u32| coarse.order[rough.parts.labels.origins[part as usize] as usize] as u32;
    let mut origins: Vec<u32> = (0..rough.parts.labels.origins.len() as u32)
        .map(origin)
        .collect();
    let mut labels = try_filled("pattern", fine.len(), NO_PATCH)?;
    let mut open = try_filled("pattern", fine.len(), false)?;
    for i in 0..fine.len() {
        let patch = patches.labels()[i];
        if patch == NO_PATCH {
            continue;
        }
        let around: Vec<usize> = on_coarse(&lattice, i / fine.cols(), i % fine.cols()).collect();
        let own = |k: &&usize| origins.get(of[**k] as usize) == Some(&patch);
        match around.iter().find(own) {
            Some(k) => labels[i] = of[*k],
            None => open[i] = true,
        }
    }
    let mut queue: VecDeque<usize> = (0..fine.len())
        .filter(|i| labels[*i] != NO_PATCH && fine.around(*i).any(|k| open[k]))
        .collect();
    while let Some(i) = queue.pop_front() {
        for k in fine.around(i) {
            if open[k] && patches.labels()[k] == patches.labels()[i] {
                open[k] = false;
                labels[k] = labels[i];
                queue.push_back(k);
            }
        }
    }
    let left = (0..fine.len()).filter(|i| open[*i]);
    let same_patch = |i: usize, k: usize| patches.labels()[i] == patches.labels()[k];
    for region in connected_groups(&fine, left, same_patch) {
        if region.len() >= MIN_CUT_VERTICES {
            let patch = patches.labels()[region[0]];
            region
                .iter()
                .for_each(|k| labels[*k] = origins.len() as u32);
            origins.push(patch);
        }
    }
    Ok((labels, origins))
}

/// Creates a part of the fine lattice with the flat positions it has on the coarse lattice; `None` if these do not
/// determine the positions of all its vertices.
pub(super) fn placed(
    parts: &Parts,
    part: usize,
    rough: &AssembledSheets,
) -> Result<Option<FlatPatch>> {
    let Some(flat_patch) = rough.net.flat_patches[part].as_ref() else {
        return Ok(None);
    };
    let motion = rough.arrangement.layout.motions[part];
    let start = |[row, col]: [usize; 2]| {
        let [one, other] = parents(row, col).map(|(row, col)| {
            let vertex = [usize::try_from(row).ok()?, usize::try_from(col).ok()?];
            let place = flat_patch.place(vertex);
            (!place.re.is_nan()).then_some(place)
        });
        Some(motion.apply(0.5 * (one? + other?)))
    };
    FlatPatch::at(
        &parts.surface,
        &parts.labels,
        part as u32,
        parts.window(part as u32),
        start,
    )
}

/// Makes folds of those seams that are folds in another layout; `order` holds the number there of each part. Parts that
/// were not there have no folds.
pub(super) fn fold_alike(
    net: &mut SeamGraph,
    layout: &mut Layout,
    order: &[usize],
    other: &SeamGraph,
    folds: &Layout,
) {
    // For each pair of parts: the positions of the nodes between them, and whether the node is on a fold.
    let mut nodes: BTreeMap<[usize; 2], Vec<([f64; 2], bool)>> = BTreeMap::new();
    for (number, seam) in other.seams.iter().enumerate() {
        let list = nodes.entry(seam.patches.map(|p| p as usize)).or_default();
        let own = seam
            .nodes
            .iter()
            .map(|node| (other.plan(*node), folds.folded[number]));
        list.extend(own);
    }
    for seam in 0..net.seams.len() {
        let mut pair = net.seams[seam].patches.map(|p| order[p as usize]);
        pair.sort_unstable();
        let Some(list) = nodes.get(&pair).filter(|_| !net.is_torn(seam)) else {
            continue;
        };
        let kind = |node| {
            let [x, y] = net.plan(node);
            let away = |[p, q]: [f64; 2]| (p - x).powi(2) + (q - y).powi(2);
            let nearest = list.iter().min_by(|a, b| away(a.0).total_cmp(&away(b.0)));
            nearest.is_some_and(|(_, folded)| *folded)
        };
        let kinds: Vec<bool> = net.seams[seam]
            .nodes
            .iter()
            .map(|node| kind(*node))
            .collect();
        let divided = net.divide_where(seam, &kinds);
        layout.folded.resize(net.seams.len(), false);
        for (part, folded) in divided {
            layout.folded[part] = folded;
        }
    }
}

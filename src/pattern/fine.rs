//! Sheets that were found on a coarse lattice, laid flat and drawn on the fine one.
//!
//! Where a surface has to be cut depends on its shape and not on its sampling. Surfaces with many vertices are
//! therefore cut and joined on every second or every fourth vertex, where trial cuts and trial joins cost less.
//! Then each vertex of the fine lattice gets the part of the nearest coarse vertex, the positions on the coarse
//! lattice are the initial guess of those on the fine one, and the outlines are computed from creases and triangles
//! of the fine lattice.

use std::collections::{BTreeMap, VecDeque};

use super::assembly::{Assembled, Settled, settle};
use super::flat_patch::{FlatPatch, MIN_CUT_VERTICES};
use super::labels::{Labels, connected_groups};
use super::layout::Arrangement;
use super::outline::Layout;
use super::parts::Parts;
use super::seam_graph::SeamGraph;
use super::sew::close_cuts;
use crate::error::{Error, Result, try_filled};
use crate::heights::heightfield::Heightfield;
use crate::lattice::coarsening::{coarse_lattice, fine_vertex, parents};
use crate::lattice::hexagonal::Lattice;
use crate::shape::patches::{NO_PATCH, Patches};

/// Maximum number of vertices of a surface that is cut into sheets without doing so on a coarser lattice first.
/// `benches/patterns.md` has what it costs and gains.
const MAX_DIRECT_VERTICES: usize = 20_000;

/// Maximum number of solver iterations of all trials to close cuts of parts that were cut on the fine lattice, summed over
/// the vertices of the sheet in each trial, per vertex of the pattern.
const RECUT_STEP_BUDGET_PER_VERTEX: usize = 100;

/// A surface and its patches, sampled at every second vertex of the lattice on which the surface is given.
pub(super) struct Coarse {
    pub surface: Heightfield,
    pub patches: Patches,
    /// For each patch of the coarse lattice the number of the same patch on the fine lattice.
    order: Vec<usize>,
}

impl Coarse {
    /// Samples the surface on the lattice of twice the spacing; `None` if it has at most [`MAX_DIRECT_VERTICES`]
    /// vertices, or if too few would be left.
    pub(super) fn new(surface: &Heightfield, patches: &Patches) -> Result<Option<Coarse>> {
        let valid = surface.heights().iter().filter(|z| !z.is_nan()).count();
        let fine = *surface.lattice();
        if valid <= MAX_DIRECT_VERTICES || fine.rows() < 8 || fine.cols() < 8 {
            return Ok(None);
        }
        let lattice = coarse_lattice(&fine)?;
        let mut heights = try_filled("pattern", lattice.len(), f64::NAN)?;
        let mut labels = try_filled("pattern", lattice.len(), NO_PATCH)?;
        for i in 0..lattice.len() {
            if let Some(k) = on_fine(&lattice, &fine, i) {
                heights[i] = surface.heights()[k];
                labels[i] = patches.labels()[k];
            }
        }
        let coarse = Heightfield::new(lattice, heights)?;
        match patches.divided(&coarse, labels) {
            Ok((patches, order)) => Ok(Some(Coarse {
                surface: coarse,
                patches,
                order,
            })),
            // All of the surface is too narrow for the coarse lattice.
            Err(Error::Unsupported { .. } | Error::NoInterior { .. }) => Ok(None),
            Err(other) => Err(other),
        }
    }
}

/// Converts the index of a vertex of the coarse lattice to the index of the vertex of the fine lattice at the same
/// place.
fn on_fine(coarse: &Lattice, fine: &Lattice, i: usize) -> Option<usize> {
    let (row, col) = fine_vertex(i / coarse.cols(), i % coarse.cols());
    fine.contains(row, col)
        .then(|| fine.index(row as usize, col as usize))
}

/// Returns the indices of the one or two coarse vertices at or beside a vertex of the fine lattice.
fn on_coarse(coarse: &Lattice, row: usize, col: usize) -> impl Iterator<Item = usize> {
    let inside = |(row, col): &(isize, isize)| coarse.contains(*row, *col);
    let found: Vec<usize> = (parents(row, col).iter().filter(|vertex| inside(vertex)))
        .map(|(row, col)| coarse.index(*row as usize, *col as usize))
        .collect();
    found.into_iter()
}

/// Lays the sheets that were found on a coarse lattice flat on the fine one. The inner error holds the reason why a
/// sheet is invalid on the fine lattice. Unless `is_finest`, parts that are invalid alone are kept: the finer lattices
/// decide whether they have to be mended, and a part that is cut on several lattices falls into crumbs.
pub(super) fn refine_sheets(
    surface: &Heightfield,
    patches: &Patches,
    coarse: &Coarse,
    rough: &Assembled,
    parts: Parts,
    is_finest: bool,
) -> Result<std::result::Result<Assembled, String>> {
    let (labels, origins) = transfer_labels(surface, patches, coarse, rough)?;
    let mut parts = parts.with_labels(
        surface,
        Labels {
            of: labels,
            origins,
        },
    )?;
    // A sheet of a single part is laid flat from scratch, and border vertices that strain it too much are left out:
    // the coarse lattice does not show them.
    let known = rough.net.leaves.len();
    let several = rough
        .arrangement
        .sheets
        .iter()
        .filter(|members| members.len() > 1);
    let mut alone = vec![true; parts.labels.origins.len()];
    several
        .flatten()
        .for_each(|part| alone[*part as usize] = false);
    let single: Vec<u32> = (0..alone.len() as u32)
        .filter(|part| alone[*part as usize])
        .collect();
    parts.lay_flat_trimmed(&single)?;
    // A part that shares its sheet with others starts from its position on the coarse lattice.
    for part in (0..known).filter(|part| !alone[*part]) {
        let leaf = match placed(&parts, part, rough)? {
            None => parts.leaf(&(part as u32))?,
            found => found,
        };
        parts.leaves[part] = leaf;
    }
    let mut sheets = rough.arrangement.sheets.clone();
    sheets.extend((known..parts.leaves.len()).map(|part| vec![part as u32]));
    let decided = rough.net.decided;
    // The net and layout that say which seams are folds: those of the coarse lattice first, then the last ones here.
    let mut last: Option<(SeamGraph, Layout)> = None;
    let mut is_recut = vec![false; parts.leaves.len()];
    loop {
        // Sorted by their areas, as all patches are.
        let (found, order) = patches.divided(&parts.surface, parts.labels.of.clone())?;
        parts.renumber(&found, &order);
        let numbers = inverse(&order, is_recut.len());
        is_recut = order.iter().map(|old| is_recut[*old]).collect();
        for members in &mut sheets {
            let renumbered = members.iter().filter_map(|part| numbers[*part as usize]);
            *members = renumbered
                .filter(|part| parts.leaves[*part as usize].is_some())
                .collect();
            members.sort_unstable();
        }
        sheets.retain(|members| !members.is_empty());
        let leaves = std::mem::take(&mut parts.leaves);
        let mut net = SeamGraph::new(&parts.surface, &parts.labels, leaves, decided)?;
        let mut layout = Layout::loose(&net);
        match &last {
            None => fold_alike(
                &mut net,
                &mut layout,
                &order,
                &rough.net,
                &rough.arrangement.layout,
            ),
            Some((before, folds)) => fold_alike(&mut net, &mut layout, &order, before, folds),
        }
        let mut arrangement = Arrangement { layout, sheets };
        match settle(&parts, &mut net, &mut arrangement)? {
            Settled::Opened(wrong) if wrong.is_empty() || !is_finest => {
                if is_recut.contains(&true) {
                    let is_wanted = |part: u32| is_recut[part as usize];
                    let budget = RECUT_STEP_BUDGET_PER_VERTEX;
                    close_cuts(
                        &mut net,
                        &mut arrangement,
                        parts.options.max_strain,
                        budget,
                        is_wanted,
                    )?;
                }
                return Ok(Ok(Assembled {
                    parts,
                    patches: found,
                    net,
                    arrangement,
                }));
            }
            Settled::Opened(wrong) => {
                parts.leaves = std::mem::take(&mut net.leaves);
                for (part, reason) in wrong {
                    let first = parts.leaves.len() as u32;
                    match parts.cut_alone(part) {
                        Ok(true) => {}
                        Ok(false) | Err(Error::NotFlat { .. }) => return Ok(Err(reason)),
                        Err(other) => return Err(other),
                    }
                    is_recut[part as usize] = true;
                    is_recut.resize(parts.leaves.len(), true);
                    let added = first..parts.leaves.len() as u32;
                    arrangement.sheets.extend(added.map(|part| vec![part]));
                }
            }
            Settled::Specks(part, specks) => {
                parts.leaves = std::mem::take(&mut net.leaves);
                parts.trims += 1;
                parts.leave_out_specks(part, specks)?;
            }
        }
        sheets = arrangement.sheets;
        last = Some((net, arrangement.layout));
    }
}

/// Inverts a renumbering of parts: the new number of each of `count` parts, from the old numbers in their new order; `None` if a part is gone.
fn inverse(order: &[usize], count: usize) -> Vec<Option<u32>> {
    let mut numbers = vec![None; count];
    for (number, old) in order.iter().enumerate() {
        numbers[*old] = Some(number as u32);
    }
    numbers
}

/// Transfers labels from the coarse lattice to the fine one: returns the part of each fine vertex, and the patch of
/// each part. Regions that no coarse part reaches become parts of their own, unless they are too small to be cut, which
/// are left out: such a part would have no outline. Vertices left out on the coarse lattice stay so.
fn transfer_labels(
    surface: &Heightfield,
    patches: &Patches,
    coarse: &Coarse,
    rough: &Assembled,
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
        let left_out = |k: &usize| of[*k] == NO_PATCH && !coarse.surface.heights()[*k].is_nan();
        match around.iter().find(own) {
            Some(k) => labels[i] = of[*k],
            None => open[i] = !around.iter().any(left_out),
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
fn placed(parts: &Parts, part: usize, rough: &Assembled) -> Result<Option<FlatPatch>> {
    let Some(leaf) = rough.net.leaves[part].as_ref() else {
        return Ok(None);
    };
    let motion = rough.arrangement.layout.motions[part];
    let start = |[row, col]: [usize; 2]| {
        let [one, other] = parents(row, col).map(|(row, col)| {
            let vertex = [usize::try_from(row).ok()?, usize::try_from(col).ok()?];
            let place = leaf.place(vertex);
            (!place.re.is_nan()).then_some(place)
        });
        Some(motion.of(0.5 * (one? + other?)))
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
fn fold_alike(
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pattern::PatternOptions;
    use crate::pattern::heightfield::{DIRECT_OUTLINE_DETAIL, find_sheets};
    use crate::shape::patches::PatchOptions;

    /// Sheets of a folded card on its own lattice, decided on the coarse one, and the number of vertices left out. Some
    /// vertices of its border, on no coarse lattice, are drawn down.
    fn torn_card(columns: &[usize]) -> (Vec<Vec<u32>>, usize) {
        let lattice = Lattice::new(140, 160, 1.0).unwrap();
        let torn: Vec<[f64; 2]> = columns
            .iter()
            .map(|col| lattice.position(0, *col))
            .collect();
        let surface = Heightfield::from_fn(lattice, |x, y| {
            let depth = |[p, q]: &[f64; 2]| (1.0 - (x - p).hypot(y - q)).max(0.0);
            -0.5 * (x - 60.3).abs() - 12.0 * torn.iter().map(depth).sum::<f64>()
        });
        let surface = surface.unwrap();
        let patches = Patches::new(&surface, &PatchOptions::default()).unwrap();
        let options = PatternOptions::default().max_strain(0.003);
        let coarse = Coarse::new(&surface, &patches).unwrap().unwrap();
        let rough = find_sheets(
            &coarse.surface,
            &coarse.patches,
            &options,
            DIRECT_OUTLINE_DETAIL,
        )
        .unwrap();
        let parts = Parts::none(&surface, &options);
        let found = refine_sheets(&surface, &patches, &coarse, &rough, parts, true).unwrap();
        let found = found.unwrap_or_else(|reason| panic!("{reason}"));
        (found.arrangement.sheets, found.parts.left_out())
    }

    #[test]
    fn what_only_the_fine_lattice_shows_torn_is_left_out_there() {
        let (sheets, out) = torn_card(&[81]);
        assert_eq!(sheets, [[0, 1]]);
        assert!((1..=16).contains(&out), "{out}");
    }

    #[test]
    fn a_part_that_is_invalid_on_the_fine_lattice_alone_is_mended_and_joined_again() {
        // More torn vertices than may be left out of a sheet whose other parts are valid.
        let (sheets, out) = torn_card(&[81, 91, 101, 111, 121, 131]);
        assert_eq!(sheets.len(), 1, "{sheets:?}");
        assert!(out <= 140 * 160 / 50, "{out}");
    }
}

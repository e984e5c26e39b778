//! Sheets that were found on a coarse lattice, laid flat and drawn on the fine one.
//!
//! Where a surface has to be cut depends on its shape and not on its sampling. Surfaces with many vertices are
//! therefore cut and joined on every second or every fourth vertex, where trial cuts and trial joins cost less.
//! Then each vertex of the fine lattice gets the part of the nearest coarse vertex, the positions on the coarse
//! lattice are the initial guess of those on the fine one, and the outlines are computed from creases and triangles
//! of the fine lattice.

use super::assembly::{AssembledSheets, FlatteningOutcome, settle};
use super::coarse::Coarse;
use super::labels::Labels;
use super::layout::Arrangement;
use super::outline::Layout;
use super::parts::Parts;
use super::seam_graph::SeamGraph;
use super::sew::close_cuts;
use super::transfer::{fold_alike, placed, transfer_labels};
use crate::error::{Error, Result};
use crate::heights::heightfield::Heightfield;
use crate::progress;
use crate::shape::patches::Patches;

/// Lays the sheets that were found on a coarse lattice flat on the fine one. The inner error holds the reason why a
/// sheet is invalid on the fine lattice. Unless `is_finest`, parts that are invalid alone are kept: the finer lattices
/// decide whether they have to be mended, and a part that is cut on several lattices falls into parts too small to cut.
pub(super) fn refine_sheets(
    surface: &Heightfield,
    patches: &Patches,
    coarse: &Coarse,
    rough: &AssembledSheets,
    parts: Parts,
    is_finest: bool,
) -> Result<std::result::Result<AssembledSheets, String>> {
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
    let known = rough.net.flat_patches.len();
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
    progress::part(0.3, || parts.lay_flat_trimmed(&single))?;
    // A part that shares its sheet with others starts from its position on the coarse lattice.
    for part in (0..known).filter(|part| !alone[*part]) {
        let flat_patch = match placed(&parts, part, rough)? {
            None => parts.flat_patch(&(part as u32))?,
            found => found,
        };
        parts.flat_patches[part] = flat_patch;
    }
    let mut sheets = rough.arrangement.sheets.clone();
    sheets.extend((known..parts.flat_patches.len()).map(|part| vec![part as u32]));
    let decided = rough.net.decided;
    // The net and layout that say which seams are folds: those of the coarse lattice first, then the last ones here.
    let mut last: Option<(SeamGraph, Layout)> = None;
    let mut is_recut = vec![false; parts.flat_patches.len()];
    loop {
        // Sorted by their areas, as all patches are.
        let (found, order) = patches.divided(&parts.surface, parts.labels.of.clone())?;
        parts.renumber(&found, &order);
        let numbers = inverse(&order, is_recut.len());
        is_recut = order.iter().map(|old| is_recut[*old]).collect();
        for members in &mut sheets {
            let renumbered = members.iter().filter_map(|part| numbers[*part as usize]);
            *members = renumbered
                .filter(|part| parts.flat_patches[*part as usize].is_some())
                .collect();
            members.sort_unstable();
        }
        sheets.retain(|members| !members.is_empty());
        let flat_patches = std::mem::take(&mut parts.flat_patches);
        let mut net = SeamGraph::new(&parts.surface, &parts.labels, flat_patches, decided)?;
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
        let settled = progress::part(0.9, || settle(&parts, &mut net, &mut arrangement))?;
        match settled {
            FlatteningOutcome::Opened(wrong) if wrong.is_empty() || !is_finest => {
                if is_recut.contains(&true) {
                    let is_wanted = |part: u32| is_recut[part as usize];
                    let limit = parts.options.max_strain;
                    close_cuts(&mut net, &mut arrangement, limit, is_wanted)?;
                }
                return Ok(Ok(AssembledSheets {
                    parts,
                    patches: found,
                    net,
                    arrangement,
                }));
            }
            FlatteningOutcome::Opened(wrong) => {
                parts.flat_patches = std::mem::take(&mut net.flat_patches);
                for (part, reason) in wrong {
                    let first = parts.flat_patches.len() as u32;
                    match parts.cut_alone(part) {
                        Ok(true) => {}
                        Ok(false) | Err(Error::NotFlat { .. }) => return Ok(Err(reason)),
                        Err(other) => return Err(other),
                    }
                    is_recut[part as usize] = true;
                    is_recut.resize(parts.flat_patches.len(), true);
                    let added = first..parts.flat_patches.len() as u32;
                    arrangement.sheets.extend(added.map(|part| vec![part]));
                }
            }
            FlatteningOutcome::Removable(part, removed) => {
                parts.flat_patches = std::mem::take(&mut net.flat_patches);
                parts.leave_out_vertices(part, removed)?;
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lattice::hexagonal::Lattice;
    use crate::pattern::PatternOptions;
    use crate::pattern::heightfield::{DIRECT_OUTLINE_DETAIL, find_sheets};
    use crate::shape::patches::PatchOptions;
    use crate::unroll::flat_triangle::Point;

    /// A folded card on its own lattice, cut as decided on the coarse one. Some vertices of its border, on no coarse
    /// lattice, are drawn down.
    fn torn_card(columns: &[usize]) -> AssembledSheets {
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
        found.unwrap_or_else(|reason| panic!("{reason}"))
    }

    #[test]
    fn what_only_the_fine_lattice_shows_torn_is_left_out_there() {
        let card = torn_card(&[81]);
        assert_eq!(card.arrangement.sheets, [[0, 1]]);
        let out = card.parts.left_out();
        assert!((1..=16).contains(&out), "{out}");
    }

    #[test]
    fn a_sheet_that_has_not_changed_is_not_laid_flat_again() {
        let mut card = torn_card(&[]);
        let places = |card: &AssembledSheets| -> Vec<Vec<Point>> {
            let all = card.net.flat_patches.iter().flatten();
            all.map(|flat_patch| flat_patch.places().to_vec()).collect()
        };
        let before = places(&card);
        settle(&card.parts, &mut card.net, &mut card.arrangement).unwrap();
        assert_eq!(places(&card), before);
    }

    #[test]
    fn a_part_that_is_invalid_on_the_fine_lattice_alone_is_mended_and_joined_again() {
        // More torn vertices than may be left out of a sheet whose other parts are valid.
        let card = torn_card(&[81, 91, 101, 111, 121, 131]);
        let sheets = &card.arrangement.sheets;
        assert_eq!(sheets.len(), 1, "{sheets:?}");
        let out = card.parts.left_out();
        assert!(out <= 140 * 160 / 50, "{out}");
    }
}

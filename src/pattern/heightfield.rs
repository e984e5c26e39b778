//! Patterns of heightfields.

use super::assembly::{AssembledSheets, Assembly, assemble_sheets, draw_sheets};
use super::coarse::Coarse;
use super::fine::refine_sheets;
use super::options::PatternOptions;
use super::parts::Parts;
use super::sheets::Pattern;
use crate::error::{Error, Result, positive};
use crate::heights::heightfield::Heightfield;
use crate::progress;
use crate::shape::patches::Patches;

/// Strain limits on a coarse lattice, as shares of the limit on the fine one, tried in this order: the next one is
/// used if sheets are invalid on the fine lattice.
const COARSE_STRAIN_SHARES: [f64; 2] = [0.9, 0.7];

/// Size of the smallest detail of sheets' outlines, in lattice spacings, where sheets are cut without a coarser
/// lattice. With a larger value loops are cut off whose removal makes the two sides of a joint differ in length.
pub(super) const DIRECT_OUTLINE_DETAIL: f64 = 0.4;

/// Cuts a surface into flat sheets; the first sheet is the one with the largest patch.
///
/// Every sheet has a simple outline and has a strain of at most [`PatternOptions::max_strain`]. A patch with a
/// larger strain is cut in two where its strain is largest, repeatedly, and its parts are joined again as far as
/// their sides fit: a cone gets one slit, a dome several. A crease whose sides fit along a part of its length is a
/// fold there and a cut elsewhere. Then cuts are closed again, whole or in part, where strain and outlines stay
/// valid. A part that cannot be cut further and that lies flat with none of its neighbours is left out, and so
/// is a sheet that is a crumb, less than a thousandth of the area ([`Pattern::missing`]).
///
/// Surfaces of more than twenty thousand vertices are cut on the lattice of twice the spacing, recursively; their
/// own lattice then costs one unrolling, and a cut of each part that is invalid there alone. The lattice on which the surface is cut costs one unrolling of each part,
/// two or three more of parts that are cut again, and up to 800 steps of `O(vertices)` for closing cuts.
///
/// # Errors
/// [`Error::Shape`] or [`Error::Mismatch`] if the patches belong to another surface, [`Error::Option`] for a seam gap or
/// a strain that is not positive and finite, [`Error::NotFlat`] if more than a tenth of the surface would be left out, and the errors
/// of [`unroll`](crate::unroll::unroll).
pub fn pattern(
    surface: &Heightfield,
    patches: &Patches,
    options: &PatternOptions,
) -> Result<Pattern> {
    patches.check_of(surface)?;
    positive("maxSeamGap", options.max_seam_gap)?;
    positive("maxStrain", options.max_strain)?;
    positive("tolerance", options.unrolling.tolerance)?;
    let found = progress::part(0.9, || {
        find_sheets(surface, patches, options, DIRECT_OUTLINE_DETAIL)
    })?;
    draw_sheets(surface, &found)
}

/// Finds the sheets of a surface, on a coarse lattice first if it has many vertices.
pub(super) fn find_sheets(
    surface: &Heightfield,
    patches: &Patches,
    options: &PatternOptions,
    finest: f64,
) -> Result<AssembledSheets> {
    find_sheets_at(surface, patches, options, finest, true)
}

/// Finds the sheets of a surface on its own lattice, or on a coarser one of the same surface.
fn find_sheets_at(
    surface: &Heightfield,
    patches: &Patches,
    options: &PatternOptions,
    mut finest: f64,
    is_finest: bool,
) -> Result<AssembledSheets> {
    if let Some(coarse) = Coarse::new(surface, patches)? {
        finest = 1.0;
        for margin in COARSE_STRAIN_SHARES {
            let stricter = options.max_strain(margin * options.max_strain);
            // The finer lattice has four times the vertices, but its sheets are found already.
            let rough = progress::part(0.5, || {
                find_sheets_at(&coarse.surface, &coarse.patches, &stricter, finest, false)
            });
            let rough = match rough {
                Err(Error::NotFlat { .. }) => break,
                other => other?,
            };
            let parts = Parts::none(surface, options);
            let refined = progress::part(0.9, || {
                refine_sheets(surface, patches, &coarse, &rough, parts, is_finest)
            });
            if let Ok(found) = refined? {
                return Ok(found);
            }
        }
    }
    loop {
        match cut_and_join(surface, patches, options, finest) {
            Err(Error::NotFlat { .. }) if finest < 1.0 => finest = 1.0,
            other => return other,
        }
    }
}

/// Cuts and joins parts on one lattice until every sheet is valid.
fn cut_and_join(
    surface: &Heightfield,
    patches: &Patches,
    options: &PatternOptions,
    finest: f64,
) -> Result<AssembledSheets> {
    let mut parts = progress::part(0.3, || Parts::new(surface, patches, options))?;
    parts.finest = finest;
    progress::part(0.6, || parts.cut_strained())?;
    progress::part(0.65, || parts.merge_strained_small_parts())?;
    // Parts of invalid sheets are cut further; parts that are too small for that are left out.
    let mut rounds = 0u32;
    loop {
        // Most surfaces take one round or two.
        let end = 1.0 - 0.1 / f64::from(rounds + 1);
        let assembly = progress::part(end, || assemble_sheets(parts, patches, options))?;
        let faults = match assembly {
            Assembly::Whole(whole) => return Ok(*whole),
            Assembly::Cut(again, faults) => {
                parts = *again;
                faults
            }
        };
        rounds += 1;
        let mut small = Vec::new();
        for (part, reason) in faults {
            if !progress::part(end, || parts.cut(part))? {
                small.push((part, reason));
            }
        }
        progress::part(end, || parts.cut_strained())?;
        // Go from the last part to the first, because removing a part changes the numbers of later ones.
        small.sort_unstable();
        for (part, reason) in small.into_iter().rev() {
            if !parts.leave_out(part)? {
                return Err(parts.refused(part, reason));
            }
        }
    }
}

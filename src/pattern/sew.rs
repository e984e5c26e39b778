//! Cuts closed again, as far as every sheet stays what it has to be: what is cut to make parts flat is
//! more than has to stay open.

use std::collections::VecDeque;

use super::check::{SheetMesh, are_close, strain_along, strains};
use super::fault::{SHEET_RELAXATION, fault, folds_of};
use super::layout::{Arrangement, fits, longest_first, motion_to_join, seam_gap};
use super::outline::Layout;
use super::seam_graph::{NEGLIGIBLE_GAP_LENGTHS, SeamGraph};
use crate::error::Result;
use crate::math::planar::polyline_length;
use crate::progress;
use crate::unroll::arap_mesh::StoppingCriteria;
use crate::unroll::flat_triangle::Point;

/// Maximum strain of a sheet after a crease was closed, as a share of the limit, unless the sheets on either side
/// of the crease had more strain before. `benches/patterns.md` has what others give.
pub(super) const CREASE_STRAIN_SHARE: f64 = 0.1;

/// Maximum strain of the triangles along a closed seam, as a multiple of the limit for the sheet.
/// `benches/patterns.md` has what others give.
pub(super) const MAX_SEAM_STRAIN_FACTOR: f64 = 2.0;

/// Minimum number of nodes of each half of a seam that is divided because it cannot be closed as a whole.
/// `benches/patterns.md` has what others give.
pub(super) const MIN_HALVED_SEAM_NODES: usize = 12;

/// Maximum number of solver iterations of all trials to close cuts, summed over the vertices of the sheet in each
/// trial, per vertex of the pattern.
const STEP_BUDGET_PER_VERTEX: usize = 800;

/// Maximum squared gap of a cut, as a multiple of the area times the squared strain that its sheet may have, at which it
/// is tried to close the cut: where two sides are pulled together by a distance, a strip about as wide is strained. Of the
/// cuts closed on the scans of `benches/patterns.md` the largest ratio was 0.96.
pub(super) const MAX_CLOSED_GAP_RATIO: f64 = 2.0;

/// Maximum depth, in lattice spacings, by which two sheets may reach into each other where the cut between them is tried to
/// be closed: laying them flat together moves their outlines by less. Of the cuts closed on the scans of
/// `benches/patterns.md` the largest depth was 1.44.
pub(super) const MAX_CLOSED_OVERLAP_SPACINGS: f64 = 2.0;

/// Stopping criteria for the first steps of a trial, which show whether it is worth more.
pub(super) const TRIAL_RELAXATION: StoppingCriteria = StoppingCriteria {
    relative_tolerance: 0.01,
    max_steps: 6,
    ..SHEET_RELAXATION
};

/// Factor of the limits for strains and gaps after the first steps of a trial, above which it is abandoned. Later
/// steps hardly lower the strain of a sheet; with 1.02 the scan `range` of `benches/patterns.md` has one sheet more.
pub(super) const TRIAL_LIMIT_FACTOR: f64 = 1.05;

/// Closes cuts again where the sheets stay valid, the longest first; a cut that cannot be closed as a whole is
/// halved, and each half is tried. Only cuts of the wanted parts are tried.
pub(super) fn close_cuts(
    net: &mut SeamGraph,
    arrangement: &mut Arrangement,
    limit: f64,
    is_wanted: impl Fn(u32) -> bool,
) -> Result<()> {
    let open = |seam: &usize| {
        let wanted = net.seams[*seam].patches.iter().any(|part| is_wanted(*part));
        wanted && !arrangement.layout.folded[*seam]
    };
    let mut pending: VecDeque<usize> = longest_first(net).into_iter().filter(open).collect();
    // Cuts inside of patches are closed before creases.
    pending
        .make_contiguous()
        .sort_by_key(|seam| !net.seams[*seam].smooth);
    let vertices: usize = net
        .flat_patches
        .iter()
        .flatten()
        .map(|flat_patch| flat_patch.places().len())
        .sum();
    let mut budget = STEP_BUDGET_PER_VERTEX * vertices;
    while let Some(seam) = pending.pop_front() {
        if budget == 0 {
            break;
        }
        let end = 1.0 - budget as f64 / (STEP_BUDGET_PER_VERTEX * vertices) as f64;
        let is_closed = arrangement.layout.folded[seam]
            || progress::part(end, || {
                close_cut(net, arrangement, seam, limit, &mut budget)
            })?;
        if is_closed {
            continue;
        }
        let nodes = net.seams[seam].nodes.len();
        if nodes < 2 * MIN_HALVED_SEAM_NODES || !net.seams[seam].smooth {
            continue;
        }
        let other = net.divide(seam, nodes / 2);
        arrangement.layout.folded.push(false);
        // Insert both halves in the order of lengths.
        for part in [seam, other] {
            let long = |seam: usize| polyline_length(&net.seams[seam].sides[0]);
            let key = |seam: usize| (net.seams[seam].smooth, long(seam));
            let before = |next: &usize| key(*next) >= key(part);
            let place = pending.iter().position(|next| !before(next));
            pending.insert(place.unwrap_or(pending.len()), part);
        }
    }
    close_narrow_gaps(net, arrangement, limit);
    net.join_parts(&mut arrangement.layout.folded);
    Ok(())
}

/// Closes those parts of cuts whose two sides are closer than the lattice's resolution
/// ([`NEGLIGIBLE_GAP_LENGTHS`]).
fn close_narrow_gaps(net: &mut SeamGraph, arrangement: &mut Arrangement, limit: f64) {
    for members in &arrangement.sheets {
        let inside = |seam: &usize| {
            let patches = net.seams[*seam].patches;
            let own = patches.iter().all(|p| members.binary_search(p).is_ok());
            own && !arrangement.layout.folded[*seam] && !net.is_torn(*seam)
        };
        let open: Vec<usize> = (0..net.seams.len()).filter(inside).collect();
        let layout = &mut arrangement.layout;
        let mut closed = Vec::new();
        for seam in open {
            let [one, other] = [0, 1].map(|side| layout.side(net, seam, side));
            let pairs = one.iter().zip(&other);
            let near: Vec<bool> = pairs
                .map(|(p, q)| (p - q).norm() <= NEGLIGIBLE_GAP_LENGTHS * net.spacing)
                .collect();
            let parts = net.divide_where(seam, &near);
            layout.folded.resize(net.seams.len(), false);
            for (part, near) in parts {
                layout.folded[part] = near;
                closed.extend(near.then_some(part));
            }
        }
        if !closed.is_empty() && fault(net, layout, members, limit).is_some() {
            closed
                .into_iter()
                .for_each(|seam| layout.folded[seam] = false);
        }
    }
}

/// Tries to close one cut, that is to join its two sides. Returns whether the sheet is valid then; if not, the former
/// layout is restored.
fn close_cut(
    net: &mut SeamGraph,
    arrangement: &mut Arrangement,
    seam: usize,
    limit: f64,
    budget: &mut usize,
) -> Result<bool> {
    let sheet_of = |patch: u32| {
        let own = |members: &Vec<u32>| members.binary_search(&patch).is_ok();
        arrangement.sheets.iter().position(own)
    };
    let [Some(a), Some(b)] = net.seams[seam].patches.map(sheet_of) else {
        return Ok(false);
    };
    let mut members = arrangement.sheets[a].clone();
    let mut layout = arrangement.layout.clone();
    if a != b {
        let motion = motion_to_join(net, &layout, seam);
        layout.carry(&arrangement.sheets[b], &motion);
        let sheets = [a, b].map(|sheet| &arrangement.sheets[sheet][..]);
        let depth = MAX_CLOSED_OVERLAP_SPACINGS * net.spacing;
        if layout.reach_into_each_other(net, sheets, depth) {
            return Ok(false);
        }
        members.extend(&arrangement.sheets[b]);
        members.sort_unstable();
    }
    layout.folded[seam] = true;
    // Also close the other seams whose sides coincide after the motion.
    for other in 0..net.seams.len() {
        let own = || {
            net.seams[other]
                .patches
                .iter()
                .all(|p| members.binary_search(p).is_ok())
        };
        if !layout.folded[other] && !net.is_torn(other) && own() && fits(net, &layout, other, 0.0) {
            layout.folded[other] = true;
        }
    }
    let ties = folds_of(net, &layout, &members);
    let before: Vec<(u32, Vec<Point>)> = (members.iter())
        .filter_map(|p| {
            Some((
                *p,
                net.flat_patches[*p as usize].as_ref()?.places().to_vec(),
            ))
        })
        .collect();
    // A crease is closed only if that adds hardly any strain: a crease whose two sides fit only with strain cannot be
    // folded.
    let most = match net.seams[seam].smooth {
        true => limit,
        false => {
            let sheets = [a, b].map(|sheet| strains(net, &arrangement.sheets[sheet]).0.rms());
            (CREASE_STRAIN_SHARE * limit)
                .max(sheets[0])
                .max(sheets[1])
                .min(limit)
        }
    };
    let joined = !are_close(net, &layout, &ties);
    let closing_energy = seam_gap(net, &layout, seam).powi(2);
    if joined && closing_energy > MAX_CLOSED_GAP_RATIO * most * most * strains(net, &members).0.area
    {
        return Ok(false);
    }
    // Whether the sheet is valid with limits that are larger by a factor.
    let is_valid = |net: &SeamGraph, layout: &Layout, factor: f64| {
        let most_gap = factor * NEGLIGIBLE_GAP_LENGTHS * net.spacing;
        // A large strain in a small place hardly changes the strain of the whole sheet, so it is checked separately.
        strain_along(net, seam) <= factor * MAX_SEAM_STRAIN_FACTOR * limit
            && ties
                .iter()
                .all(|seam| seam_gap(net, layout, *seam) <= most_gap)
            && fault(net, layout, &members, factor * most).is_none()
    };
    let mut is_closed = !joined && is_valid(net, &layout, 1.0);
    if joined {
        let mut sheet = SheetMesh::new(net, &layout, &members, &ties)?;
        // Most trials fail, and a few steps show that.
        for until in [TRIAL_RELAXATION, SHEET_RELAXATION] {
            let work = sheet.relax(net, &mut layout, until)?;
            *budget = budget.saturating_sub(work);
            is_closed = is_valid(net, &layout, 1.0);
            if is_closed || !is_valid(net, &layout, TRIAL_LIMIT_FACTOR) {
                break;
            }
        }
    }
    if is_closed {
        arrangement.layout = layout;
        arrangement.sheets[a] = members;
        if a != b {
            arrangement.sheets.swap_remove(b);
        }
        return Ok(true);
    }
    if joined {
        for (patch, places) in before {
            net.set_places(patch, places);
        }
    }
    Ok(false)
}

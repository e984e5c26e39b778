//! Arranges flat patches beside each other on sheets, joining as many seams as fit.

use super::motion::Motion;
use super::outline::Layout;
use super::seam_graph::{NEGLIGIBLE_GAP_LENGTHS, SeamGraph};
use crate::math::planar::polyline_length;

/// Rigid motions of all patches in the plane, and the sheets that the patches are on.
pub(super) struct Arrangement {
    pub layout: Layout,
    /// Numbers of the patches on each sheet, ascending.
    pub sheets: Vec<Vec<u32>>,
}

/// Arranges patches on sheets: for each seam, the longest first, moves the sheet on one side to the other if the two
/// sides of the seam then fit within `gap` times their length and the patches do not overlap. Such a seam becomes a
/// fold.
pub(super) fn arrange_patches(net: &SeamGraph, gap: f64) -> Arrangement {
    let mut layout = Layout::loose(net);
    // The sheet of each patch, and the patches of each sheet.
    let mut of: Vec<usize> = (0..net.flat_patches.len()).collect();
    let mut sheets: Vec<Vec<u32>> = (net.flat_patches.iter().enumerate())
        .map(|(patch, flat_patch)| flat_patch.iter().map(|_| patch as u32).collect())
        .collect();
    let order = longest_first(net);
    for seam in &order {
        let [a, b] = net.seams[*seam].patches.map(|patch| of[patch as usize]);
        if a == b || sheets[a].is_empty() || sheets[b].is_empty() {
            continue;
        }
        let motion = motion_to_join(net, &layout, *seam);
        let mut trial = layout.clone();
        trial.carry(&sheets[b], &motion);
        if !fits(net, &trial, *seam, gap) {
            continue;
        }
        // Other seams between the same two sheets may fit after this motion, such as the last one around a vertex
        // whose angles sum to 2π.
        let mut joint = [&sheets[a][..], &sheets[b]].concat();
        joint.sort_unstable();
        for seam in order.iter().filter(|seam| !layout.folded[**seam]) {
            let own = net.seams[*seam]
                .patches
                .iter()
                .all(|p| [a, b].contains(&of[*p as usize]));
            if own && fits(net, &trial, *seam, gap) {
                trial.folded[*seam] = true;
            }
        }
        if !trial.overlaps(net, &joint) {
            layout = trial;
            for patch in &joint {
                of[*patch as usize] = a.min(b);
            }
            sheets[a.max(b)] = Vec::new();
            sheets[a.min(b)] = joint;
        }
    }
    sheets.retain(|members| !members.is_empty());
    Arrangement { layout, sheets }
}

/// Lists the numbers of the seams whose two sides may be joined, the longest seam first.
pub(super) fn longest_first(net: &SeamGraph) -> Vec<usize> {
    let lengths: Vec<f64> = net
        .seams
        .iter()
        .map(|seam| polyline_length(&seam.sides[0]))
        .collect();
    let whole = |seam: &usize| {
        let nodes = net.seams[*seam].nodes.len();
        nodes > 2 && !net.is_torn(*seam) && lengths[*seam] > 0.0
    };
    let mut order: Vec<usize> = (0..net.seams.len()).filter(whole).collect();
    order.sort_by(|a, b| lengths[*b].total_cmp(&lengths[*a]));
    order
}

/// Computes the rigid motion in the plane that brings the second side of a seam to its first, by least squares.
pub(super) fn motion_to_join(net: &SeamGraph, layout: &Layout, seam: usize) -> Motion {
    let [there, here] = [0, 1].map(|side| layout.side(net, seam, side));
    Motion::between(&here, &there)
}

/// Returns whether the gap of a seam is at most `gap` times the seam's length, or below the lattice's resolution.
pub(super) fn fits(net: &SeamGraph, layout: &Layout, seam: usize, gap: f64) -> bool {
    let most = gap * polyline_length(&net.seams[seam].sides[0]);
    seam_gap(net, layout, seam) <= most.max(NEGLIGIBLE_GAP_LENGTHS * net.spacing)
}

/// Computes the seam gap: the root mean square distance between the two sides of a seam.
pub(super) fn seam_gap(net: &SeamGraph, layout: &Layout, seam: usize) -> f64 {
    let [one, other] = [0, 1].map(|side| layout.side(net, seam, side));
    let squares: f64 = one
        .iter()
        .zip(&other)
        .map(|(p, q)| (p - q).norm_sqr())
        .sum();
    (squares / one.len() as f64).sqrt()
}

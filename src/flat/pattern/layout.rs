//! Patches laid beside each other, as many as fit.

use super::line::length;
use super::net::{Net, Seam};
use super::outline::{Layout, Motion};

pub(super) struct Arrangement {
    pub layout: Layout,
    /// The patches of each sheet, ascending, and its largest gap.
    pub sheets: Vec<(Vec<u32>, f64)>,
}

/// A seam whose sides are further apart in space, in spacings, is a tear.
pub(super) const TORN: f64 = 0.5;

/// A distance that the lattice cannot tell from none, in spacings.
pub(super) const FINE: f64 = 0.25;

/// Makes folds of the seams whose sides fit within a share of their length and that are not `barred`,
/// the longest first.
pub(super) fn arranged(net: &Net, gap: f64, barred: &[bool]) -> Arrangement {
    let mut layout = Layout {
        motions: vec![Motion::NONE; net.leaves.len()],
        folded: vec![false; net.seams.len()],
    };
    let mut sheets: Vec<Option<(Vec<u32>, f64)>> = (net.leaves.iter().enumerate())
        .map(|(patch, leaf)| leaf.as_ref().map(|_| (vec![patch as u32], 0.0)))
        .collect();
    let long = |seam: &Seam| length(&seam.sides[0]);
    let mut order: Vec<usize> = (0..net.seams.len())
        .filter(|seam| {
            let free = !barred[*seam];
            let seam = &net.seams[*seam];
            free && seam.apart <= TORN * net.spacing && long(seam) > 0.0
        })
        .collect();
    order.sort_by(|a, b| long(&net.seams[*b]).total_cmp(&long(&net.seams[*a])));
    let of = |sheets: &[Option<(Vec<u32>, f64)>], patch: u32| {
        let holds = |sheet: &(Vec<u32>, f64)| sheet.0.contains(&patch);
        sheets.iter().position(|s| s.as_ref().is_some_and(holds))
    };
    for seam in &order {
        let [one, other] = net.seams[*seam].patches.map(|patch| of(&sheets, patch));
        let (Some(a), Some(b)) = (one, other) else {
            continue;
        };
        let (Some(fixed), Some(moved)) = (&sheets[a], &sheets[b]) else {
            continue;
        };
        if a == b || net.seams[*seam].nodes.len() < 3 {
            continue;
        }
        let [there, here] = [0, 1].map(|side| layout.side(net, *seam, side));
        let motion = Motion::between(&here, &there);
        let mut trial = layout.clone();
        for patch in &moved.0 {
            let own = &mut trial.motions[*patch as usize];
            *own = own.then(&motion);
        }
        if !fits(net, &trial, *seam, gap) {
            continue;
        }
        // Others may fit as well then: around a vertex with a full turn, the last one does.
        let mut joint = [&fixed.0[..], &moved.0].concat();
        joint.sort_unstable();
        let mut most = fixed.1.max(moved.1);
        for seam in order.iter().filter(|seam| !layout.folded[**seam]) {
            let own = net.seams[*seam].patches.iter().all(|p| joint.contains(p));
            if own && fits(net, &trial, *seam, gap) {
                trial.folded[*seam] = true;
                most = most.max(apart(net, &trial, *seam));
            }
        }
        if !trial.overlaps(net, &joint) {
            layout = trial;
            sheets[a.max(b)] = None;
            sheets[a.min(b)] = Some((joint, most));
        }
    }
    Arrangement {
        layout,
        sheets: sheets.into_iter().flatten().collect(),
    }
}

/// Whether the sides of a seam lie on each other but for a share of its length, or as nearly as the
/// lattice can tell.
fn fits(net: &Net, layout: &Layout, seam: usize, gap: f64) -> bool {
    let most = gap * length(&net.seams[seam].sides[0]);
    apart(net, layout, seam) <= most.max(FINE * net.spacing)
}

/// Root mean square of the distances between the sides of a seam.
pub(super) fn apart(net: &Net, layout: &Layout, seam: usize) -> f64 {
    let [one, other] = [0, 1].map(|side| layout.side(net, seam, side));
    let squares: f64 = one
        .iter()
        .zip(&other)
        .map(|(p, q)| (p - q).norm_sqr())
        .sum();
    (squares / one.len() as f64).sqrt()
}

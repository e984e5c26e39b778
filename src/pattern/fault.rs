//! Faults that make a sheet invalid: strain, flipped triangles, an outline that crosses itself.

use super::check::{crossing, strains};
use super::flat_patch::Strain;
use super::outline::Layout;
use super::seam_graph::SeamGraph;
use super::sheet_lines::lines;
use super::trim::PartFault;
use crate::error::rounded;
use crate::unroll::arap_mesh::StoppingCriteria;
use crate::unroll::flat_triangle::Point;

/// Stopping criteria of the solver that lays the patches of a sheet flat together.
pub(super) const SHEET_RELAXATION: StoppingCriteria = StoppingCriteria {
    tolerance: 1e-8,
    relative_tolerance: 1e-4,
    target_energy: 0.0,
    hopeless_energy: f64::INFINITY,
    max_steps: 25,
};

/// Reason why a sheet is invalid.
pub(super) enum Fault {
    /// The sheet's strain exceeds the limit; holds that strain, and the parts of the sheet that are strained by more
    /// than the limit.
    Strain(f64, Vec<u32>),
    /// Triangles of the sheet are flipped (lie upside down); holds the parts with such triangles.
    Flipped(Vec<u32>),
    /// The sheet's outline crosses itself; holds a point where it does.
    Crossing(Point),
}

impl Fault {
    /// Returns the parts that have this fault, and the fault in the form that
    /// [`removable_vertices`](super::trim::removable_vertices) takes; `None` for an outline that crosses itself,
    /// which belongs to no single part.
    pub(super) fn part_fault(&self, limit: f64) -> Option<(&[u32], PartFault)> {
        match self {
            Fault::Strain(_, parts) => Some((parts, PartFault::Strain(limit))),
            Fault::Flipped(parts) => Some((parts, PartFault::Flipped)),
            Fault::Crossing(_) => None,
        }
    }

    pub(super) fn reason(&self, limit: f64) -> String {
        match self {
            Fault::Strain(strain, _) => format!(
                "its strain would be {} %, more than the limit of {} %",
                rounded(100.0 * strain),
                rounded(100.0 * limit)
            ),
            Fault::Flipped(_) => "triangles of it would lie upside down".into(),
            Fault::Crossing(_) => "its outline would cross itself".into(),
        }
    }
}

/// Lists the numbers of a sheet's seams that are folds.
pub(super) fn folds_of(net: &SeamGraph, layout: &Layout, members: &[u32]) -> Vec<usize> {
    let own = |seam: &usize| layout.folded[*seam] && members.contains(&net.seams[*seam].patches[0]);
    (0..net.seams.len()).filter(own).collect()
}

/// Checks a sheet and returns its first fault: strain above `limit`, flipped triangles, or a self-intersection of
/// its outline, in this order; `None` for a valid sheet.
pub(super) fn fault(
    net: &SeamGraph,
    layout: &Layout,
    members: &[u32],
    limit: f64,
) -> Option<Fault> {
    let (sum, all) = strains(net, members);
    // The third of them with the largest strain, so that few unrollings of the whole sheet are needed.
    let those = |wrong: &dyn Fn(&Strain) -> bool| -> Vec<u32> {
        let mut found: Vec<&(u32, Strain)> = all.iter().filter(|(_, s)| wrong(s)).collect();
        found.sort_by(|a, b| b.1.rms().total_cmp(&a.1.rms()));
        found.truncate(found.len().div_ceil(3));
        found.into_iter().map(|(patch, _)| *patch).collect()
    };
    if sum.rms() > limit {
        return Some(Fault::Strain(sum.rms(), those(&|s| s.rms() > limit)));
    }
    if sum.flipped > 0 {
        return Some(Fault::Flipped(those(&|s| s.flipped > 0)));
    }
    let lines: Vec<Vec<Point>> = (lines(net, layout, members).0.into_iter())
        .map(|runs| {
            let points = runs.into_iter().flat_map(|(_, mut points)| {
                points.pop();
                points
            });
            points.collect()
        })
        .collect();
    crossing(&lines).map(Fault::Crossing)
}

//! Border vertices whose removal makes a part valid: where a surface ends in a steep point, a few vertices hold nearly all
//! strain or lie upside down however the part is cut.

use super::flat_patch::FlatPatch;
use super::labels::{Labels, connected_groups};
use crate::lattice::hexagonal::{Lattice, NEIGHBOUR_DIRECTIONS};
use rustc_hash::FxHashMap;

/// Maximum number of border vertices that are removed from a part, as a share of the part's vertices.
pub(super) const MAX_REMOVED_SHARE: f64 = 0.002;

/// Maximum strain of a part after border vertices were removed, as a share of the strain limit.
const TRIMMED_STRAIN_SHARE: f64 = 0.5;

/// Fault of a part that the removal of a few border vertices has to mend.
#[derive(Debug, Clone, Copy)]
pub(super) enum PartFault {
    /// The part's strain is above the limit, which this value holds.
    Strain(f64),
    /// Triangles of the part are flipped (lie upside down in the layout).
    Flipped,
}

/// Finds the few border vertices of a part whose removal is sure to mend its fault; `None` if they are more than `most`
/// allows for the number of the part's vertices, if they are not at the border, or if the part would not stay connected.
pub(super) fn removable_vertices(
    lattice: &Lattice,
    labels: &Labels,
    part: u32,
    flat_patch: &FlatPatch,
    part_fault: PartFault,
    most: impl Fn(usize) -> usize,
) -> Option<Vec<usize>> {
    let vertex_strain_energy = flat_patch.vertex_strain_energy(lattice);
    let most = most(vertex_strain_energy.len());
    let removed: FxHashMap<usize, ()> = match part_fault {
        PartFault::Strain(limit) => heaviest(
            &vertex_strain_energy,
            TRIMMED_STRAIN_SHARE * limit / flat_patch.strain().rms(),
        ),
        PartFault::Flipped => flat_patch.flipped(lattice),
    }
    .into_iter()
    .map(|i| (i, ()))
    .collect();
    if removed.is_empty() || removed.len() > most {
        return None;
    }
    let together = |inside: &dyn Fn(usize) -> bool| {
        let members = vertex_strain_energy
            .iter()
            .map(|(i, _)| *i)
            .filter(|i| inside(*i));
        connected_groups(lattice, members, |_, _| true)
    };
    let whole = together(&|i| !removed.contains_key(&i)).len() == 1;
    let is_outermost = |i: usize| {
        let own = lattice.around(i).filter(|k| labels.of[*k] == part);
        own.count() < NEIGHBOUR_DIRECTIONS.len()
    };
    let removed = together(&|i| removed.contains_key(&i));
    let at_border = |group: &Vec<usize>| group.iter().any(|i| is_outermost(*i));
    (whole && removed.iter().all(at_border)).then(|| removed.concat())
}

/// Finds the smallest set of vertices without which the sum of squared strains falls to a given share of the whole,
/// from each vertex's contribution to that sum (`vertex_strain_energy`).
fn heaviest(vertex_strain_energy: &[(usize, f64)], share: f64) -> Vec<usize> {
    let mut sorted = vertex_strain_energy.to_vec();
    sorted.sort_by(|a, b| b.1.total_cmp(&a.1));
    let all: f64 = sorted.iter().map(|(_, square)| square).sum();
    let mut left = all;
    let heavy = sorted.iter().take_while(|(_, square)| {
        let wanted = left > all * share.powi(2);
        left -= square;
        wanted
    });
    heavy.map(|(i, _)| *i).collect()
}

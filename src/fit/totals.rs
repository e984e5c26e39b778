//! Totals over all components: energies, dual bounds and work.

use super::admm::incumbent::Incumbent;
use super::report::{LevelReport, relative_gap};

/// Sums of energies, dual bounds and work over the components of a surface.
#[derive(Default)]
pub(super) struct Totals {
    pub fidelity: f64,
    pub nuclear_norm: f64,
    pub dual_bound: f64,
    pub rounding: f64,
    pub iterations: usize,
    pub cg_iterations: usize,
}

impl Totals {
    /// Adds the energies and the dual bound of a component's incumbent, times a share.
    pub(super) fn add(&mut self, incumbent: &Incumbent, share: f64) {
        self.fidelity += share * incumbent.fidelity;
        self.nuclear_norm += share * incumbent.nuclear_norm;
        self.dual_bound += share * incumbent.dual_bound;
        self.rounding += share * incumbent.rounding;
    }

    pub(super) fn add_work(&mut self, levels: &[LevelReport]) {
        self.iterations += levels.iter().map(|level| level.iterations).sum::<usize>();
        self.cg_iterations += levels
            .iter()
            .map(|level| level.cg_iterations)
            .sum::<usize>();
    }

    pub(super) fn objective(&self) -> f64 {
        self.fidelity + self.nuclear_norm
    }

    pub(super) fn gap(&self) -> Option<f64> {
        relative_gap(self.objective(), self.dual_bound, self.rounding)
    }
}

/// Adds the counts of vertices and iterations of one component's levels, `part`, to those in `levels` for lattices of the
/// same spacing.
pub(super) fn add_levels(levels: &mut Vec<LevelReport>, part: &[LevelReport]) {
    let missing = part.len().saturating_sub(levels.len());
    levels.splice(0..0, part[..missing].iter().copied());
    let first = levels.len() - part.len();
    for (i, (level, more)) in levels[first..].iter_mut().zip(part).enumerate() {
        if i >= missing {
            level.interior += more.interior;
            level.iterations += more.iterations;
            level.cg_iterations += more.cg_iterations;
        }
    }
}

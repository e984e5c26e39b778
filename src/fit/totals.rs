//! The figures of all parts together.

use super::admm::best::Best;
use super::report::{LevelReport, relative_gap};

/// Sums over the parts.
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
    pub(super) fn add(&mut self, best: &Best, share: f64) {
        self.fidelity += share * best.fidelity;
        self.nuclear_norm += share * best.nuclear_norm;
        self.dual_bound += share * best.dual_bound;
        self.rounding += share * best.rounding;
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

/// Adds the work on one part's lattices to that on the others' of the same spacing.
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

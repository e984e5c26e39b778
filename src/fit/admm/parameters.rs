//! Parameters of ADMM on one level of the multigrid hierarchy.

use super::certificate::Certificate;
use crate::fit::options::{Energy, Options, Schedule};

/// Which schedule ADMM follows on a level, and when it stops there.
#[derive(Debug, Clone, Copy)]
pub(crate) struct AdmmParameters {
    pub(super) schedule: Schedule,
    /// Requested relative duality gap.
    pub(super) gap: f64,
    pub(super) max_iterations: usize,
    /// Whether there are finer levels.
    pub(super) is_coarse: bool,
    /// Whether z-steps are preconditioned by a multigrid V-cycle.
    pub(super) has_v_cycles: bool,
    /// Whether the weights are those of the current surface's normals ([`Energy::SecondForm`]).
    pub(super) follows_normals: bool,
}

/// Minimum number of interior vertices of a coarse level: a smaller one saves nothing.
const MIN_COARSE_VERTICES: usize = 500;

/// Requested gap of coarse levels, unless a larger one is asked for: their lattice differs from the fine one
/// by more than that.
const MIN_COARSE_GAP: f64 = 0.01;

/// Maximum number of iterations of a coarse level (`benches/choices.md`): more would save the finer one less
/// than they cost.
const MAX_COARSE_ITERATIONS: usize = 200;

/// Ratio of a warm start's own gap to the square root of the requested one above which coarse levels are a
/// better start (`benches/choices.md`).
const WARM_START_MAX_GAP_FACTOR: f64 = 3.0;

impl AdmmParameters {
    /// The parameters on the finest level.
    pub(crate) fn new(options: &Options) -> Self {
        AdmmParameters {
            schedule: options.schedule,
            gap: options.gap_or_default(),
            max_iterations: options.max_iterations,
            is_coarse: false,
            has_v_cycles: true,
            follows_normals: options.energy_or_default() == Energy::SecondForm,
        }
    }

    /// The parameters for z-steps by conjugate gradients without a V-cycle.
    pub(crate) fn without_v_cycles(self) -> Self {
        AdmmParameters {
            has_v_cycles: false,
            ..self
        }
    }

    /// The parameters on a coarse level or on the finest one, after a number of iterations on others.
    pub(crate) fn on_level(&self, is_coarse: bool, iterations_done: usize) -> Self {
        let left = self.max_iterations.saturating_sub(iterations_done);
        let (gap, max_iterations) = match is_coarse {
            true => (
                self.gap.max(MIN_COARSE_GAP),
                left.min(MAX_COARSE_ITERATIONS),
            ),
            false => (self.gap, left),
        };
        AdmmParameters {
            gap,
            max_iterations,
            is_coarse,
            ..*self
        }
    }

    /// Whether a lattice with this number of interior vertices is worth a coarse level of its own.
    pub(crate) fn wants_level(&self, interior: usize) -> bool {
        self.schedule == Schedule::Default && interior >= MIN_COARSE_VERTICES
    }

    /// Whether a warm start is so far from the optimum that coarse levels are a better start.
    pub(crate) fn is_far(&self, start: &Certificate) -> bool {
        let objective = start.objective();
        let gap = (objective - start.dual_bound) / objective;
        gap.is_nan() || gap > WARM_START_MAX_GAP_FACTOR * self.gap.sqrt()
    }

    /// Whether this iteration is the last one allowed.
    pub(super) fn is_last(&self, iteration: usize) -> bool {
        iteration >= self.max_iterations
    }
}

//! Detection of ADMM iterates that diverge, as they may where z-steps are solved too inexactly.

/// Factor by which the objective must grow from one check to the next, and exceed the objective of the input heights,
/// for ADMM's iterates to count as divergent (`benches/choices.md`, One constant at a time).
const DIVERGENCE_FACTOR: f64 = 10.0;

/// Maximum number of restarts of ADMM after a divergence; each restart doubles the conjugate-gradient iterations of a
/// z-step, so that the last ones solve it nearly exactly.
const MAX_DIVERGENCE_RESTARTS: u32 = 6;

/// Detector of divergence: the objective at the last check, and the number of restarts so far.
#[derive(Debug, Clone)]
pub(super) struct DivergenceGuard {
    last_objective: f64,
    restarts: u32,
}

impl DivergenceGuard {
    /// Makes the detector for a solve that has not been checked yet.
    pub(super) fn new() -> Self {
        DivergenceGuard {
            last_objective: f64::MAX,
            restarts: 0,
        }
    }

    /// Forgets the objective of the last check, because the next one belongs to another energy or surface.
    pub(super) fn forget_objective(&mut self) {
        self.last_objective = f64::MAX;
    }

    /// Returns whether ADMM's iterates diverge, by the objective and the dual residual of a check; `input_objective`
    /// computes the objective of the input heights.
    pub(super) fn is_divergent(
        &mut self,
        objective: f64,
        dual_residual: f64,
        input_objective: impl FnOnce() -> f64,
    ) -> bool {
        let last = std::mem::replace(&mut self.last_objective, objective);
        let is_bounded = objective <= DIVERGENCE_FACTOR * last
            || objective <= DIVERGENCE_FACTOR * input_objective();
        !(is_bounded && dual_residual.is_finite())
    }

    /// Counts a restart after a divergence; returns `false` if there have been too many.
    pub(super) fn restart(&mut self) -> bool {
        self.forget_objective();
        self.restarts += 1;
        self.restarts <= MAX_DIVERGENCE_RESTARTS
    }

    /// Returns whether ADMM was restarted after a divergence.
    pub(super) fn has_restarted(&self) -> bool {
        self.restarts > 0
    }

    /// Factor by which the maximum number of conjugate-gradient iterations of a z-step is multiplied: 2 to the power of
    /// the number of restarts.
    pub(super) fn accuracy_factor(&self) -> usize {
        1 << self.restarts
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn growth_beyond_the_input_is_divergence_and_each_restart_doubles_the_work() {
        let mut guard = DivergenceGuard::new();
        // Any first objective is within the bounds, whatever the input's.
        assert!(!guard.is_divergent(1e9, 1.0, || 1.0));
        // Growth below the input's own objective is none.
        assert!(!guard.is_divergent(1.0, 1.0, || 1.0));
        assert!(!guard.is_divergent(90.0, 1.0, || 10.0));
        assert!(guard.is_divergent(1000.0, 1.0, || 10.0));
        assert!(guard.is_divergent(f64::NAN, 1.0, || 10.0));
        for restarts in 1..=MAX_DIVERGENCE_RESTARTS {
            assert!(guard.restart() && guard.has_restarted());
            assert_eq!(guard.accuracy_factor(), 2usize.pow(restarts));
            // The objective before a restart says nothing.
            assert!(!guard.is_divergent(1e30, 1.0, || 1.0));
        }
        assert!(!guard.restart());
        assert!(guard.is_divergent(1.0, f64::INFINITY, || 1.0));
    }
}

//! The z-step (paper, Eq. 17) in progress: conjugate gradients that can be interrupted after any iteration.

use super::iterate::Iterate;
use crate::fit::energy::problem::Problem;
use crate::fit::linear::z_step_solver::{SolvableOperator, ZStepSolver};

/// Accuracy to which the linear system of a z-step is solved.
#[derive(Debug, Clone, Copy)]
pub(super) struct ZStepAccuracy {
    /// Maximum number of conjugate-gradient iterations of the z-step, over all rounds.
    pub max_iterations: usize,
    /// Squared residual, relative to the one at the start of a round, at which the round of conjugate gradients ends.
    pub reduction: f64,
    /// Residual relative to the right-hand side `2λ z̃` at which the z-step ends. Single precision needs several rounds
    /// to reach it, each with the residual computed anew in double precision. `None`: there is one round.
    pub tolerance: Option<f64>,
}

/// Progress of a z-step's conjugate gradients.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct ZStep {
    /// Number of conjugate-gradient iterations so far.
    iterations: usize,
    round_iterations: usize,
    /// Squared residual at the start of the current round of conjugate gradients.
    initial_energy: f64,
}

impl ZStep {
    /// Begins the z-step for the right-hand side that was just given to the solver.
    pub(super) fn new<O: SolvableOperator>(solver: &O::Solver) -> Self {
        ZStep {
            initial_energy: solver.energy(),
            ..ZStep::default()
        }
    }

    /// Continues the z-step until it is complete, or until the budget of `left` conjugate-gradient iterations is used
    /// up. Returns whether it is complete.
    pub(super) fn advance<O: SolvableOperator>(
        &mut self,
        accuracy: ZStepAccuracy,
        problem: &Problem<O>,
        iterate: &mut Iterate<O>,
        solver: &mut O::Solver,
        left: &mut usize,
    ) -> bool {
        let limit = accuracy.max_iterations;
        loop {
            if let Some(tolerance) = accuracy.tolerance
                && self.round_iterations == 0
                && solver.relative_residual(problem) <= tolerance
            {
                return true;
            }
            let goal = accuracy.reduction * self.initial_energy;
            while self.iterations < limit && solver.energy() > goal {
                if *left == 0 {
                    return false;
                }
                *left -= 1;
                if !solver.step(&problem.operator) {
                    break;
                }
                self.iterations += 1;
                self.round_iterations += 1;
            }
            let has_moved = self.round_iterations > 0;
            self.round_iterations = 0;
            solver.correct(&problem.operator, &mut iterate.z);
            if accuracy.tolerance.is_none() || !has_moved || self.iterations >= limit {
                return true;
            }
            iterate.update(problem, 0.0, solver);
            self.initial_energy = solver.energy();
        }
    }

    /// Number of conjugate-gradient iterations so far.
    pub(super) fn iterations(&self) -> usize {
        self.iterations
    }
}

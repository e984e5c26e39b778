//! The least-squares cylinder of traces, by Levenberg and Marquardt's method.

use super::cylinder::Cylinder;
use super::prior::Prior;
use super::traces::{Residuals, Traces};

/// Maximum number of steps of Levenberg and Marquardt's method.
const MAX_ITERATIONS: usize = 40;

/// Initial damping of Levenberg and Marquardt's method, relative to the diagonal.
const INITIAL_DAMPING: f64 = 1e-3;

/// Minimum damping of Levenberg and Marquardt's method, relative to the diagonal.
const MIN_DAMPING: f64 = 1e-12;

/// Damping at which the search for a better step ends.
const MAX_DAMPING: f64 = 1e10;

/// Factor of Levenberg and Marquardt's damping after a step that lowers the cost.
const DAMPING_DECREASE: f64 = 0.2;

/// Factor of Levenberg and Marquardt's damping after a step that does not lower the cost.
const DAMPING_INCREASE: f64 = 4.0;

/// Relative decrease of the cost by one step at which the solution has converged.
const RELATIVE_COST_TOLERANCE: f64 = 1e-3;

/// Cost that is added for the relative decrease, so that exact traces converge, too.
const ABSOLUTE_COST: f64 = 1e-3;

impl Traces {
    /// The least-squares cylinder near an initial guess, and its residuals.
    pub fn solve(&self, start: Cylinder, prior: &Prior) -> Option<(Cylinder, Residuals)> {
        let mut best = start;
        let mut residuals = self.residuals(&best, prior)?;
        let mut damping = INITIAL_DAMPING;
        for _ in 0..MAX_ITERATIONS {
            let (matrix, values) = self.jacobian(&best, &residuals, prior)?;
            let normal = matrix.tr_mul(&matrix);
            let right = matrix.tr_mul(&values);
            let mut better = None;
            while damping < MAX_DAMPING {
                let mut damped = normal.clone();
                for k in 0..damped.nrows() {
                    damped[(k, k)] += damping * (normal[(k, k)] + 1e-9);
                }
                let step = damped.cholesky()?.solve(&right);
                let moved = best.moved(step.as_slice());
                match self.residuals(&moved, prior) {
                    Some(found) if found.cost < residuals.cost => {
                        better = Some((moved, found));
                        damping = (damping * DAMPING_DECREASE).max(MIN_DAMPING);
                        break;
                    }
                    _ => damping *= DAMPING_INCREASE,
                }
            }
            let Some((moved, found)) = better else { break };
            let gain = residuals.cost - found.cost;
            (best, residuals) = (moved, found);
            if gain < RELATIVE_COST_TOLERANCE * (ABSOLUTE_COST + residuals.cost.min(1.0)) {
                break;
            }
        }
        Some((best, residuals))
    }
}

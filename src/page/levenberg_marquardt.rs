//! Levenberg–Marquardt method for the page's cylinder that fits traced edges and lines best.

use super::cylinder::Cylinder;
use super::prior::Prior;
use super::traces::{Residuals, Traces};

/// Maximum number of steps of the Levenberg–Marquardt method for a page's cylinder.
const MAX_ITERATIONS: usize = 40;

/// Initial damping of the Levenberg–Marquardt method, relative to the normal matrix's diagonal.
const INITIAL_DAMPING: f64 = 1e-3;

/// Minimum damping of the Levenberg–Marquardt method, relative to the normal matrix's diagonal.
const MIN_DAMPING: f64 = 1e-12;

/// Damping of the Levenberg–Marquardt method at which the search for a step that lowers the cost ends.
const MAX_DAMPING: f64 = 1e10;

/// Factor that multiplies the Levenberg–Marquardt damping after a step that lowers the cost.
const DAMPING_DECREASE: f64 = 0.2;

/// Factor that multiplies the Levenberg–Marquardt damping after a step that does not lower the cost.
const DAMPING_INCREASE: f64 = 4.0;

/// Relative decrease of the least-squares cost by one step below which the fit of the cylinder has converged.
const RELATIVE_COST_TOLERANCE: f64 = 1e-3;

/// Number added to the cost in the test of its relative decrease, so that the fit of exact traces, whose cost tends to
/// 0, converges, too.
const ABSOLUTE_COST: f64 = 1e-3;

impl Traces {
    /// Finds the cylinder that fits the traces best in the least-squares sense, from an initial guess; returns it with
    /// its residuals. None if a cylinder on the way is not in front of the camera.
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

//! The paper's algorithm (Sec. 4.1), to be read beside it: [`Schedule::Paper`](crate::Schedule::Paper).
//!
//! The problem, in which every `H` is symmetric by construction (Eq. 15 and 16):
//!
//! ```text
//! min  λ Σ ‖z − z̃‖² + Σ ‖H‖_*   subject to   Cz = h
//! ```
//!
//! Its [`Iterate`](super::iterate::Iterate) holds `z` and, at each stencil, one matrix `V = ρ(U + H)`, from
//! which both follow: `ρU` is the projection of `V` onto the matrices with eigenvalues within ±1, and `ρH` its
//! soft threshold (App. D), which is what is left.

use web_time::Instant;

use super::certificate::Certificate;
use super::steps::{Admm, Check};
use super::z_step::ZStepAccuracy;
use crate::error::Result;
use crate::fit::linear::z_step_solver::SolvableOperator;
use crate::fit::report::StopReason;

/// Initial value of ADMM's penalty parameter ρ in the paper's schedule, as in the authors' code.
pub(super) const INITIAL_RHO: f64 = 1e-6;

/// Residual of the z-step's linear system, relative to its right-hand side `2λ z̃`, at which the z-step counts as
/// solved: the paper solves it by a sparse Cholesky factorisation, to rounding errors.
const Z_STEP_TOLERANCE: f64 = 1e-8;

/// Squared residual at which a round of conjugate gradients in single precision ends, relative to the one at the start
/// of the round.
const F32_CG_REDUCTION: f64 = 1e-6;

/// Maximum number of conjugate-gradient iterations in a z-step of the paper's schedule: a limit for domains on which
/// they hardly converge.
const MAX_CG_ITERATIONS: usize = 5000;

/// Over-relaxation factor of `Cz` in Eq. 18 and 19 of the paper: 1, which is none.
const PAPER_OVER_RELAXATION: f64 = 1.0;

/// Number of ADMM iterations from one check of convergence and ρ to the next in the paper's schedule, as in the authors' code.
const CHECK_ITERATIONS: usize = 10;

/// Root mean square residual for each entry of a Hessian at which the paper's schedule stops, as in the authors' code,
/// which measures both residuals among the Hessians, the dual one without the `Cᵀ` that the criterion of Boyd et al.
/// has. With `Cᵀ`, factors of 1/h² dominate, and the schedule runs ten times longer to a tenth of the gap.
const ABSOLUTE_TOLERANCE: f64 = 1e-4;

/// Residual, relative to the size of the Hessians or of the dual, at which the paper's schedule stops.
const RELATIVE_TOLERANCE: f64 = 1e-3;

/// Number of entries of a Hessian in the norm of a residual: the paper counts `h_xy` and `h_yx` (Eq. 16).
const HESSIAN_ENTRIES: f64 = 4.0;

/// Ratio of the primal to the dual residual, or the inverse, above which ρ changes in the paper's schedule, as in the authors' code:
/// Boyd et al. have 10, and a larger ratio saves factorisations, as Stellato et al. recommend.
const RESIDUAL_RATIO: f64 = 5000.0;

/// Factor by which ρ is multiplied or divided when it changes in the paper's schedule, as in the authors' code.
const RHO_FACTOR: f64 = 2.0;

/// Begins the paper's schedule with the first iterate, whose Hessians and dual are 0 unless there is a warm start.
/// Returns a reason to stop at once, if there is one.
pub(super) fn start<O: SolvableOperator>(
    admm: &mut Admm<O>,
    certificate: &Certificate,
) -> Option<StopReason> {
    admm.begin_z_step();
    stop_reason(admm, certificate, f64::INFINITY)
}

/// Runs ADMM's iterations until there is a reason to stop, which is returned, or until the budget of `left`
/// conjugate-gradient iterations is used up, which may be in the middle of a z-step.
///
/// # Errors
/// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
pub(super) fn advance<O: SolvableOperator>(
    admm: &mut Admm<O>,
    left: &mut usize,
) -> Result<Option<StopReason>> {
    while *left > 0 {
        // z ← argmin λ‖z − z̃‖² + ρ/2 ‖Cz − h + u‖²                                                (17)
        if !admm.advance_z_step(accuracy(admm), left) {
            break;
        }
        // H ← argmin ‖H‖_* + ρ/2 ‖Cz − H + U‖²                                                    (18)
        // u ← u + Cz − h                                                                          (19)
        let is_check = admm.iteration.is_multiple_of(CHECK_ITERATIONS) || admm.is_last();
        let change = admm.update_hessians_and_dual(PAPER_OVER_RELAXATION, is_check)?;
        if !is_check {
            continue;
        }
        // "After each iteration … we check for convergence … and update ρ."
        let start = Instant::now();
        let reason = match admm.check()? {
            Check::Restarted(reason) => reason,
            Check::Certified(certificate) => {
                let reason = stop_reason(admm, &certificate, change);
                let rho = next_rho(admm.iterate.rho, certificate.primal_residual, change);
                if reason.is_none() && rho != admm.iterate.rho {
                    admm.set_rho(rho);
                }
                reason
            }
        };
        admm.seconds.certificate += start.elapsed().as_secs_f64();
        if reason.is_some() {
            return Ok(reason);
        }
    }
    Ok(None)
}

/// Returns the accuracy to which the paper's schedule solves z-steps: nearly down to rounding errors.
fn accuracy<O: SolvableOperator>(admm: &Admm<O>) -> ZStepAccuracy {
    ZStepAccuracy {
        max_iterations: MAX_CG_ITERATIONS * admm.divergence.accuracy_factor(),
        reduction: F32_CG_REDUCTION,
        tolerance: Some(Z_STEP_TOLERANCE),
    }
}

/// Returns the reason to stop, if there is one. ADMM has converged (Boyd et al., Sec. 3.3.1) if both residuals, `‖Cz −
/// h‖` and the `change` `ρ‖Δh‖`, are below the tolerances.
fn stop_reason<O: SolvableOperator>(
    admm: &Admm<O>,
    certificate: &Certificate,
    change: f64,
) -> Option<StopReason> {
    let entries = HESSIAN_ENTRIES * admm.problem.operator.stencils().len() as f64;
    let absolute = entries.sqrt() * ABSOLUTE_TOLERANCE;
    let has_converged = certificate.primal_residual
        <= absolute + RELATIVE_TOLERANCE * certificate.primal_size
        && change <= absolute + RELATIVE_TOLERANCE * certificate.dual_norm;
    let reason = has_converged.then_some(StopReason::Residuals);
    admm.stop_reason(admm.parameters.gap, reason)
}

/// Returns the next ρ by residual balancing (Boyd et al., Sec. 3.4.1): it grows where the primal residual is much
/// larger than the dual one, and falls where it is much smaller.
fn next_rho(rho: f64, primal: f64, dual: f64) -> f64 {
    if dual > RESIDUAL_RATIO * primal {
        rho / RHO_FACTOR
    } else if primal > RESIDUAL_RATIO * dual {
        rho * RHO_FACTOR
    } else {
        rho
    }
}

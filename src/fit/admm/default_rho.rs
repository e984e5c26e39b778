//! ADMM's penalty parameter ρ under the default schedule: its initial value, its bounds, and its changes by relative
//! residuals.
//!
//! `benches/choices.md` has what the constants were chosen by.

use super::certificate::Certificate;
use super::steps::Admm;
use crate::fit::energy::problem::Problem;
use crate::fit::linear::z_step_solver::SolvableOperator;

/// Ratio of the scaled primal to the scaled dual residual, or the inverse, above which ρ changes
/// (`benches/choices.md`, Schedule by ablation).
const RESIDUAL_RATIO: f64 = 3.0;

/// Factor by which ρ is multiplied or divided when it changes
/// (`benches/choices.md`, Schedule by ablation).
const RHO_FACTOR: f64 = 2.0;

/// Ratio of the relative primal to the relative dual residual that changes of ρ aim at. The dual residual is measured
/// after multiplication by `Cᵀ`, which weighs its highest frequencies most, and those cost the dual bound least,
/// because dual ascent removes them (`benches/choices.md`, Constants of the schedule).
const RESIDUAL_BALANCE_RATIO: f64 = 0.025;

/// Ratio of the relative primal to the relative dual residual that changes of ρ aim at where some vertices have hardly
/// any fidelity weight: there the dual residual is the change of the Hessians (`benches/choices.md`, Constants of the
/// schedule).
const RESIDUAL_BALANCE_RATIO_WEAK_FIDELITY: f64 = 10.0;

/// Share of the duality gap below which the part that the dual residual causes makes ρ grow, and keeps ρ from falling
/// (`benches/choices.md`, Constants of the schedule).
const DUAL_COST_SHARE_LOW: f64 = 0.2;

/// Share of the duality gap above which the part that the dual residual causes makes ρ fall, on meshes, where ρ is
/// changed by this share alone.
const DUAL_COST_SHARE_HIGH: f64 = 0.7;

/// Ratio of ρ at the start of a multigrid level to ρ at the end of the next coarser one (`benches/choices.md`,
/// Constants of the schedule).
const RHO_REFINEMENT_FACTOR: f64 = 0.5;

/// Minimum of ρ at which residual balancing lowers it, in spacings, the natural unit. Where the surface jumps, its large Hessians
/// make the relative primal residual small, and ρ would fall until iterates hardly move (`benches/choices.md`, Jumps).
const MIN_RHO_SPACINGS: f64 = 0.1;

/// Maximum screening length `(ρ/2λ)^¼` of the z-step (distance over which it smooths), in lattice spacings: its fourth
/// power is the condition number. A longer one moves the surface faster and its dual bound more slowly
/// (`benches/choices.md`, Constants of the schedule).
const MAX_SCREENING_LENGTH_CELLS: f64 = 10.0;

/// Maximum of ρ, in sizes of the domain, where some vertices have hardly any fidelity weight and the screening length
/// sets no limit: about the ratio of dual and Hessian of a surface as large as the domain.
const MAX_RHO_SIZES: f64 = 10.0;

/// Initial ρ on the first multigrid level. Creases have Hessians of the order of one over the spacing, which makes the
/// spacing the natural unit of ρ.
pub(super) fn initial_rho<O: SolvableOperator>(problem: &Problem<O>) -> f64 {
    bounded_rho(problem.operator.spacing(), problem)
}

/// Initial ρ on a multigrid level, from ρ at the end of the next coarser level.
pub(crate) fn refined_rho<O: SolvableOperator>(rho: f64, fine: &Problem<O>) -> f64 {
    bounded_rho(RHO_REFINEMENT_FACTOR * rho, fine)
}

/// Initial ρ of a problem, from ρ at the end of the solve of another one with this spacing: ρ is proportional to it.
pub(crate) fn rho_for_spacing<O: SolvableOperator>(
    rho: f64,
    spacing: f64,
    problem: &Problem<O>,
) -> f64 {
    bounded_rho(rho * problem.operator.spacing() / spacing, problem)
}

/// Limits ρ by the screening length `(ρ/2λ)^¼` of the z-step. Where the optimal surface is nearly affine, the relative
/// primal residual stays at 1, and residual balancing alone would let ρ grow without end.
fn bounded_rho<O: SolvableOperator>(rho: f64, problem: &Problem<O>) -> f64 {
    if problem.has_weak_fidelity {
        return rho.min(MAX_RHO_SIZES * problem.operator.size());
    }
    let length = MAX_SCREENING_LENGTH_CELLS * problem.operator.spacing();
    rho.min(2.0 * problem.lambda * length.powi(4))
}

/// Returns the next ρ by residual balancing (Boyd et al., Sec. 3.4.1) of relative residuals and by the share of the
/// duality gap that the dual residual causes. `change` is `ρ‖ΔH‖` of the last iteration.
pub(super) fn next_rho<O: SolvableOperator>(
    admm: &Admm<O>,
    certificate: &Certificate,
    change: f64,
) -> f64 {
    let (rho, problem) = (admm.iterate.rho, &admm.problem);
    let primal = certificate.primal_residual / certificate.primal_size;
    let (grows, falls) = if problem.has_weak_fidelity {
        // At free vertices `CᵀY` itself is to vanish, and is no measure of anything.
        let dual = RESIDUAL_BALANCE_RATIO_WEAK_FIDELITY * change / certificate.dual_norm;
        (
            primal > RESIDUAL_RATIO * dual,
            dual > RESIDUAL_RATIO * primal,
        )
    } else {
        let gap = certificate.objective() - certificate.dual_bound;
        let is_cheap = certificate.dual_cost < DUAL_COST_SHARE_LOW * gap;
        if !admm.parameters.is_mesh {
            let dual = RESIDUAL_BALANCE_RATIO * certificate.dual_residual / certificate.dual_size;
            let grows = primal > RESIDUAL_RATIO * dual || is_cheap;
            let may_fall = rho > MIN_RHO_SPACINGS * problem.operator.spacing() && !is_cheap;
            (grows, may_fall && dual > RESIDUAL_RATIO * primal)
        } else {
            // Balanced residuals take more iterations on meshes (`benches/whole.md`).
            (is_cheap, certificate.dual_cost > DUAL_COST_SHARE_HIGH * gap)
        }
    };
    let next = match (grows, falls) {
        (_, true) => rho / RHO_FACTOR,
        (true, false) => rho * RHO_FACTOR,
        (false, false) => rho,
    };
    bounded_rho(next, problem)
}

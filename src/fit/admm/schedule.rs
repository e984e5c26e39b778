//! The two ways to run the iterations: on how many levels, how exactly each
//! z-step is solved, how ρ follows the residuals, and when to stop.

use super::best::{Best, MAX_AFFINE_GAP};
use super::state::Certificate;
use crate::fit::energy::problem::Problem;
use crate::fit::energy::spectral_penalty::PenaltyKind;
use crate::fit::linear::zstep::Solvable;
use crate::fit::options::{Energy, Options, Schedule};
use crate::fit::report::StopReason;

/// The numbers of a [`Schedule`] on one level.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Plan {
    schedule: Schedule,
    /// Over-relaxation of `Cz` in the H-step and the dual update.
    relaxation: f64,
    /// Conjugate-gradient iterations in a z-step, at most; while the gap is above [`SECOND_CG_STEP_GAP`]; in
    /// the first one of a level; and where vertices are free, for there one V-cycle does less.
    cg_iterations: usize,
    cg_rough: usize,
    cg_first: usize,
    cg_free: usize,
    /// Residual, relative to `2λ z̃`, at which a z-step is solved; 0 if it need not be.
    pub cg_tolerance: f64,
    /// Iterations from one certificate to the next, and at the beginning.
    check_every: usize,
    check_first: usize,
    /// ρ changes when one relative residual exceeds the other by this factor.
    imbalance: f64,
    /// It changes by what the residuals cost alone.
    by_costs: bool,
    /// Most of what a search for a better bound divides the gap by.
    climbable: f64,
    gap: f64,
    /// Whether there are finer levels.
    coarse: bool,
    max_iterations: usize,
    /// Whether the weights are those of the surface itself.
    pub follows_normals: bool,
}

/// Absolute residual at which `Schedule::Paper` stops: that of the authors' own code, which measures both
/// residuals among the Hessians, the dual one without the `Cᵀ` that the criterion of Boyd et al. has. With it
/// the factors 1/h² dominate, and the schedule runs ten times longer to a tenth of the gap.
const PAPER_ABSOLUTE_RESIDUAL: f64 = 1e-4;

/// Relative residual at which `Schedule::Paper` stops, measured as the absolute one.
const PAPER_RELATIVE_RESIDUAL: f64 = 1e-3;

/// Least number of interior vertices of a coarse level: below it nothing is saved.
const MIN_COARSE_VERTICES: usize = 500;

/// Ratio of the relative primal to the relative dual residual that changes of ρ aim at: the dual residual is
/// measured behind `Cᵀ`, which weighs its highest frequencies most, and those cost the bound least, since
/// `ascent` takes them away.
const RESIDUAL_BALANCE: f64 = 0.025;

/// The gap is the sum of what the dual residual costs and what the primal one does. ρ also rises when
/// the former is less than this share of it, and does not fall.
const SMALL_SHARE: f64 = 0.2;

/// Beyond this share the dual residual costs too much, where ρ goes by costs alone.
const LARGE_SHARE: f64 = 0.7;

/// The same where vertices are free, and the dual residual is the change of the Hessians.
const FREE_BALANCE: f64 = 10.0;

/// Relative duality gap above which a second conjugate-gradient iteration per z-step pays. Below, it saves
/// hardly more iterations than it costs.
const SECOND_CG_STEP_GAP: f64 = 0.03;

/// Squared relative residual after the first conjugate-gradient iteration below which no second one is
/// needed.
const SECOND_CG_STEP_RESIDUAL: f64 = 0.005;

/// Squared residual, relative to the first, at which conjugate gradients in single precision end.
const SINGLE_PRECISION_RESIDUAL: f64 = 1e-6;

/// Factor by which ρ changes from one level to the next finer one.
const LEVEL_RHO_FACTOR: f64 = 0.5;

/// Largest screening length of the z-step, in sizes of the domain.
const MAX_SCREENING_LENGTH: f64 = 0.1;

/// Largest screening length of the z-step, in cells: its fourth power is the condition number. Longer ones
/// move the surface faster and its bound more slowly.
const MAX_SCREENING_CELLS: f64 = 10.0;

/// Largest factor by which an ascent of the bound divides the gap.
const MAX_ASCENT_GAIN: f64 = 100.0;

/// Largest factor by which an ascent of the bound divides the gap where there are no coarser levels to start
/// from: on a mesh that begins with nothing, or with the dual of other weights, ascents from larger gaps only
/// cost time.
const MAX_ASCENT_GAIN_SINGLE_LEVEL: f64 = 10.0;

/// Gaps from here on leave the surface's Hessians a smaller eigenvalue that is worth taking away.
const FULL_RANK: f64 = 2e-3;

/// Ratio of a start's own gap to the root of the gap that is asked for from which on the start is no faster
/// than coarse lattices.
const FAR_START_RATIO: f64 = 3.0;

/// Number of iterations without over-relaxation on a new lattice.
const PLAIN_ITERATIONS: usize = 5;

/// Number of iterations at the beginning in which certificates are taken more often.
const EARLY_ITERATIONS: usize = 30;

/// Coarse levels need no smaller gap: their lattice is further from the fine one than that.
const COARSE_GAP: f64 = 0.01;

/// A coarse level that has not reached its gap by then hands over to the finer one: more iterations
/// would save the finer one less than they cost.
const COARSE_ITERATIONS: usize = 200;

impl Plan {
    /// The plan for the finest level.
    pub(crate) fn new(options: &Options) -> Self {
        let common = Plan {
            schedule: options.schedule,
            relaxation: 1.8,
            cg_iterations: 1,
            cg_rough: 2,
            cg_free: 4,
            cg_first: 3,
            cg_tolerance: 0.0,
            check_every: 10,
            check_first: 5,
            imbalance: 3.0,
            by_costs: false,
            climbable: MAX_ASCENT_GAIN,
            gap: options.gap_or_default(),
            coarse: false,
            max_iterations: options.max_iterations,
            follows_normals: options.energy_or_default() == Energy::SecondForm,
        };
        match options.schedule {
            Schedule::Default => common,
            Schedule::Paper => Plan {
                relaxation: 1.0,
                cg_iterations: 5000,
                cg_rough: 5000,
                cg_free: 5000,
                cg_first: 5000,
                cg_tolerance: 1e-8,
                check_first: 10,
                imbalance: 5000.0,
                ..common
            },
        }
    }

    /// For z-steps by conjugate gradients without a V-cycle. They leave low frequencies of the residual,
    /// which cost the bound most, and the more the larger ρ is: what both residuals cost has to be alike. They
    /// need no more of them while the gap is large: an iteration costs less than those would.
    pub(crate) fn without_cycles(self) -> Self {
        Plan {
            by_costs: true,
            climbable: MAX_ASCENT_GAIN_SINGLE_LEVEL,
            cg_rough: self.cg_iterations,
            ..self
        }
    }

    /// The same for a coarse level, or for one with fewer iterations left.
    pub(crate) fn on_level(&self, coarse: bool, iterations_done: usize) -> Self {
        let left = self.max_iterations.saturating_sub(iterations_done);
        Plan {
            gap: if coarse {
                self.gap.max(COARSE_GAP)
            } else {
                self.gap
            },
            coarse,
            max_iterations: if coarse {
                left.min(COARSE_ITERATIONS)
            } else {
                left
            },
            ..*self
        }
    }

    /// Whether a lattice with so many interior vertices is worth a level of its own.
    pub(crate) fn wants_level(&self, interior: usize) -> bool {
        self.schedule == Schedule::Default && interior >= MIN_COARSE_VERTICES
    }

    /// The penalty to start from.
    pub(crate) fn first_rho<O: Solvable>(&self, problem: &Problem<O>) -> f64 {
        match self.schedule {
            // Creases have Hessians of order 1/h, which makes h the natural unit of ρ.
            Schedule::Default => self.within_bounds(problem.operator.spacing(), problem),
            Schedule::Paper => 1e-6,
        }
    }

    /// The penalty to go on with on the lattice of half the spacing.
    pub(crate) fn finer_rho<O: Solvable>(&self, rho: f64, fine: &Problem<O>) -> f64 {
        self.within_bounds(LEVEL_RHO_FACTOR * rho, fine)
    }

    /// Where the optimum is nearly affine the relative primal residual stays at 1, and
    /// balancing alone would let ρ grow without end. There is no use for a screening
    /// length (ρ/2λ)^¼ beyond a part of the domain's size.
    fn within_bounds<O: Solvable>(&self, rho: f64, problem: &Problem<O>) -> f64 {
        let size = problem.operator.size();
        if problem.loose {
            // No screening length, but the ratio of dual and Hessian of a surface as large as this.
            return rho.min(10.0 * size);
        }
        let length =
            (MAX_SCREENING_LENGTH * size).min(MAX_SCREENING_CELLS * problem.operator.spacing());
        rho.min(2.0 * problem.lambda * length.powi(4))
    }

    /// Whether a start is so far from the optimum that a coarse lattice is a better one.
    pub(crate) fn is_far(&self, start: &Certificate) -> bool {
        let objective = start.objective();
        let gap = (objective - start.dual_bound) / objective;
        gap.is_nan() || gap > FAR_START_RATIO * self.gap.sqrt()
    }

    /// Conjugate-gradient iterations of the z-step after so many iterations, at such a gap.
    pub(crate) fn cg_limit<O: Solvable>(
        &self,
        problem: &Problem<O>,
        iteration: usize,
        gap: f64,
    ) -> usize {
        if problem.loose {
            self.cg_free
        } else if iteration == 0 {
            self.cg_first
        } else if gap > SECOND_CG_STEP_GAP {
            self.cg_rough
        } else {
            self.cg_iterations
        }
    }

    /// The squares of the residual at which a z-step, or a round of it, ends early, relative to its
    /// first ones.
    pub(crate) fn cg_reduction<O: Solvable>(&self, problem: &Problem<O>, iteration: usize) -> f64 {
        match self.schedule {
            Schedule::Paper => SINGLE_PRECISION_RESIDUAL,
            Schedule::Default if iteration == 0 || problem.loose => 0.0,
            Schedule::Default => SECOND_CG_STEP_RESIDUAL,
        }
    }

    /// Whether [`Plan::stop`] and [`Plan::next_rho`] ask for the change of the Hessians.
    pub(crate) fn measures_change<O: Solvable>(&self, problem: &Problem<O>) -> bool {
        self.schedule == Schedule::Paper || problem.loose
    }

    /// Whether a certificate is due.
    pub(crate) fn is_check(&self, iteration: usize) -> bool {
        let every = if iteration <= EARLY_ITERATIONS {
            self.check_first
        } else {
            self.check_every
        };
        iteration.is_multiple_of(every) || self.is_last(iteration)
    }

    /// Over-relaxation leaves nearly all of the highest frequencies of a residual, with the opposite
    /// sign. Iterations without take them away, where the start is full of them and where the
    /// bound is to be taken.
    pub(crate) fn relaxation(&self, iteration: usize) -> f64 {
        if iteration <= PLAIN_ITERATIONS || self.is_check(iteration) {
            1.0
        } else {
            self.relaxation
        }
    }

    /// Whether an affine surface is worth a try.
    pub(crate) fn tries_affine<O: Solvable>(&self, problem: &Problem<O>) -> bool {
        self.schedule == Schedule::Default
            && !self.follows_normals
            && problem.constrained.is_empty()
    }

    /// Whether an iterate of such a gap is worth the search for a better bound.
    pub(crate) fn climbs<O: Solvable>(&self, problem: &Problem<O>, gap: f64) -> bool {
        self.schedule == Schedule::Default
            && matches!(problem.kind, PenaltyKind::Nuclear | PenaltyKind::Huber(_))
            && !problem.loose
            && gap > self.gap
            && gap < self.climbable * self.gap
    }

    /// Whether the surface's Hessians are to be brought to the rank of the split ones once the iterations
    /// have stopped: those of a smaller gap have it.
    pub(crate) fn reduces_rank<O: Solvable>(&self, problem: &Problem<O>) -> bool {
        self.schedule == Schedule::Default
            && matches!(problem.kind, PenaltyKind::Nuclear | PenaltyKind::Huber(_))
            && !problem.loose
            && !self.follows_normals
            && self.gap >= FULL_RANK
    }

    /// Whether another surface of such an objective has the gap that is asked for, too.
    pub(crate) fn is_certified(&self, objective: f64, best: &Best) -> bool {
        objective - best.dual_bound + best.rounding <= self.gap * objective
    }

    /// Whether an objective that has come down from one check to the next by so much is about as low
    /// as it gets.
    pub(crate) fn has_settled(&self, before: f64, objective: f64) -> bool {
        before - objective <= self.gap * objective
    }

    /// When the search is worth it again that after so many iterations came to such a gap: gaps
    /// hardly fall faster than with the square of the iterations.
    pub(crate) fn next_climb(&self, iteration: usize, gap: f64) -> usize {
        (iteration as f64 * (gap / self.gap).sqrt()) as usize
    }

    /// The bound that would end the iterations.
    pub(crate) fn bound_wanted(&self, objective: f64) -> f64 {
        (1.0 - self.gap) * objective
    }

    /// Whether the certificate is to be balanced, which costs as much as some tens of iterations:
    /// a quarter more of them than the `last` time.
    pub(crate) fn is_balance(&self, iteration: usize, last: usize) -> bool {
        iteration >= last + last / 4 + 2 * self.check_every || self.is_last(iteration)
    }

    /// Whether ρ may change: a quarter more iterations after the `last` time, so that it settles in the
    /// end, without which ADMM need not converge.
    pub(crate) fn may_tune(&self, iteration: usize, last: usize) -> bool {
        self.schedule == Schedule::Paper || iteration >= last + last / 4
    }

    /// Twice the conjugate-gradient iterations, and no over-relaxation: for a domain on which the
    /// usual ones do not converge.
    pub(crate) fn be_more_exact(&mut self) {
        self.relaxation = 1.0;
        for limit in [
            &mut self.cg_iterations,
            &mut self.cg_rough,
            &mut self.cg_first,
            &mut self.cg_free,
        ] {
            *limit *= 2;
        }
    }

    /// Whether there may be no further iteration.
    pub(crate) fn is_last(&self, iteration: usize) -> bool {
        iteration >= self.max_iterations
    }

    /// Residual balancing (Boyd et al., Sec. 3.4.1), by what the residuals cost: the penalty to go on
    /// with.
    pub(crate) fn next_rho<O: Solvable>(
        &self,
        problem: &Problem<O>,
        rho: f64,
        certificate: &Certificate,
        change: f64,
    ) -> f64 {
        let (primal, dual) = match self.schedule {
            // At free vertices `CᵀY` itself is to vanish: no measure of anything.
            Schedule::Default if problem.loose => (
                certificate.primal_residual / certificate.primal_size,
                FREE_BALANCE * change / certificate.dual_norm,
            ),
            Schedule::Default => (
                certificate.primal_residual / certificate.primal_size,
                RESIDUAL_BALANCE * certificate.dual_residual / certificate.dual_size,
            ),
            Schedule::Paper => (certificate.primal_residual, change),
        };
        let mut up = primal > self.imbalance * dual;
        let mut down = dual > self.imbalance * primal;
        if self.schedule == Schedule::Default && !problem.loose {
            let gap = certificate.objective() - certificate.dual_bound;
            let cheap = certificate.dual_cost < SMALL_SHARE * gap;
            (up, down) = match self.by_costs {
                true => (cheap, certificate.dual_cost > LARGE_SHARE * gap),
                false => (up || cheap, down && !cheap),
            };
        }
        let next = match (up, down) {
            (_, true) => rho / 2.0,
            (true, false) => rho * 2.0,
            (false, false) => rho,
        };
        match self.schedule {
            Schedule::Default => self.within_bounds(next, problem),
            Schedule::Paper => next,
        }
    }

    /// Whether to stop after `iteration` iterations, the last of which moved the
    /// Hessians by `change = ρ‖ΔH‖`, and why.
    pub(crate) fn stop<O: Solvable>(
        &self,
        problem: &Problem<O>,
        iteration: usize,
        certificate: &Certificate,
        change: f64,
        best: &Best,
    ) -> Option<StopReason> {
        let (objective, rounding) = (best.objective(), best.rounding);
        let missing = objective - best.dual_bound;
        // An affine surface is worth a try on the next lattice before this one has proved it.
        let wanted = if best.affine && self.coarse {
            MAX_AFFINE_GAP
        } else {
            self.gap
        };
        let certified = missing + rounding <= wanted * objective;
        if objective <= rounding || (missing <= rounding && !certified) {
            return Some(StopReason::Rounding);
        }
        let done = match self.schedule {
            Schedule::Default => certified.then_some(StopReason::Gap),
            Schedule::Paper => {
                // Four entries of a Hessian, as in the paper.
                let entries = 4.0 * problem.operator.stencils().len() as f64;
                let absolute = entries.sqrt() * PAPER_ABSOLUTE_RESIDUAL;
                // Before the first iteration both residuals vanish without meaning anything.
                let met = iteration > 0
                    && certificate.primal_residual
                        <= absolute + PAPER_RELATIVE_RESIDUAL * certificate.primal_size
                    && change <= absolute + PAPER_RELATIVE_RESIDUAL * certificate.dual_norm;
                met.then_some(StopReason::Residuals)
            }
        };
        done.or(self.is_last(iteration).then_some(StopReason::MaxIterations))
    }
}

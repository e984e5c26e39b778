//! The default schedule: few conjugate-gradient iterations in each z-step, over-relaxation, dual ascent for the
//! bound, and an end at a certified gap.
//!
//! `benches/choices.md` has what its constants were chosen by.

use std::mem;

use web_time::Instant;

use super::affine::MAX_AFFINE_GAP;
use super::certificate::Certificate;
use super::default_rho::next_rho;
use super::dual_ascent::{DualAscent, EVALUATION_COST_CG_ITERATIONS};
use super::rank::RankReduction;
use super::steps::{Admm, Check};
use super::timing::{AscentTimer, GrowingInterval};
use super::z_step::ZStepAccuracy;
use crate::error::Result;
use crate::fit::energy::problem::Problem;
use crate::fit::energy::spectral_penalty::PenaltyKind;
use crate::fit::linear::z_step_solver::SolvableOperator;
use crate::fit::report::StopReason;

/// Maximum number of conjugate-gradient iterations in a z-step.
const MAX_CG_ITERATIONS: usize = 1;

/// Maximum number of conjugate-gradient iterations in a z-step with V-cycles while the gap is large.
const MAX_CG_ITERATIONS_LARGE_GAP: usize = 2;

/// Maximum number of conjugate-gradient iterations in the first z-step of a level.
const MAX_CG_ITERATIONS_FIRST: usize = 3;

/// Maximum number of conjugate-gradient iterations in a z-step where vertices have next to no fidelity, because
/// a V-cycle does less there.
const MAX_CG_ITERATIONS_WEAK_FIDELITY: usize = 4;

/// Relative duality gap above which a second conjugate-gradient iteration in each z-step pays. Below, it saves
/// hardly more iterations than it costs.
const EXTRA_CG_GAP: f64 = 0.03;

/// Squared residual, relative to the first, at which a z-step ends.
const CG_REDUCTION: f64 = 0.005;

/// Over-relaxation of `Cz` in the updates of Hessians and dual.
const OVER_RELAXATION: f64 = 1.8;

/// Number of iterations at the start of a level without over-relaxation.
const UNRELAXED_ITERATIONS: usize = 5;

/// Number of iterations from one check to the next.
const CHECK_ITERATIONS: usize = 10;

/// Number of iterations from one check to the next at the start of a level.
const FREQUENT_CHECK_ITERATIONS: usize = 5;

/// Number of iterations at the start of a level in which checks are more frequent.
const FREQUENT_CHECKS_END: usize = 30;

/// Maximum ratio of the current gap to the requested one at which dual ascent is tried.
const MAX_ASCENT_GAP_RATIO: f64 = 100.0;

/// Maximum ratio of the current gap to the requested one at which dual ascent is tried without V-cycles: a mesh has
/// no coarser levels to start from, and ascents from larger gaps only cost time.
const MAX_ASCENT_GAP_RATIO_WITHOUT_V_CYCLES: f64 = 10.0;

/// Minimum requested gap at which rank reduction is applied; surfaces solved to a smaller gap have Hessians of rank
/// one already.
const MIN_RANK_REDUCTION_GAP: f64 = 2e-3;

/// The default schedule on one level.
#[derive(Debug, Clone)]
pub(super) struct DefaultSchedule<O: SolvableOperator> {
    phase: Phase<O>,
    ascent_timer: AscentTimer,
    rho_changes: GrowingInterval,
    /// Buffers of the last dual ascent, to be used again.
    idle_ascent: Option<Box<DualAscent<O>>>,
}

/// Current work of the schedule.
#[derive(Debug, Clone)]
enum Phase<O: SolvableOperator> {
    /// An iteration, in its z-step.
    Iteration,
    /// Dual ascent from the iterate of a check, whose outcome decides how to continue.
    DualAscent {
        ascent: Box<DualAscent<O>>,
        certificate: Certificate,
        change: f64,
    },
    /// Rank reduction of the final surface, with the reason why the iterations stopped.
    RankReduction {
        reduction: RankReduction,
        reason: StopReason,
    },
}

impl<O: SolvableOperator> DefaultSchedule<O> {
    /// A schedule in which dual ascent is not tried before an iteration.
    pub(super) fn new(first_ascent_iteration: usize) -> Self {
        DefaultSchedule {
            phase: Phase::Iteration,
            ascent_timer: AscentTimer::new(first_ascent_iteration),
            rho_changes: GrowingInterval::default(),
            idle_ascent: None,
        }
    }

    /// Begins with the first iterate, or with the affine surface if that is better.
    pub(super) fn start(
        &mut self,
        admm: &mut Admm<O>,
        certificate: Certificate,
        may_be_affine: bool,
    ) -> Result<Option<StopReason>> {
        if may_be_affine {
            admm.try_affine()?;
        }
        admm.begin_z_step();
        self.ascend_or_decide(admm, certificate, 0.0)
    }

    /// Begins a pass with other weights.
    pub(super) fn begin_pass(&mut self, admm: &mut Admm<O>) -> Result<Option<StopReason>> {
        admm.try_affine()?;
        admm.begin_z_step();
        self.ascent_timer.begin_pass(admm.iteration);
        Ok(stop_reason(admm))
    }

    /// Continues until there is a reason to stop, or until the budget of conjugate-gradient iterations is
    /// `left` empty.
    ///
    /// # Errors
    /// Out of memory.
    pub(super) fn advance(
        &mut self,
        admm: &mut Admm<O>,
        left: &mut usize,
    ) -> Result<Option<StopReason>> {
        while *left > 0 {
            let reason = match mem::replace(&mut self.phase, Phase::Iteration) {
                Phase::Iteration => self.iterate(admm, left)?,
                Phase::DualAscent {
                    ascent,
                    certificate,
                    change,
                } => {
                    *left = left.saturating_sub(EVALUATION_COST_CG_ITERATIONS);
                    self.ascend(admm, ascent, certificate, change)
                }
                Phase::RankReduction { reduction, reason } => {
                    *left = left.saturating_sub(2);
                    self.reduce_rank(admm, reduction, reason)
                }
            };
            if reason.is_some() {
                return Ok(reason);
            }
        }
        Ok(None)
    }

    /// One iteration, or as much of it as the budget allows.
    fn iterate(&mut self, admm: &mut Admm<O>, left: &mut usize) -> Result<Option<StopReason>> {
        if !admm.advance_z_step(z_step_accuracy(admm), left) {
            return Ok(None);
        }
        let is_check = is_check(admm);
        let measures_change = is_check && admm.problem.has_weak_fidelity;
        let change = admm.update_hessians_and_dual(relaxation(admm), measures_change)?;
        if !is_check {
            return Ok(None);
        }
        let start = Instant::now();
        let reason = self.check(admm, change)?;
        admm.seconds.certificate += start.elapsed().as_secs_f64();
        Ok(reason)
    }

    /// Certifies the iterate, then decides at once or after dual ascent.
    fn check(&mut self, admm: &mut Admm<O>, change: f64) -> Result<Option<StopReason>> {
        let before = admm.incumbent.objective();
        let certificate = match admm.check()? {
            Check::Certified(certificate) => certificate,
            Check::Restarted(reason) => return Ok(reason),
        };
        let objective = admm.incumbent.objective();
        let has_settled = before - objective <= admm.parameters.gap * objective;
        if has_settled && !admm.replaces_incumbent() {
            self.ascent_timer.note_settled(admm.iteration);
        }
        self.ascend_or_decide(admm, certificate, change)
    }

    /// Begins dual ascent if it may reach the requested gap; otherwise decides whether to stop.
    fn ascend_or_decide(
        &mut self,
        admm: &mut Admm<O>,
        certificate: Certificate,
        change: f64,
    ) -> Result<Option<StopReason>> {
        // With another energy at each check, no bound is kept.
        let is_due = self.ascent_timer.is_due(admm.iteration)
            || admm.is_last()
            || admm.parameters.follows_normals;
        if !is_due || !is_ascent_useful(admm) {
            return Ok(self.decide(admm, &certificate, change));
        }
        let mut ascent = match self.idle_ascent.take() {
            Some(ascent) => ascent,
            None => Box::new(DualAscent::new(&admm.problem)?),
        };
        let goal = (1.0 - admm.parameters.gap) * admm.incumbent.objective();
        let bound = admm.incumbent.dual_bound;
        ascent.start_dual_ascent(&mut admm.iterate, &admm.problem, bound, goal)?;
        self.phase = Phase::DualAscent {
            ascent,
            certificate,
            change,
        };
        Ok(None)
    }

    /// Continues dual ascent; at its end, decides how to go on.
    fn ascend(
        &mut self,
        admm: &mut Admm<O>,
        mut ascent: Box<DualAscent<O>>,
        certificate: Certificate,
        change: f64,
    ) -> Option<StopReason> {
        let start = Instant::now();
        let bound = ascent.evaluate_bound(&mut admm.iterate, &admm.problem);
        let reason = if let Some(bound) = bound {
            self.idle_ascent = Some(ascent);
            admm.incumbent.dual_bound = bound;
            let ratio = admm.incumbent.gap() / admm.parameters.gap;
            self.ascent_timer.note_ascent(admm.iteration, ratio);
            self.decide(admm, &certificate, change)
        } else {
            self.phase = Phase::DualAscent {
                ascent,
                certificate,
                change,
            };
            None
        };
        admm.seconds.certificate += start.elapsed().as_secs_f64();
        reason
    }

    /// Decides whether to stop, and changes ρ if not.
    fn decide(
        &mut self,
        admm: &mut Admm<O>,
        certificate: &Certificate,
        change: f64,
    ) -> Option<StopReason> {
        let reason = stop_reason(admm);
        let is_due = admm.iteration > 0 && self.rho_changes.has_passed(admm.iteration, 0);
        if reason.is_none() && is_due {
            let rho = next_rho(admm, certificate, change);
            if rho != admm.iterate.rho {
                self.rho_changes.restart(admm.iteration);
                admm.set_rho(rho);
            }
        }
        reason
    }

    /// Begins rank reduction of the incumbent after the iterations have stopped; `false` if it is not worth it.
    pub(super) fn begin_rank_reduction(
        &mut self,
        admm: &Admm<O>,
        reason: StopReason,
    ) -> Result<bool> {
        let is_useful = reason == StopReason::Gap
            && !admm.incumbent.is_affine
            && has_rank_one_optimum(&admm.problem)
            && !admm.parameters.follows_normals
            && admm.parameters.gap >= MIN_RANK_REDUCTION_GAP;
        if !is_useful {
            return Ok(false);
        }
        // Its memory is free for that.
        self.idle_ascent = None;
        let Some(reduction) = RankReduction::new(&admm.problem, &admm.incumbent.z)? else {
            return Ok(false);
        };
        self.phase = Phase::RankReduction { reduction, reason };
        Ok(true)
    }

    /// Continues rank reduction; at its end, takes over the surface if the bound certifies it as well.
    fn reduce_rank(
        &mut self,
        admm: &mut Admm<O>,
        mut reduction: RankReduction,
        reason: StopReason,
    ) -> Option<StopReason> {
        let start = Instant::now();
        admm.cg_iterations += 1;
        let (problem, incumbent) = (&admm.problem, &mut admm.incumbent);
        let is_complete = match reduction.step(problem, &mut admm.iterate, &mut admm.solver) {
            Some(z) => {
                let (fidelity, nuclear_norm) = (problem.distance(z), problem.smoothness(z));
                if incumbent.certifies(fidelity + nuclear_norm, admm.parameters.gap) {
                    incumbent.set_surface(z, fidelity, nuclear_norm);
                }
                true
            }
            None => false,
        };
        if !is_complete {
            self.phase = Phase::RankReduction { reduction, reason };
        }
        admm.seconds.z_step += start.elapsed().as_secs_f64();
        is_complete.then_some(reason)
    }
}

/// Accuracy of the current z-step.
fn z_step_accuracy<O: SolvableOperator>(admm: &Admm<O>) -> ZStepAccuracy {
    let is_weak = admm.problem.has_weak_fidelity;
    let max_iterations = if is_weak {
        MAX_CG_ITERATIONS_WEAK_FIDELITY
    } else if admm.iteration == 0 {
        MAX_CG_ITERATIONS_FIRST
    } else if admm.parameters.has_v_cycles && admm.incumbent.gap() > EXTRA_CG_GAP {
        MAX_CG_ITERATIONS_LARGE_GAP
    } else {
        MAX_CG_ITERATIONS
    };
    ZStepAccuracy {
        max_iterations: max_iterations * admm.divergence.accuracy_factor(),
        reduction: if admm.iteration == 0 || is_weak {
            0.0
        } else {
            CG_REDUCTION
        },
        tolerance: None,
    }
}

/// Whether the iteration that was just begun ends with a check.
fn is_check<O: SolvableOperator>(admm: &Admm<O>) -> bool {
    let every = if admm.iteration <= FREQUENT_CHECKS_END {
        FREQUENT_CHECK_ITERATIONS
    } else {
        CHECK_ITERATIONS
    };
    admm.iteration.is_multiple_of(every) || admm.is_last()
}

/// Over-relaxation of the current iteration. Over-relaxation leaves nearly all of the highest frequencies of a
/// residual, with the opposite sign; so it is off at the start, where the iterate is full of them, where the bound is
/// evaluated, and after a divergence.
fn relaxation<O: SolvableOperator>(admm: &Admm<O>) -> f64 {
    let is_plain =
        admm.iteration <= UNRELAXED_ITERATIONS || is_check(admm) || admm.divergence.has_restarted();
    if is_plain { 1.0 } else { OVER_RELAXATION }
}

/// Whether the optimum of the energy has Hessians of rank one nearly everywhere, which dual ascent and rank
/// reduction rely on.
fn has_rank_one_optimum<O: SolvableOperator>(problem: &Problem<O>) -> bool {
    matches!(problem.kind, PenaltyKind::Nuclear | PenaltyKind::Huber(_))
        && !problem.has_weak_fidelity
}

/// Whether dual ascent may reach the requested gap from the current one.
fn is_ascent_useful<O: SolvableOperator>(admm: &Admm<O>) -> bool {
    let ratio = match admm.parameters.has_v_cycles {
        true => MAX_ASCENT_GAP_RATIO,
        false => MAX_ASCENT_GAP_RATIO_WITHOUT_V_CYCLES,
    };
    let (gap, requested) = (admm.incumbent.gap(), admm.parameters.gap);
    has_rank_one_optimum(&admm.problem) && gap > requested && gap < ratio * requested
}

/// Reason to stop after a check: the requested gap is certified. For an affine surface on a coarse level a larger gap
/// is enough, because the next lattice may certify it sooner.
fn stop_reason<O: SolvableOperator>(admm: &Admm<O>) -> Option<StopReason> {
    let incumbent = &admm.incumbent;
    let gap = if incumbent.is_affine && admm.parameters.is_coarse {
        MAX_AFFINE_GAP
    } else {
        admm.parameters.gap
    };
    let is_certified = incumbent.certifies(incumbent.objective(), gap);
    admm.stop_reason(gap, is_certified.then_some(StopReason::Gap))
}

//! The default schedule of ADMM: few conjugate-gradient iterations in each z-step, over-relaxation, dual ascent for the
//! dual bound, and a stop at a certified gap.
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

/// Maximum number of conjugate-gradient iterations in a z-step of the default schedule
/// (`benches/choices.md`, One constant at a time).
const MAX_CG_ITERATIONS: usize = 1;

/// Maximum number of conjugate-gradient iterations in a z-step on a lattice while the duality gap is large
/// (`benches/choices.md`, One constant at a time).
const MAX_CG_ITERATIONS_LARGE_GAP: usize = 2;

/// Maximum number of conjugate-gradient iterations in a z-step where some vertices have hardly any fidelity weight,
/// because a V-cycle reduces the error less there (`benches/choices.md`, One constant at a time).
const MAX_CG_ITERATIONS_WEAK_FIDELITY: usize = 4;

/// Relative duality gap above which a second conjugate-gradient iteration in each z-step pays. Below, it saves hardly
/// more iterations of ADMM than it costs (`benches/choices.md`, Constants of the schedule).
const EXTRA_CG_GAP: f64 = 0.03;

/// Squared residual at which a z-step ends, relative to the one at the start of that z-step
/// (`benches/choices.md`, Schedule by ablation).
const CG_REDUCTION: f64 = 0.005;

/// Over-relaxation factor of `Cz` in ADMM's updates of Hessians and dual
/// (`benches/choices.md`, One constant at a time).
const OVER_RELAXATION: f64 = 1.8;

/// Number of ADMM iterations from one check of the certificate to the next
/// (`benches/choices.md`, One constant at a time).
const CHECK_ITERATIONS: usize = 10;

/// Number of ADMM iterations from one check of the certificate to the next at the start of a multigrid level
/// (`benches/choices.md`, Schedule by ablation).
const FREQUENT_CHECK_ITERATIONS: usize = 5;

/// Number of ADMM iterations at the start of a multigrid level in which checks of the certificate are more frequent
/// (`benches/choices.md`, One constant at a time).
const FREQUENT_CHECKS_END: usize = 30;

/// Minimum requested duality gap at which rank reduction is applied; surfaces solved to a smaller gap have Hessians of
/// rank one already (`benches/choices.md`, One constant at a time).
const MIN_RANK_REDUCTION_GAP: f64 = 2e-3;

/// State of the default schedule on one multigrid level.
#[derive(Debug, Clone)]
pub(super) struct DefaultSchedule<O: SolvableOperator> {
    phase: Phase<O>,
    ascent_timer: AscentTimer,
    rho_changes: GrowingInterval,
    /// Buffers of the last dual ascent, kept for the next one.
    idle_ascent: Option<Box<DualAscent<O>>>,
}

/// What the default schedule is doing at the moment.
#[derive(Debug, Clone)]
enum Phase<O: SolvableOperator> {
    /// An ADMM iteration, interrupted in its z-step or about to begin.
    Iteration,
    /// Dual ascent from the iterate of a check; its outcome decides whether ADMM stops.
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
    /// Makes the schedule of a level, in which dual ascent is not tried before iteration `first_ascent_iteration`.
    pub(super) fn new(first_ascent_iteration: usize) -> Self {
        DefaultSchedule {
            phase: Phase::Iteration,
            ascent_timer: AscentTimer::new(first_ascent_iteration),
            rho_changes: GrowingInterval::default(),
            idle_ascent: None,
        }
    }

    /// Begins a level with its first iterate, or with the affine least-squares surface if that `may_be_affine` and has
    /// the smaller objective. Returns a reason to stop at once, if there is one.
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

    /// Begins a further pass, whose penalty weights differ from the last one's. Returns a reason to stop at once, if
    /// there is one.
    pub(super) fn begin_pass(&mut self, admm: &mut Admm<O>) -> Result<Option<StopReason>> {
        admm.try_affine()?;
        admm.begin_z_step();
        self.ascent_timer.begin_pass(admm.iteration);
        Ok(stop_reason(admm))
    }

    /// Continues ADMM until there is a reason to stop, which is returned, or until the budget of `left`
    /// conjugate-gradient iterations is used up.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
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

    /// Runs one ADMM iteration, or as much of it as the budget of `left` conjugate-gradient iterations allows.
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

    /// Computes the iterate's certificate, then decides at once or after dual ascent whether ADMM stops.
    fn check(&mut self, admm: &mut Admm<O>, change: f64) -> Result<Option<StopReason>> {
        let before = admm.incumbent.objective();
        let certificate = match admm.check()? {
            Check::Certified(certificate) => certificate,
            Check::Restarted(reason) => return Ok(reason),
        };
        let objective = admm.incumbent.objective();
        let has_settled = before - objective <= admm.parameters.gap * objective;
        if has_settled && !admm.parameters.follows_normals {
            self.ascent_timer.note_settled(admm.iteration);
        }
        self.ascend_or_decide(admm, certificate, change)
    }

    /// Begins dual ascent if that may reach the requested gap; decides at once whether ADMM stops if not.
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

    /// Continues dual ascent by one evaluation of the bound; at its end, decides whether ADMM stops.
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

    /// Decides whether ADMM stops, and changes ρ if it goes on.
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

    /// Begins rank reduction of the incumbent surface after the iterations have stopped for `reason`; returns `false`
    /// if rank reduction is not worthwhile.
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

    /// Continues rank reduction by one step; at its end, replaces the incumbent by the reduced surface if the dual
    /// bound certifies the requested gap for that as well.
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

/// Returns the accuracy to which the current z-step is to be solved.
fn z_step_accuracy<O: SolvableOperator>(admm: &Admm<O>) -> ZStepAccuracy {
    let is_weak = admm.problem.has_weak_fidelity;
    let max_iterations = if is_weak {
        MAX_CG_ITERATIONS_WEAK_FIDELITY
    } else if !admm.parameters.is_mesh && admm.incumbent.gap() > EXTRA_CG_GAP {
        MAX_CG_ITERATIONS_LARGE_GAP
    } else {
        MAX_CG_ITERATIONS
    };
    ZStepAccuracy {
        max_iterations: max_iterations * admm.divergence.accuracy_factor(),
        reduction: if is_weak { 0.0 } else { CG_REDUCTION },
        tolerance: None,
    }
}

/// Returns whether the ADMM iteration that was just begun ends with a check of its certificate.
fn is_check<O: SolvableOperator>(admm: &Admm<O>) -> bool {
    let every = if admm.iteration <= FREQUENT_CHECKS_END {
        FREQUENT_CHECK_ITERATIONS
    } else {
        CHECK_ITERATIONS
    };
    admm.iteration.is_multiple_of(every) || admm.is_last()
}

/// Returns the over-relaxation factor of the current ADMM iteration. Over-relaxation leaves nearly all of the highest
/// frequencies of a residual, with the opposite sign; so it is off (1) where the dual bound is evaluated, and after a
/// divergence.
fn relaxation<O: SolvableOperator>(admm: &Admm<O>) -> f64 {
    let is_plain = is_check(admm) || admm.divergence.has_restarted();
    if is_plain { 1.0 } else { OVER_RELAXATION }
}

/// Returns whether the optimal surface has Hessians of rank one nearly everywhere, which dual ascent and rank reduction
/// rely on.
fn has_rank_one_optimum<O: SolvableOperator>(problem: &Problem<O>) -> bool {
    matches!(problem.kind, PenaltyKind::Nuclear | PenaltyKind::Huber(_))
        && !problem.has_weak_fidelity
}

/// Returns whether dual ascent may reach the requested duality gap from the current one.
fn is_ascent_useful<O: SolvableOperator>(admm: &Admm<O>) -> bool {
    has_rank_one_optimum(&admm.problem) && admm.incumbent.gap() > admm.parameters.gap
}

/// Returns the reason to stop after a check, if there is one: the requested gap is certified, rounding errors, or the
/// iteration limit. For an affine surface on a coarse level a larger gap suffices, because the next finer lattice may
/// certify it sooner.
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

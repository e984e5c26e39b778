//! ADMM, as a machine that runs in steps.

use web_time::Instant;

use super::ascent::{Ascent, LOOK_CG_ITERATIONS};
use super::balance::{BALANCE_LIMITS, Balanced, balanced_bound};
use super::best::Best;
use super::rank::RankReduction;
use super::schedule::Plan;
use super::state::{Certificate, State};
use crate::error::Result;
use crate::fit::energy::creases::Creases;
use crate::fit::energy::problem::Problem;
use crate::fit::linear::zstep::{Solvable, Solver};
use crate::fit::report::{LevelReport, Seconds, StopReason};

#[derive(Debug, Clone)]
pub(crate) struct Level<O: Solvable> {
    pub problem: Problem<O>,
    pub state: State<O>,
    pub best: Best,
    /// The penalty at the start.
    pub first_rho: f64,
    pub seconds: Seconds,
    pub(super) plan: Plan,
    pub(super) solver: O::Solver,
    ascent: Option<Ascent<O>>,
    /// What is done to the surface at the very end, and why the iterations had stopped before.
    reduction: Option<(RankReduction, StopReason)>,
    /// A check whose search for a better bound is under way, and how much `z` changed before it.
    checking: Option<(Certificate, f64)>,
    /// The iteration from which on it is worth it again, and the first one of this pass.
    next_climb: usize,
    pass_start: usize,
    /// Whether the objective has settled for the first time in this pass.
    settled: bool,
    /// Conjugate-gradient iterations of the z-step under way, and of its current round.
    z_step: usize,
    round: usize,
    /// Right-hand side energy at the start of the round.
    first_energy: f64,
    iteration: usize,
    /// When the certificate was last balanced, and when ρ last changed.
    balanced: usize,
    tuned: usize,
    pub(super) cg_iterations: usize,
    /// Objective at the last check (of a start, it says nothing), and how often it went out of hand.
    last_objective: f64,
    recoveries: usize,
    /// Until this iteration the surface follows a load, which is next to nothing of the energy: any
    /// iterate takes the place of the best one, and a small gap says nothing.
    follows_until: usize,
}

/// Number of iterations in which a surface follows a load.
const LOAD_ITERATIONS: usize = 10;

/// An objective that grows by more than this from one check to the next, and is as much above the
/// input's, is out of hand.
const OUT_OF_HAND: f64 = 10.0;

/// Most recoveries from that.
const MOST_RECOVERIES: usize = 6;

impl<O: Solvable> Level<O> {
    /// Starts from `state`, with the solver of its z-steps, or from the affine surface if that
    /// `may_be_affine`, and looks for better bounds from the iteration `next_climb` on; a reason to
    /// stop at once comes with it.
    pub(crate) fn new(
        problem: Problem<O>,
        mut state: State<O>,
        solver: O::Solver,
        plan: Plan,
        next_climb: usize,
        may_be_affine: bool,
    ) -> Result<(Self, Option<StopReason>)> {
        let start = Instant::now();
        let certificate = state.certify(&problem);
        // A start from a coarser level need not be better than the input.
        let mut best = Best::of_input(&problem);
        best.take(&state.z, &certificate);
        let mut level = Level {
            first_rho: state.rho,
            follows_until: 0,
            problem,
            state,
            best,
            seconds: Seconds::default(),
            plan,
            first_energy: 0.0,
            solver,
            ascent: None,
            reduction: None,
            checking: None,
            next_climb,
            pass_start: 0,
            settled: false,
            z_step: 0,
            round: 0,
            iteration: 0,
            balanced: 0,
            tuned: 0,
            cg_iterations: 0,
            last_objective: f64::MAX,
            recoveries: 0,
        };
        if may_be_affine {
            level.try_affine()?;
        }
        level.start_z_step();
        let reason = level.settle_check(certificate, 0.0)?;
        level.seconds.setup = start.elapsed().as_secs_f64();
        Ok((level, reason))
    }

    pub(crate) fn report(&self) -> LevelReport {
        LevelReport {
            spacing: self.problem.operator.spacing(),
            interior: self.problem.operator.stencils().len(),
            iterations: self.iteration,
            cg_iterations: self.cg_iterations,
        }
    }

    /// Runs until `left` conjugate-gradient iterations are used up or there is a
    /// reason to stop.
    ///
    /// # Errors
    /// Out of memory.
    pub(crate) fn advance(&mut self, left: &mut usize) -> Result<Option<StopReason>> {
        while *left > 0 {
            let start = Instant::now();
            if self.reduction.is_some() {
                *left = left.saturating_sub(2);
                let reason = self.lower_rank();
                self.seconds.z_step += start.elapsed().as_secs_f64();
                if reason.is_some() {
                    return Ok(reason);
                }
                continue;
            }
            if self.checking.is_some() {
                *left = left.saturating_sub(LOOK_CG_ITERATIONS);
                let reason = self.look();
                self.seconds.certificate += start.elapsed().as_secs_f64();
                if reason.is_some() {
                    return Ok(reason);
                }
                continue;
            }
            let done = self.run_z_step(left);
            self.seconds.z_step += start.elapsed().as_secs_f64();
            if done {
                // The update costs about as much; so a solve without work for CG ends as well.
                *left = left.saturating_sub(1);
                let reason = self.finish_iteration()?;
                if reason.is_some() {
                    return Ok(reason);
                }
            }
        }
        Ok(None)
    }

    /// Goes on with the z-step under way; tells whether it is complete.
    fn run_z_step(&mut self, left: &mut usize) -> bool {
        let limit = self
            .plan
            .cg_limit(&self.problem, self.iteration, self.best.gap());
        loop {
            let tight = self.plan.cg_tolerance > 0.0;
            if tight
                && self.round == 0
                && self.solver.relative_residual(&self.problem) <= self.plan.cg_tolerance
            {
                return true;
            }
            let reduction = self.plan.cg_reduction(&self.problem, self.iteration);
            let goal = reduction * self.first_energy;
            while self.z_step < limit && self.solver.energy() > goal {
                if *left == 0 {
                    return false;
                }
                *left -= 1;
                if !self.solver.step(&self.problem.operator) {
                    break;
                }
                self.z_step += 1;
                self.round += 1;
                self.cg_iterations += 1;
            }
            let moved = self.round > 0;
            self.round = 0;
            self.solver
                .correct(&self.problem.operator, &mut self.state.z);
            if !tight || !moved || self.z_step >= limit {
                return true;
            }
            self.state.update(&self.problem, 0.0, &mut self.solver);
            self.first_energy = self.solver.energy();
        }
    }

    /// Makes the z-step's right-hand side anew.
    fn start_z_step(&mut self) {
        self.state.update(&self.problem, 0.0, &mut self.solver);
        self.first_energy = self.solver.energy();
    }

    /// H-step, dual update and, when one is due, the certificate.
    fn finish_iteration(&mut self) -> Result<Option<StopReason>> {
        let start = Instant::now();
        self.z_step = 0;
        self.iteration += 1;
        if self.plan.follows_normals {
            self.problem.take_normals(&self.state.z)?;
        }
        let check = self.plan.is_check(self.iteration);
        let relaxation = self.plan.relaxation(self.iteration);
        let state = &mut self.state;
        let change = if check && self.plan.measures_change(&self.problem) {
            state.update_and_measure(&self.problem, relaxation, &mut self.solver)
        } else {
            state.update(&self.problem, relaxation, &mut self.solver);
            0.0
        };
        self.first_energy = self.solver.energy();
        self.seconds.h_step += start.elapsed().as_secs_f64();
        if !check {
            return Ok(None);
        }
        let start = Instant::now();
        let reason = self.check(change)?;
        self.seconds.certificate += start.elapsed().as_secs_f64();
        Ok(reason)
    }

    fn check(&mut self, change: f64) -> Result<Option<StopReason>> {
        let mut certificate = self.state.certify(&self.problem);
        if self.is_out_of_hand(&certificate) {
            return Ok(self.recover());
        }
        let balance = self.problem.loose && self.plan.is_balance(self.iteration, self.balanced);
        if balance {
            self.balanced = self.iteration;
            let (z, rho) = (self.state.z.clone(), self.state.rho);
            let (state, solver) = (&mut self.state, &mut self.solver);
            let Balanced { bound, steps, .. } =
                balanced_bound(state, &self.problem, &z, rho, solver, BALANCE_LIMITS)?;
            self.cg_iterations += steps;
            certificate.dual_bound = certificate.dual_bound.max(bound);
        }
        if self.plan.follows_normals || self.iteration <= self.follows_until {
            // Another energy than at the last check.
            self.best.replace(&self.state.z, &certificate);
        } else {
            let before = self.best.objective();
            self.best.take(&self.state.z, &certificate);
            self.settle(before);
        }
        self.settle_check(certificate, change)
    }

    /// Decides after a check, at once or after a search for a better bound.
    fn settle_check(
        &mut self,
        certificate: Certificate,
        change: f64,
    ) -> Result<Option<StopReason>> {
        if self.begin_climb()? {
            self.checking = Some((certificate, change));
            return Ok(None);
        }
        Ok(self.decide(&certificate, change))
    }

    /// Goes on with the search; a reason to stop may come of what it has found.
    fn look(&mut self) -> Option<StopReason> {
        let (Some(ascent), Some((certificate, change))) = (&mut self.ascent, self.checking.take())
        else {
            return None;
        };
        let Some(bound) = ascent.look(&mut self.state, &self.problem) else {
            self.checking = Some((certificate, change));
            return None;
        };
        self.best.dual_bound = bound;
        let iterations = self.iteration - self.pass_start;
        self.next_climb = self.pass_start + self.plan.next_climb(iterations, self.best.gap());
        self.decide(&certificate, change)
    }

    /// Whether to stop, and the penalty from here on.
    fn decide(&mut self, certificate: &Certificate, change: f64) -> Option<StopReason> {
        let reason = self.plan.stop(
            &self.problem,
            self.iteration,
            certificate,
            change,
            &self.best,
        );
        let reason = reason.filter(|_| self.iteration >= self.follows_until);
        let rho = self
            .plan
            .next_rho(&self.problem, self.state.rho, certificate, change);
        let due = self.iteration > 0 && self.plan.may_tune(self.iteration, self.tuned);
        if reason.is_none() && due && rho != self.state.rho {
            self.tuned = self.iteration;
            self.state.set_rho(&self.problem, rho);
            self.solver.set_rho(rho);
            self.start_z_step();
        }
        reason
    }

    /// Whether the iterates diverge, as they may where z-steps are too inexact for their domain.
    fn is_out_of_hand(&mut self, certificate: &Certificate) -> bool {
        let objective = certificate.objective();
        let last = std::mem::replace(&mut self.last_objective, objective);
        let bounded = objective <= OUT_OF_HAND * last
            || objective <= OUT_OF_HAND * self.problem.smoothness(&self.problem.target);
        !(bounded && certificate.dual_residual.is_finite())
    }

    /// Back to the best surface, and on with z-steps that are more exact.
    fn recover(&mut self) -> Option<StopReason> {
        self.recoveries += 1;
        if self.recoveries > MOST_RECOVERIES {
            return Some(StopReason::Diverged);
        }
        self.plan.be_more_exact();
        self.state.start_again(&self.best.z);
        self.last_objective = f64::MAX;
        self.start_z_step();
        let last = self.plan.is_last(self.iteration);
        last.then_some(StopReason::MaxIterations)
    }

    /// Once the surface has settled, all that is left to find is a bound: it is looked for then,
    /// however long levels before have taken.
    fn settle(&mut self, before: f64) {
        if !self.settled && self.plan.has_settled(before, self.best.objective()) {
            self.settled = true;
            self.next_climb = self.next_climb.min(self.iteration);
        }
    }

    /// Begins to look for a better bound with this iterate, if that is worth it.
    fn begin_climb(&mut self) -> Result<bool> {
        let worth = self.plan.climbs(&self.problem, self.best.gap());
        let due = self.iteration >= self.next_climb || self.plan.is_last(self.iteration);
        // Of another energy at each check, no bound is kept.
        let due = due || self.plan.follows_normals;
        if !worth || !due {
            return Ok(false);
        }
        let bound = self.best.dual_bound;
        let goal = self.plan.bound_wanted(self.best.objective());
        let ascent = match &mut self.ascent {
            Some(ascent) => ascent,
            none => none.insert(Ascent::new(&self.problem)?),
        };
        ascent.begin(&mut self.state, &self.problem, bound, goal)?;
        Ok(true)
    }

    /// Begins to bring the rank of the best surface's Hessians down, if that is worth it.
    pub(crate) fn begin_reduction(&mut self, reason: StopReason) -> Result<bool> {
        if reason != StopReason::Gap || self.best.affine || !self.plan.reduces_rank(&self.problem) {
            return Ok(false);
        }
        // Its memory is free for that.
        self.ascent = None;
        let reduction = RankReduction::new(&self.problem, &self.best.z)?;
        self.reduction = reduction.map(|reduction| (reduction, reason));
        Ok(self.reduction.is_some())
    }

    /// Goes on with that; at the end, takes the surface if it is certified as well.
    fn lower_rank(&mut self) -> Option<StopReason> {
        let (reduction, reason) = self.reduction.as_mut()?;
        let reason = *reason;
        self.cg_iterations += 1;
        let z = reduction.step(&self.problem, &mut self.state, &mut self.solver)?;
        let (fidelity, nuclear_norm) = (self.problem.distance(z), self.problem.smoothness(z));
        if self.plan.is_certified(fidelity + nuclear_norm, &self.best) {
            self.best.z.copy_from_slice(z);
            (self.best.fidelity, self.best.nuclear_norm) = (fidelity, nuclear_norm);
        }
        self.reduction = None;
        Some(reason)
    }

    /// Another pass, in which every vertex's norm is weighted by one over its
    /// size in the best surface so far. A reason to stop at once comes with it.
    pub(crate) fn reweight(&mut self) -> Result<Option<StopReason>> {
        self.problem.reweight(&self.best.z)?;
        self.begin_pass()
    }

    /// Makes creases cost less, if enough of them change by that.
    pub(crate) fn reweight_creases(&mut self, radius: f64) -> Result<Creases> {
        self.problem.reweight_creases(&self.best.z, radius)
    }

    /// Another pass, with other weights or a border that has been `loaded`.
    pub(crate) fn begin_pass_at_creases(&mut self, loaded: bool) -> Result<Option<StopReason>> {
        let stop = self.begin_pass()?;
        if loaded {
            self.follow_load(LOAD_ITERATIONS);
            return Ok(None);
        }
        Ok(stop)
    }

    /// Makes the surface follow a load for so many iterations.
    pub(crate) fn follow_load(&mut self, iterations: usize) {
        self.follows_until = self.iteration + iterations;
    }

    /// Goes on with other weights.
    fn begin_pass(&mut self) -> Result<Option<StopReason>> {
        let certificate = self.state.certify(&self.problem);
        self.best.replace(&self.state.z, &certificate);
        self.last_objective = f64::MAX;
        self.try_affine()?;
        self.start_z_step();
        self.z_step = 0;
        self.pass_start = self.iteration;
        self.next_climb = self.iteration;
        self.settled = false;
        Ok(self.plan.stop(
            &self.problem,
            self.iteration,
            &certificate,
            f64::INFINITY,
            &self.best,
        ))
    }
}

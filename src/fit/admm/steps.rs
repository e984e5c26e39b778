//! The steps of ADMM that both schedules are made of: z-step, update of Hessians and dual, check, change of ρ.

use web_time::Instant;

use super::balance::balanced_bound;
use super::certificate::Certificate;
use super::divergence::DivergenceGuard;
use super::incumbent::Incumbent;
use super::iterate::Iterate;
use super::parameters::AdmmParameters;
use super::timing::GrowingInterval;
use super::z_step::{ZStep, ZStepAccuracy};
use crate::error::Result;
use crate::fit::energy::problem::Problem;
use crate::fit::linear::z_step_solver::{SolvableOperator, ZStepSolver};
use crate::fit::report::{Seconds, StopReason};

/// Minimum number of ADMM iterations between two balancings of the dual, each of which costs about as much as these
/// iterations (`benches/choices.md`, One constant at a time).
const BALANCE_ITERATIONS: usize = 20;

/// ADMM on one multigrid level without a schedule: problem, iterate and incumbent.
#[derive(Debug, Clone)]
pub(crate) struct Admm<O: SolvableOperator> {
    pub problem: Problem<O>,
    pub iterate: Iterate<O>,
    pub incumbent: Incumbent,
    /// Value of ρ at the start of the level.
    pub initial_rho: f64,
    pub seconds: Seconds,
    pub(super) parameters: AdmmParameters,
    /// Linear solver of the z-steps.
    pub(super) solver: O::Solver,
    /// Number of ADMM iterations whose z-step is complete.
    pub(super) iteration: usize,
    pub(super) cg_iterations: usize,
    pub(super) divergence: DivergenceGuard,
    z_step: ZStep,
    balancing: GrowingInterval,
}

/// Outcome of a check of ADMM's iterate.
pub(super) enum Check {
    Certified(Certificate),
    /// The iterates diverged and ADMM started again from the incumbent, unless there is a reason to stop.
    Restarted(Option<StopReason>),
}

impl<O: SolvableOperator> Admm<O> {
    /// Starts ADMM at an iterate; also returns the iterate's certificate.
    pub(super) fn new(
        problem: Problem<O>,
        mut iterate: Iterate<O>,
        solver: O::Solver,
        parameters: AdmmParameters,
    ) -> (Self, Certificate) {
        let certificate = iterate.certify(&problem);
        // An iterate from a coarser level may be worse than the input.
        let mut incumbent = Incumbent::from_input(&problem);
        incumbent.update(&iterate.z, &certificate);
        let admm = Admm {
            initial_rho: iterate.rho,
            problem,
            iterate,
            incumbent,
            seconds: Seconds::default(),
            parameters,
            solver,
            iteration: 0,
            cg_iterations: 0,
            divergence: DivergenceGuard::new(),
            z_step: ZStep::default(),
            balancing: GrowingInterval::default(),
        };
        (admm, certificate)
    }

    /// Begins a z-step: makes its right-hand side from the iterate.
    pub(super) fn begin_z_step(&mut self) {
        self.iterate.update(&self.problem, 0.0, &mut self.solver);
        self.z_step = ZStep::new::<O>(&self.solver);
    }

    /// Continues the z-step (Eq. 17); returns whether it is complete, and then counts the iteration. The budget of
    /// `left` conjugate-gradient iterations also pays for the update that follows, which costs about one of them, so
    /// that a solve without work for conjugate gradients ends as well.
    pub(super) fn advance_z_step(&mut self, accuracy: ZStepAccuracy, left: &mut usize) -> bool {
        let start = Instant::now();
        let before = self.z_step.iterations();
        let (problem, iterate, solver) = (&self.problem, &mut self.iterate, &mut self.solver);
        let is_complete = self
            .z_step
            .advance(accuracy, problem, iterate, solver, left);
        self.cg_iterations += self.z_step.iterations() - before;
        if is_complete {
            self.iteration += 1;
            *left = left.saturating_sub(1);
        }
        self.seconds.z_step += start.elapsed().as_secs_f64();
        is_complete
    }

    /// Updates Hessians and dual (Eq. 18 and 19) with the over-relaxation `relaxation`, and begins the next z-step.
    /// Returns `ρ‖ΔH‖`, the change of the Hessians, or 0 where that is not measured.
    pub(super) fn update_hessians_and_dual(
        &mut self,
        relaxation: f64,
        measures_change: bool,
    ) -> Result<f64> {
        let start = Instant::now();
        if self.parameters.follows_normals {
            self.problem.set_normal_weights(&self.iterate.z)?;
        }
        let (iterate, problem, solver) = (&mut self.iterate, &self.problem, &mut self.solver);
        let change = if measures_change {
            iterate.update_and_measure(problem, relaxation, solver)
        } else {
            iterate.update(problem, relaxation, solver);
            0.0
        };
        self.z_step = ZStep::new::<O>(&self.solver);
        self.seconds.h_step += start.elapsed().as_secs_f64();
        Ok(change)
    }

    /// Computes the iterate's certificate and updates the incumbent; restarts from the incumbent if the iterates
    /// diverge.
    pub(super) fn check(&mut self) -> Result<Check> {
        let mut certificate = self.iterate.certify(&self.problem);
        let input_objective = || self.problem.smoothness(&self.problem.target);
        let (objective, residual) = (certificate.objective(), certificate.dual_residual);
        let divergence = &mut self.divergence;
        if divergence.is_divergent(objective, residual, input_objective) {
            return Ok(Check::Restarted(self.restart()));
        }
        if self.problem.has_weak_fidelity && self.is_balance_due() {
            self.balancing.restart(self.iteration);
            let (z, rho) = (self.iterate.z.clone(), self.iterate.rho);
            let (problem, solver) = (&self.problem, &mut self.solver);
            let balanced = balanced_bound(&mut self.iterate, problem, &z, rho, solver)?;
            self.cg_iterations += balanced.iterations;
            certificate.dual_bound = certificate.dual_bound.max(balanced.bound);
        }
        if self.parameters.follows_normals {
            self.incumbent.replace(&self.iterate.z, &certificate);
        } else {
            self.incumbent.update(&self.iterate.z, &certificate);
        }
        Ok(Check::Certified(certificate))
    }

    fn is_balance_due(&self) -> bool {
        self.balancing
            .has_passed(self.iteration, BALANCE_ITERATIONS)
            || self.is_last()
    }

    /// Restarts ADMM from the incumbent after a divergence, with more accurate z-steps. Returns a reason to stop, if
    /// there is one.
    fn restart(&mut self) -> Option<StopReason> {
        if !self.divergence.restart() {
            return Some(StopReason::Diverged);
        }
        self.iterate.reset(&self.incumbent.z);
        self.begin_z_step();
        self.is_last().then_some(StopReason::MaxIterations)
    }

    /// Changes ρ between two iterations of ADMM.
    pub(super) fn set_rho(&mut self, rho: f64) {
        self.iterate.set_rho(&self.problem, rho);
        self.solver.set_rho(rho);
        self.begin_z_step();
    }

    /// Returns the reason to stop after a check, if there is one: rounding errors, `of_schedule`, or the number of
    /// iterations. `gap` is the requested relative duality gap.
    pub(super) fn stop_reason(
        &self,
        gap: f64,
        of_schedule: Option<StopReason>,
    ) -> Option<StopReason> {
        if self.incumbent.is_exact(gap) {
            return Some(StopReason::Rounding);
        }
        of_schedule.or(self.is_last().then_some(StopReason::MaxIterations))
    }

    /// Returns whether the current iteration is the last one allowed.
    pub(super) fn is_last(&self) -> bool {
        self.parameters.is_last(self.iteration)
    }

    /// Begins a pass whose penalty weights differ from the last one's: computes the iterate's certificate under these
    /// weights and makes it the incumbent.
    pub(super) fn begin_pass(&mut self) -> Certificate {
        let certificate = self.iterate.certify(&self.problem);
        self.incumbent.replace(&self.iterate.z, &certificate);
        self.divergence.forget_objective();
        certificate
    }
}

//! ADMM on one level under either schedule, in steps that can be interrupted.

use web_time::Instant;

use super::default_rho;
use super::default_schedule::DefaultSchedule;
use super::iterate::Iterate;
use super::paper;
use super::parameters::AdmmParameters;
use super::steps::Admm;
use crate::error::Result;
use crate::fit::energy::creases::Creases;
use crate::fit::energy::problem::Problem;
use crate::fit::linear::zstep::SolvableOperator;
use crate::fit::options::Schedule;
use crate::fit::report::{LevelReport, StopReason};

/// Number of iterations in which a surface follows the load on its border.
const LOAD_WARMUP_ITERATIONS: usize = 10;

/// ADMM on one level, with the schedule that it follows.
#[derive(Debug, Clone)]
pub(crate) struct AdmmSolver<O: SolvableOperator> {
    pub admm: Admm<O>,
    schedule: ScheduleState<O>,
}

/// How far the schedule has come; that of the paper has nothing to remember.
#[derive(Debug, Clone)]
enum ScheduleState<O: SolvableOperator> {
    Paper,
    Default(DefaultSchedule<O>),
}

/// ρ at the start of the first level.
pub(crate) fn initial_rho<O: SolvableOperator>(
    parameters: &AdmmParameters,
    problem: &Problem<O>,
) -> f64 {
    match parameters.schedule {
        Schedule::Default => default_rho::initial_rho(problem),
        Schedule::Paper => paper::INITIAL_RHO,
    }
}

impl<O: SolvableOperator> AdmmSolver<O> {
    /// Starts from an iterate, with the solver of its z-steps, or from the affine surface of least squares if it
    /// `may_be_affine`. The default schedule tries dual ascent from an iteration on. A reason to stop at once
    /// comes with it.
    ///
    /// # Errors
    /// Out of memory.
    pub(crate) fn new(
        problem: Problem<O>,
        iterate: Iterate<O>,
        solver: O::Solver,
        parameters: AdmmParameters,
        first_ascent_iteration: usize,
        may_be_affine: bool,
    ) -> Result<(Self, Option<StopReason>)> {
        let start = Instant::now();
        let (mut admm, certificate) = Admm::new(problem, iterate, solver, parameters);
        let (schedule, reason) = match parameters.schedule {
            Schedule::Paper => (ScheduleState::Paper, paper::start(&mut admm, &certificate)),
            Schedule::Default => {
                let mut schedule = DefaultSchedule::new(first_ascent_iteration);
                let reason = schedule.start(&mut admm, certificate, may_be_affine)?;
                (ScheduleState::Default(schedule), reason)
            }
        };
        admm.seconds.setup = start.elapsed().as_secs_f64();
        Ok((AdmmSolver { admm, schedule }, reason))
    }

    /// The work on this level so far.
    pub(crate) fn report(&self) -> LevelReport {
        let operator = &self.admm.problem.operator;
        LevelReport {
            spacing: operator.spacing(),
            interior: operator.stencils().len(),
            iterations: self.admm.iteration,
            cg_iterations: self.admm.cg_iterations,
        }
    }

    /// Continues until there is a reason to stop, or until the budget of conjugate-gradient iterations is
    /// `left` empty.
    ///
    /// # Errors
    /// Out of memory.
    pub(crate) fn advance(&mut self, left: &mut usize) -> Result<Option<StopReason>> {
        match &mut self.schedule {
            ScheduleState::Paper => paper::advance(&mut self.admm, left),
            ScheduleState::Default(schedule) => schedule.advance(&mut self.admm, left),
        }
    }

    /// Begins another pass, in which every stencil's norm is weighted by one over its size in the incumbent. A
    /// reason to stop at once comes with it.
    pub(crate) fn reweight(&mut self) -> Result<Option<StopReason>> {
        self.admm.problem.reweight(&self.admm.incumbent.z)?;
        self.begin_pass()
    }

    /// Makes creases cost less, if enough of them change by that.
    pub(crate) fn reweight_creases(&mut self, radius: f64) -> Result<Creases> {
        let Admm {
            problem, incumbent, ..
        } = &mut self.admm;
        problem.reweight_creases(&incumbent.z, radius)
    }

    /// Begins another pass after the weights at creases have changed, or the border was `loaded`. A reason to
    /// stop at once comes with it.
    pub(crate) fn begin_pass_at_creases(&mut self, loaded: bool) -> Result<Option<StopReason>> {
        let reason = self.begin_pass()?;
        if loaded {
            self.follow_load(LOAD_WARMUP_ITERATIONS);
            return Ok(None);
        }
        Ok(reason)
    }

    /// Makes the surface follow a load on its border for a number of iterations, before which it does not stop.
    pub(crate) fn follow_load(&mut self, iterations: usize) {
        self.admm.warmup.start(self.admm.iteration, iterations);
    }

    fn begin_pass(&mut self) -> Result<Option<StopReason>> {
        let certificate = self.admm.begin_pass();
        match &mut self.schedule {
            ScheduleState::Paper => Ok(paper::start(&mut self.admm, &certificate)),
            ScheduleState::Default(schedule) => schedule.begin_pass(&mut self.admm),
        }
    }

    /// Begins to bring the incumbent's Hessians to rank one after the iterations have stopped for a `reason`;
    /// `false` if that is not worth it.
    pub(crate) fn begin_rank_reduction(&mut self, reason: StopReason) -> Result<bool> {
        match &mut self.schedule {
            ScheduleState::Paper => Ok(false),
            ScheduleState::Default(schedule) => schedule.begin_rank_reduction(&self.admm, reason),
        }
    }
}

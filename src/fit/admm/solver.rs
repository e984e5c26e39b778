//! ADMM on one multigrid level under either schedule, in steps that can be interrupted.

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
use crate::fit::linear::z_step_solver::SolvableOperator;
use crate::fit::options::Schedule;
use crate::fit::report::{LevelReport, StopReason};

/// ADMM on one multigrid level, with the schedule that it follows.
#[derive(Debug, Clone)]
pub(crate) struct AdmmSolver<O: SolvableOperator> {
    pub admm: Admm<O>,
    schedule: ScheduleState<O>,
}

/// State of ADMM's schedule; the paper's schedule has none.
#[derive(Debug, Clone)]
enum ScheduleState<O: SolvableOperator> {
    Paper,
    Default(DefaultSchedule<O>),
}

/// Initial ρ on the first multigrid level, under the schedule of `parameters`.
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
    /// Starts ADMM from an iterate, with the solver of its z-steps, or from the affine least-squares surface if the
    /// iterate `may_be_affine`. The default schedule tries dual ascent from iteration `first_ascent_iteration` on. Also
    /// returns a reason to stop at once, if there is one.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
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

    /// Reports the work done on this multigrid level so far.
    pub(crate) fn report(&self) -> LevelReport {
        let operator = &self.admm.problem.operator;
        LevelReport {
            spacing: operator.spacing(),
            interior: operator.stencils().len(),
            iterations: self.admm.iteration,
            cg_iterations: self.admm.cg_iterations,
        }
    }

    /// Continues ADMM until there is a reason to stop, which is returned, or until the budget of `left`
    /// conjugate-gradient iterations is used up.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub(crate) fn advance(&mut self, left: &mut usize) -> Result<Option<StopReason>> {
        match &mut self.schedule {
            ScheduleState::Paper => paper::advance(&mut self.admm, left),
            ScheduleState::Default(schedule) => schedule.advance(&mut self.admm, left),
        }
    }

    /// Begins a reweighting pass, in which every stencil's norm is weighted by one over its size in the incumbent.
    /// Returns a reason to stop at once, if there is one.
    pub(crate) fn reweight(&mut self) -> Result<Option<StopReason>> {
        self.admm.problem.reweight(&self.admm.incumbent.z)?;
        self.begin_pass()
    }

    /// Reduces the penalty weights of stencils on sharp creases of the incumbent, of a bend radius below `radius`.
    pub(crate) fn reweight_creases(&mut self, radius: f64) -> Result<Creases> {
        let Admm {
            problem, incumbent, ..
        } = &mut self.admm;
        problem.reweight_creases(&incumbent.z, radius)
    }

    /// Begins a crease pass, after the penalty weights at creases have changed or the border was `loaded`. Returns a
    /// reason to stop at once, if there is one: not where the border was loaded, because a load is a tiny part of the energy, and the
    /// gap says nothing before the surface has followed it.
    pub(crate) fn begin_pass_at_creases(&mut self, loaded: bool) -> Result<Option<StopReason>> {
        Ok(self.begin_pass()?.filter(|_| !loaded))
    }

    fn begin_pass(&mut self) -> Result<Option<StopReason>> {
        let certificate = self.admm.begin_pass();
        match &mut self.schedule {
            ScheduleState::Paper => Ok(paper::start(&mut self.admm, &certificate)),
            ScheduleState::Default(schedule) => schedule.begin_pass(&mut self.admm),
        }
    }

    /// Begins to reduce the incumbent's Hessians to rank one after the iterations have stopped for a `reason`; returns
    /// `false` if that is not worthwhile.
    pub(crate) fn begin_rank_reduction(&mut self, reason: StopReason) -> Result<bool> {
        match &mut self.schedule {
            ScheduleState::Paper => Ok(false),
            ScheduleState::Default(schedule) => schedule.begin_rank_reduction(&self.admm, reason),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::fit::coordinates::Coordinates;
    use crate::fit::heightfields;
    use crate::fit::linear::cg::ConjugateGradients;
    use crate::math::sym2::Sym2;
    use crate::{Heightfield, Input, Lattice, Options};

    /// A noisy roof under the default schedule, after some iterations.
    fn started() -> heightfields::AdmmSolver {
        let lattice = Lattice::new(20, 20, 0.05).unwrap();
        let field = Heightfield::from_fn(lattice, |x, y| {
            0.3 * (x - 0.4 * y - 0.6).abs() + 0.01 * (97.0 * x + 61.0 * y).sin()
        })
        .unwrap();
        let input = Input::new(field);
        let domain = Arc::new(input.domain().unwrap());
        let coordinates = Coordinates::new(&input, &domain, 1.0);
        let options = Options::paper()
            .lambda(1e4)
            .schedule(Schedule::Default)
            .gap(1e-4);
        let problem =
            heightfields::Problem::new(&input, domain.clone(), &coordinates, &options).unwrap();
        let parameters = AdmmParameters::new(&options);
        let iterate = Iterate::new(&problem, initial_rho(&parameters, &problem)).unwrap();
        let domains = std::slice::from_ref(&domain);
        let cg = ConjugateGradients::new(&problem, domains, iterate.rho).unwrap();
        let (mut solver, reason) =
            AdmmSolver::new(problem, iterate, cg, parameters, usize::MAX, false).unwrap();
        assert_eq!(reason, None);
        assert_eq!(solver.advance(&mut 12).unwrap(), None);
        solver
    }

    /// Makes the Hessians so large that no z-step brings the surface back before the next check.
    fn spoil(solver: &mut heightfields::AdmmSolver) {
        let Admm {
            problem, iterate, ..
        } = &mut solver.admm;
        for (number, stencil) in problem.operator.domain.interior().cells().enumerate() {
            let sign = if number % 3 == 0 { 1.0 } else { -1.0 };
            let hessian = Sym2::new(sign * 1e9, 0.0, 1e9);
            iterate.set_matrices(stencil, Sym2::default(), hessian);
        }
    }

    #[test]
    fn iterates_that_diverge_start_again_from_the_incumbent() {
        let mut solver = started();
        let before = solver.admm.incumbent.objective();
        spoil(&mut solver);
        let mut reason = None;
        while reason.is_none() {
            reason = solver.advance(&mut 100).unwrap();
        }
        assert_eq!(reason, Some(StopReason::Gap));
        assert!(solver.admm.divergence.has_restarted());
        assert!(solver.admm.incumbent.objective() <= before);
    }
}

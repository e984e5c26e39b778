//! The public solver of heightfields: chooses λ where that is asked, then solves for the surface.

use std::ops::ControlFlow;
use std::sync::Arc;

use web_time::Instant;

use super::component_solver::{ComponentSolver, PreparedInput, StartMode, Status};
use super::input::Input;
use super::options::Options;
use super::report::{LambdaChoice, LambdaReason, Progress, StopReason};
use super::surface::Surface;
use super::threads::Threads;
use super::tuning::closed_form::{self, InputStatistics};
use super::tuning::levelling::Levelling;
use super::tuning::noise::Noise;
use super::tuning::refinement::{MAX_NOISE_DISTANCE, MAX_RESIDUAL, Next, Refinement};
use super::tuning::residual::root_mean_square;
use super::tuning::search::Search;
use super::warm_start::WarmStart;
use crate::error::Result;

/// A solve that runs in steps, so that its caller can look at it, draw, or stop
/// it in between.
///
/// ```
/// use developable::{Heightfield, Lattice, Options, Solver, Status};
/// # fn main() -> developable::Result<()> {
/// let lattice = Lattice::new(30, 30, 1.0)?;
/// let field = Heightfield::from_fn(lattice, |x, y| 0.01 * x * x + 0.1 * (7.0 * y).sin())?;
/// let mut solver = Solver::new(&field, &Options::default())?;
/// while solver.advance(100)? == Status::Running {
///     println!("gap {:.3?}", solver.progress().gap);
/// }
/// assert!(solver.surface()?.report().is_certified(0.01));
/// # Ok(())
/// # }
/// ```
#[derive(Debug, Clone)]
pub struct Solver {
    /// Levelling of the input's rows and columns, until it is finished.
    levelling: Option<Levelling>,
    /// Search for the penalty, until it is finished.
    search: Option<Search>,
    choice: Option<LambdaChoice>,
    /// Refinement of λ by solves at full size, until it is finished.
    refinement: Option<Refinement>,
    /// Noise of the input, where λ or the penalty is chosen by it.
    noise: Option<Noise>,
    solve: ComponentSolver,
    threads: Threads,
}

impl Solver {
    /// Sets up a solve; the first calls of [`Solver::advance`] do the costly part. Memory: about 180 bytes for each
    /// vertex of the valid vertices' bounding box.
    ///
    /// # Errors
    /// [`Error::Option`](crate::Error::Option) for an option out of range,
    /// [`Error::NoInterior`](crate::Error::NoInterior) if there is nothing to solve,
    /// [`Error::Underdetermined`](crate::Error::Underdetermined) if a part of the surface is not held in place,
    /// [`Error::Overflow`](crate::Error::Overflow) or [`Error::Underflow`](crate::Error::Underflow) if the heights are
    /// too large or too small for their energy to be computed, [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn new(input: impl Into<Input>, options: &Options) -> Result<Self> {
        Solver::set_up(input.into(), options, None)
    }

    fn set_up(input: Input, options: &Options, warm_start: Option<Arc<WarmStart>>) -> Result<Self> {
        let started = Instant::now();
        options.validate()?;
        let is_design = input.is_design();
        options.check_effects_on(is_design, input.has_free_vertices())?;
        // Faults of the sensor are repaired where λ is to be found from the heights.
        let input = match options.chooses_lambda() {
            true => input.without_spikes()?,
            false => input,
        };
        let prepared = PreparedInput::new(input)?;
        let threads = Threads::new(options.threads, &prepared.domain);
        let asked = options.with_energy_for(is_design);
        threads.run(|| Solver::start(prepared, asked, [0; 2], threads, warm_start, started))
    }

    /// Chooses the options that are not given, and sets up the solve. The input has been levelled by some numbers of solves and
    /// of iterations.
    fn start(
        prepared: PreparedInput,
        asked: Options,
        [solves, iterations]: [usize; 2],
        threads: Threads,
        warm_start: Option<Arc<WarmStart>>,
        started: Instant,
    ) -> Result<Self> {
        let mut levelling = None;
        let statistics = InputStatistics::of(&prepared.input, &asked)?;
        let InputStatistics { scale, noise, .. } = statistics;
        let (mut options, mut choice) = (asked, None);
        let (mut search, mut refinement) = (None, None);
        if asked.chooses_lambda() {
            let (first, found, aim) = closed_form::initial_options(&asked, statistics);
            options = first;
            let [offset_rows, offset_columns] = prepared.input.offset_lines();
            choice = Some(LambdaChoice {
                offset_rows,
                offset_columns,
                solves,
                iterations,
                ..found
            });
            if found.reason == LambdaReason::Noise {
                levelling = Levelling::new(&prepared.input, &asked, &first, statistics)?;
            }
            if let Some(aim) = aim.filter(|_| levelling.is_none()) {
                // λ is refined again where the coarse lattice was too coarse for the shape.
                refinement = Some(Refinement::new(aim, 1.0));
                search = Search::new(&prepared.input, &first, statistics, aim)?;
            }
        }
        let options = closed_form::with_huber_defaults(&options, noise, scale);
        let start_mode = match search.is_some() || levelling.is_some() {
            true => StartMode::Deferred,
            false => StartMode::Immediate,
        };
        Ok(Solver {
            levelling,
            search,
            choice,
            refinement,
            noise,
            solve: ComponentSolver::new(
                prepared, &options, scale, warm_start, start_mode, started,
            )?,
            threads,
        })
    }

    /// Restarts the solve with other options on the same input, with a warm start from the last surface if that is
    /// close enough. A solve that is interrupted by a restart is discarded. On an error nothing has changed.
    ///
    /// # Errors
    /// As [`Solver::new`].
    pub fn restart(&mut self, options: &Options) -> Result<()> {
        self.restart_with(self.solve.input.clone(), options)
    }

    /// Restarts the solve with another input, such as slightly different heights or another mask. On a lattice of the
    /// same shape it has a warm start from the last surface if that is close enough. On an error nothing has changed.
    ///
    /// # Errors
    /// As [`Solver::new`].
    pub fn restart_with(&mut self, input: impl Into<Input>, options: &Options) -> Result<()> {
        let input = input.into();
        let warm_start = self.solve.warm_start(input.field.lattice());
        *self = Solver::set_up(input, options, warm_start)?;
        Ok(())
    }

    /// Continues the solve for about `work` conjugate-gradient iterations, at least one. Results do not depend on how
    /// the work is divided.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory) in the set-up of a component or a level.
    pub fn advance(&mut self, work: usize) -> Result<Status> {
        let threads = self.threads;
        threads.run(|| self.continue_solve(work))
    }

    /// Continues the solve on the threads that this is called on.
    fn continue_solve(&mut self, work: usize) -> Result<Status> {
        let mut left = work.max(1);
        while let Some(levelling) = &mut self.levelling
            && self.solve.status == Status::Running
        {
            if !levelling.advance(&mut left)? {
                return Ok(Status::Running);
            }
            self.begin_levelled()?;
        }
        while let Some(search) = &mut self.search
            && self.solve.status == Status::Running
        {
            if !search.advance(&mut left)? {
                return Ok(Status::Running);
            }
            self.take_choice()?;
        }
        while left > 0 {
            let status = self.solve.advance(&mut left)?;
            if status == Status::Running || !self.raise_lambda()? {
                return Ok(status);
            }
        }
        Ok(Status::Running)
    }

    /// Starts anew from the heights that have been levelled.
    fn begin_levelled(&mut self) -> Result<()> {
        let Some(levelling) = self.levelling.take() else {
            return Ok(());
        };
        let done = [levelling.solves, levelling.iterations];
        let (input, domain) = (levelling.input, self.solve.domain.clone());
        let warm_start = self.solve.warm_start(input.field.lattice());
        let (threads, started) = (self.threads, self.solve.started);
        let prepared = PreparedInput { input, domain };
        let asked = levelling.asked;
        *self = Solver::start(prepared, asked, done, threads, warm_start, started)?;
        Ok(())
    }

    /// Begins again with a larger λ where the surface is farther from the heights than the tolerance allows; tells whether
    /// it does.
    fn raise_lambda(&mut self) -> Result<bool> {
        let (Some(choice), Some(noise)) = (&mut self.choice, &self.noise) else {
            return Ok(false);
        };
        let Status::Stopped(reason) = self.solve.status else {
            return Ok(false);
        };
        if choice.residual_ratio.is_some() {
            return Ok(false);
        }
        let surface = self.solve.surface()?;
        let (input, domain) = (&self.solve.input, &self.solve.domain);
        let residual = |unit| root_mean_square(input, domain, surface.heightfield(), unit);
        let options = self.solve.options;
        let lambda = options.lambda_or_default().value();
        let is_solved = matches!(reason, StopReason::Gap | StopReason::Rounding);
        if let Some(refinement) = self.refinement.as_mut().filter(|_| is_solved)
            && let Next::Solve(next) = refinement.next(lambda, residual(refinement.unit())?)
        {
            choice.raises += usize::from(next > lambda);
            choice.solves += 1;
            choice.iterations += surface.report().iterations;
            self.solve.begin_again(&options.lambda(next))?;
            return Ok(true);
        }
        self.refinement = None;
        if noise.vertex_sigma > 0.0 && choice.reason != LambdaReason::NoNoise {
            let ratio = residual([noise.vertex_sigma, MAX_RESIDUAL])?;
            choice.residual_ratio = Some(ratio);
            choice.residual_exceeds_noise =
                choice.tolerance.is_none() && ratio > MAX_NOISE_DISTANCE;
        }
        Ok(false)
    }

    /// Ends the search for λ and starts the solve with the options that it has chosen.
    fn take_choice(&mut self) -> Result<()> {
        match (self.search.take(), &mut self.choice) {
            (Some(search), Some(choice)) => self.solve.begin_with(&search.found(choice)),
            _ => Ok(()),
        }
    }

    /// Returns the progress at the last check. Before the first one, and while λ is [chosen](super::options::Lambda::Auto), the figures
    /// are those of the input, on a level above 0; iterations of the search are counted. On a coarse level objective
    /// and dual bound are scaled by the number of vertices: they estimate those of the finest level, which alone
    /// certifies. Components not yet solved count with the input's objective and the bound 0.
    pub fn progress(&self) -> Progress {
        let mut progress = self.solve.progress();
        progress.iteration += self.choice.map_or(0, |choice| choice.iterations);
        progress.iteration += self.search.as_ref().map_or(0, Search::iterations);
        if self.search.is_some() || self.levelling.is_some() {
            progress.level = 1;
        }
        progress
    }

    /// Stops a running solve: its surface is then the best one so far, marked
    /// [`StopReason::Cancelled`](crate::StopReason::Cancelled).
    pub fn cancel(&mut self) {
        self.solve.cancel();
    }

    /// Returns the best surface so far, in the input's units, with extrapolated heights at omitted vertices. A solve
    /// that is still running is reported as cancelled; its surface is prolonged from a coarse level to the finest
    /// lattice and certified there. Before the first iteration it is the input. Components not yet solved are as in the
    /// input, without free vertices.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn surface(&self) -> Result<Surface> {
        let mut surface = self.threads.run(|| self.solve.surface())?;
        surface.report.lambda_choice = self.choice;
        surface.report.threads = self.threads.len();
        surface.report.thread_limit = self.threads.limit();
        Ok(surface)
    }
}

/// Fits the surface of least energy to an input: sets up a [`Solver`] and runs it to its end.
///
/// # Errors
/// As [`Solver::new`].
pub fn fit(input: impl Into<Input>, options: &Options) -> Result<Surface> {
    fit_with(input, options, |_| ControlFlow::Continue(()))
}

/// Fits a surface to an input as [`fit`] does, and calls `on_progress` every few conjugate-gradient iterations.
/// If that breaks, the best surface so far is returned, marked [`StopReason::Cancelled`](crate::StopReason::Cancelled).
///
/// # Errors
/// As [`Solver::new`].
pub fn fit_with(
    input: impl Into<Input>,
    options: &Options,
    mut on_progress: impl FnMut(&Progress) -> ControlFlow<()>,
) -> Result<Surface> {
    /// Number of conjugate-gradient iterations between two calls of the progress callback: about ten iterations of
    /// ADMM.
    const ADVANCE_WORK: usize = 20;
    let mut solver = Solver::new(input, options)?;
    while solver.advance(ADVANCE_WORK)? == Status::Running {
        if on_progress(&solver.progress()).is_break() {
            solver.cancel();
        }
    }
    solver.surface()
}

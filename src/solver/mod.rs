//! ADMM for the nuclear norm of the Hessian (paper, Sec. 4.1), with a certified
//! duality gap.

mod cg;
mod frame;
mod grid;
mod lanes;
mod level;
mod levels;
mod multigrid;
mod options;
mod problem;
mod report;
mod schedule;
mod state;
mod transfer;

use std::ops::ControlFlow;
use std::sync::Arc;

use web_time::Instant;

pub use options::{Energy, Lambda, Normalization, Options, Schedule};
pub use report::{LevelReport, Progress, Report, Seconds, StopReason};

use crate::domain::Domain;
use crate::error::{Error, Result};
use crate::heightfield::Heightfield;
use crate::input::Input;
use crate::restore::restore_omitted;
use crate::surface::Surface;
use frame::Frame;
use level::{Best, Level};
use levels::{coarsen, prolong};
use problem::Problem;
use schedule::Plan;
use state::State;

/// Lattices are coarsened, for multigrid, as long as so many interior vertices are left.
const COARSEST_GRID: usize = 20;

/// Whether a [`Solver`] has more to do.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Status {
    /// [`Solver::advance`] should be called again.
    Running,
    /// Done; further calls change nothing.
    Stopped(StopReason),
}

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
///     println!("gap {:.3}", solver.progress().gap);
/// }
/// assert!(solver.surface()?.report().gap <= 0.01);
/// # Ok(())
/// # }
/// ```
#[derive(Debug, Clone)]
pub struct Solver {
    field: Heightfield,
    frame: Frame,
    plan: Plan,
    /// The level under way; the finest one at the end.
    level: Level,
    /// The problems of the finer levels, the finest first.
    finer: Vec<Problem>,
    /// The domains of all lattices, the finest first.
    domains: Vec<Arc<Domain>>,
    /// The levels done, the coarsest first.
    coarser: Vec<LevelReport>,
    status: Status,
    started: Instant,
    seconds: Seconds,
}

impl Solver {
    /// Sets up a solve. Memory: about 130 bytes for each vertex of the valid
    /// vertices' bounding box.
    ///
    /// # Errors
    /// [`Error::Option`] for an option out of range, [`Error::NoInterior`] if
    /// there is nothing to solve, [`Error::Overflow`] if the heights are too
    /// large for their energy to be computed, [`Error::OutOfMemory`].
    pub fn new(input: impl Into<Input>, options: &Options) -> Result<Self> {
        let field = &input.into().field;
        let started = Instant::now();
        options.validate()?;
        let plan = Plan::new(options);
        let domain = Arc::new(Domain::new(field)?);
        let frame = Frame::new(field, &domain, options.normalization);
        let lambda = options.lambda.value();
        let mut domains = vec![domain.clone()];
        let mut finer = vec![Problem::new(field, domain, &frame, lambda)?];
        let objective = finer[0].input_objective();
        if !objective.is_finite() {
            return Err(Error::Overflow {
                spacing: field.lattice().spacing(),
            });
        }
        if objective > finer[0].rounding {
            let mut coarse = coarsen(field)?;
            while let Some(domain) = Domain::new(&coarse)
                .ok()
                .filter(|domain| domain.interior_len() >= COARSEST_GRID)
            {
                let domain = Arc::new(domain);
                if plan.wants_level(domain.interior_len()) {
                    finer.push(Problem::new(&coarse, domain.clone(), &frame, lambda)?);
                }
                domains.push(domain);
                coarse = coarsen(&coarse)?;
            }
        }
        let coarsest = finer.remove(finer.len() - 1);
        let state = State::new(&coarsest, plan.first_rho(&coarsest))?;
        let (level, reason) = Level::new(
            coarsest,
            state,
            plan.on_level(!finer.is_empty(), 0),
            &domains[finer.len()..],
        )?;
        let mut solver = Solver {
            field: field.clone(),
            frame,
            plan,
            level,
            finer,
            domains,
            coarser: Vec::new(),
            status: Status::Running,
            started,
            seconds: Seconds {
                setup: started.elapsed().as_secs_f64(),
                ..Seconds::default()
            },
        };
        if let Some(reason) = reason {
            solver.finish_level(reason)?;
        }
        Ok(solver)
    }

    /// Solves the same input again with other options, from where it stands:
    /// for a slider. On an error nothing has changed.
    ///
    /// # Errors
    /// As [`Solver::new`].
    pub fn restart(&mut self, options: &Options) -> Result<()> {
        *self = Solver::new(&self.field, options)?;
        Ok(())
    }

    /// Solves another input, on a lattice of the same shape, from where it
    /// stands: slightly other heights, another mask. On a lattice of another
    /// shape it starts from nothing. On an error nothing has changed.
    ///
    /// # Errors
    /// As [`Solver::new`].
    pub fn restart_with(&mut self, input: impl Into<Input>, options: &Options) -> Result<()> {
        *self = Solver::new(input, options)?;
        Ok(())
    }

    /// Runs about `work` conjugate-gradient iterations, at least one. Results
    /// do not depend on how the work is divided.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`] on the way to a finer level.
    pub fn advance(&mut self, work: usize) -> Result<Status> {
        let mut left = work.max(1);
        while left > 0 && self.status == Status::Running {
            if let Some(reason) = self.level.advance(&mut left) {
                self.finish_level(reason)?;
            }
        }
        Ok(self.status)
    }

    /// Goes on to finer levels as long as they have nothing to do.
    fn finish_level(&mut self, mut reason: StopReason) -> Result<()> {
        while let Some(fine) = self.finer.pop() {
            self.coarser.push(self.level.report());
            self.seconds = self.seconds + self.level.seconds;
            let done = self.coarser.iter().map(|level| level.iterations).sum();
            let plan = self.plan.on_level(!self.finer.is_empty(), done);
            let rho = self.plan.finer_rho(self.level.state.rho, &fine);
            let state = prolong(&self.level.problem, &self.level.state, &fine, rho)?;
            let (level, stop) = Level::new(fine, state, plan, &self.domains[self.finer.len()..])?;
            self.level = level;
            match stop {
                Some(next) => reason = next,
                None => return Ok(()),
            }
        }
        self.status = Status::Stopped(reason);
        Ok(())
    }

    /// Figures of the last check. While a coarse level is under way, its
    /// objective and bound are scaled by the number of vertices: estimates of
    /// the finest level's, which alone certifies.
    pub fn progress(&self) -> Progress {
        let report = self.level.report();
        let finest = self.finer.first().unwrap_or(&self.level.problem);
        let share = finest.domain.interior_len() as f64 / report.interior as f64;
        let coarser = self.coarser.iter();
        Progress {
            level: self.finer.len(),
            iteration: report.iterations + coarser.clone().map(|l| l.iterations).sum::<usize>(),
            cg_iterations: report.cg_iterations + coarser.map(|l| l.cg_iterations).sum::<usize>(),
            objective: share * self.level.best.objective(),
            dual_bound: share * self.level.best.dual_bound,
            gap: self.gap_of(&self.level.best),
            rho: self.level.state.rho,
            elapsed: self.started.elapsed().as_secs_f64(),
        }
    }

    /// Stops a running solve: its surface is then the best one so far, marked
    /// [`StopReason::Cancelled`].
    pub fn cancel(&mut self) {
        if self.status == Status::Running {
            self.status = Status::Stopped(StopReason::Cancelled);
        }
    }

    /// The best surface so far, in the input's units, omitted vertices
    /// restored. While the solve is running it is reported as cancelled; from a
    /// coarse level it is carried to the finest one, and certified there.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn surface(&self) -> Result<Surface> {
        let carried = self.carry_to_finest()?;
        let best = carried.as_ref().unwrap_or(&self.level.best);
        let problem = self.finer.first().unwrap_or(&self.level.problem);
        let domain = &problem.domain;
        let mut heights = problem.heights(&self.frame, &best.z);
        restore_omitted(domain, &self.field, &mut heights);
        let mut levels = self.coarser.clone();
        levels.push(self.level.report());
        let report = Report {
            interior: domain.interior_len(),
            boundary: domain.boundary_len(),
            omitted: domain.omitted_len(),
            iterations: levels.iter().map(|level| level.iterations).sum(),
            cg_iterations: levels.iter().map(|level| level.cg_iterations).sum(),
            levels,
            occluded: 0,
            constrained: 0,
            free: 0,
            components: 1,
            energy: Energy::Nuclear,
            reweighting: 0,
            objective: best.objective(),
            fidelity: best.fidelity,
            nuclear_norm: best.nuclear_norm,
            dual_bound: best.dual_bound,
            gap: self.gap_of(best),
            lambda: problem.lambda,
            rho: self.level.state.rho,
            scale: self.frame.scale,
            stop_reason: match self.status {
                Status::Running => StopReason::Cancelled,
                Status::Stopped(reason) => reason,
            },
            seconds: Seconds {
                total: self.started.elapsed().as_secs_f64(),
                ..self.seconds + self.level.seconds
            },
        };
        Ok(Surface {
            heightfield: Heightfield::new(*self.field.lattice(), heights)?,
            report,
        })
    }

    fn gap_of(&self, best: &Best) -> f64 {
        match self.status {
            // Objective and optimum are the same but for rounding errors.
            Status::Stopped(StopReason::Rounding) => 0.0,
            _ => best.gap(),
        }
    }

    /// A coarse level's iterate on the finest lattice, or the input if that is better.
    fn carry_to_finest(&self) -> Result<Option<Best>> {
        let mut state: Option<State> = None;
        let mut coarse = &self.level.problem;
        for fine in self.finer.iter().rev() {
            let from = state.as_ref().unwrap_or(&self.level.state);
            state = Some(prolong(
                coarse,
                from,
                fine,
                self.plan.finer_rho(from.rho, fine),
            )?);
            coarse = fine;
        }
        let Some(mut state) = state else {
            return Ok(None);
        };
        let certificate = state.certify(coarse);
        let mut best = Best::new(&state.z, &certificate);
        best.take_input(coarse);
        Ok(Some(best))
    }
}

/// Solves to the end.
///
/// # Errors
/// As [`Solver::new`].
pub fn fit(input: impl Into<Input>, options: &Options) -> Result<Surface> {
    fit_with(input, options, |_| ControlFlow::Continue(()))
}

/// Solves to the end, unless `on_progress` breaks off: it is called every few
/// conjugate-gradient iterations, and after a break the best surface so far
/// comes back, marked [`StopReason::Cancelled`].
///
/// # Errors
/// As [`Solver::new`].
pub fn fit_with(
    input: impl Into<Input>,
    options: &Options,
    mut on_progress: impl FnMut(&Progress) -> ControlFlow<()>,
) -> Result<Surface> {
    /// About ten iterations of the default schedule.
    const WORK: usize = 20;
    let mut solver = Solver::new(input, options)?;
    while solver.advance(WORK)? == Status::Running {
        if on_progress(&solver.progress()).is_break() {
            solver.cancel();
        }
    }
    solver.surface()
}

//! ADMM for the nuclear norm of the Hessian (paper, Sec. 4.1), with a certified
//! duality gap.

use std::ops::ControlFlow;
use std::sync::Arc;

use web_time::Instant;

use super::admm::schedule::Plan;
use super::cascade::{Answer, Cascade, SET_UP};
use super::components::{Components, check_held};
use super::coordinates::Coordinates;
use super::heightfields::Problem;
use super::input::Input;
use super::options::{Bending, Energy, Lambda, Options};
use super::preparation::{Preparation, Prepared};
use super::report::{
    HuberReport, LambdaChoice, LambdaReason, LevelReport, Progress, Report, Seconds, StopReason,
};
use super::restore::restore_omitted;
use super::surface::Surface;
use super::totals::{Totals, add_levels};
use super::tuning::noise::Noise;
use super::tuning::search::{self as tuning, Search};
use super::warm_start::WarmStart;
use crate::error::{Error, Result, try_filled};
use crate::heights::heightfield::Heightfield;
use crate::lattice::domain::Domain;
use crate::lattice::hexagonal::Lattice;

/// Whether a [`Solver`] has more to do.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Status {
    /// [`Solver::advance`] should be called again.
    Running,
    /// Done; further calls change nothing.
    Stopped(StopReason),
}

/// What is known about an input before a solve: the factor from the user's units to the energy's, and
/// its noise.
#[derive(Debug, Clone, Copy)]
pub(super) struct Known {
    pub scale: f64,
    pub noise: Option<Noise>,
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
///     println!("gap {:.3?}", solver.progress().gap);
/// }
/// assert!(solver.surface()?.report().is_certified(0.01));
/// # Ok(())
/// # }
/// ```
#[derive(Debug, Clone)]
pub struct Solver {
    input: Input,
    /// As they are used.
    options: Options,
    /// What λ is chosen by, while it is, and what has come of it.
    search: Option<Search>,
    choice: Option<LambdaChoice>,
    /// Factor from the user's units to the energy's.
    scale: f64,
    domain: Arc<Domain>,
    components: Components,
    /// Of the first parts.
    answers: Vec<Answer>,
    /// The part after those: before its first iteration, and then.
    preparing: Option<Preparation>,
    running: Option<Cascade>,
    /// `P(z̃)` of each part, if there are several.
    energies: Vec<f64>,
    /// The last answer: what the parts to come, and the next restart, may start from.
    memory: Option<Arc<WarmStart>>,
    status: Status,
    started: Instant,
    setup: f64,
}

impl Solver {
    /// Sets up a solve, all but what the first calls of [`Solver::advance`] do. Memory: about 180 bytes for each vertex of the valid
    /// vertices' bounding box.
    ///
    /// # Errors
    /// [`Error::Option`] for an option out of range, [`Error::NoInterior`] if
    /// there is nothing to solve, [`Error::Underdetermined`] if a part of the
    /// surface is not held in place, [`Error::Overflow`] or [`Error::Underflow`] if
    /// the heights are too large or too small for their energy to be computed,
    /// [`Error::OutOfMemory`].
    pub fn new(input: impl Into<Input>, options: &Options) -> Result<Self> {
        Solver::set_up(input.into(), options, None, None)
    }

    pub(super) fn with_known(input: Input, options: &Options, known: Known) -> Result<Self> {
        Solver::set_up(input, options, None, Some(known))
    }

    fn set_up(
        input: Input,
        options: &Options,
        memory: Option<Arc<WarmStart>>,
        known: Option<Known>,
    ) -> Result<Self> {
        let started = Instant::now();
        options.validate()?;
        let input = input.bridge()?;
        let domain = Arc::new(input.domain()?);
        check_held(&input, &domain)?;
        let known = match known {
            Some(known) => known,
            None => Known::of(&input, options)?,
        };
        let Known { scale, noise } = known;
        let asked = *options;
        let (mut options, mut choice, mut search) = (asked, None, None);
        if asked.lambda == Lambda::Auto {
            let (first, found) = tuning::first(&asked, noise, scale);
            if found.reason == LambdaReason::Noise {
                search = Search::new(&input, &asked, &first, known)?;
            }
            options = match search {
                None if found.reason == LambdaReason::Noise => tuning::without(&first),
                _ => first,
            };
            choice = Some(found);
        }
        let options = tuning::guarded(&options, noise, scale);
        let components = Components::new(&domain)?;
        let energies = match components.list.len() {
            1 if search.is_none() => Vec::new(),
            n => {
                let coordinates = Coordinates::new(&input, &domain, scale);
                let problem = Problem::new(&input, domain.clone(), &coordinates, &options)?;
                problem.smoothness_by(n, |cell| components.of(cell))
            }
        };
        if energies.iter().any(|energy| !energy.is_finite()) {
            return Err(Error::Overflow {
                spacing: input.field.lattice().spacing(),
            });
        }
        let mut solver = Solver {
            input,
            options,
            search,
            choice,
            scale,
            domain,
            components,
            answers: Vec::new(),
            preparing: None,
            running: None,
            energies,
            memory,
            status: Status::Running,
            started,
            setup: 0.0,
        };
        if solver.search.is_none() {
            solver.next_part()?;
        }
        solver.setup = started.elapsed().as_secs_f64();
        Ok(solver)
    }

    /// Solves the same input again with other options, from the last answer if
    /// that is close enough: for a slider. A solve that is overtaken before its
    /// end leaves nothing behind. On an error nothing has changed.
    ///
    /// # Errors
    /// As [`Solver::new`].
    pub fn restart(&mut self, options: &Options) -> Result<()> {
        self.restart_with(self.input.clone(), options)
    }

    /// Solves another input, on a lattice of the same shape, from the last
    /// answer if that is close enough: slightly other heights, another mask. On
    /// a lattice of another shape it starts from nothing. On an error nothing
    /// has changed.
    ///
    /// # Errors
    /// As [`Solver::new`].
    pub fn restart_with(&mut self, input: impl Into<Input>, options: &Options) -> Result<()> {
        self.restart_about(input.into(), options, None)
    }

    fn restart_about(
        &mut self,
        input: Input,
        options: &Options,
        known: Option<Known>,
    ) -> Result<()> {
        let shape = |lattice: &Lattice| [lattice.rows(), lattice.cols()];
        let same = shape(input.field.lattice()) == shape(self.input.field.lattice());
        let memory = if !same {
            None
        } else if self.next_number().is_none() {
            Some(Arc::new(WarmStart {
                domain: self.domain.clone(),
                components: self.components.clone(),
                answers: self.answers.clone(),
                lambda: self.options.lambda.value(),
            }))
        } else {
            // What was overtaken is no answer yet.
            self.memory.clone()
        };
        *self = Solver::set_up(input, options, memory, known)?;
        Ok(())
    }

    /// [`Solver::restart`], with what is known already.
    pub(super) fn restart_known(&mut self, options: &Options, known: Known) -> Result<()> {
        self.restart_about(self.input.clone(), options, Some(known))
    }

    /// Begins with the next part, if there is one left.
    fn next_part(&mut self) -> Result<()> {
        let Some(number) = self.next_number() else {
            self.memory = None;
            self.status = Status::Stopped(self.reason());
            return Ok(());
        };
        let (input, domain) = match self.components.list.len() {
            1 => (self.input.clone(), self.domain.clone()),
            _ => {
                let input = self.components.crop(&self.input, &self.domain, number)?;
                let domain = Arc::new(input.domain()?);
                (input, domain)
            }
        };
        let corner = self.components.corner(number);
        let warm = |problem: &Problem, plan: &Plan| match &self.memory {
            Some(memory) => memory.state(problem, plan, corner),
            None => Ok(None),
        };
        let part = Preparation::new(input, domain, self.scale, &self.options, warm)?;
        self.preparing = Some(part);
        Ok(())
    }

    /// Goes on to what is prepared.
    fn begin(&mut self, part: Cascade) -> Result<()> {
        match part.reason() {
            Some(reason) => {
                self.answers.push(part.into_answer(reason));
                self.next_part()
            }
            None => {
                self.running = Some(part);
                Ok(())
            }
        }
    }

    fn next_number(&self) -> Option<usize> {
        let next = self.answers.len();
        (next < self.components.list.len()).then_some(next)
    }

    /// The worst of the reasons why parts stopped. Rounding errors of some may be too large for the
    /// gap of all.
    fn reason(&self) -> StopReason {
        let mut total = Totals::default();
        for answer in &self.answers {
            total.add(&answer.best, 1.0);
        }
        let certified = total.gap().is_some_and(|gap| gap <= self.options.gap);
        let any = |reason| self.answers.iter().any(|answer| answer.reason == reason);
        [
            StopReason::Cancelled,
            StopReason::Diverged,
            StopReason::MaxIterations,
            StopReason::Residuals,
            StopReason::Gap,
        ]
        .into_iter()
        .find(|reason| any(*reason))
        .filter(|reason| *reason != StopReason::Gap || certified)
        .unwrap_or(StopReason::Rounding)
    }

    /// Runs about `work` conjugate-gradient iterations, at least one. Results
    /// do not depend on how the work is divided.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`] on the way to the first level or a finer one.
    pub fn advance(&mut self, work: usize) -> Result<Status> {
        let mut left = work.max(1);
        while let Some(search) = &mut self.search
            && self.status == Status::Running
        {
            if !search.advance(&mut left)? {
                return Ok(self.status);
            }
            self.take_choice()?;
        }
        while left > 0 && self.status == Status::Running {
            if let Some(preparing) = self.preparing.take() {
                let start = Instant::now();
                left = left.saturating_sub(SET_UP);
                let prepared = preparing.step()?;
                self.setup += start.elapsed().as_secs_f64();
                match prepared {
                    Prepared::Partly(part) => self.preparing = Some(part),
                    Prepared::Fully(part) => self.begin(*part)?,
                }
                continue;
            }
            let Some(running) = &mut self.running else {
                // Where memory was short the last time.
                self.next_part()?;
                continue;
            };
            if let Some(reason) = running.advance(&mut left)? {
                let done = self.running.take();
                self.answers.extend(done.map(|c| c.into_answer(reason)));
                self.next_part()?;
            }
        }
        Ok(self.status)
    }

    /// Ends the search and begins with the solve.
    fn take_choice(&mut self) -> Result<()> {
        let (Some(search), Some(choice)) = (self.search.take(), &mut self.choice) else {
            return Ok(());
        };
        self.options = search.found(choice);
        if self.components.list.len() == 1 {
            self.energies.clear();
        }
        self.next_part()
    }

    /// Figures of the last check. Before the first one, and while λ is [looked for](Lambda::Auto), they
    /// are the input's, on a level above 0; iterations of the search go on being counted. While a coarse level is under way, its
    /// objective and bound are scaled by the number of vertices: estimates of
    /// the finest level's, which alone certifies. Components of the surface that are
    /// still to come count as they are in the input, with 0 as their bound.
    pub fn progress(&self) -> Progress {
        let mut total = Totals::default();
        for answer in &self.answers {
            total.add(&answer.best, 1.0);
            total.add_work(&answer.levels);
        }
        let mut pending = self.answers.len();
        if let Some(preparing) = &self.preparing {
            let problem = preparing.problem();
            total.nuclear_norm += problem.smoothness(&problem.target);
            pending += 1;
        }
        if let Some(running) = &self.running {
            let level = running.level();
            let share = running.problem().operator.domain.interior_len() as f64
                / level.problem.operator.domain.interior_len() as f64;
            total.add(&level.best, share);
            total.add_work(&running.levels());
            pending += 1;
        }
        let pending = self.energies.iter().skip(pending);
        total.nuclear_norm += pending.sum::<f64>();
        let searched = match (&self.search, &self.choice) {
            (Some(search), _) => search.iterations(),
            (None, choice) => choice.map_or(0, |choice| choice.iterations),
        };
        let level = match (&self.search, &self.preparing) {
            (None, None) => self.running.as_ref().map_or(0, Cascade::levels_left),
            _ => 1,
        };
        Progress {
            level,
            iteration: searched + total.iterations,
            cg_iterations: total.cg_iterations,
            objective: total.objective(),
            dual_bound: total.dual_bound,
            gap: self.known_gap(&total),
            rho: self.rho(),
            elapsed: self.started.elapsed().as_secs_f64(),
        }
    }

    fn known_gap(&self, total: &Totals) -> Option<f64> {
        let rounding = self.status == Status::Stopped(StopReason::Rounding);
        total.gap().filter(|_| !rounding)
    }

    /// Of the largest part.
    fn rho(&self) -> f64 {
        let running = || self.running.as_ref().map(|c| c.level().state.rho);
        let first = self.answers.first().map(|answer| answer.state.rho);
        first.or_else(running).unwrap_or(0.0)
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
    /// coarse level it is carried to the finest one, and certified there; before the first iteration
    /// it is the input; parts that are still to come are as in the input, without the free vertices
    /// that have no height there.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn surface(&self) -> Result<Surface> {
        let unfinished = match (&self.preparing, &self.running) {
            (Some(preparing), _) => Some(preparing.answer()?),
            (None, running) => running.as_ref().map(Cascade::answer).transpose()?,
        };
        let answers = || self.answers.iter().chain(&unfinished);
        let lattice = *self.input.field.lattice();
        let mut heights = try_filled("surface", lattice.len(), f64::NAN)?;
        let mut total = Totals::default();
        let mut levels: Vec<LevelReport> = Vec::new();
        let mut seconds = Seconds::default();
        for (number, answer) in answers().enumerate() {
            let (top, left) = self.components.corner(number);
            answer
                .problem
                .write_heights(&answer.best.z, |(row, col), z| {
                    heights[lattice.index(top + row, left + col)] = z;
                });
            total.add(&answer.best, 1.0);
            total.add_work(&answer.levels);
            add_levels(&mut levels, &answer.levels);
            seconds = seconds + answer.seconds;
        }
        let pending = answers().count();
        for cell in self.domain.active().cells() {
            let vertex = self.domain.lattice_index(cell);
            let given = self.input.weight(vertex) > 0.0;
            if self.components.of(cell) >= pending && given {
                heights[vertex] = self.input.field.heights()[vertex];
            }
        }
        restore_omitted(&self.domain, &self.input, &mut heights);
        let constrained = (0..lattice.len()).filter(|v| self.input.is_constrained(*v));
        for vertex in constrained.clone() {
            // To the last bit.
            heights[vertex] = self.input.field.heights()[vertex];
        }
        total.nuclear_norm += self.energies.iter().skip(pending).sum::<f64>();
        let stop_reason = match self.status {
            Status::Running => StopReason::Cancelled,
            Status::Stopped(reason) => reason,
        };
        let passes = answers().map(|answer| answer.passes).max().unwrap_or(0);
        let at_creases = self.options.energy == Energy::Huber;
        let Bending {
            bend_radius,
            flatness,
            crease_radius,
        } = Bending::SMOOTH.within(&self.options);
        let report = Report {
            interior: self.domain.interior_len(),
            boundary: self.domain.boundary_len(),
            omitted: self.domain.omitted_len(),
            occluded: self.domain.occluded_len(),
            constrained: constrained.count(),
            bridged: self.input.bridged,
            free: answers().map(|answer| answer.problem.free.len()).sum(),
            components: self.components.list.len(),
            iterations: total.iterations,
            cg_iterations: total.cg_iterations,
            levels,
            energy: self.options.energy,
            reweighting: if at_creases { 0 } else { passes },
            huber: at_creases.then(|| HuberReport {
                bend_radius,
                flatness,
                crease_radius,
                crease_passes: passes,
                creases: answers().map(|answer| answer.creases.vertices).sum(),
            }),
            objective: total.objective(),
            fidelity: total.fidelity,
            nuclear_norm: total.nuclear_norm,
            dual_bound: total.dual_bound,
            gap: self.known_gap(&total),
            lambda: self.options.lambda.value(),
            lambda_choice: self.choice,
            rho: answers().next().map_or(0.0, |answer| answer.state.rho),
            scale: self.scale,
            stop_reason,
            seconds: Seconds {
                setup: self.setup,
                total: self.started.elapsed().as_secs_f64(),
                ..seconds
            },
        };
        Ok(Surface {
            heightfield: Heightfield::new(lattice, heights)?,
            report,
        })
    }
}

impl Known {
    fn of(input: &Input, options: &Options) -> Result<Self> {
        let wanted = options.lambda == Lambda::Auto || options.energy == Energy::Huber;
        Ok(Known {
            scale: options.normalization.factor(&input.field),
            noise: if wanted { Noise::of(input)? } else { None },
        })
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

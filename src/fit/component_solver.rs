//! Solver with known options, which solves one connected component of the surface after the other.

use std::mem;
use std::sync::Arc;

use web_time::Instant;

use super::component_setup::ComponentSetup;
use super::components::{Components, check_held};
use super::coordinates::Coordinates;
use super::extrapolate_omitted::extrapolate_omitted;
use super::heightfields::Problem;
use super::input::Input;
use super::multilevel::{Answer, Multilevel, SET_UP_CG_ITERATIONS};
use super::options::{Energy, HuberOptions, Options};
use super::report::{HuberReport, LevelReport, Progress, Report, Seconds, StopReason};
use super::surface::Surface;
use super::threads::ThreadLimit;
use super::totals::{Totals, add_levels};
use super::warm_start::WarmStart;
use crate::error::{Error, Result, try_filled};
use crate::heights::heightfield::Heightfield;
use crate::lattice::domain::Domain;
use crate::lattice::hexagonal::Lattice;

/// Status of a [`Solver`](crate::Solver): whether it has more to do.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Status {
    /// The solve is not finished: [`Solver::advance`](crate::Solver::advance) should be called again.
    Running,
    /// The solve is finished, for the given reason; further calls change nothing.
    Stopped(StopReason),
}

/// Input that determines a surface: its small holes are bridged, and every component has enough given heights.
#[derive(Debug, Clone)]
pub(super) struct PreparedInput {
    pub input: Input,
    pub domain: Arc<Domain>,
}

impl PreparedInput {
    /// Bridges small holes of an input and checks that it determines a surface.
    ///
    /// # Errors
    /// [`Error::NoInterior`], [`Error::Underdetermined`], [`Error::OutOfMemory`].
    pub(super) fn new(input: Input) -> Result<Self> {
        let input = input.bridge()?;
        let domain = Arc::new(input.domain()?);
        check_held(&input, &domain)?;
        Ok(PreparedInput { input, domain })
    }
}

/// Solver of all components of a surface, one after the other, which can be interrupted.
#[derive(Debug, Clone)]
pub(super) struct ComponentSolver {
    pub input: Input,
    /// Options of the solve, with λ and the penalty's parameters chosen.
    pub options: Options,
    /// Factor from the input's units to normalised coordinates.
    scale: f64,
    /// Vertices that take part in the solve.
    pub domain: Arc<Domain>,
    components: Components,
    /// Results of the finished components, in the order of the components.
    answers: Vec<Answer>,
    /// Set-up of the current component, before its first iteration.
    preparing: Option<ComponentSetup>,
    /// Solve of the current component, after its set-up.
    running: Option<Multilevel>,
    /// Energy `P(z̃)` of the input in each component, if there are several.
    energies: Vec<f64>,
    /// Result of the last finished solve, from which further components and the next restart may start.
    warm_start: Option<Arc<WarmStart>>,
    pub status: Status,
    /// Time from which the report counts seconds.
    pub started: Instant,
    setup: f64,
}

/// When a [`ComponentSolver`] starts its first component.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum StartMode {
    /// The first component starts when the solver is made.
    Immediate,
    /// The first component starts with [`ComponentSolver::begin_with`], when the options have been chosen.
    Deferred,
}

impl ComponentSolver {
    /// Makes a solver for a prepared input. `scale` is the factor to normalised coordinates, `started` the time from
    /// which the report counts seconds.
    ///
    /// # Errors
    /// [`Error::Overflow`], [`Error::Underflow`], [`Error::OutOfMemory`].
    pub(super) fn new(
        PreparedInput { input, domain }: PreparedInput,
        options: &Options,
        scale: f64,
        warm_start: Option<Arc<WarmStart>>,
        start_mode: StartMode,
        started: Instant,
    ) -> Result<Self> {
        let components = Components::new(&domain)?;
        let energies = match components.list.len() {
            1 if start_mode == StartMode::Immediate => Vec::new(),
            n => {
                let coordinates = Coordinates::new(&input, &domain, scale);
                let problem = Problem::new(&input, domain.clone(), &coordinates, options)?;
                problem.smoothness_by(n, |cell| components.component(cell))
            }
        };
        if energies.iter().any(|energy| !energy.is_finite()) {
            return Err(Error::Overflow {
                spacing: input.field.lattice().spacing(),
            });
        }
        let mut solve = ComponentSolver {
            input,
            options: *options,
            scale,
            domain,
            components,
            answers: Vec::new(),
            preparing: None,
            running: None,
            energies,
            warm_start,
            status: Status::Running,
            started,
            setup: 0.0,
        };
        if start_mode == StartMode::Immediate {
            solve.next_part()?;
        }
        solve.setup = started.elapsed().as_secs_f64();
        Ok(solve)
    }

    /// Begins a deferred solve with the options that were chosen.
    pub(super) fn begin_with(&mut self, options: &Options) -> Result<()> {
        self.options = *options;
        if self.components.list.len() == 1 {
            self.energies.clear();
        }
        self.next_part()
    }

    /// Begins again with other options, with a warm start from the surface that was found.
    pub(super) fn begin_again(&mut self, options: &Options) -> Result<()> {
        let answers = mem::take(&mut self.answers);
        self.warm_start = Some(self.warm_start_from(answers));
        self.status = Status::Running;
        self.begin_with(options)
    }

    /// The warm start for another solve on a lattice of the same shape; `None` for another shape.
    pub(super) fn warm_start(&self, lattice: &Lattice) -> Option<Arc<WarmStart>> {
        let shape = |lattice: &Lattice| [lattice.rows(), lattice.cols()];
        if shape(lattice) != shape(self.input.field.lattice()) {
            None
        } else if self.next_number().is_none() {
            Some(self.warm_start_from(self.answers.clone()))
        } else {
            // What was overtaken is no answer yet.
            self.warm_start.clone()
        }
    }

    /// Makes the warm start from the answers of all components.
    fn warm_start_from(&self, answers: Vec<Answer>) -> Arc<WarmStart> {
        Arc::new(WarmStart {
            domain: self.domain.clone(),
            components: self.components.clone(),
            answers,
            lambda: self.options.lambda_or_default().value(),
        })
    }

    /// Begins with the next component, if there is one left, or ends the solve.
    fn next_part(&mut self) -> Result<()> {
        let Some(number) = self.next_number() else {
            self.warm_start = None;
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
        let warm_start = self
            .warm_start
            .as_deref()
            .map(|warm_start| (warm_start, corner));
        let part = ComponentSetup::new(input, domain, self.scale, &self.options, warm_start)?;
        self.preparing = Some(part);
        Ok(())
    }

    /// Continues with the solve of a component that has been set up.
    fn begin(&mut self, part: Multilevel) -> Result<()> {
        match part.reason {
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

    /// Returns the number of the current component; `None` when all are done.
    fn next_number(&self) -> Option<usize> {
        let next = self.answers.len();
        (next < self.components.list.len()).then_some(next)
    }

    /// Returns the least successful of the reasons why components stopped; where some reached the duality gap and all together are
    /// within it, that is the reason, although others were stopped by their number of iterations.
    fn reason(&self) -> StopReason {
        let mut total = Totals::default();
        for answer in &self.answers {
            total.add(&answer.incumbent, 1.0);
        }
        let certified = total
            .gap()
            .is_some_and(|gap| gap <= self.options.gap_or_default());
        let any = |reason| self.answers.iter().any(|answer| answer.reason == reason);
        [
            StopReason::Cancelled,
            StopReason::Diverged,
            StopReason::Gap,
            StopReason::MaxIterations,
            StopReason::Residuals,
        ]
        .into_iter()
        // Rounding errors of some components may exceed the gap of all together.
        .find(|reason| any(*reason) && (*reason != StopReason::Gap || certified))
        .unwrap_or(StopReason::Rounding)
    }

    /// Continues the solve until `left` conjugate-gradient iterations are used up.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`] in the set-up of a component or a level.
    pub(super) fn advance(&mut self, left: &mut usize) -> Result<Status> {
        while *left > 0 && self.status == Status::Running {
            if let Some(mut preparing) = self.preparing.take() {
                let start = Instant::now();
                *left = left.saturating_sub(SET_UP_CG_ITERATIONS);
                match preparing.step()? {
                    true => self.preparing = Some(preparing),
                    false => self.begin(preparing.into_multilevel()?)?,
                }
                self.setup += start.elapsed().as_secs_f64();
                continue;
            }
            let Some(running) = &mut self.running else {
                // Where memory was short the last time.
                self.next_part()?;
                continue;
            };
            if let Some(reason) = running.advance(left)? {
                let done = self.running.take();
                self.answers.extend(done.map(|c| c.into_answer(reason)));
                self.next_part()?;
            }
        }
        Ok(self.status)
    }

    /// Returns the figures of the last check. Before the first one they are those of the input, on a level above 0.
    pub(super) fn progress(&self) -> Progress {
        let mut total = Totals::default();
        for answer in &self.answers {
            total.add(&answer.incumbent, 1.0);
            total.add_work(&answer.levels);
        }
        let mut pending = self.answers.len();
        if let Some(preparing) = &self.preparing {
            let problem = &preparing.problem;
            total.nuclear_norm += problem.smoothness(&problem.target);
            pending += 1;
        }
        if let Some(running) = &self.running {
            let level = &running.level;
            let share = running.problem().operator.domain.interior_len() as f64
                / level.admm.problem.operator.domain.interior_len() as f64;
            total.add(&level.admm.incumbent, share);
            total.add_work(&running.levels());
            pending += 1;
        }
        let pending = self.energies.iter().skip(pending);
        total.nuclear_norm += pending.sum::<f64>();
        let level = match &self.preparing {
            None => self.running.as_ref().map_or(0, Multilevel::levels_left),
            Some(_) => 1,
        };
        Progress {
            level,
            iteration: total.iterations,
            cg_iterations: total.cg_iterations,
            objective: total.objective(),
            dual_bound: total.dual_bound,
            gap: self.known_gap(&total),
            rho: self.rho(),
            elapsed: self.started.elapsed().as_secs_f64(),
        }
    }

    /// Returns the relative duality gap of all components together; `None` where rounding errors are all that is left
    /// of it.
    fn known_gap(&self, total: &Totals) -> Option<f64> {
        let rounding = self.status == Status::Stopped(StopReason::Rounding);
        total.gap().filter(|_| !rounding)
    }

    /// Returns ADMM's penalty parameter ρ for the largest component.
    fn rho(&self) -> f64 {
        let running = || self.running.as_ref().map(|c| c.level.admm.iterate.rho);
        let first = self.answers.first().map(|answer| answer.iterate.rho);
        first.or_else(running).unwrap_or(0.0)
    }

    /// Stops a running solve as cancelled.
    pub(super) fn cancel(&mut self) {
        if self.status == Status::Running {
            self.status = Status::Stopped(StopReason::Cancelled);
        }
    }

    /// Returns the best surface so far; its report does not say how λ was chosen, nor how many threads there were.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub(super) fn surface(&self) -> Result<Surface> {
        let unfinished = match (&self.preparing, &self.running) {
            (Some(preparing), _) => Some(preparing.answer()?),
            (None, running) => running.as_ref().map(Multilevel::answer).transpose()?,
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
                .write_heights(&answer.incumbent.z, |(row, col), z| {
                    heights[lattice.index(top + row, left + col)] = z;
                });
            total.add(&answer.incumbent, 1.0);
            total.add_work(&answer.levels);
            add_levels(&mut levels, &answer.levels);
            seconds = seconds + answer.seconds;
        }
        let pending = answers().count();
        for cell in self.domain.active().cells() {
            let vertex = self.domain.lattice_index(cell);
            let given = self.input.weight(vertex) > 0.0;
            if self.components.component(cell) >= pending && given {
                heights[vertex] = self.input.field.heights()[vertex];
            }
        }
        extrapolate_omitted(&self.domain, &self.input, &mut heights);
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
        let at_creases = self.options.energy_or_default() == Energy::Huber;
        let HuberOptions {
            bend_radius,
            flatness,
            crease_radius,
        } = HuberOptions::SMOOTH.within(&self.options);
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
            energy: self.options.energy_or_default(),
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
            lambda: self.options.lambda_or_default().value(),
            lambda_choice: None,
            rho: answers().next().map_or(0.0, |answer| answer.iterate.rho),
            scale: self.scale,
            stop_reason,
            threads: 1,
            thread_limit: ThreadLimit::Options,
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

//! What comes before the first iteration, in steps: the energy, the coarser lattices, the system
//! of the first z-step.

use std::mem;
use std::sync::Arc;

use super::admm::best::Best;
use super::admm::schedule::Plan;
use super::coarsen::coarsen;
use super::coordinates::Coordinates;
use super::energy::creases::Creases;
use super::heightfields::{Level, Problem, State};
use super::input::Input;
use super::linear::cg::ConjugateGradients;
use super::multilevel::{Answer, Multilevel};
use super::operator::lattice::position;
use super::options::Options;
use super::report::{Seconds, StopReason};
use super::thin_plate::{self, InitialGuess};
use super::warm_start::WarmStart;
use crate::error::{Error, Result};
use crate::heights::heightfield::Heightfield;
use crate::lattice::domain::Domain;

/// Relative duality gap from which on a surface is only looked at, and an earlier thin plate is good enough for
/// it.
const PREVIEW_GAP: f64 = 0.05;

/// Lattices are coarsened, for multigrid, as long as so many interior vertices are left.
const COARSEST_GRID: usize = 20;

/// One connected part on the way to its [`Multilevel`].
#[derive(Debug, Clone)]
pub(crate) enum ComponentSetup {
    Lattices(Box<Lattices>),
    FirstLevel(Box<FirstLevel>),
}

/// What a step leads to.
pub(crate) enum SetupStep {
    Partly(ComponentSetup),
    Fully(Box<Multilevel>),
}

/// The problem on the finest lattice, and coarser lattices as they are found.
#[derive(Debug, Clone)]
pub(crate) struct Lattices {
    input: Input,
    options: Options,
    coordinates: Coordinates,
    plan: Plan,
    problem: Problem,
    /// The state to start from on the finest lattice, if there is one, and the heights of free vertices.
    warm: Option<State>,
    guess: InitialGuess,
    /// The domains of all lattices so far, the finest first, and the inputs of the coarser ones.
    domains: Vec<Arc<Domain>>,
    coarse: Vec<Input>,
    next: Next,
}

/// What there is to be done.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Next {
    /// One more lattice.
    Coarsen,
    /// Heights for free vertices, which the lattices help to find.
    Fill,
    /// The same lattices again, for those heights.
    CoarsenAgain,
    Done,
}

/// The first level, but for its first certificate.
#[derive(Debug, Clone)]
pub(crate) struct FirstLevel {
    options: Options,
    plan: Plan,
    problem: Problem,
    state: State,
    cg: ConjugateGradients,
    /// The problems of the finer levels, the finest first.
    finer: Vec<Problem>,
    domains: Vec<Arc<Domain>>,
}

impl ComponentSetup {
    /// `warm_start`: what to start from on the finest lattice, if there is anything, and the vertex of the
    /// whole lattice that is `(0, 0)` of the input's.
    pub(crate) fn new(
        input: Input,
        domain: Arc<Domain>,
        scale: f64,
        options: &Options,
        warm_start: Option<(&WarmStart, (usize, usize))>,
    ) -> Result<Self> {
        let plan = Plan::new(options);
        let coordinates = Coordinates::new(&input, &domain, scale);
        let mut problem = Problem::new(&input, domain.clone(), &coordinates, options)?;
        let energy = problem.smoothness(&problem.target);
        if !energy.is_finite() {
            return Err(Error::Overflow {
                spacing: problem.operator.domain.lattice().spacing(),
            });
        }
        let trivial = energy <= problem.rounding && problem.free.is_empty();
        let (guess, warm) = match warm_start {
            Some((warm_start, corner)) => (
                match options.gap_or_default() >= PREVIEW_GAP {
                    true => warm_start.thin_plate(&mut problem, corner),
                    false => InitialGuess::Plane,
                },
                warm_start.state(&problem, &plan, corner)?,
            ),
            None => (InitialGuess::Plane, None),
        };
        Ok(ComponentSetup::Lattices(Box::new(Lattices {
            warm,
            guess,
            input,
            options: *options,
            coordinates,
            plan,
            problem,
            domains: vec![domain],
            coarse: Vec::new(),
            next: if trivial { Next::Done } else { Next::Coarsen },
        })))
    }

    /// One step, of about what [`SET_UP`](super::multilevel::SET_UP) says.
    pub(crate) fn step(self) -> Result<SetupStep> {
        Ok(match self {
            ComponentSetup::Lattices(mut lattices) => SetupStep::Partly(match lattices.step()? {
                true => ComponentSetup::Lattices(lattices),
                false => ComponentSetup::FirstLevel(Box::new(lattices.into_level()?)),
            }),
            ComponentSetup::FirstLevel(level) => {
                SetupStep::Fully(Box::new(level.into_multilevel()?))
            }
        })
    }

    /// On the finest lattice.
    pub(crate) fn problem(&self) -> &Problem {
        match self {
            ComponentSetup::Lattices(lattices) => &lattices.problem,
            ComponentSetup::FirstLevel(level) => level.finer.first().unwrap_or(&level.problem),
        }
    }

    /// The input as it is.
    pub(crate) fn answer(&self) -> Result<Answer> {
        let plan = match self {
            ComponentSetup::Lattices(lattices) => &lattices.plan,
            ComponentSetup::FirstLevel(level) => &level.plan,
        };
        let problem = self.problem().clone();
        let first_rho = plan.first_rho(&problem);
        Ok(Answer {
            state: State::new(&problem, first_rho)?,
            best: Best::of_input(&problem),
            problem,
            first_rho,
            reason: StopReason::Cancelled,
            levels: Vec::new(),
            passes: 0,
            creases: Creases::default(),
            seconds: Seconds::default(),
        })
    }
}

impl Lattices {
    /// Whether there is more to be done.
    fn step(&mut self) -> Result<bool> {
        match self.next {
            Next::Coarsen | Next::CoarsenAgain => {
                if !self.coarsen()? {
                    let fill = self.next == Next::Coarsen && !self.problem.free.is_empty();
                    self.next = if fill { Next::Fill } else { Next::Done };
                }
            }
            Next::Fill => {
                thin_plate::fill(&mut self.problem, &self.domains, &self.plan, self.guess)?;
                self.problem
                    .take_first_normals(self.options.energy_or_default())?;
                give_back(&mut self.input, &self.problem)?;
                self.domains.truncate(1);
                self.coarse.clear();
                self.next = Next::CoarsenAgain;
            }
            Next::Done => return Ok(false),
        }
        Ok(true)
    }

    /// The next coarser lattice, unless that is of no use: as long as enough stencils are left, and
    /// each stands for four of the finer ones, within a factor of 2. Where holes take most of them
    /// away, or close, the next lattice says little about the last.
    fn coarsen(&mut self) -> Result<bool> {
        let finer = &self.domains[self.domains.len() - 1];
        let next = coarsen(self.coarse.last().unwrap_or(&self.input), finer)?;
        let Ok(domain) = next.domain() else {
            return Ok(false);
        };
        let (fine, coarse) = (finer.interior_len(), domain.interior_len());
        let is_of_use = coarse >= COARSEST_GRID && (fine / 8..=3 * fine / 8).contains(&coarse);
        if is_of_use {
            self.domains.push(Arc::new(domain));
            self.coarse.push(next);
        }
        Ok(is_of_use)
    }

    /// The coarsest lattice that is worth a level of its own, or the finest where there is a state
    /// to start from.
    fn into_level(self) -> Result<FirstLevel> {
        let Lattices {
            mut problem,
            domains,
            options,
            plan,
            ..
        } = self;
        let mut finer = Vec::new();
        let state = match self.warm {
            Some(state) => state,
            None => {
                for (input, domain) in self.coarse.iter().zip(&domains[1..]) {
                    if !plan.wants_level(domain.interior_len()) {
                        break;
                    }
                    let coarse = Problem::new(input, domain.clone(), &self.coordinates, &options)?;
                    finer.push(mem::replace(&mut problem, coarse));
                }
                State::new(&problem, plan.first_rho(&problem))?
            }
        };
        let cg = ConjugateGradients::new(&problem, &domains[finer.len()..], state.rho)?;
        Ok(FirstLevel {
            options,
            plan,
            problem,
            state,
            cg,
            finer,
            domains,
        })
    }
}

impl FirstLevel {
    fn into_multilevel(self) -> Result<Multilevel> {
        let plan = self.plan.on_level(!self.finer.is_empty(), 0);
        let (level, reason) = Level::new(self.problem, self.state, self.cg, plan, 0, true)?;
        Multilevel::new(
            level,
            reason,
            self.finer,
            self.domains,
            self.plan,
            &self.options,
        )
    }
}

/// Puts the heights that were found for free vertices where the given ones are.
fn give_back(input: &mut Input, problem: &Problem) -> Result<()> {
    let domain = &problem.operator.domain;
    let lattice = *input.field.lattice();
    let mut heights = input.field.heights().to_vec();
    for cell in &problem.free {
        let cell = *cell as usize;
        heights[domain.lattice_index(cell)] = problem
            .operator
            .coordinates
            .outward(position(domain, cell), problem.target[cell]);
    }
    input.field = Heightfield::new(lattice, heights)?;
    Ok(())
}

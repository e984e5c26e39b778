//! Set-up of one component's solve in steps, before its first iteration: the energy, and the coarser lattices.

use std::mem;
use std::sync::Arc;

use super::admm::incumbent::Incumbent;
use super::admm::parameters::AdmmParameters;
use super::admm::solver::initial_rho;
use super::coarsen::coarsen;
use super::coordinates::Coordinates;
use super::energy::creases::Creases;
use super::heightfields::{AdmmSolver, Iterate, Problem};
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

/// Minimum requested duality gap at which a solve counts as a preview, for which the thin plate of an earlier solve is
/// a good enough initial guess.
const PREVIEW_GAP: f64 = 0.05;

/// Minimum number of interior vertices of a coarse lattice of the multigrid hierarchy.
const MIN_COARSE_GRID_VERTICES: usize = 20;

/// Set-up of one component's solve in steps: the problem on the finest lattice, and the coarser lattices made so far. It ends with
/// the [`Multilevel`] solve.
#[derive(Debug, Clone)]
pub(crate) struct ComponentSetup {
    input: Input,
    options: Options,
    coordinates: Coordinates,
    parameters: AdmmParameters,
    /// Problem on the finest lattice.
    pub problem: Problem,
    /// First iterate on the finest lattice, if there is a warm start.
    warm: Option<Iterate>,
    /// Initial guess for the thin plate's heights at free vertices.
    guess: InitialGuess,
    /// Domains of all lattices so far, the finest first.
    domains: Vec<Arc<Domain>>,
    /// Inputs on the coarser lattices.
    coarse: Vec<Input>,
    next: Next,
}

/// The next step of a set-up.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Next {
    /// Coarsen the input once more.
    Coarsen,
    /// Compute heights of free vertices, for which the coarse lattices are needed.
    Fill,
    /// Coarsen the input again, with the heights of free vertices.
    CoarsenAgain,
    Done,
}

impl ComponentSetup {
    /// Begins the set-up of a component. A `warm_start` is an earlier solve, with the vertex of the whole lattice that
    /// is vertex `(0, 0)` of the component's lattice.
    pub(crate) fn new(
        input: Input,
        domain: Arc<Domain>,
        scale: f64,
        options: &Options,
        warm_start: Option<(&WarmStart, (usize, usize))>,
    ) -> Result<Self> {
        let parameters = AdmmParameters::new(options);
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
                warm_start.iterate(&problem, &parameters, corner)?,
            ),
            None => (InitialGuess::Plane, None),
        };
        Ok(ComponentSetup {
            warm,
            guess,
            input,
            options: *options,
            coordinates,
            parameters,
            problem,
            domains: vec![domain],
            coarse: Vec::new(),
            next: if trivial { Next::Done } else { Next::Coarsen },
        })
    }

    /// Returns the input as the result of a solve that was cancelled before its first iteration.
    pub(crate) fn answer(&self) -> Result<Answer> {
        let problem = self.problem.clone();
        let initial_rho = initial_rho(&self.parameters, &problem);
        Ok(Answer {
            iterate: Iterate::new(&problem, initial_rho)?,
            incumbent: Incumbent::from_input(&problem),
            problem,
            initial_rho,
            reason: StopReason::Cancelled,
            levels: Vec::new(),
            passes: 0,
            creases: Creases::default(),
            seconds: Seconds::default(),
        })
    }

    /// Takes one step of the set-up, which costs about
    /// [`SET_UP_CG_ITERATIONS`](super::multilevel::SET_UP_CG_ITERATIONS) conjugate-gradient iterations; returns whether there is
    /// another one.
    pub(crate) fn step(&mut self) -> Result<bool> {
        match self.next {
            Next::Coarsen | Next::CoarsenAgain => {
                if !self.coarsen()? {
                    let fill = self.next == Next::Coarsen && !self.problem.free.is_empty();
                    self.next = if fill { Next::Fill } else { Next::Done };
                }
            }
            Next::Fill => {
                thin_plate::fill(
                    &mut self.problem,
                    &self.domains,
                    &self.parameters,
                    self.guess,
                )?;
                self.problem
                    .set_input_normal_weights(self.options.energy_or_default())?;
                give_back(&mut self.input, &self.problem)?;
                self.domains.truncate(1);
                self.coarse.clear();
                self.next = Next::CoarsenAgain;
            }
            Next::Done => return Ok(false),
        }
        Ok(true)
    }

    /// Adds the next coarser lattice and returns whether it is useful: it has enough stencils, and their number is a
    /// quarter of the finer lattice's within a factor of 2. Where holes take most of the stencils away, or close, the
    /// coarse lattice says little about the fine one.
    fn coarsen(&mut self) -> Result<bool> {
        let finer = &self.domains[self.domains.len() - 1];
        let next = coarsen(self.coarse.last().unwrap_or(&self.input), finer)?;
        let Ok(domain) = next.domain() else {
            return Ok(false);
        };
        let (fine, coarse) = (finer.interior_len(), domain.interior_len());
        let is_of_use =
            coarse >= MIN_COARSE_GRID_VERTICES && (fine / 8..=3 * fine / 8).contains(&coarse);
        if is_of_use {
            self.domains.push(Arc::new(domain));
            self.coarse.push(next);
        }
        Ok(is_of_use)
    }

    /// Begins the solve on its first level: the coarsest lattice that is worth a level of its own, or the finest one with a warm
    /// start.
    pub(crate) fn into_multilevel(self) -> Result<Multilevel> {
        let ComponentSetup {
            mut problem,
            domains,
            options,
            parameters,
            ..
        } = self;
        let mut finer = Vec::new();
        let iterate = match self.warm {
            Some(iterate) => iterate,
            None => {
                for (input, domain) in self.coarse.iter().zip(&domains[1..]) {
                    if !parameters.wants_level(domain.interior_len()) {
                        break;
                    }
                    let coarse = Problem::new(input, domain.clone(), &self.coordinates, &options)?;
                    finer.push(mem::replace(&mut problem, coarse));
                }
                Iterate::new(&problem, initial_rho(&parameters, &problem))?
            }
        };
        let cg = ConjugateGradients::new(&problem, &domains[finer.len()..], iterate.rho)?;
        let on_level = parameters.on_level(!finer.is_empty(), 0);
        let (level, reason) = AdmmSolver::new(problem, iterate, cg, on_level, 0, true)?;
        Multilevel::new(level, reason, finer, domains, parameters, &options)
    }
}

/// Writes the heights that were found for the problem's free vertices into the input.
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

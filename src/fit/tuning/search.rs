//! Choice of λ and of the penalty by solves on coarse lattices, before the one solve at full size.
//!
//! The distance of a coarse solve's surface to the heights tells whether λ suits: it is the size of the noise, or the
//! tolerance that was asked for. Which bends are cheap and which of them are creases follows from heights whose noise a solve
//! does not know.

use std::sync::Arc;

use web_time::Instant;

use super::closed_form::{InputStatistics, with_huber_defaults};
use super::merge::merge;
use super::refinement::{Aim, Next, Refinement};
use super::residual::root_mean_square;
use super::validation::Validation;
use crate::error::Result;
use crate::fit::component_solver::{ComponentSolver, PreparedInput, StartMode, Status};
use crate::fit::input::Input;
use crate::fit::options::{Energy, HuberOptions, LAMBDA_RANGE, Options};
use crate::fit::report::{LambdaChoice, LambdaReason};
use crate::fit::warm_start::WarmStart;

/// Penalties that are compared to [`HuberOptions::ANY`], in this order: flat facets with creases, and smooth bends
/// (`benches/scenes.md`, Fewer rules).
const OTHER_PENALTIES: [HuberOptions; 2] = [HuberOptions::new(0.1, 1.0, 0.2), HuberOptions::SMOOTH];

/// Minimum number of interior vertices of a coarse lattice (`benches/scenes.md`).
const MIN_COARSE_VERTICES: usize = 400;

/// Relative duality gap of coarse solves: their surfaces differ by more than it leaves open
/// (`benches/scenes.md`, One constant at a time).
const SEARCH_GAP: f64 = 0.05;

/// Factor between the values of λ that are compared under correlated noise (`benches/scenes.md`, Data thinning).
const LAMBDA_STEP: f64 = 3.0;

/// Choice of λ and of the penalty in progress.
#[derive(Debug, Clone)]
pub(crate) struct Search {
    statistics: InputStatistics,
    /// Options of the caller, with the λ that is best so far.
    first: Options,
    stage: Stage,
    solve: Box<ComponentSolver>,
    /// Penalty that is best so far.
    penalty: HuberOptions,
    /// Spacing of the coarse lattice, in those of the input's.
    spacings: f64,
    /// Whether candidates were compared.
    is_compared: bool,
    solves: usize,
    raises: usize,
    iterations: usize,
}

/// Stage of a search.
#[derive(Debug, Clone)]
enum Stage {
    /// λ is refined by the surfaces of a coarse input.
    Fidelity {
        input: Input,
        refinement: Refinement,
    },
    /// Candidates are compared by validation.
    Comparison(Comparison),
}

/// Validation of candidates in progress.
#[derive(Debug, Clone)]
struct Comparison {
    validation: Validation,
    /// Candidates that are still to be solved with; the last one is next.
    left: Vec<Candidate>,
    now: Candidate,
    best: Candidate,
    /// Squared prediction error of the best candidate.
    error: f64,
    /// Whether values of λ are to be compared after the penalties.
    compares_lambda: bool,
}

/// Penalty and λ.
#[derive(Debug, Clone, Copy)]
struct Candidate {
    penalty: HuberOptions,
    lambda: f64,
}

impl Search {
    /// Starts a search at the λ of `first`; `None` where neither λ nor a penalty is to be chosen by solves.
    ///
    /// # Errors
    /// Out of memory, and errors of the solver.
    pub(crate) fn new(
        input: &Input,
        first: &Options,
        statistics: InputStatistics,
        aim: Aim,
    ) -> Result<Option<Self>> {
        let coarse = coarse_input(input)?;
        if interior_len(&coarse) == 0 {
            return Ok(None);
        }
        // Noise is no guide where a distance is aimed at.
        let statistics = InputStatistics {
            noise: statistics.noise.filter(|_| matches!(aim, Aim::Noise(_))),
            ..statistics
        };
        let spacings = coarse.field.lattice().spacing() / input.field.lattice().spacing();
        let refinement = Refinement::new(aim, spacings);
        let penalty = match aim {
            Aim::Noise(_) => HuberOptions::ANY,
            Aim::Distance { .. } => HuberOptions::SMOOTH,
        };
        let solve = trial(&coarse, &trial_options(first, penalty), statistics, None)?;
        Ok(Some(Search {
            statistics,
            first: *first,
            stage: Stage::Fidelity {
                input: coarse,
                refinement,
            },
            solve: Box::new(solve),
            penalty,
            spacings,
            is_compared: false,
            solves: 0,
            raises: 0,
            iterations: 0,
        }))
    }

    /// Continues the search until `left` conjugate-gradient iterations are used up; returns whether it has finished.
    pub(crate) fn advance(&mut self, left: &mut usize) -> Result<bool> {
        while *left > 0 {
            let before = self.solve.progress().cg_iterations;
            let mut work = *left;
            let status = self.solve.advance(&mut work)?;
            let done = self.solve.progress().cg_iterations - before;
            *left = left.saturating_sub(done.max(1));
            if status == Status::Running {
                continue;
            }
            if !self.take_solve()? {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// Uses the surface of a finished coarse solve, and starts the next one; returns whether there is one.
    fn take_solve(&mut self) -> Result<bool> {
        let surface = self.solve.surface()?;
        self.iterations += surface.report().iterations;
        self.solves += 1;
        match &mut self.stage {
            Stage::Fidelity { input, refinement } => {
                let lambda = self.first.lambda_or_default().value();
                let (domain, field) = (&self.solve.domain, surface.heightfield());
                let residual = root_mean_square(input, domain, field, refinement.unit())?;
                let next = refinement.next(lambda, residual);
                match next {
                    Next::Solve(next) => {
                        let warm_start = self.solve.warm_start(input.field.lattice());
                        self.raises += usize::from(next > lambda);
                        self.first = self.first.lambda(next);
                        let options = trial_options(&self.first, self.penalty);
                        *self.solve = trial(input, &options, self.statistics, warm_start)?;
                        Ok(true)
                    }
                    Next::Keep(next) => {
                        self.raises -= usize::from(next < lambda && self.raises > 0);
                        self.first = self.first.lambda(next);
                        let coarse = input.clone();
                        self.start_comparison(&coarse)
                    }
                }
            }
            Stage::Comparison(comparison) => {
                comparison.take(comparison.validation.squared_error(surface.heightfield()));
                let is_left = comparison.step();
                let (input, best) = (&comparison.validation.input, comparison.best);
                if is_left {
                    let warm_start = self.solve.warm_start(input.field.lattice());
                    let options = comparison.options(&self.first);
                    *self.solve = trial(input, &options, self.statistics, warm_start)?;
                } else {
                    self.penalty = best.penalty;
                    self.first = self.first.lambda(best.lambda);
                }
                Ok(is_left)
            }
        }
    }

    /// Starts the comparison of candidates on the coarse lattice if there are any, and enough heights validate them; returns whether
    /// it does. Under correlated noise these are penalties, and then values of λ; else penalties alone.
    fn start_comparison(&mut self, coarse: &Input) -> Result<bool> {
        let Some(noise) = self.statistics.noise else {
            return Ok(false);
        };
        let has_penalties = self.first.energy_or_default() == Energy::Huber;
        // Noise of pixels is independent from vertex to vertex of a lattice coarser than the input's.
        let is_independent = coarse.pixel_noise.is_none();
        let validation = match noise.is_correlated() {
            true => Validation::by_thinning(coarse, noise, self.spacings)?,
            false if has_penalties && is_independent => Validation::by_held_out_heights(coarse)?,
            false => None,
        };
        let Some(validation) = validation else {
            return Ok(false);
        };
        let lambda = self.first.lambda_or_default().value();
        let candidate = |penalty| Candidate { penalty, lambda };
        let others = OTHER_PENALTIES.into_iter().rev().filter(|_| has_penalties);
        let comparison = Comparison {
            left: others.map(candidate).collect(),
            now: candidate(self.penalty),
            best: candidate(self.penalty),
            error: f64::INFINITY,
            compares_lambda: noise.is_correlated(),
            validation,
        };
        let options = comparison.options(&self.first);
        *self.solve = trial(
            &comparison.validation.input,
            &options,
            self.statistics,
            None,
        )?;
        self.stage = Stage::Comparison(comparison);
        self.is_compared = true;
        Ok(true)
    }

    /// Number of ADMM iterations of all solves so far.
    pub(crate) fn iterations(&self) -> usize {
        self.iterations + self.solve.progress().iteration
    }

    /// Options with λ and the best penalty in all that was not given; writes the reason and the cost into `choice`.
    pub(crate) fn found(&self, choice: &mut LambdaChoice) -> Options {
        if self.is_compared {
            choice.reason = LambdaReason::Prediction;
        }
        choice.solves += self.solves;
        choice.raises = self.raises;
        choice.iterations += self.iterations;
        self.penalty.within(&self.first).of(&self.first)
    }
}

impl Comparison {
    /// Compares a candidate's squared prediction error with the least one.
    fn take(&mut self, error: f64) {
        if error < self.error {
            (self.best, self.error) = (self.now, error);
        }
    }

    /// Goes on to the next candidate; returns whether there is one.
    fn step(&mut self) -> bool {
        if self.left.is_empty() && self.compares_lambda {
            self.compares_lambda = false;
            let Candidate { penalty, lambda } = self.best;
            let [low, high] = [LAMBDA_RANGE.start(), LAMBDA_RANGE.end()];
            let factors = [LAMBDA_STEP, 1.0 / LAMBDA_STEP];
            self.left.extend(factors.map(|factor| Candidate {
                penalty,
                lambda: (factor * lambda).clamp(*low, *high),
            }));
        }
        let next = self.left.pop();
        self.now = next.unwrap_or(self.now);
        next.is_some()
    }

    /// Returns the options of the solve with the present candidate.
    fn options(&self, first: &Options) -> Options {
        let lambda = self.now.lambda * self.validation.lambda_factor;
        trial_options(&first.lambda(lambda), self.now.penalty)
    }
}

pub(super) fn interior_len(input: &Input) -> usize {
    input.domain().map_or(0, |domain| domain.interior_len())
}

/// Averages an input to the coarsest lattice with [`MIN_COARSE_VERTICES`] interior vertices, or keeps it where it has fewer.
fn coarse_input(input: &Input) -> Result<Input> {
    let mut coarse = input.clone();
    loop {
        let coarser = merge(&coarse)?;
        if interior_len(&coarser) < MIN_COARSE_VERTICES {
            return Ok(coarse);
        }
        coarse = coarser;
    }
}

/// Options of solves that look for λ or level lines: the energy and normalisation that were asked for, a coarse duality gap, and the
/// shape alone.
/// Parameters of the penalty that the caller gave are left out, so that they change no other parameter.
pub(crate) fn trial_options(first: &Options, penalty: HuberOptions) -> Options {
    Options {
        energy: first.energy,
        normalization: first.normalization,
        lambda: first.lambda,
        is_trial: true,
        ..penalty.of(&Options::default())
    }
    .gap(SEARCH_GAP)
}

/// Starts a coarse solve.
pub(super) fn trial(
    input: &Input,
    options: &Options,
    InputStatistics { scale, noise, .. }: InputStatistics,
    warm_start: Option<Arc<WarmStart>>,
) -> Result<ComponentSolver> {
    let started = Instant::now();
    let prepared = PreparedInput::new(input.clone())?;
    let options = with_huber_defaults(options, noise, scale);
    let start_mode = StartMode::Immediate;
    ComponentSolver::new(prepared, &options, scale, warm_start, start_mode, started)
}

#[cfg(all(test, not(target_arch = "wasm32")))] // proptest is native
mod tests {
    use super::*;
    use crate::fit::options::Lambda;
    use crate::fit::solver::fit;
    use crate::lattice::domain::tests::arbitrary_field;
    use crate::{Heightfield, Lattice};
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(60))]
        /// Outlines, holes and sizes of any kind, heights from far too small to far too large.
        #[test]
        fn any_input_gets_a_lambda_or_an_error(
            outline in arbitrary_field(), seed in 0..1000u64, size in -20..20i32,
        ) {
            let mut random = oorandom::Rand64::new(seed.into());
            let scale = 10f64.powi(size);
            let heights = outline.heights().iter().map(|z| z * 0.0 + scale * random.rand_float());
            let field = Heightfield::new(*outline.lattice(), heights.collect()).unwrap();
            let given = field.heights().iter().filter(|z| !z.is_nan()).count();
            let options = Options::default().lambda(Lambda::Auto).energy(Energy::Huber);
            if let Ok(surface) = fit(&field, &options) {
                let report = surface.report();
                prop_assert!(report.lambda.is_finite() && report.lambda > 0.0, "{report:?}");
                prop_assert!(report.lambda_choice.is_some());
                let found = surface.heightfield().heights().iter().filter(|z| z.is_finite());
                prop_assert!(found.count() >= given);
            }
        }
    }

    /// λ is checked once, then each penalty is tried once.
    #[test]
    fn every_penalty_is_tried_once() {
        let lattice = Lattice::new(90, 90, 1.0).unwrap();
        let mut random = oorandom::Rand64::new(4);
        let field = Heightfield::from_fn(lattice, |x, _| x.max(60.0 - x)).unwrap();
        let heights = field.heights().iter().map(|z| z + random.rand_float());
        let field = Heightfield::new(lattice, heights.collect()).unwrap();
        let surface = fit(&field, &Options::default()).unwrap();
        let choice = surface.report().lambda_choice.unwrap();
        assert_eq!(choice.solves, 1 + (1 + OTHER_PENALTIES.len()));
        assert!(choice.iterations > 0);
        let ratio = surface.report().lambda * choice.sigma.unwrap() / (90.0 * 90.0);
        assert!((0.1..100.0).contains(&ratio), "{ratio}");
    }
}

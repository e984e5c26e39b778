//! Penalty of [`Energy::Huber`] by cross-validation: the one under which a solve predicts held-out heights best.
//!
//! λ follows from the noise ([`closed_form`](super::closed_form)). Which bends are cheap and which of them are creases
//! does not, so a few penalties are compared at that λ, each by one solve on a coarser lattice.

use std::sync::Arc;

use web_time::Instant;

use super::closed_form::{Known, default_penalty, with_huber_defaults};
use super::held_out::{HeldOut, advantage};
use super::merge::merge;
use super::noise::Noise;
use crate::error::Result;
use crate::fit::component_solver::{ComponentSolver, PreparedInput, StartMode, Status};
use crate::fit::input::Input;
use crate::fit::options::{Energy, HuberOptions, Options};
use crate::fit::report::{LambdaChoice, LambdaReason};
use crate::fit::warm_start::WarmStart;

/// Penalties that are compared to [`default_penalty`], in this order: flat facets with creases, smooth bends, smooth
/// bends with creases (`benches/choices.md`).
const OTHER_PENALTIES: [HuberOptions; 3] = [
    HuberOptions::new(0.1, 1.0, 0.2),
    HuberOptions::SMOOTH,
    HuberOptions::new(0.3, 0.3, 0.3),
];

/// Minimum number of standard errors by which a penalty must predict held-out heights better to replace the best one.
const MIN_ADVANTAGE: f64 = 1.0;

/// Number of times that the spacing is doubled before penalties are compared, where enough vertices are left: a solve
/// then costs a sixteenth.
const SEARCH_MERGES: usize = 2;

/// Minimum number of interior vertices of the first lattice on which noise is white, if that is not the input's.
const MIN_MERGED_VERTICES: usize = 400;

/// Minimum number of interior vertices of a lattice of twice the spacing, where the finer one would do as well.
const MIN_SPARE_VERTICES: usize = 1500;

/// Relative duality gap of the solves that are compared: their surfaces differ by more than it leaves open.
const SEARCH_GAP: f64 = 0.1;

/// Maximum number of iterations of a solve that is compared.
const MAX_SEARCH_ITERATIONS: usize = 500;

/// Minimum relative reduction of the mean squared prediction error for a penalty of smaller flatness under correlated
/// noise. A surface that bends more easily follows such noise, and so predicts held-out heights better without being
/// nearer to the truth.
const CORRELATED_FLATNESS_GAIN: f64 = 0.15;

/// Minimum relative reduction of the mean squared prediction error at which a penalty of larger crease radius is chosen
/// under correlated noise.
const CORRELATED_CREASE_GAIN: f64 = 0.045;

/// Minimum relative reduction of the mean squared prediction error at which a penalty of larger crease radius is chosen
/// where noise is correlated on the input's lattice but white on the coarse lattice of the search: on the input's
/// lattice creases would follow the noise.
const FINER_CREASE_GAIN: f64 = 0.021;

/// Cross-validation in progress.
#[derive(Debug, Clone)]
pub(crate) struct Search {
    held_out: HeldOut,
    known: Known,
    /// Whether noise is correlated on the lattice of the search, so that held-out noise can be predicted.
    is_correlated: bool,
    /// Options of the caller, with λ.
    first: Options,
    penalties: Vec<HuberOptions>,
    /// Index of the penalty that is tried.
    now: usize,
    /// Index of the best penalty so far, and its squared prediction errors.
    best: usize,
    misses: Vec<f64>,
    solve: Box<ComponentSolver>,
    iterations: usize,
}

impl Search {
    /// Starts a search at the λ of `first`; `None` where no penalty is to be chosen, too few heights can be held out,
    /// or noise is correlated on every lattice that is large enough. Quantised heights are searched all the same.
    ///
    /// # Errors
    /// Out of memory, and errors of the solver.
    pub(crate) fn new(input: &Input, first: &Options, known: Known) -> Result<Option<Self>> {
        let Some(noise) = known.noise else {
            return Ok(None);
        };
        if first.energy_or_default() != Energy::Huber {
            return Ok(None);
        }
        let (input, is_correlated) = searchable(input, noise)?;
        if is_correlated && noise.step.is_none() {
            return Ok(None);
        }
        let Some(held_out) = HeldOut::from_input(&input)? else {
            return Ok(None);
        };
        let mut penalties = vec![default_penalty(known.noise)];
        penalties.extend(OTHER_PENALTIES);
        let options = trial_options(first, penalties[0]);
        let solve = trial(&held_out, &options, known, None)?;
        Ok(Some(Search {
            held_out,
            known,
            is_correlated,
            first: *first,
            penalties,
            now: 0,
            best: 0,
            misses: Vec::new(),
            solve: Box::new(solve),
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
            let surface = self.solve.surface()?;
            self.iterations += surface.report().iterations;
            let misses = self.held_out.misses(surface.heightfield());
            if self.now == 0 || self.is_better(&misses) {
                (self.best, self.misses) = (self.now, misses);
            }
            self.now += 1;
            let Some(penalty) = self.penalties.get(self.now) else {
                return Ok(true);
            };
            let options = trial_options(&self.first, *penalty);
            let warm_start = self.solve.warm_start(self.held_out.input.field.lattice());
            *self.solve = trial(&self.held_out, &options, self.known, warm_start)?;
        }
        Ok(false)
    }

    /// Whether the penalty that was tried replaces the best one so far; `misses` are its squared prediction errors.
    fn is_better(&self, misses: &[f64]) -> bool {
        let [new, old] = [self.now, self.best].map(|index| self.penalties[index]);
        let sharp = old.crease_radius.max(HuberOptions::SMOOTH.crease_radius);
        let was_correlated = self.known.noise.is_some_and(|noise| noise.merged > 0);
        let min_gain = match (self.is_correlated, new.crease_radius > sharp) {
            (true, _) if new.flatness < old.flatness => CORRELATED_FLATNESS_GAIN,
            (true, true) => CORRELATED_CREASE_GAIN,
            (false, true) if was_correlated => FINER_CREASE_GAIN,
            _ => 0.0,
        };
        let sum = |misses: &[f64]| misses.iter().sum::<f64>();
        sum(misses) <= (1.0 - min_gain) * sum(&self.misses)
            && advantage(&self.misses, misses) > MIN_ADVANTAGE
    }

    /// Number of ADMM iterations of all solves so far.
    pub(crate) fn iterations(&self) -> usize {
        self.iterations + self.solve.progress().iteration
    }

    /// Options with the best penalty in all that was not given; writes the reason and the cost into `choice`.
    pub(crate) fn found(&self, choice: &mut LambdaChoice) -> Options {
        choice.reason = LambdaReason::Prediction;
        choice.solves = self.now;
        choice.iterations = self.iterations;
        self.penalties[self.best]
            .within(&self.first)
            .of(&self.first)
    }
}

/// The input on the lattice of a search, and whether its noise is correlated there, too.
fn searchable(input: &Input, noise: Noise) -> Result<(Input, bool)> {
    // Rounding errors of quantised heights are correlated on every lattice.
    let whitening = match noise.step {
        Some(_) => 0,
        None => noise.merged,
    };
    let mut searched = input.clone();
    let mut merges = 0;
    while merges < whitening.max(SEARCH_MERGES) {
        let coarse = merge(&searched)?;
        let size = coarse.domain().map_or(0, |domain| domain.interior_len());
        let is_spare = merges >= whitening.max(1);
        let least = if is_spare {
            MIN_SPARE_VERTICES
        } else {
            MIN_MERGED_VERTICES
        };
        if size < least {
            break;
        }
        searched = coarse;
        merges += 1;
    }
    let is_white = noise.step.is_none() && merges >= noise.merged;
    Ok((searched, !is_white && noise.merged > 0))
}

/// Options of the solves that are compared: the energy and normalisation that were asked for, a coarse duality gap, and
/// the shape alone. Parameters of the penalty that the caller gave are left out, so that they change no other parameter.
fn trial_options(first: &Options, penalty: HuberOptions) -> Options {
    Options {
        energy: first.energy,
        normalization: first.normalization,
        lambda: first.lambda,
        is_trial: true,
        ..penalty.of(&Options::default())
    }
    .max_iterations(MAX_SEARCH_ITERATIONS)
    .gap(SEARCH_GAP)
}

/// Starts a candidate's solve, of an input without the held-out heights.
fn trial(
    held_out: &HeldOut,
    options: &Options,
    Known { scale, noise }: Known,
    warm_start: Option<Arc<WarmStart>>,
) -> Result<ComponentSolver> {
    let started = Instant::now();
    let prepared = PreparedInput::new(held_out.input.clone())?;
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

    /// Each penalty is tried once, at the λ that follows from the noise.
    #[test]
    fn every_penalty_is_tried_once() {
        let lattice = Lattice::new(90, 90, 1.0).unwrap();
        let mut random = oorandom::Rand64::new(4);
        let field = Heightfield::from_fn(lattice, |x, _| x.max(60.0 - x)).unwrap();
        let heights = field.heights().iter().map(|z| z + random.rand_float());
        let field = Heightfield::new(lattice, heights.collect()).unwrap();
        let surface = fit(&field, &Options::default()).unwrap();
        let choice = surface.report().lambda_choice.unwrap();
        assert_eq!(choice.solves, 1 + OTHER_PENALTIES.len());
        assert!(choice.iterations > 0);
        let ratio = surface.report().lambda * choice.sigma.unwrap() / (90.0 * 90.0);
        assert!((0.1..100.0).contains(&ratio), "{ratio}");
    }
}

//! Choice of λ and of the parameters of [`Energy::Huber`]: from the noise at first, then by how well solves predict
//! held-out heights.

use std::mem;
use std::sync::Arc;

use web_time::Instant;

use super::held_out::{HELD_OUT_CLASSES, HeldOut, advantage};
use super::merge::merge;
use super::noise::Noise;
use crate::error::Result;
use crate::fit::component_solver::{ComponentSolver, PreparedInput, StartMode, Status};
use crate::fit::input::Input;
use crate::fit::options::{Bending, Border, Energy, Lambda, Options};
use crate::fit::report::{LambdaChoice, LambdaReason};
use crate::fit::warm_start::WarmStart;

/// Product `λ σ h` of the first λ that is tried under white noise, in normalised coordinates: σ is the noise's standard
/// deviation, h the spacing. The best λ is about there.
const FIRST_LAMBDA_NOISE: f64 = 8.0;

/// Product `λ σ h √A` of the first λ that is tried under correlated noise, of which `A` vertices share a value, in
/// normalised coordinates. It is larger than under white noise, since a shape beside such noise makes the noise look
/// larger than it is (`benches/scenes.md`).
const CORRELATED_LAMBDA_NOISE: f64 = 14.0;

/// Maximum λ that the search for the best λ begins with. An input whose noise is so small that it asks for a larger one
/// counts as free of noise and gets [`WITHOUT_NOISE`].
const MAX_SEARCH_LAMBDA: f64 = 1e9;
const WITHOUT_NOISE: Lambda = Lambda::Big;

/// Factor from one λ that is tried to the next.
const LAMBDA_STEP_FACTOR: f64 = 3.0;

/// Maximum number of times that λ is divided by [`LAMBDA_STEP_FACTOR`] in the search for the best λ.
const MAX_STEPS_DOWN: i32 = 3;

/// Maximum number of times that four vertices are averaged to one before the search for the best λ.
const MAX_MERGES: usize = 4;

/// Relative duality gap of the solves that cross-validation compares: their surfaces differ by more than it leaves
/// open.
const SEARCH_GAP: f64 = 0.02;

/// Maximum number of ADMM iterations of a solve that cross-validation compares.
const MAX_SEARCH_ITERATIONS: usize = 500;

/// Minimum number of interior vertices of the lattice of twice the spacing at which cross-validation runs there.
const MIN_DOUBLED_VERTICES: usize = 1500;

/// Minimum number of interior vertices of a lattice, coarsened until correlated noise is white, at which
/// cross-validation runs there.
const MIN_WHITENED_VERTICES: usize = 400;

/// Minimum number of held-out heights that resolves small differences between candidates for λ and Huber parameters.
/// Where one class of vertices has fewer, further classes are held out, each in a solve of its own.
const MIN_HELD_OUT_HEIGHTS: usize = 1500;

/// Number of standard errors by which a candidate with a smaller λ must predict held-out heights better to replace the
/// best one: it may be a little worse. A candidate with another penalty has the threshold of its [`Choice`].
const SMALLER_LAMBDA_HURDLE: f64 = -0.5;

/// Number of standard errors by which a candidate with a larger λ must predict held-out heights better to replace the
/// best one.
const LARGER_LAMBDA_HURDLE: f64 = 2.0;

/// Ratio of λ to the λ that suits the noise ([`FIRST_LAMBDA_NOISE`]) above which there are no crease passes, since
/// these would make creases of noise.
const LOUD_NOISE_RATIO: f64 = 2.0;

/// Minimum relative reduction of the mean squared prediction error at which a penalty of smaller flatness is chosen
/// under correlated noise. A surface that bends more easily follows such noise, and so predicts held-out heights better
/// without being nearer to the truth.
const CORRELATED_FLATNESS_GAIN: f64 = 0.15;

/// Minimum relative reduction of the mean squared prediction error at which a penalty of larger crease radius is chosen
/// under correlated noise.
const CORRELATED_CREASE_GAIN: f64 = 0.045;

/// Minimum relative reduction of the mean squared prediction error at which a penalty of larger crease radius is chosen
/// where noise is correlated on the input's lattice but white on the coarse lattice of the search: on the input's
/// lattice creases would follow the noise.
const FINER_CREASE_GAIN: f64 = 0.021;

/// Number of standard errors by which another penalty must predict held-out heights better under correlated noise,
/// besides the relative reduction of the error.
const BENDING_HURDLE: f64 = 1.0;

/// Parameters of the Huber penalty that cross-validation compares, in order: the nuclear norm as the starting point,
/// smooth bends, smooth bends with creases, flat facets, and smooth bends without flatness.
const BENDING_CHOICES: [Choice; 5] = [
    (Bending::NUCLEAR, &[0], 0.0),
    (Bending::SMOOTH, &[0, -1], 0.0),
    (Bending::new(0.3, 0.3, 0.3), &[0], 0.0),
    (Bending::new(0.1, 1.0, 0.2), &[0], 0.0),
    (Bending::new(0.1, 0.0, 0.3), &[-1], 1.0),
];

/// Noise and coordinate scale of an input, known before its solve.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Known {
    pub scale: f64,
    pub noise: Option<Noise>,
}

impl Known {
    pub(crate) fn of(input: &Input, options: &Options) -> Result<Self> {
        let wanted = options.lambda_or_default() == Lambda::Auto
            || options.energy_or_default() == Energy::Huber;
        Ok(Known {
            scale: options.normalization.factor(&input.field),
            noise: if wanted {
                Noise::from_input(input)?
            } else {
                None
            },
        })
    }
}

/// Makes the initial options of a search, with the initial λ and the reason for it: a λ from the size of the noise,
/// [`WITHOUT_NOISE`] for an input without noise, or [`Lambda::Medium`] where the noise cannot be measured.
pub(crate) fn initial_options(
    options: &Options,
    noise: Option<Noise>,
    scale: f64,
) -> (Options, LambdaChoice) {
    let mut choice = LambdaChoice {
        reason: LambdaReason::Unknown,
        sigma: noise.map(|noise| noise.sigma),
        step: noise.and_then(|noise| noise.step),
        correlation_length: noise.map_or(0.0, |noise| noise.correlation_length),
        ambiguous: noise.is_some_and(|noise| noise.ambiguous),
        merged: noise.map_or(0, |noise| noise.merged),
        solves: 0,
        iterations: 0,
    };
    let lambda = match noise.map(|noise| {
        let product = match noise.correlation_length > 0.0 {
            true => CORRELATED_LAMBDA_NOISE,
            false => FIRST_LAMBDA_NOISE,
        };
        product / (noise.product * scale * scale)
    }) {
        None => Lambda::Medium,
        Some(lambda) if lambda <= MAX_SEARCH_LAMBDA => {
            choice.reason = LambdaReason::Noise;
            Lambda::Value(lambda.max(1.0 / MAX_SEARCH_LAMBDA))
        }
        Some(_) => {
            choice.reason = LambdaReason::NoNoise;
            WITHOUT_NOISE
        }
    };
    (options.lambda(lambda), choice)
}

/// Fills in the default Huber parameters where the options give none, restrained so that the surface does not follow
/// noise where λ is large for it.
pub(crate) fn with_huber_defaults(options: &Options, noise: Option<Noise>, scale: f64) -> Options {
    let loudness = noise.map_or(0.0, |noise| {
        options.lambda_or_default().value() * noise.product * scale * scale / FIRST_LAMBDA_NOISE
    });
    at_loudness(options, Bending::SMOOTH, loudness)
}

/// Makes the fallback options where cross-validation is impossible: those of [`initial_options`] with fixed Huber
/// parameters. Under correlated noise these are the nuclear norm's, as any other penalty would follow the noise.
pub(crate) fn without_search(first: &Options, noise: Option<Noise>) -> Options {
    match noise.is_some_and(|noise| noise.merged > 0) {
        true => at_loudness(first, Bending::NUCLEAR, f64::INFINITY),
        false => at_loudness(first, Bending::ANY, 1.0),
    }
}

/// Fills in the parameters of `bending` where the options give none, restrained so that the surface does not follow
/// noise. `loudness` is the ratio of λ to the λ that suits the noise: flatness grows in proportion to it, up to 1 (the
/// nuclear norm), and above [`LOUD_NOISE_RATIO`] there are no crease passes.
fn at_loudness(options: &Options, bending: Bending, loudness: f64) -> Options {
    let quiet = Bending {
        flatness: (Bending::SMOOTH.flatness * loudness).clamp(bending.flatness, 1.0),
        ..bending
    };
    let mut out = quiet.within(options).of(options);
    if loudness > LOUD_NOISE_RATIO {
        out.crease_passes.get_or_insert(0);
    }
    out
}

/// Brings an input to the lattice on which cross-validation runs; also returns whether its noise is correlated there,
/// too.
fn searchable(input: &Input, noise: Noise) -> Result<(Input, bool)> {
    let halved = |input: &Input| -> Result<(Input, usize)> {
        let merged = merge(input)?;
        let size = merged.domain().map_or(0, |domain| domain.interior_len());
        Ok((merged, size))
    };
    // Rounding errors of quantised heights are correlated on every lattice.
    if noise.step.is_none() && (1..=MAX_MERGES).contains(&noise.merged) {
        let mut coarse = input.clone();
        let mut size = usize::MAX;
        for _ in 0..noise.merged {
            (coarse, size) = halved(&coarse)?;
        }
        if size >= MIN_WHITENED_VERTICES {
            return Ok((coarse, false));
        }
    }
    let (coarse, size) = halved(input)?;
    let searched = if size < MIN_DOUBLED_VERTICES {
        input.clone()
    } else {
        coarse
    };
    Ok((searched, noise.merged > 0))
}

/// Candidate of cross-validation: index of its penalty among [`Search::bendings`], and the exponent of
/// [`LAMBDA_STEP_FACTOR`] by which its λ differs from the first.
type Candidate = (usize, i32);

/// Huber parameters to compare, the exponents of [`LAMBDA_STEP_FACTOR`] to try with them, and the number of standard
/// errors by which they must predict held-out heights better than the best candidate.
type Choice = (Bending, &'static [i32], f64);

/// Cross-validation in progress: compares candidates for λ and Huber parameters by how well they predict held-out
/// heights.
#[derive(Debug, Clone)]
pub(crate) struct Search {
    /// Inputs with held-out heights: each candidate is solved once for each of them.
    held_out: Vec<HeldOut>,
    /// Exponents of [`LAMBDA_STEP_FACTOR`] at the smallest and the largest λ to try. The largest is 0, the first λ,
    /// where noise is quantised or correlated on the input's lattice.
    steps: [i32; 2],
    /// Whether noise is correlated on the lattice of the search, so that held-out noise can be predicted. Then λ stays
    /// the first one, and another penalty needs a minimum reduction of the prediction error.
    dependent: bool,
    known: Known,
    /// Options that the caller asked for.
    asked: Options,
    /// Options that all solves of the cross-validation share, with the first λ.
    options: Options,
    bendings: Vec<Choice>,
    /// Candidates for λ and Huber parameters that have been compared so far.
    tried: Vec<Candidate>,
    best: Candidate,
    misses: Vec<f64>,
    now: Candidate,
    /// Squared prediction errors of the current candidate in its finished solves.
    missed: Vec<f64>,
    solved: usize,
    solve: Box<ComponentSolver>,
    iterations: usize,
}

impl Search {
    /// Starts a search for λ and Huber parameters around the options that [`initial_options`] gives; `None` where too
    /// few heights can be held out, or noise is correlated on every lattice large enough. Quantised heights are
    /// searched all the same, for the Huber parameters alone.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory), and errors of the solver.
    pub(crate) fn new(
        input: &Input,
        asked: &Options,
        first: &Options,
        known: Known,
    ) -> Result<Option<Self>> {
        let Some(noise) = known.noise else {
            return Ok(None);
        };
        let (input, dependent) = searchable(input, noise)?;
        if dependent && noise.step.is_none() {
            return Ok(None);
        }
        let Some(class) = HeldOut::of(&input, 0)? else {
            return Ok(None);
        };
        // Further held-out heights would not help: their noise is as predictable.
        let solves = match dependent {
            true => 1,
            false => MIN_HELD_OUT_HEIGHTS
                .div_ceil(class.len())
                .min(HELD_OUT_CLASSES),
        };
        let mut held_out = vec![class];
        for class in 1..solves {
            held_out.extend(HeldOut::of(&input, class)?);
        }
        let mut bendings: Vec<Choice> = Vec::new();
        for (bending, steps, hurdle) in BENDING_CHOICES {
            let steps: &[i32] = if dependent { &[0] } else { steps };
            let hurdle = if noise.merged > 0 {
                BENDING_HURDLE
            } else {
                hurdle
            };
            if asked.energy_or_default() == Energy::Huber || bendings.is_empty() {
                bendings.push((bending, steps, hurdle));
            }
        }
        let now = (0, 0);
        let compared = compared(asked, first.lambda_or_default());
        let options = candidate_options(&compared, &bendings, now);
        let solve = trial(&held_out[0], &options, known, None)?;
        Ok(Some(Search {
            held_out,
            steps: match dependent {
                true => [0, 0],
                false => [
                    -MAX_STEPS_DOWN,
                    i32::from(noise.merged == 0 && noise.step.is_none()),
                ],
            },
            dependent,
            known,
            asked: *asked,
            options: compared,
            bendings,
            tried: Vec::new(),
            best: now,
            misses: Vec::new(),
            now,
            missed: Vec::new(),
            solved: 0,
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
            let misses = self.held_out[self.solved].misses(surface.heightfield());
            self.missed.extend(misses);
            self.solved += 1;
            if self.solved < self.held_out.len() {
                self.begin()?;
                continue;
            }
            self.solved = 0;
            let misses = mem::take(&mut self.missed);
            if self.tried.is_empty() || self.is_better(&misses) {
                (self.best, self.misses) = (self.now, misses);
            }
            self.tried.push(self.now);
            let Some(next) = self.next() else {
                return Ok(true);
            };
            self.now = next;
            self.begin()?;
        }
        Ok(false)
    }

    /// Starts the next solve of the current candidate, with a warm start from the surface of the solve before.
    fn begin(&mut self) -> Result<()> {
        let held_out = &self.held_out[self.solved];
        let options = candidate_options(&self.options, &self.bendings, self.now);
        let memory = self.solve.warm_start(held_out.input.field.lattice());
        *self.solve = trial(held_out, &options, self.known, memory)?;
        Ok(())
    }

    /// Returns whether the current candidate replaces the best one so far; `misses` are its squared prediction errors.
    fn is_better(&self, misses: &[f64]) -> bool {
        let [(new, _, other), (old, ..)] =
            [self.now, self.best].map(|(bending, _)| self.bendings[bending]);
        let hurdle = match (self.now.0 == self.best.0, self.now.1 < self.best.1) {
            (false, _) => other,
            (true, true) => SMALLER_LAMBDA_HURDLE,
            (true, false) => LARGER_LAMBDA_HURDLE,
        };
        let sharp = old.crease_radius.max(Bending::SMOOTH.crease_radius);
        let correlated = self.known.noise.is_some_and(|noise| noise.merged > 0);
        let least = match (self.dependent, correlated && new.crease_radius > sharp) {
            (true, _) if new.flatness < old.flatness => CORRELATED_FLATNESS_GAIN,
            (true, true) => CORRELATED_CREASE_GAIN,
            (false, true) => FINER_CREASE_GAIN,
            _ => 0.0,
        };
        let sum = |misses: &[f64]| misses.iter().sum::<f64>();
        let enough = sum(misses) <= (1.0 - least) * sum(&self.misses);
        (least == 0.0 || enough) && advantage(&self.misses, misses) > hurdle
    }

    /// Returns the next candidate, or `None` at the end: first every penalty with each of its λ, then λ next to the
    /// best one's until neither neighbour is better. Only the nuclear norm is tried above the first λ, where other
    /// penalties would follow noise.
    fn next(&self) -> Option<Candidate> {
        let missing = |candidate: &Candidate| !self.tried.contains(candidate);
        let (bending, step) = self.best;
        let others = self.bendings.iter().enumerate();
        let others = others
            .flat_map(|(bending, (_, steps, _))| steps.iter().map(move |step| (bending, *step)));
        let [least, most] = self.steps;
        let most = if bending == 0 { most } else { 0 };
        let beside = [step - 1, step + 1]
            .into_iter()
            .filter(|step| (least..=most).contains(step))
            .map(|step| (bending, step));
        others.chain(beside).find(missing)
    }

    /// Number of ADMM iterations of all solves so far.
    pub(crate) fn iterations(&self) -> usize {
        self.iterations + self.solve.progress().iteration
    }

    /// Returns the options of the best candidate, with the caller's in all that was given; writes the reason and the
    /// cost into `choice`.
    pub(crate) fn found(&self, choice: &mut LambdaChoice) -> Options {
        if !self.dependent {
            choice.reason = LambdaReason::Prediction;
        }
        choice.solves = self.tried.len();
        choice.iterations = self.iterations;
        let found = candidate_options(&self.options, &self.bendings, self.best);
        Options {
            lambda: found.lambda,
            bend_radius: self.asked.bend_radius.or(found.bend_radius),
            flatness: self.asked.flatness.or(found.flatness),
            crease_radius: self.asked.crease_radius.or(found.crease_radius),
            crease_passes: self.asked.crease_passes.or(found.crease_passes),
            ..self.asked
        }
    }
}

/// Makes the options of a candidate from those with the first λ.
fn candidate_options(first: &Options, bendings: &[Choice], (bending, step): Candidate) -> Options {
    let factor = LAMBDA_STEP_FACTOR.powi(step);
    let options = first.lambda(first.lambda_or_default().value() * factor);
    at_loudness(&options, bendings[bending].0, factor)
}

/// Starts a candidate's solve, of an input without the held-out heights.
fn trial(
    held_out: &HeldOut,
    options: &Options,
    Known { scale, noise }: Known,
    memory: Option<Arc<WarmStart>>,
) -> Result<ComponentSolver> {
    let started = Instant::now();
    let solvable = PreparedInput::new(held_out.input.clone())?;
    let options = with_huber_defaults(options, noise, scale);
    ComponentSolver::new(
        solvable,
        &options,
        scale,
        memory,
        StartMode::Immediate,
        started,
    )
}

/// Makes the options of the compared solves: the energy and normalisation that were asked for, a coarse duality gap and
/// a free border. The other options hardly change which candidate is best.
fn compared(asked: &Options, first: Lambda) -> Options {
    Options {
        energy: asked.energy,
        normalization: asked.normalization,
        ..Options::default()
    }
    .lambda(first)
    .border(Border::Free)
    .max_iterations(MAX_SEARCH_ITERATIONS)
    .gap(SEARCH_GAP)
}

#[cfg(all(test, not(target_arch = "wasm32")))] // proptest is native
mod tests {
    use super::*;
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

    /// Candidates whose λ is too large for the noise have a large flatness and no crease passes.
    #[test]
    fn candidates_are_guarded() {
        let first = Options::default().energy(Energy::Huber).lambda(1e4);
        let at = |step| candidate_options(&first, &BENDING_CHOICES, (1, step));
        assert_eq!((at(0).flatness, at(0).crease_passes), (Some(0.3), None));
        assert_eq!((at(-1).flatness, at(-1).crease_passes), (Some(0.3), None));
        assert!((at(1).flatness.unwrap() - 0.9).abs() < 1e-12 && at(1).crease_passes == Some(0));
        assert_eq!(at(2).flatness, Some(1.0));
    }

    /// The input is a lattice without holes, large enough for a search on the lattice of twice the spacing.
    #[test]
    fn the_search_goes_on_to_the_best_bending_and_then_to_the_best_lambda() {
        let lattice = Lattice::new(90, 90, 1.0).unwrap();
        let mut random = oorandom::Rand64::new(4);
        let field = Heightfield::from_fn(lattice, |x, _| x.max(60.0 - x)).unwrap();
        let heights = field.heights().iter().map(|z| z + random.rand_float());
        let field = Heightfield::new(lattice, heights.collect()).unwrap();
        let surface = fit(&field, &Options::default().energy(Energy::Nuclear)).unwrap();
        let choice = surface.report().lambda_choice.unwrap();
        // The first, one to each side at least; there is but one bending.
        assert!((3..=6).contains(&choice.solves), "{choice:?}");
        assert!(choice.iterations > 0);
        let ratio = surface.report().lambda * choice.sigma.unwrap() / (90.0 * 90.0);
        assert!((0.1..100.0).contains(&ratio), "{ratio}");
    }
}

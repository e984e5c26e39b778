//! Reports of a solve: its progress while it runs, and its figures afterwards.

use super::options::Energy;
use super::threads::ThreadLimit;

/// Reason why a solve stopped.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(rename_all = "camelCase")
)]
#[non_exhaustive]
pub enum StopReason {
    /// The certified relative duality gap reached the option [`Options::gap`](crate::Options::gap).
    Gap,
    /// The residuals fell below the tolerances of the schedule [`Schedule::Paper`](crate::Schedule::Paper).
    Residuals,
    /// Objective and dual bound differ by no more than rounding errors: the surface is optimal as far as double
    /// precision can tell. This is the reason for an affine input.
    Rounding,
    /// The number of iterations reached the option [`Options::max_iterations`](crate::Options::max_iterations) before the
    /// duality gap was as small as asked for.
    MaxIterations,
    /// The progress callback, or [`Solver::cancel`](crate::Solver::cancel), asked to stop; in JavaScript the option `signal`
    /// with `onAbort: 'keep'`.
    Cancelled,
    /// A mesh has no noise, or less than a hundredth of the spacing of its vertices, and λ was to suit its noise: the surface is the mesh as it
    /// is.
    NoNoise,
    /// ADMM's iterates diverged, and did so again with more accurate z-steps. The surface is the best one from before,
    /// and its dual bound holds.
    Diverged,
}

/// Computes the relative duality gap: the largest share by which an objective may exceed the optimum. `None` if
/// objective or dual bound is not known, or if the objective is no more than `rounding`.
pub(crate) fn relative_gap(objective: f64, dual_bound: f64, rounding: f64) -> Option<f64> {
    let known = objective.is_finite() && dual_bound.is_finite() && objective > rounding;
    known.then(|| ((objective - dual_bound) / objective).max(0.0))
}

/// Progress of a running solve: the figures of its last check, in which objective and dual bound are computed.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(rename_all = "camelCase")
)]
#[non_exhaustive]
pub struct Progress {
    /// Number of finer multigrid levels still to come; 0 on the finest one.
    pub level: usize,
    /// Number of ADMM iterations so far, on all levels.
    pub iteration: usize,
    /// Number of conjugate-gradient iterations so far, over all z-steps.
    pub cg_iterations: usize,
    /// Objective of the best surface so far; before the first check, that of the initial surface.
    pub objective: f64,
    /// Best lower bound of the optimal objective so far.
    pub dual_bound: f64,
    /// Relative duality gap `(objective − dual_bound) / objective`; `None` where the objective is a rounding error.
    pub gap: Option<f64>,
    /// Current penalty parameter ρ of ADMM.
    pub rho: f64,
    /// Time since the solver was made, in seconds.
    pub elapsed: f64,
}

/// Time spent in each phase of a solve, in seconds.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(rename = "SolveSeconds")
)]
#[non_exhaustive]
pub struct Seconds {
    /// Time for the set-up: domain, normalisation, allocation, in seconds.
    pub setup: f64,
    /// Time for z-steps, that is for conjugate gradients, in seconds.
    #[cfg_attr(feature = "serde", serde(rename = "zStep"))]
    pub z_step: f64,
    /// Time for the Hessians, their soft threshold and the dual update, in seconds.
    #[cfg_attr(feature = "serde", serde(rename = "hStep"))]
    pub h_step: f64,
    /// Time for objective, dual bound and residuals, in seconds.
    pub certificate: f64,
    /// Total time in seconds, from the solver's construction to the surface, pauses between calls included.
    pub total: f64,
}

impl std::ops::Add for Seconds {
    type Output = Seconds;
    fn add(self, other: Seconds) -> Seconds {
        Seconds {
            setup: self.setup + other.setup,
            z_step: self.z_step + other.z_step,
            h_step: self.h_step + other.h_step,
            certificate: self.certificate + other.certificate,
            total: self.total + other.total,
        }
    }
}

/// Work of a solve on one multigrid level.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(rename_all = "camelCase")
)]
#[non_exhaustive]
pub struct LevelReport {
    /// Spacing of the level's lattice, in normalised coordinates.
    pub spacing: f64,
    /// Number of interior vertices of the level's lattice.
    pub interior: usize,
    /// Number of ADMM iterations on the level.
    pub iterations: usize,
    /// Number of conjugate-gradient iterations on the level, over all z-steps.
    pub cg_iterations: usize,
}

/// Reason for the λ that [`Lambda::Auto`](crate::Lambda::Auto) has chosen.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(rename_all = "camelCase")
)]
#[non_exhaustive]
pub enum LambdaReason {
    /// λ follows from size and correlation length of the noise, and the penalty is the one that best predicts held-out
    /// heights (cross-validation). Where noise is correlated, penalty and λ, up to a factor, are those that best predict
    /// heights with another draw of it (data thinning).
    Prediction,
    /// λ follows from size and correlation length of the noise, without a comparison of penalties: the energy has no
    /// parameters, or there are too few heights to predict.
    Noise,
    /// The heights have hardly any noise: λ is [`Lambda::Big`](crate::Lambda::Big), or larger, so that the surface keeps
    /// within [`LambdaChoice::tolerance`].
    NoNoise,
    /// λ is the smallest one that keeps the surface within [`Options::tolerance`](crate::Options::tolerance).
    Tolerance,
    /// There are too few heights to estimate their noise: λ is [`Lambda::Medium`](crate::Lambda::Medium).
    #[default]
    Unknown,
}

/// Choice of λ by [`Lambda::Auto`](crate::Lambda::Auto): its reason, what it found out about the noise, and its cost.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(rename_all = "camelCase")
)]
#[non_exhaustive]
pub struct LambdaChoice {
    /// Reason for the chosen λ.
    pub reason: LambdaReason,
    /// Standard deviation σ of the heights' noise, in the input's units: of an image, that of its pixels. `None` if it
    /// cannot be measured.
    pub sigma: Option<f64>,
    /// Quantisation step of the heights, in the input's units; `None` unless their noise is rounding to multiples of
    /// such a step.
    pub step: Option<f64>,
    /// Correlation length of the noise, in the input's units: the standard deviation of the Gaussian blur that turns
    /// white noise into noise like it. 0 for noise that is independent from vertex to vertex.
    pub correlation_length: f64,
    /// Whether the noise of heights that no camera has measured is correlated and larger than 15 % of their standard deviation,
    /// as the shape of a terrain looks too, so that noise and shape cannot be told apart: σ and λ are uncertain.
    pub ambiguous: bool,
    /// Root mean square distance from the heights that the surface keeps within, in the input's units: the one that was
    /// asked for, or a default where heights have no noise or [`LambdaChoice::ambiguous`] noise; `None` otherwise.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub tolerance: Option<f64>,
    /// Root mean square of the residual, in standard deviations σ of the noise; more than 2 σ at a vertex counts as that. It is about
    /// 1 where λ suits the shape. Far above, the surface is farther from the heights than their noise explains. `None` before the
    /// end of the solve, or without noise.
    pub residual_ratio: Option<f64>,
    /// Whether the residual is larger than the noise explains, so that the surface has lost a part of the shape.
    pub residual_exceeds_noise: bool,
    /// Whether rows of the image had offsets of their own, as line sensors give them, which were taken out of the heights.
    pub offset_rows: bool,
    /// Whether columns of the image had offsets of their own, which were taken out of the heights.
    pub offset_columns: bool,
    /// Number of times that λ was raised above the one that follows from the noise, since the residual of the surface
    /// showed that one to be too small.
    pub raises: usize,
    /// Number of solves before the last one: those by which offset rows and columns are levelled, and those that look for λ, nearly
    /// all of them on coarse lattices.
    pub solves: usize,
    /// Number of ADMM iterations of these solves, which the report's own number of iterations does not include.
    pub iterations: usize,
}

/// Parameters of the energy [`Energy::Huber`] that a solve has used, whether given or chosen.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(rename_all = "camelCase")
)]
#[non_exhaustive]
pub struct HuberReport {
    /// Bend radius in normalised coordinates: see the option [`Options::bend_radius`](crate::Options::bend_radius).
    pub bend_radius: f64,
    /// Flatness, from 0 to 1: see the option [`Options::flatness`](crate::Options::flatness).
    pub flatness: f64,
    /// Crease radius in normalised coordinates: see the option [`Options::crease_radius`](crate::Options::crease_radius).
    pub crease_radius: f64,
    /// Number of crease passes after the first solve.
    pub crease_passes: usize,
    /// Number of interior vertices that lie on a crease: the last crease pass gives bends there a smaller weight, so that the crease
    /// stays sharp.
    pub creases: usize,
}

/// Report of a solve: what was solved, how well, and at what cost.
///
/// Energies are in normalised coordinates ([`Normalization`](crate::Normalization)), in which the surface's longer side is 1.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(rename = "SolveReport", rename_all = "camelCase")
)]
#[non_exhaustive]
pub struct Report {
    /// Number of interior vertices, where the Hessian is evaluated: the paper's set `I`.
    pub interior: usize,
    /// Number of boundary vertices, which are neighbours of interior vertices but not interior: the paper's set `∂I`.
    pub boundary: usize,
    /// Number of omitted vertices, which have heights but neither are nor touch interior vertices: left out of the
    /// solve and extrapolated afterwards.
    pub omitted: usize,
    /// Number of vertices where no Hessian was evaluated because of an occlusion.
    pub occluded: usize,
    /// Number of vertices without data in holes that were [bridged](crate::Bridging): they have heights in the surface.
    pub bridged: usize,
    /// Number of vertices whose height is a constraint, which the surface meets exactly.
    pub constrained: usize,
    /// Number of free vertices in the solve, with neither a constraint nor a fidelity term.
    pub free: usize,
    /// Number of connected components, each of which was solved by itself.
    pub components: usize,
    /// Number of ADMM iterations on all levels.
    pub iterations: usize,
    /// Number of conjugate-gradient iterations over all z-steps on all levels.
    pub cg_iterations: usize,
    /// Work on each multigrid level, the coarsest first.
    pub levels: Vec<LevelReport>,
    /// Energy whose penalty was minimised.
    pub energy: Energy,
    /// Number of reweighting passes after the first solve.
    pub reweighting: usize,
    /// Parameters of the energy [`Energy::Huber`] and the number of its creases; `None` for other energies.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub huber: Option<HuberReport>,
    /// Objective (fidelity plus penalty) of the returned surface; always finite.
    pub objective: f64,
    /// Fidelity term `λ Σ (z − z̃)²` of the objective; with the border condition
    /// [`Border::Loaded`](crate::Border::Loaded) the work of the border's moments is subtracted.
    pub fidelity: f64,
    /// Penalty term of the objective: `Σ ‖H‖_*`, or the penalty of another energy.
    pub nuclear_norm: f64,
    /// Certified lower bound of the optimal objective; always finite, and 0 where nothing better is known.
    pub dual_bound: f64,
    /// Relative duality gap `(objective − dual_bound) / objective`: the objective exceeds the optimum by at most this
    /// share of itself. `None` if the solve stopped by [`StopReason::Rounding`], and where the objective is a rounding error.
    pub gap: Option<f64>,
    /// Weight λ of the fidelity term, as a number.
    pub lambda: f64,
    /// How λ was chosen; `None` unless it was [`Lambda::Auto`](crate::Lambda::Auto).
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub lambda_choice: Option<LambdaChoice>,
    /// Penalty parameter ρ of ADMM in the last iteration.
    pub rho: f64,
    /// Factor from the input's units to normalised coordinates.
    pub scale: f64,
    /// Reason why the solve stopped.
    pub stop_reason: StopReason,
    /// Number of threads that the solve ran on.
    pub threads: usize,
    /// Reason why there were not more threads.
    pub thread_limit: ThreadLimit,
    /// Time spent in each phase of the solve, in seconds.
    pub seconds: Seconds,
}

impl Report {
    /// Whether the surface is certified to a relative duality gap of at most `gap`.
    ///
    /// ```
    /// use developable::{Heightfield, Lattice, Options, fit};
    /// # fn main() -> developable::Result<()> {
    /// let lattice = Lattice::new(20, 20, 1.0)?;
    /// let field = Heightfield::from_fn(lattice, |x, y| (0.3 * x).sin() + 0.1 * y)?;
    /// assert!(fit(&field, &Options::default())?.report().is_certified(0.01));
    /// # Ok(())
    /// # }
    /// ```
    pub fn is_certified(&self, gap: f64) -> bool {
        self.gap.is_some_and(|certified| certified <= gap)
    }
}

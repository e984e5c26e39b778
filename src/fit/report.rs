//! Reports of a solve, while it runs and afterwards.

use super::options::Energy;

/// Why a solve stopped.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(rename_all = "camelCase")
)]
#[non_exhaustive]
pub enum StopReason {
    /// The certified relative gap reached [`Options::gap`](crate::Options::gap).
    Gap,
    /// The residuals of [`Schedule::Paper`](crate::Schedule::Paper) fell below its tolerances.
    Residuals,
    /// Objective and dual bound differ by no more than rounding errors: the surface is optimal as far as double
    /// precision can tell. So it is for an affine input.
    Rounding,
    /// [`Options::max_iterations`](crate::Options::max_iterations) was reached.
    MaxIterations,
    /// The callback, or [`Solver::cancel`](crate::Solver::cancel), asked to stop.
    Cancelled,
    /// The iterates diverged, and did so again with more exact steps. The surface is the best one from before,
    /// and its bound holds.
    Diverged,
}

/// Relative duality gap: the largest share by which an objective may exceed the optimum. `None` if objective or
/// bound is not known, or if the objective is a rounding error.
pub(crate) fn relative_gap(objective: f64, dual_bound: f64, rounding: f64) -> Option<f64> {
    let known = objective.is_finite() && dual_bound.is_finite() && objective > rounding;
    known.then(|| ((objective - dual_bound) / objective).max(0.0))
}

/// Progress of a running solve: the figures of its last check.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(rename_all = "camelCase")
)]
#[non_exhaustive]
pub struct Progress {
    /// Number of finer levels still to come; 0 on the finest one.
    pub level: usize,
    /// ADMM iterations so far, on all levels.
    pub iteration: usize,
    /// Conjugate-gradient iterations so far, over all z-steps.
    pub cg_iterations: usize,
    /// Objective of the best surface so far; before the first check, that of the initial surface.
    pub objective: f64,
    /// Best lower bound of the optimum so far.
    pub dual_bound: f64,
    /// Relative duality gap `(objective − dual_bound) / objective`; `None` where the objective is a rounding
    /// error.
    pub gap: Option<f64>,
    /// ADMM penalty ρ.
    pub rho: f64,
    /// Seconds since the solver was made.
    pub elapsed: f64,
}

/// Seconds spent in each phase of a solve.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct Seconds {
    /// Domain, normalisation, allocation.
    pub setup: f64,
    /// Conjugate gradients.
    #[cfg_attr(feature = "serde", serde(rename = "zStep"))]
    pub z_step: f64,
    /// Hessians, their soft threshold, the dual update.
    #[cfg_attr(feature = "serde", serde(rename = "hStep"))]
    pub h_step: f64,
    /// Objective, dual bound and residuals.
    pub certificate: f64,
    /// Total, from the solver's construction to the surface, pauses between steps included.
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

/// The work on one level.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(rename_all = "camelCase")
)]
#[non_exhaustive]
pub struct LevelReport {
    /// Lattice spacing, in normalised coordinates.
    pub spacing: f64,
    /// Interior vertices.
    pub interior: usize,
    /// ADMM iterations.
    pub iterations: usize,
    /// Conjugate-gradient iterations over all z-steps.
    pub cg_iterations: usize,
}

/// Reason for the λ that [`Lambda::Auto`](crate::Lambda::Auto) has chosen.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(rename_all = "camelCase")
)]
#[non_exhaustive]
pub enum LambdaReason {
    /// This λ predicts held-out heights best (cross-validation).
    Prediction,
    /// λ follows from size and correlation length of the noise, without cross-validation: there are too few heights
    /// to hold some out, or their noise is correlated, so that held-out noise could be predicted.
    Noise,
    /// The heights have hardly any noise: λ is [`Lambda::Big`](crate::Lambda::Big).
    NoNoise,
    /// There are too few heights to estimate their noise: λ is [`Lambda::Medium`](crate::Lambda::Medium).
    Unknown,
}

/// How [`Lambda::Auto`](crate::Lambda::Auto) has chosen λ.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(rename_all = "camelCase")
)]
#[non_exhaustive]
pub struct LambdaChoice {
    /// Reason for this λ.
    pub reason: LambdaReason,
    /// Standard deviation σ of the heights' noise, in the input's units; `None` if it cannot be measured.
    pub sigma: Option<f64>,
    /// Quantisation step of the heights, in the input's units; `None` unless their noise is rounding to such steps.
    pub step: Option<f64>,
    /// Correlation length of the noise, in the input's units: the standard deviation of the Gaussian blur that turns
    /// white noise into noise like it. 0 for noise that is independent from vertex to vertex.
    pub correlation_length: f64,
    /// Whether the noise is correlated over distances at which the shape bends, too, so that noise and shape could
    /// not be told apart: σ and λ are uncertain.
    pub ambiguous: bool,
    /// Number of times that the spacing is doubled until noise is independent from vertex to vertex; 0 for white
    /// noise.
    pub merged: usize,
    /// Number of candidates for λ and penalty that were compared, each by up to three solves.
    pub solves: usize,
    /// Number of ADMM iterations of these solves, which [`Report::iterations`] does not include.
    pub iterations: usize,
}

/// Parameters of [`Energy::Huber`] as they were used, whether given or chosen.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(rename_all = "camelCase")
)]
#[non_exhaustive]
pub struct HuberReport {
    /// See [`Options::bend_radius`](crate::Options::bend_radius).
    pub bend_radius: f64,
    /// See [`Options::flatness`](crate::Options::flatness).
    pub flatness: f64,
    /// See [`Options::crease_radius`](crate::Options::crease_radius).
    pub crease_radius: f64,
    /// Number of crease passes after the first solve.
    pub crease_passes: usize,
    /// Interior vertices on a crease, where the last pass weighs bends less.
    pub creases: usize,
}

/// The report of a solve: what was solved, how well, and at what cost.
///
/// Energies are in normalised coordinates (see [`Normalization`](crate::Normalization)).
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(rename_all = "camelCase")
)]
#[non_exhaustive]
pub struct Report {
    /// Vertices where the Hessian is evaluated: the set `I`.
    pub interior: usize,
    /// Valid vertices touched by a stencil without being interior: `∂I`.
    pub boundary: usize,
    /// Valid vertices that no stencil touches: left out of the solve and extrapolated afterwards.
    pub omitted: usize,
    /// Vertices where no Hessian was taken because of an occlusion.
    pub occluded: usize,
    /// Vertices without data whose hole was [bridged](crate::Bridging): they have heights in the
    /// surface.
    pub bridged: usize,
    /// Vertices whose height is a hard constraint.
    pub constrained: usize,
    /// Vertices of the solve with neither a constraint nor a fidelity term of their own.
    pub free: usize,
    /// Connected components, each of which was solved by itself.
    pub components: usize,
    /// ADMM iterations on all levels.
    pub iterations: usize,
    /// Conjugate-gradient iterations over all z-steps on all levels.
    pub cg_iterations: usize,
    /// Work on each level, the coarsest first.
    pub levels: Vec<LevelReport>,
    /// Energy whose penalty was minimised.
    pub energy: Energy,
    /// Number of reweighting passes after the first solve.
    pub reweighting: usize,
    /// Parameters of [`Energy::Huber`] and its creases; `None` for other energies.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub huber: Option<HuberReport>,
    /// Energy of the returned surface; always finite.
    pub objective: f64,
    /// Fidelity `λ Σ (z − z̃)²`; with [`Border::Loaded`](crate::Border::Loaded) the work of the border's moments is
    /// subtracted.
    pub fidelity: f64,
    /// Penalty of the Hessians: `Σ ‖H‖_*`, or that of another energy.
    pub nuclear_norm: f64,
    /// Certified lower bound of the optimum; always finite, and 0 where nothing better is known.
    pub dual_bound: f64,
    /// Relative duality gap `(objective − dual_bound) / objective`: the result exceeds the optimum by at most this
    /// share of the objective. `None` for [`StopReason::Rounding`], and where the objective itself is a rounding
    /// error.
    pub gap: Option<f64>,
    /// λ as a number.
    pub lambda: f64,
    /// How λ was chosen, for [`Lambda::Auto`](crate::Lambda::Auto).
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub lambda_choice: Option<LambdaChoice>,
    /// Last ADMM penalty ρ.
    pub rho: f64,
    /// Factor from the input's units to normalised coordinates.
    pub scale: f64,
    /// Why the solve stopped.
    pub stop_reason: StopReason,
    /// Seconds per phase.
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

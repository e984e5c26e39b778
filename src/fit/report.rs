//! What a solve tells about itself, while it runs and afterwards.

use serde::Serialize;

use super::options::Energy;

/// Why a solve stopped.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "camelCase")]
pub enum StopReason {
    /// The certified relative gap reached [`Options::gap`](crate::Options::gap).
    Gap,
    /// The residuals of [`Schedule::Paper`](crate::Schedule::Paper) fell below its tolerances.
    Residuals,
    /// The objective is zero up to rounding, hence optimal: the surface is affine.
    Rounding,
    /// [`Options::max_iterations`](crate::Options::max_iterations) was reached.
    MaxIterations,
    /// The callback, or [`Solver::cancel`](crate::Solver::cancel), asked to stop.
    Cancelled,
}

/// Where a running solve stands: the figures of its last check.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Progress {
    /// How many finer levels are still to come; 0 on the finest one.
    pub level: usize,
    /// ADMM iterations so far, on all levels.
    pub iteration: usize,
    /// Conjugate-gradient iterations so far, over all z-steps.
    pub cg_iterations: usize,
    /// Objective of the best iterate so far; that of the start before the first check.
    pub objective: f64,
    /// Best lower bound of the optimum so far.
    pub dual_bound: f64,
    /// `(objective − dual_bound) / objective`.
    pub gap: f64,
    /// ADMM penalty ρ.
    pub rho: f64,
    /// Seconds since the solver was made.
    pub elapsed: f64,
}

/// Seconds spent in each phase of a solve.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct Seconds {
    /// Domain, normalisation, allocation.
    pub setup: f64,
    /// Conjugate gradients.
    #[serde(rename = "zStep")]
    pub z_step: f64,
    /// Hessians, their soft threshold, the dual update.
    #[serde(rename = "hStep")]
    pub h_step: f64,
    /// Objective, dual bound and residuals.
    pub certificate: f64,
    /// Everything, from making the solver to the surface; pauses between steps included.
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
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
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

/// What was solved, how well and at what cost.
///
/// Energies are in normalised coordinates (see
/// [`Normalization`](crate::Normalization)).
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Report {
    /// Vertices where the Hessian is evaluated: the set `I`.
    pub interior: usize,
    /// Valid vertices touched by a stencil without being interior: `∂I`.
    pub boundary: usize,
    /// Valid vertices that no stencil touches: left out of the solve, restored afterwards.
    pub omitted: usize,
    /// Vertices where no Hessian was taken because of an occlusion.
    pub occluded: usize,
    /// Vertices without data whose hole was [bridged](crate::Bridging): they have heights in the
    /// surface.
    pub bridged: usize,
    /// Vertices whose height was given for good.
    pub constrained: usize,
    /// Vertices of the solve with neither a constraint nor a fidelity term of their own.
    pub free: usize,
    /// Connected parts, each of which was solved for itself.
    pub components: usize,
    /// ADMM iterations on all levels.
    pub iterations: usize,
    /// Conjugate-gradient iterations over all z-steps on all levels.
    pub cg_iterations: usize,
    /// The levels that were worked on, the coarsest first.
    pub levels: Vec<LevelReport>,
    /// What was minimised besides the fidelity term.
    pub energy: Energy,
    /// Reweighted passes that were made after the first solve.
    pub reweighting: usize,
    /// Energy of the returned surface.
    pub objective: f64,
    /// Its first term, `λ Σ (z − z̃)²`.
    pub fidelity: f64,
    /// Its second term, `Σ ‖H‖_*`.
    pub nuclear_norm: f64,
    /// Certified lower bound of the optimum.
    pub dual_bound: f64,
    /// `(objective − dual_bound) / objective`: the most by which the result can miss the optimum;
    /// 0 for [`StopReason::Rounding`].
    pub gap: f64,
    /// λ as a number.
    pub lambda: f64,
    /// Last ADMM penalty ρ.
    pub rho: f64,
    /// Factor from the input's units to normalised coordinates.
    pub scale: f64,
    /// Why the solve stopped.
    pub stop_reason: StopReason,
    /// Seconds per phase.
    pub seconds: Seconds,
}

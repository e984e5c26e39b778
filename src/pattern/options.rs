//! Options of a pattern.

use crate::unroll::UnrollOptions;
use crate::unroll::arap_mesh::StoppingCriteria;
use crate::unroll::distortion::NOTICEABLE_STRAIN;

/// Default maximum seam gap, as a share of the fold's length: half a millimetre on 10 cm. No table chose it.
const DEFAULT_MAX_SEAM_GAP_SHARE: f64 = 0.005;

/// Ratio of the energy to the energy at the strain limit above which the solver that lays parts flat gives up where it
/// progresses slowly. `benches/patterns.md` has what others give.
const HOPELESS_STRAIN_FACTOR: f64 = 2.5;

/// Change of the energy in one step of the solver, as a share of it, below which a part has converged. With
/// 1e-3 fewer sheets are within the limit: the bunny of `benches/patterns.md` has 33 instead of 24.
const RELATIVE_TOLERANCE: f64 = 1e-4;

/// Options of a pattern: maximum seam gap, maximum strain, and how patches are laid flat.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Deserialize),
    serde(default, rename_all = "camelCase", deny_unknown_fields)
)]
#[non_exhaustive]
pub struct PatternOptions {
    /// Maximum seam gap of a fold: root mean square distance between its two sides on the flat sheet, as a share of
    /// the fold's length. A quarter of the mean edge length of the mesh that is cut is always allowed. Default 0.005.
    pub max_seam_gap: f64,
    /// Maximum strain of a sheet, root mean square over its area. Default 0.01.
    pub max_strain: f64,
    /// Stopping criteria of the solver that lays patches flat.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub unrolling: UnrollOptions,
    /// Whether sheets are folded back into space to measure their distance from the surface
    /// ([`Refolding`](super::Refolding)). Takes about as long as laying the sheets flat. Default `false`.
    pub refold: bool,
}

impl Default for PatternOptions {
    fn default() -> Self {
        PatternOptions {
            max_seam_gap: DEFAULT_MAX_SEAM_GAP_SHARE,
            max_strain: NOTICEABLE_STRAIN,
            unrolling: UnrollOptions::default(),
            refold: false,
        }
    }
}

impl PatternOptions {
    /// Sets the maximum seam gap, as a share of the fold's length, and returns the options.
    pub fn max_seam_gap(self, max_seam_gap: f64) -> Self {
        PatternOptions {
            max_seam_gap,
            ..self
        }
    }

    /// Sets the maximum root mean square strain of a sheet, and returns the options.
    pub fn max_strain(self, max_strain: f64) -> Self {
        PatternOptions { max_strain, ..self }
    }

    /// Sets whether sheets are folded back into space to measure their distance from the surface, and returns the
    /// options.
    pub fn refold(self, refold: bool) -> Self {
        PatternOptions { refold, ..self }
    }

    /// Sets the stopping criteria of the solver that lays patches flat, and returns the options.
    pub fn unrolling(self, unrolling: UnrollOptions) -> Self {
        PatternOptions { unrolling, ..self }
    }

    /// Returns the stopping criteria of the solver that lays a part flat by itself.
    pub(super) fn relaxation(&self) -> StoppingCriteria {
        StoppingCriteria {
            tolerance: self.unrolling.tolerance,
            relative_tolerance: RELATIVE_TOLERANCE,
            target_energy: 0.0,
            // The energy is the sum of the squares of both principal strains.
            hopeless_energy: HOPELESS_STRAIN_FACTOR * 2.0 * self.max_strain * self.max_strain,
            max_steps: self.unrolling.max_iterations,
        }
    }
}

//! Options of a pattern.

use crate::unroll::UnrollOptions;

/// Default maximum seam gap, as a share of the fold's length: half a millimetre on 10 cm. No table chose it.
const DEFAULT_MAX_SEAM_GAP_SHARE: f64 = 0.005;

/// Default maximum root mean square strain of a sheet: lengths on the sheet are wrong by 1 %, 2 mm on a page of A4, as
/// in a layout that counts as unrolled. No table chose it; the patterns in `benches/choices.md` keep to it.
const DEFAULT_MAX_STRAIN: f64 = 0.01;

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
    /// the fold's length. A quarter of the lattice's spacing is always allowed. Default 0.005.
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
            max_strain: DEFAULT_MAX_STRAIN,
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
}

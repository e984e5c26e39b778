//! Options of unrolling.

/// Default change of the energy over the area in one iteration, without unit, below which a layout has converged: the
/// energy of strains of 10⁻⁵.
const DEFAULT_TOLERANCE: f64 = 1e-10;

/// Default maximum number of iterations for laying a surface flat. Surfaces of 200 thousand vertices take 6 to 26
/// (`benches/choices.md`).
const DEFAULT_MAX_ITERATIONS: usize = 500;

/// Options of [`unroll`](super::unroll), which lays a surface flat: when its iteration stops.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Deserialize),
    serde(default, rename_all = "camelCase", deny_unknown_fields)
)]
#[non_exhaustive]
pub struct UnrollOptions {
    /// Change of the energy over the area (the mean of the squared strains, without unit) in one iteration, below which
    /// the layout has converged. Default 10⁻¹⁰.
    pub tolerance: f64,
    /// Maximum number of iterations for laying the surface flat. Default 500.
    pub max_iterations: usize,
}

impl Default for UnrollOptions {
    fn default() -> Self {
        UnrollOptions {
            tolerance: DEFAULT_TOLERANCE,
            max_iterations: DEFAULT_MAX_ITERATIONS,
        }
    }
}

impl UnrollOptions {
    /// Sets the change of the energy per iteration below which the layout has converged, and returns the options.
    pub fn tolerance(self, tolerance: f64) -> Self {
        UnrollOptions { tolerance, ..self }
    }

    /// Sets the maximum number of iterations, and returns the options.
    pub fn max_iterations(self, max_iterations: usize) -> Self {
        UnrollOptions {
            max_iterations,
            ..self
        }
    }
}

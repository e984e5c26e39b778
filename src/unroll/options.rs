//! Options of unrolling.

/// Options of [`unroll`](super::unroll): when its iteration stops.
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
    /// Maximum number of iterations. Default 500.
    pub max_iterations: usize,
}

impl Default for UnrollOptions {
    fn default() -> Self {
        UnrollOptions {
            tolerance: 1e-10,
            max_iterations: 500,
        }
    }
}

impl UnrollOptions {
    /// These options with another tolerance.
    pub fn tolerance(self, tolerance: f64) -> Self {
        UnrollOptions { tolerance, ..self }
    }

    /// These options with another maximum number of iterations.
    pub fn max_iterations(self, max_iterations: usize) -> Self {
        UnrollOptions {
            max_iterations,
            ..self
        }
    }
}

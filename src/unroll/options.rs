//! Options of unrolling.

/// When to stop.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct UnrollOptions {
    /// Stop when iterations change the energy over the area, which is the mean of the squared
    /// strains, by less than this. Default 10⁻¹⁰.
    pub tolerance: f64,
    /// Most iterations. Default 500.
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

    /// These options with another limit.
    pub fn max_iterations(self, max_iterations: usize) -> Self {
        UnrollOptions {
            max_iterations,
            ..self
        }
    }
}

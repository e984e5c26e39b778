//! Options of a mesh's fit.

use crate::error::{Error, Result};
use crate::fit::options::{
    DEFAULT_CREASE_PASSES, DEFAULT_GAP, Energy, HuberOptions, Lambda, Options,
};
use crate::math::sym2::Sym2;

/// Options of [`fit_mesh`](super::fit_mesh), with the names that they have in [`Options`]. The energy is
/// [`Energy::Huber`].
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Deserialize),
    serde(default, rename_all = "camelCase", deny_unknown_fields)
)]
pub struct MeshOptions {
    pub(super) lambda: Lambda,
    pub(super) gap: f64,
    pub(super) max_iterations: usize,
    pub(super) bend_radius: f64,
    pub(super) flatness: f64,
    pub(super) crease_radius: f64,
    pub(super) crease_passes: Option<usize>,
}

impl Default for MeshOptions {
    fn default() -> Self {
        let HuberOptions {
            bend_radius,
            flatness,
            crease_radius,
        } = HuberOptions::SMOOTH;
        MeshOptions {
            lambda: Lambda::Auto,
            gap: DEFAULT_GAP,
            max_iterations: 1000,
            bend_radius,
            flatness,
            crease_radius,
            crease_passes: None,
        }
    }
}

impl MeshOptions {
    /// Sets the weight λ of the fidelity term, in coordinates in which the mesh's bounding sphere has the diameter 1.
    /// Default [`Lambda::Auto`], which is `6.4/σh` for noise of standard deviation `σ` and a spacing `h`.
    pub fn lambda(mut self, lambda: impl Into<Lambda>) -> Self {
        self.lambda = lambda.into();
        self
    }

    /// Sets the certified relative duality gap at which the solve of the last linearised problem stops; default 0.01.
    pub fn gap(mut self, gap: f64) -> Self {
        self.gap = gap;
        self
    }

    /// Sets the maximum number of ADMM iterations for each linearisation; default 1000.
    pub fn max_iterations(mut self, iterations: usize) -> Self {
        self.max_iterations = iterations;
        self
    }

    /// Sets the bend radius `1/δ` of the Huber penalty, in the coordinates of [`MeshOptions::lambda`]: the cost of
    /// tighter bends is linear, that of wider ones quadratic; default 0.1.
    pub fn bend_radius(mut self, radius: f64) -> Self {
        self.bend_radius = radius;
        self
    }

    /// Sets the flatness `α` of the Huber penalty: its slope at 0, from 0 to 1; default 0.3.
    pub fn flatness(mut self, slope: f64) -> Self {
        self.flatness = slope;
        self
    }

    /// Sets the crease radius `1/T`, in the coordinates of [`MeshOptions::lambda`]: bends of a smaller radius are
    /// creases; default 0.1.
    pub fn crease_radius(mut self, radius: f64) -> Self {
        self.crease_radius = radius;
        self
    }

    /// Sets the number of crease passes, at most 20; each solves another linearisation, in which bends at creases cost
    /// less. Default: 2, or 0 where λ is large for the noise of the mesh.
    pub fn crease_passes(mut self, passes: usize) -> Self {
        self.crease_passes = Some(passes);
        self
    }

    /// Number of crease passes: the given one or the default.
    pub(super) fn crease_passes_or_default(&self) -> usize {
        self.crease_passes.unwrap_or(DEFAULT_CREASE_PASSES)
    }

    /// Whether a stencil's dual is the moment of a bend: the direction of a smaller one is arbitrary.
    pub(super) fn is_bend(&self, dual: Sym2) -> bool {
        dual.spectral_norm() > self.flatness
    }

    /// Checks that every option is within its range.
    ///
    /// # Errors
    /// [`Error::Option`] with the name of the first option that is out of range.
    pub fn validate(&self) -> Result<()> {
        self.common().validate()
    }

    /// Converts these options to the options of a heightfield's solve.
    pub(super) fn common(&self) -> Options {
        Options::default()
            .energy(Energy::Huber)
            .lambda(self.lambda)
            .gap(self.gap)
            .max_iterations(self.max_iterations)
            .bend_radius(self.bend_radius)
            .flatness(self.flatness)
            .crease_radius(self.crease_radius)
            .crease_passes(self.crease_passes_or_default())
    }
}

/// Checks that there is a confidence for each of a number of `vertices`, and that each is finite and at least 0.
pub(super) fn check_confidence(confidence: &[f64], vertices: usize) -> Result<()> {
    crate::error::check_count("confidence of the mesh", vertices, 1, confidence.len())?;
    let odd = confidence
        .iter()
        .position(|c| !(c.is_finite() && *c >= 0.0));
    match odd {
        None => Ok(()),
        Some(vertex) => Err(Error::NotFinite {
            what: "confidence of the mesh",
            value: confidence[vertex],
            row: vertex,
            col: 0,
            advice: "a confidence is a finite number, 0 or more",
        }),
    }
}

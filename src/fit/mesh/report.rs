//! What a solve over a mesh tells about itself.

use crate::fit::report::{Seconds, StopReason};

/// What was mended of a mesh before it was solved. The result has the vertices and triangles of the input
/// all the same.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct Repairs {
    /// Vertices that are at the place of another one and move with it.
    pub joined: usize,
    /// Triangles with two corners at one place.
    pub degenerate: usize,
    /// Triangles that are there twice.
    pub repeated: usize,
    /// Triangles that faced the other side than those around them.
    pub turned: usize,
    /// Vertices of no triangle, which stay where they are.
    pub unused: usize,
}

/// One linearisation, and the convex problem about it.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(rename_all = "camelCase")
)]
#[non_exhaustive]
pub struct MeshPass {
    /// ADMM iterations.
    pub iterations: usize,
    /// Conjugate-gradient iterations over all z-steps.
    pub cg_iterations: usize,
    /// Energy of the best iterate, in the linearised problem.
    pub objective: f64,
    /// Certified lower bound of that problem's optimum.
    pub dual_bound: f64,
    /// `(objective − dual_bound) / objective`.
    pub gap: Option<f64>,
    /// Why it stopped.
    pub stop_reason: StopReason,
    /// Vertices on creases, where bends cost less in this pass.
    pub creases: usize,
    /// How far vertices went from its base: root mean square, and at most, in the input's units.
    pub moved: f64,
    /// See [`MeshPass::moved`].
    pub moved_most: f64,
}

/// What was solved, how well and at what cost.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(rename_all = "camelCase")
)]
#[non_exhaustive]
pub struct MeshReport {
    /// Vertices of the solve: those of the input, but at most one at each place.
    pub vertices: usize,
    /// Those among them with triangles all around, where the surface bends.
    pub interior: usize,
    /// Those on the border, put where the surface inside goes on to.
    pub border: usize,
    /// Those among them where parts of the surface touch in a point.
    pub pinched: usize,
    /// Connected parts.
    pub components: usize,
    /// What was mended first.
    pub repairs: Repairs,
    /// From one vertex to the next, on a hexagonal lattice with as many: in the input's units.
    pub spacing: f64,
    /// Factor from the input's units to normalised coordinates, in which the ball about it has the
    /// diameter 1.
    pub scale: f64,
    /// Standard deviation of the noise along the normals, in the input's units; none if there are too
    /// few vertices to tell.
    pub sigma: Option<f64>,
    /// λ as a number, in normalised coordinates.
    pub lambda: f64,
    /// The linearisations, in order. A gap is a certificate for that linearised problem's best iterate
    /// alone: the energy itself is not convex, and nothing is certified of it.
    pub passes: Vec<MeshPass>,
    /// What the surface encloses before and after, in the input's units; none for open ones.
    pub volume: Option<[f64; 2]>,
    /// Its area before and after.
    pub area: [f64; 2],
    /// Triangles that face away from the surface around them, before and after.
    pub flipped: [usize; 2],
    /// Why the solve stopped.
    pub stop_reason: StopReason,
    /// Seconds per phase.
    pub seconds: Seconds,
}

impl MeshReport {
    /// The certified gap of the last linearised problem.
    pub fn gap(&self) -> Option<f64> {
        self.passes.last().and_then(|pass| pass.gap)
    }
}

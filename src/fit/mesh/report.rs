//! The report of a fit of a mesh.

use crate::fit::report::{Seconds, StopReason};

/// Repairs of a mesh before it was fitted. The result has the vertices and triangles of the input all the same.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct Repairs {
    /// Number of vertices at the same position as another one, with which they move.
    pub joined: usize,
    /// Triangles with two corners at one place.
    pub degenerate: usize,
    /// Triangles that repeat another one.
    pub repeated: usize,
    /// Number of triangles that faced the other side than their neighbours and were reversed.
    pub turned: usize,
    /// Vertices of no triangle, which stay where they are.
    pub unused: usize,
}

/// One linearisation, and the solve of its convex problem.
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
    /// Certified lower bound of the linearised problem's optimum.
    pub dual_bound: f64,
    /// `(objective − dual_bound) / objective`.
    pub gap: Option<f64>,
    /// Why the solve stopped.
    pub stop_reason: StopReason,
    /// Vertices on creases, where bends cost less in this pass.
    pub creases: usize,
    /// Root mean square distance from the base by which vertices moved, in the input's units.
    pub moved: f64,
    /// Largest distance from the base by which a vertex moved, in the input's units.
    pub moved_most: f64,
}

/// The report of a fit of a mesh: what was solved, how well, and at what cost.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(rename_all = "camelCase")
)]
#[non_exhaustive]
pub struct MeshReport {
    /// Number of vertices of the solve: of the input's vertices, one at each position.
    pub vertices: usize,
    /// Number of interior vertices, which have triangles all around.
    pub interior: usize,
    /// Vertices on the border, which are extrapolated from the surface inside.
    pub border: usize,
    /// Number of vertices at which parts of the surface touch in a point.
    pub pinched: usize,
    /// Connected components.
    pub components: usize,
    /// Repairs before the fit.
    pub repairs: Repairs,
    /// Spacing of a hexagonal lattice with vertices of the same mean area, in the input's units.
    pub spacing: f64,
    /// Factor from the input's units to normalised coordinates, in which the bounding sphere has the diameter
    /// 1.
    pub scale: f64,
    /// Standard deviation of the noise along the normals, in the input's units; `None` if there are too few
    /// vertices to estimate it.
    pub sigma: Option<f64>,
    /// λ as a number, in normalised coordinates.
    pub lambda: f64,
    /// The linearisations, in order. A gap is a certificate for the best iterate of that linearised problem
    /// alone: the energy itself is not convex, and nothing is certified of it.
    pub passes: Vec<MeshPass>,
    /// Volume that the surface encloses before and after, in the input's units; `None` for open surfaces.
    pub volume: Option<[f64; 2]>,
    /// Area before and after.
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

//! The report of a mesh's fit.

use crate::fit::report::{Seconds, StopReason};

/// Repairs of a mesh before its fit. The fitted mesh has the vertices and triangles of the input all the same.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(rename = "MeshRepairs")
)]
#[non_exhaustive]
pub struct Repairs {
    /// Number of vertices that share their position with an earlier one and move together with it.
    pub joined: usize,
    /// Number of triangles with two corners at one position, which are ignored.
    pub degenerate: usize,
    /// Number of triangles that repeat another one, which are ignored.
    pub repeated: usize,
    /// Number of triangles that faced the other side than their neighbours and were reversed.
    pub turned: usize,
    /// Number of vertices of no triangle, which stay where they are.
    pub unused: usize,
    /// Number of edges of three triangles or more. None of these continues another across it: it is a border of each, and they
    /// move together there.
    pub branched: usize,
}

/// Figures of one pass of a mesh's fit: a linearisation of the energy, and the solve of its convex problem.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(rename_all = "camelCase")
)]
#[non_exhaustive]
pub struct MeshPass {
    /// Number of ADMM iterations of the pass, on the mesh and on coarser levels together.
    pub iterations: usize,
    /// Number of conjugate-gradient steps of the pass, over all z-steps of all levels; V-cycles on levels that are solved by
    /// these.
    pub cg_iterations: usize,
    /// Objective of the best iterate, in the linearised problem.
    pub objective: f64,
    /// Certified lower bound of the linearised problem's optimal objective.
    pub dual_bound: f64,
    /// Relative duality gap `(objective − dual_bound) / objective` of the linearised problem.
    pub gap: Option<f64>,
    /// Reason why the pass stopped.
    pub stop_reason: StopReason,
    /// Number of vertices on creases, where bends cost less in this pass.
    pub creases: usize,
    /// Root mean square distance by which vertices moved from the base of the linearisation, in the input's unit of
    /// length.
    pub moved: f64,
    /// Largest distance by which a vertex moved from the base of the linearisation, in the input's unit of length.
    pub moved_most: f64,
}

/// A triangle of a fitted mesh that is folded over or crosses another one near it.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct EntangledTriangle {
    /// Index of the triangle in the mesh.
    pub triangle: usize,
    /// Middle of the triangle in the fitted mesh.
    pub position: [f64; 3],
}

/// Report of a mesh's fit: what was solved, how well, and at what cost.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(rename_all = "camelCase")
)]
#[non_exhaustive]
pub struct MeshReport {
    /// Number of vertices in the solve: vertices of the input at one position count as one.
    pub vertices: usize,
    /// Number of interior vertices of the solve: those with triangles all around, whose bends make up the energy.
    pub interior: usize,
    /// Number of vertices on the border of the surface, which have no bend of their own.
    pub border: usize,
    /// Number of pinched vertices, at which parts of the surface touch in a point.
    pub pinched: usize,
    /// Number of connected components of the mesh.
    pub components: usize,
    /// Repairs of the mesh before its fit.
    pub repairs: Repairs,
    /// Spacing of a hexagonal lattice with vertices of the mesh's mean area, in the input's unit of length.
    pub spacing: f64,
    /// Factor from the input's units to normalised coordinates, in which the mesh's bounding sphere has the diameter 1.
    pub scale: f64,
    /// Standard deviation of the noise along the normals, in the input's unit of length; `None` if there are too few
    /// vertices to estimate it.
    pub sigma: Option<f64>,
    /// Weight λ of the fidelity term, as a number, in normalised coordinates.
    pub lambda: f64,
    /// Figures of the passes, in order. A pass's duality gap certifies the best iterate of its linearised problem
    /// alone: the energy itself is not convex, and nothing is certified of it.
    pub passes: Vec<MeshPass>,
    /// Volume that the surface encloses before and after the fit, in the input's unit cubed; `None` for open surfaces.
    pub volume: Option<[f64; 2]>,
    /// Area of the surface before and after the fit, in the input's unit squared.
    pub area: [f64; 2],
    /// Number of folded triangles, which face away from the surface around them, before and after the fit.
    pub flipped: [usize; 2],
    /// Triangles of the finished surface that are folded over or cross others near them, because their vertices cannot be
    /// parted without leaving their reach: five standard deviations of the noise, and more if λ is smaller than suits it.
    pub entangled: Vec<EntangledTriangle>,
    /// Reason why the fit stopped.
    pub stop_reason: StopReason,
    /// Time spent in each phase of the fit, in seconds.
    pub seconds: Seconds,
}

impl MeshReport {
    /// Returns the certified relative duality gap of the last linearised problem.
    pub fn gap(&self) -> Option<f64> {
        self.passes.last().and_then(|pass| pass.gap)
    }
}

//! An unrolled surface and its report.

use super::distortion::Distortion;
use crate::scene::triangulation::Triangulation;

/// Figures of an [`Unrolling`]: iterations, energy, strain and overlaps of the flat layout.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(rename_all = "camelCase")
)]
#[non_exhaustive]
pub struct UnrollReport {
    /// Number of connected components of the surface. Each component is laid flat by itself.
    pub parts: usize,
    /// Number of iterations made, each of a local and a global step.
    pub iterations: usize,
    /// Energy of the layout over its area, without unit: the mean of the sum of both squared principal strains.
    pub energy: f64,
    /// Decrease of the energy over the area in the last iteration of laying the surface flat.
    pub change: f64,
    /// Area of the surface, in the surface's units squared.
    pub area: f64,
    /// Strain of the flat layout (relative changes of length): 0 for a developable surface.
    pub distortion: Distortion,
    /// Strain of the view from above, taken as a flat layout: a measure of how far from flat the surface is.
    pub plan: Distortion,
    /// Number of pairs of border edges of the layout that cross: 0 if the layout does not cover itself.
    pub crossings: usize,
}

/// A surface laid flat.
///
/// Each connected component lies as near to its place in the view from above as a rotation and a translation can bring
/// it. Components may overlap.
#[derive(Debug, Clone, PartialEq)]
pub struct Unrolling {
    pub(super) mesh: Triangulation,
    pub(super) places: Vec<[f64; 2]>,
    pub(super) parts: Vec<u32>,
    pub(super) stretches: Vec<[f64; 2]>,
    pub(super) overlaps: Vec<[[u32; 2]; 2]>,
    pub(super) report: UnrollReport,
}

impl Unrolling {
    /// Returns the triangles of the surface that is laid flat.
    pub fn mesh(&self) -> &Triangulation {
        &self.mesh
    }

    /// Returns the position of each vertex of the mesh in the plane, in the surface's units.
    pub fn places(&self) -> &[[f64; 2]] {
        &self.places
    }

    /// Returns the number of the connected component of each vertex of the mesh; component 0 has the most vertices.
    pub fn parts(&self) -> &[u32] {
        &self.parts
    }

    /// Returns the singular values `σ₁ ≥ σ₂` of each triangle's map to the plane, both 1 where the map is rigid: `σ₁σ₂`
    /// is the ratio of areas, `σ₁/σ₂` the distortion of angles. `σ₂` is negative where the triangle lies upside down.
    pub fn stretches(&self) -> &[[f64; 2]] {
        &self.stretches
    }

    /// Returns the pairs of border edges of the layout that cross, each edge by the numbers of its two vertices in
    /// the mesh.
    pub fn overlaps(&self) -> &[[[u32; 2]; 2]] {
        &self.overlaps
    }

    /// Returns the figures of the flat layout: iterations, energy, strain and overlaps.
    pub fn report(&self) -> &UnrollReport {
        &self.report
    }
}

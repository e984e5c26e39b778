//! An unrolled surface and its report.

use super::distortion::Distortion;
use crate::scene::triangulation::Triangulation;

/// What came of it.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(rename_all = "camelCase")
)]
#[non_exhaustive]
pub struct UnrollReport {
    /// Connected parts of the surface, each laid flat for itself.
    pub parts: usize,
    /// Local and global steps.
    pub iterations: usize,
    /// Energy over area: the mean of the squared strains.
    pub energy: f64,
    /// How much the last iteration changed that.
    pub change: f64,
    /// Area of the surface, in its own units.
    pub area: f64,
    /// Of the layout: 0 for what can be unrolled.
    pub distortion: Distortion,
    /// The same for the view from above: how far from flat the surface was to begin with.
    pub plan: Distortion,
    /// Pairs of edges on the border of the layout that cross: 0 where it does not overlap.
    pub crossings: usize,
}

/// A surface laid flat.
///
/// Each connected part lies upright where it is seen from above, as nearly as it goes. Parts may
/// come to lie on each other.
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
    /// The surface, as triangles.
    pub fn mesh(&self) -> &Triangulation {
        &self.mesh
    }

    pub(crate) fn into_mesh(self) -> Triangulation {
        self.mesh
    }

    /// Where each vertex of the mesh lies on the plane, in the surface's units.
    pub fn places(&self) -> &[[f64; 2]] {
        &self.places
    }

    /// The connected part of each vertex of the mesh; 0 is that with the most vertices.
    pub fn parts(&self) -> &[u32] {
        &self.parts
    }

    /// For each triangle the singular values `σ₁ ≥ σ₂` of its map to the plane, both 1 where it is
    /// rigid: `σ₁σ₂` is the change of area, `σ₁/σ₂` that of angles. `σ₂` is negative where the
    /// triangle lies upside down.
    pub fn stretches(&self) -> &[[f64; 2]] {
        &self.stretches
    }

    /// Pairs of edges on the border, by the mesh's vertices, that cross.
    pub fn overlaps(&self) -> &[[[u32; 2]; 2]] {
        &self.overlaps
    }

    /// How well it went.
    pub fn report(&self) -> &UnrollReport {
        &self.report
    }
}

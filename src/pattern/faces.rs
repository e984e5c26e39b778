//! The triangles of a sheet, with their positions on the surface and on the flat sheet.

use crate::scene::mesh::TexturedTriangle;
use crate::unroll::flat_triangle::{FlatTriangle, Point};

/// The triangles of a sheet, with their positions on the surface and on the flat sheet.
#[derive(Debug, Clone, PartialEq, Default)]
#[non_exhaustive]
pub struct Faces {
    /// Position of each of the sheet's vertices on the surface in space.
    pub built: Vec<[f64; 3]>,
    /// Position of each of the sheet's vertices on the flat sheet.
    pub flat: Vec<[f64; 2]>,
    /// Numbers of the three vertices of each of the sheet's triangles, counter-clockwise.
    pub triangles: Vec<[u32; 3]>,
    /// Part of its texture that each of the sheet's triangles shows; empty unless a mesh with texture coordinates was laid flat as it
    /// is.
    pub textured: Vec<Option<TexturedTriangle>>,
}

impl Faces {
    /// Computes the singular values `σ₁ ≥ σ₂` of each triangle's map from space to the flat sheet, both 1 where the map is rigid or the
    /// triangle has no area.
    pub fn stretches(&self) -> Vec<[f64; 2]> {
        let stretch = |corners: &[u32; 3]| {
            let piece = FlatTriangle::from_points(corners.map(|v| self.built[v as usize]));
            let places = corners
                .map(|v| self.flat[v as usize])
                .map(|[x, y]| Point::new(x, y));
            match piece.exists() {
                true => piece.singular_values(places),
                false => [1.0; 2],
            }
        };
        self.triangles.iter().map(stretch).collect()
    }
}

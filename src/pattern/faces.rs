//! The triangles of a sheet, with their positions on the surface and on the flat sheet.

use crate::scene::mesh::TexturedTriangle;

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

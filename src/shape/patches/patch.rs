//! What a patch is, and the label of vertices and triangles without one.

/// Label of vertices without a height, and of those that belong to no patch.
pub const NO_PATCH: u32 = u32::MAX;

/// A smooth part of a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct Patch {
    /// Number of its vertices.
    pub vertices: usize,
    /// Its area on the surface, in the surface's units: each triangle's in equal parts its
    /// corners'.
    pub area: f64,
}

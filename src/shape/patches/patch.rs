//! A patch, and the label of vertices and triangles without one.

/// Label of vertices and triangles that belong to no patch, as those without a height.
pub const NO_PATCH: u32 = u32::MAX;

/// A patch: a region of a surface without a crease inside.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct Patch {
    /// Number of its vertices.
    pub vertices: usize,
    /// Area on the surface, in the surface's units squared. Each corner of a triangle counts a third of its area.
    pub area: f64,
}

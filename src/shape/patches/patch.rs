//! A patch, and the label of vertices and triangles without one.

/// Label of a vertex or triangle that belongs to no patch, such as a vertex without a height.
pub const NO_PATCH: u32 = u32::MAX;

/// A patch: a region of a surface without a crease inside.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct Patch {
    /// Number of vertices that belong to the patch.
    pub vertices: usize,
    /// Area of the patch on the surface, in the surface's units squared. Each corner of a triangle counts a third
    /// of the triangle's area.
    pub area: f64,
}

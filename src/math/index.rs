//! The value that stands for a missing index.

/// Sentinel in arrays of `u32` indices (of vertices, half-edges, components): there is none. Arrays have fewer entries,
/// so that it is no index of anything.
pub(crate) const NO_INDEX: u32 = u32::MAX;

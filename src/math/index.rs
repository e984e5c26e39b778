//! The number that stands for a missing index.

/// Sentinel for "no index" in arrays of `u32` indices (of vertices, half-edges, components). Arrays have fewer entries,
/// so that no entry has this index.
pub(crate) const NO_INDEX: u32 = u32::MAX;

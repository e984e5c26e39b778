//! What a fit of a mesh is given.

use super::geometry::Point;
use super::topology::Topology;

/// Mesh to be fitted, which stays the same from one linearisation to the next, in normalised coordinates.
#[derive(Debug, Clone)]
pub(super) struct MeshInput {
    pub topology: Topology,
    /// The vertices as they were given.
    pub noisy: Vec<Point>,
    /// What each vertex is trusted, 1 for all if empty.
    pub confidence: Vec<f64>,
    /// Which vertices stay where they are.
    pub held: Vec<bool>,
}

//! The input of a fit of a mesh.

use super::geometry::Point;
use super::topology::Topology;

/// The mesh to be fitted, in normalised coordinates; it is the same for all linearisations.
#[derive(Debug, Clone)]
pub(super) struct MeshInput {
    pub topology: Topology,
    /// Positions of the vertices as given.
    pub noisy: Vec<Point>,
    /// Confidence of each vertex; empty for 1 each.
    pub confidence: Vec<f64>,
    /// Whether each vertex stays where it is.
    pub held: Vec<bool>,
}

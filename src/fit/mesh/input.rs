//! The input of a mesh's fit.

use super::geometry::Point;
use super::topology::Topology;

/// Mesh to be fitted, in normalised coordinates; the same for all linearisations.
#[derive(Debug, Clone)]
pub(super) struct MeshInput {
    pub topology: Topology,
    /// Position of each vertex as given.
    pub noisy: Vec<Point>,
    /// Confidence of each vertex; empty if each is 1.
    pub confidence: Vec<f64>,
    /// Whether each vertex stays where it is.
    pub held: Vec<bool>,
}

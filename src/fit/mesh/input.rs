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
    /// Maximum distance of each vertex from where it was given.
    pub reach: Vec<f64>,
}

impl MeshInput {
    /// The position within a vertex's reach that is nearest to `x` at the same height along the unit vector `up`, or as
    /// near to that height as the reach allows.
    pub(super) fn within_reach_across(&self, vertex: usize, x: Point, up: &Point) -> Point {
        let (start, reach) = (self.noisy[vertex], self.reach[vertex]);
        let offset = x - start;
        // No number in a mesh without extent.
        if offset.norm() <= reach || reach.is_nan() {
            return x;
        }
        let rise = up.dot(&offset).clamp(-reach, reach);
        let across = offset - up * up.dot(&offset);
        let most = (reach * reach - rise * rise).sqrt();
        let share = if across.norm() > most {
            most / across.norm()
        } else {
            1.0
        };
        start + up * rise + across * share
    }

    /// Brings all vertices within their reach: the farther beyond it one is, the nearer to where it was given, because a
    /// step far beyond the noise says nothing about the surface.
    pub(super) fn keep_within_reach(&self, x: &mut [Point]) {
        for (vertex, x) in x.iter_mut().enumerate() {
            let (start, reach) = (self.noisy[vertex], self.reach[vertex]);
            let length = (*x - start).norm();
            if length > reach {
                *x = start + (*x - start) * (reach / length).powi(2);
            }
        }
    }
}

//! Volume, area and number of folded triangles of a mesh's surface.

use super::geometry::{Point, faces_away, normals, twice_area, volume};
use super::topology::Topology;

/// Volume, area and number of folded triangles of a mesh's surface.
#[derive(Debug, Clone, Copy)]
pub(super) struct ShapeMeasures {
    pub volume: f64,
    pub area: f64,
    pub flipped: usize,
}

impl ShapeMeasures {
    /// Measures a surface with vertices at `x`. A triangle is folded if it faces away from the vertex normals of the
    /// `smooth` surface.
    pub(super) fn new(topology: &Topology, x: &[Point], smooth: &[Point]) -> Self {
        let up = normals(topology, smooth, None);
        let flipped = (topology.triangles.iter()).filter(|triangle| faces_away(x, &up, triangle));
        ShapeMeasures {
            volume: volume(topology, x),
            area: topology
                .triangles
                .iter()
                .map(|t| twice_area(x, t).norm() / 2.0)
                .sum(),
            flipped: flipped.count(),
        }
    }
}

//! Measures how much of a mesh its heights from one side do not show.

use nalgebra::Vector3;

use super::mesh::Mesh;
use super::sampling::Samples;
use crate::lattice::hexagonal::shift;

/// Minimum depth of a hidden triangle behind the heights, in spacings of the lattice.
const MIN_HIDDEN_DEPTH_SPACINGS: f64 = 3.0;

impl Samples {
    /// Returns the share of the area of a mesh that lies behind the heights sampled from it, from 0 to 1: of each
    /// triangle that is decided at its centroid. 0 for a point cloud. Costs `O(triangles)`.
    pub fn hidden_share(&self, mesh: &Mesh) -> f64 {
        let (field, frame) = (self.heightfield(), self.frame());
        let lattice = field.lattice();
        let [left, top] = lattice.origin();
        let nearest = |x: f64, y: f64| {
            let row = ((top - y) / lattice.row_spacing()).round();
            // Casts saturate, so that what is outside has no vertex.
            let inside = row >= 0.0 && row < lattice.rows() as f64;
            let offset = if inside { shift(row as usize) } else { 0.0 };
            let col = ((x - left) / lattice.spacing() + offset).round();
            let inside = inside && col >= 0.0 && col < lattice.cols() as f64;
            inside.then(|| field.heights()[lattice.index(row as usize, col as usize)])
        };
        let (mut whole, mut hidden) = (0.0, 0.0);
        for triangle in mesh.triangles() {
            let [a, b, c] = (mesh.corners(*triangle)).map(|p| Vector3::from(frame.view(p)));
            let area = (b - a).cross(&(c - a)).norm();
            if !area.is_finite() {
                continue;
            }
            whole += area;
            let middle = (a + b + c) / 3.0;
            let depth = nearest(middle.x, middle.y).map(|height| height - middle.z);
            if depth.is_some_and(|depth| depth > MIN_HIDDEN_DEPTH_SPACINGS * lattice.spacing()) {
                hidden += area;
            }
        }
        if whole > 0.0 { hidden / whole } else { 0.0 }
    }
}

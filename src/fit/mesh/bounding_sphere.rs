//! Normalised coordinates of a mesh, in which its bounding sphere has the diameter 1.

use super::geometry::Point;
use crate::error::{Error, Result};
use crate::scene::mesh::Mesh;

/// Map from the user's coordinates of a mesh to normalised ones, `scale (x − centre)`, in which its bounding sphere has
/// the diameter 1.
#[derive(Debug, Clone, Copy)]
pub(super) struct BoundingSphere {
    centre: Point,
    pub scale: f64,
}

impl BoundingSphere {
    /// Finds the bounding sphere about the centroid of a mesh's area, which does not depend on how the mesh is rotated.
    pub(super) fn from_mesh(mesh: &Mesh) -> Result<Self> {
        let corners = |triangle: &[u32; 3]| mesh.corners(*triangle).map(Point::from);
        let (mut sum, mut weight) = (Point::zeros(), 0.0);
        for triangle in mesh.triangles() {
            let [a, b, c] = corners(triangle);
            // The weight is never 0, so that triangles without area have a position, too.
            let area = (b - a).cross(&(c - a)).norm() + f64::MIN_POSITIVE;
            sum += area / 3.0 * (a + b + c);
            weight += area;
        }
        let centre = sum / weight;
        let named = mesh.triangles().iter().flat_map(corners);
        let radius = named.map(|x| (x - centre).norm()).fold(0.0, f64::max);
        let scale = 0.5 / radius;
        if !centre.iter().all(|x| x.is_finite()) || !scale.is_normal() || !radius.is_normal() {
            return Err(Error::mesh_size(radius));
        }
        Ok(BoundingSphere { centre, scale })
    }

    /// Converts a point from the user's coordinates to normalised ones.
    pub(super) fn inward(self, x: [f64; 3]) -> Point {
        self.scale * (Point::from(x) - self.centre)
    }

    /// Converts a point from normalised coordinates to the user's.
    pub(super) fn outward(self, x: Point) -> [f64; 3] {
        (self.centre + x / self.scale).into()
    }
}

/// Returns the factor from a mesh's coordinates to those in which its bounding sphere has the diameter 1.
///
/// # Errors
/// [`Error::Topology`] if the mesh has no size.
pub(crate) fn bounding_sphere_scale(mesh: &Mesh) -> Result<f64> {
    Ok(BoundingSphere::from_mesh(mesh)?.scale)
}

//! The part of the depths that shows a page with four known corners, however its edges are bent.
//!
//! Seen by a camera, the edge of a bent page is no straight line between two corners. Seen along the normal of the
//! plane through its corners it nearly is: an edge bends out of that plane. So a depth belongs to the page if its
//! point, moved along that normal, lies between the corners.

use nalgebra::{Vector2, Vector3};

use crate::math::least_squares::LeastSquares;
use crate::math::planar::polygon_contains;

/// Radius around a page's corner, in the photo, within which depths determine the corner's position in space, as a
/// share of the distance to the opposite corner: small, since a page may bend strongly there.
const CORNER_RADIUS_SHARE: f64 = 0.05;

/// Minimum number of depths around a page's corner that determine its position in space.
const MIN_CORNER_DEPTHS: usize = 6;

/// Ridge of the least-squares fit of a corner's position in space: decides only what the depths leave undetermined.
const CORNER_FIT_RIDGE: f64 = 1e-9;

/// Maximum distance of a page's points from the plane through its corners, as a share of its diagonal: points further
/// away belong to something else.
const MAX_HEIGHT_SHARE: f64 = 0.6;

/// The prism in space over a page's four corners that contains the page.
pub(super) struct Footprint {
    origin: Vector3<f64>,
    normal: Vector3<f64>,
    axes: [Vector3<f64>; 2],
    corners: [[f64; 2]; 4],
    max_height: f64,
}

impl Footprint {
    /// Makes the prism over the four corners of a page in the photo. `seen` are the points of the depths in space with
    /// their places in the photo. None if too few depths lie around a corner.
    pub(super) fn new(
        corners: &[[f64; 2]; 4],
        seen: &[([f64; 2], Vector3<f64>)],
    ) -> Option<Footprint> {
        let mut found = [Vector3::zeros(); 4];
        for (k, found) in found.iter_mut().enumerate() {
            let [here, across] = [corners[k], corners[(k + 2) % 4]];
            let radius = CORNER_RADIUS_SHARE * (across[0] - here[0]).hypot(across[1] - here[1]);
            let mut fit = LeastSquares::<3, 3>::with_ridge([CORNER_FIT_RIDGE; 3]);
            let mut count = 0;
            for (place, point) in seen {
                let [x, y] = [0, 1].map(|i| (place[i] - here[i]) / radius);
                let weight = 1.0 - x.hypot(y);
                if weight > 0.0 && polygon_contains(corners, *place) {
                    count += 1;
                    fit.add(&Vector3::new(1.0, x, y), (*point).into(), weight);
                }
            }
            if count < MIN_CORNER_DEPTHS {
                return None;
            }
            *found = fit.solve()?.row(0).transpose();
        }
        let [a, b, c, d] = found;
        let normal = (c - a).cross(&(d - b)).try_normalize(0.0)?;
        let along = (b - a) - normal * normal.dot(&(b - a));
        let along = along.try_normalize(0.0)?;
        let mut footprint = Footprint {
            origin: (a + b + c + d) / 4.0,
            normal,
            axes: [along, normal.cross(&along)],
            corners: [[0.0; 2]; 4],
            max_height: MAX_HEIGHT_SHARE * (c - a).norm().max((d - b).norm()),
        };
        footprint.corners = found.map(|corner| footprint.place(&corner).into());
        Some(footprint)
    }

    /// Whether a point in space lies in the prism, so that it may belong to the page.
    pub(super) fn holds(&self, point: &Vector3<f64>) -> bool {
        let height = (point - self.origin).dot(&self.normal);
        height.abs() <= self.max_height && polygon_contains(&self.corners, self.place(point).into())
    }

    /// Projects a point in space along the prism's axis to the plane through the corners; returns its coordinates
    /// there.
    fn place(&self, point: &Vector3<f64>) -> Vector2<f64> {
        let off = point - self.origin;
        Vector2::new(off.dot(&self.axes[0]), off.dot(&self.axes[1]))
    }
}

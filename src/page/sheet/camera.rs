//! Pinhole camera that is fitted together with a sheet: focal length and principal point relative to nominal ones.

use nalgebra::Vector3;

/// Pinhole camera in normalised image coordinates: pixels relative to the nominal principal point, divided by the
/// nominal focal length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct SheetCamera {
    /// Logarithm of the ratio of the focal length to the nominal one.
    pub log_scale: f64,
    /// Principal point relative to the nominal one, divided by the nominal focal length.
    pub centre: [f64; 2],
}

impl SheetCamera {
    /// Projects a point in the camera's axes to normalised image coordinates (pixels from the nominal principal point,
    /// over the nominal focal length); None if it is not in front of the camera.
    pub fn project(&self, point: Vector3<f64>) -> Option<[f64; 2]> {
        let scale = self.log_scale.exp();
        (point.z > 0.0).then(|| {
            [
                self.centre[0] + scale * point.x / point.z,
                self.centre[1] + scale * point.y / point.z,
            ]
        })
    }

    /// Direction in space in which a place in the photo, in normalised image coordinates, is seen; its depth is 1.
    pub fn ray(&self, seen: [f64; 2]) -> Vector3<f64> {
        let scale = self.log_scale.exp();
        let [x, y] = [0, 1].map(|k| (seen[k] - self.centre[k]) / scale);
        Vector3::new(x, y, 1.0)
    }

    /// Gradient, by the point's position, of the projected point's coordinate along the image direction `[nx, ny]`.
    pub fn gradient(&self, point: Vector3<f64>, [nx, ny]: [f64; 2]) -> Vector3<f64> {
        let scale = self.log_scale.exp() / point.z;
        Vector3::new(nx, ny, -(nx * point.x + ny * point.y) / point.z) * scale
    }
}

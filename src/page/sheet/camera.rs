//! The pinhole camera of a sheet: a focal factor and a principal point that are found along with the sheet.

use nalgebra::Vector3;

/// Pinhole camera in normalised coordinates: pixels relative to the nominal principal point, over the nominal focal length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct SheetCamera {
    /// Logarithm of the focal length over the nominal one.
    pub log_scale: f64,
    /// Principal point relative to the nominal one, in nominal focal lengths.
    pub centre: [f64; 2],
}

/// Minimum depth of a point in front of the camera, in widths of the page.
const MIN_DEPTH: f64 = 0.05;

impl SheetCamera {
    /// Projects a point; None if it is not in front of the camera.
    pub fn project(&self, point: Vector3<f64>) -> Option<[f64; 2]> {
        let scale = self.log_scale.exp();
        (point.z > MIN_DEPTH).then(|| {
            [
                self.centre[0] + scale * point.x / point.z,
                self.centre[1] + scale * point.y / point.z,
            ]
        })
    }

    /// Gradient by the point of the projection's coordinate along a direction.
    pub fn gradient(&self, point: Vector3<f64>, [nx, ny]: [f64; 2]) -> Vector3<f64> {
        let scale = self.log_scale.exp() / point.z;
        Vector3::new(nx, ny, -(nx * point.x + ny * point.y) / point.z) * scale
    }
}

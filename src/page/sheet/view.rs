//! Normalised image coordinates of a photo: pixels relative to a nominal principal point, in nominal focal lengths.

/// Nominal camera of a photo, which converts pixels to normalised image coordinates and back.
#[derive(Debug, Clone, Copy)]
pub(super) struct PhotoView {
    /// Nominal focal length of the camera, in pixels.
    pub focal: f64,
    /// Nominal principal point of the camera, in pixels.
    pub centre: [f64; 2],
}

impl PhotoView {
    /// Converts a place in the photo from pixels to normalised image coordinates: relative to the principal point,
    /// divided by the focal length.
    pub fn to_normalised(self, pixel: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|k| (pixel[k] - self.centre[k]) / self.focal)
    }

    /// Converts a place in the photo from normalised image coordinates (relative to the principal point, divided by the
    /// focal length) to pixels.
    pub fn to_pixels(self, at: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|k| at[k] * self.focal + self.centre[k])
    }
}

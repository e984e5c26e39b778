//! Normalised coordinates of a photo.

/// The nominal camera of a photo: pixels to normalised coordinates and back.
#[derive(Debug, Clone, Copy)]
pub(super) struct PhotoView {
    /// Nominal focal length, in pixels.
    pub focal: f64,
    /// Nominal principal point, in pixels.
    pub centre: [f64; 2],
}

impl PhotoView {
    /// Normalised coordinates of a place in the photo.
    pub fn to_normalised(self, pixel: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|k| (pixel[k] - self.centre[k]) / self.focal)
    }

    /// Place in the photo of normalised coordinates, in pixels.
    pub fn to_pixels(self, at: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|k| at[k] * self.focal + self.centre[k])
    }
}

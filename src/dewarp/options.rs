//! Options of dewarping.

/// Options of dewarping: resolution and margins of the flat image.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct DewarpOptions {
    /// Resolution of the flat image, in pixels per unit of length. `None`: the mean resolution of the photo.
    pub dots: Option<f64>,
    /// Crop the flat image to the largest upright rectangle within the sheet. Default false.
    pub trim: bool,
}

impl DewarpOptions {
    /// These options with another resolution, in pixels per unit of length.
    pub fn dots(self, dots: f64) -> Self {
        DewarpOptions {
            dots: Some(dots),
            ..self
        }
    }

    /// These options with or without cropping of the margins.
    pub fn trim(self, trim: bool) -> Self {
        DewarpOptions { trim, ..self }
    }
}

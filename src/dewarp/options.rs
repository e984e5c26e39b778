//! Options of dewarping: resolution and margins of the flat image.

/// Options of dewarping: resolution and margins of the flat image.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct DewarpOptions {
    /// Resolution of the flat image, in pixels per unit of length. `None`: the mean resolution of the photo.
    pub dots: Option<f64>,
    /// Whether the flat image is cropped to the largest upright rectangle within the sheet. Default false.
    pub trim: bool,
}

impl DewarpOptions {
    /// Returns these options with another resolution of the flat image, in pixels per unit of length.
    pub fn dots(self, dots: f64) -> Self {
        DewarpOptions {
            dots: Some(dots),
            ..self
        }
    }

    /// Returns these options with or without cropping the flat image to the largest rectangle within the sheet.
    pub fn trim(self, trim: bool) -> Self {
        DewarpOptions { trim, ..self }
    }
}

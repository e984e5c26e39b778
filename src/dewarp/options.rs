//! Options of making photos flat.

/// What of a flat image is wanted.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct DewarpOptions {
    /// Pixels of the flat image per unit of length. `None`: as many as the photo has.
    pub dots: Option<f64>,
    /// Cut off the margins: keep the largest upright rectangle that is all sheet. Default false.
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

    /// These options with margins cut off, or not.
    pub fn trim(self, trim: bool) -> Self {
        DewarpOptions { trim, ..self }
    }
}

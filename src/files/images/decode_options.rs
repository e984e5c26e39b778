//! Options of decoding an image file of heights.

use crate::error::{Error, Result};
use crate::files::image_format::Format;

/// Options of decoding an image file of heights.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct DecodeOptions {
    /// Name of the array of an NPZ file or of the channel of an EXR file; `None`: the only one that may have heights.
    pub array: Option<String>,
    /// Name of the file, which may say what is in it; empty if it is not known.
    pub name: String,
    /// Side length of a pixel, in the unit of the heights, whatever the file says of it.
    pub pixel_size: Option<f64>,
    /// A value that is no data, rounded as the file stores numbers; `None`: no other than those that the file names.
    pub no_data: Option<f64>,
    /// Whether values that nobody would measure are no data.
    pub assume_no_data: bool,
}

impl Default for DecodeOptions {
    fn default() -> Self {
        DecodeOptions {
            array: None,
            name: String::new(),
            pixel_size: None,
            no_data: None,
            assume_no_data: true,
        }
    }
}

impl DecodeOptions {
    /// Sets the name of the array of an NPZ file or of the channel of an EXR file, and returns the options.
    pub fn array(mut self, name: impl Into<String>) -> Self {
        self.array = Some(name.into());
        self
    }

    /// Sets the name of the file, and returns the options.
    pub fn name(mut self, name: impl Into<String>) -> Self {
        self.name = name.into();
        self
    }

    /// Sets the side length of a pixel, and returns the options.
    pub fn pixel_size(mut self, side: f64) -> Self {
        self.pixel_size = Some(side);
        self
    }

    /// Sets a value that is no data, and returns the options.
    pub fn no_data(mut self, value: f64) -> Self {
        self.no_data = Some(value);
        self
    }

    /// Sets whether values that nobody would measure are no data, and returns the options.
    pub fn assume_no_data(mut self, assume: bool) -> Self {
        self.assume_no_data = assume;
        self
    }

    /// Returns an error if an array is named for a file that has no named arrays.
    pub(super) fn check(&self, format: Format) -> Result<()> {
        match &self.array {
            Some(name) if !matches!(format, Format::Npz | Format::Exr) => {
                let requirement = "is for NPZ and EXR files, and this is neither";
                Err(Error::option("array", name, requirement))
            }
            _ => Ok(()),
        }
    }
}

//! Grey levels of the pixels of a picture.

use crate::error::{Error, Result, try_filled};
use crate::files::failure::not_read;

/// Layout of a pixel's samples: the first `colours` samples are one of grey or three of colour; `alpha` is the index of
/// the alpha sample.
pub(super) struct Channels {
    pub(super) colours: usize,
    pub(super) alpha: Option<usize>,
}

/// Reads the grey values of an image, whose samples `sample(pixel, channel)` returns; a pixel with an alpha of 0
/// becomes NaN, no data.
pub(super) fn grey(
    (width, height): (usize, usize),
    channels: &Channels,
    sample: impl Fn(usize, usize) -> f64,
) -> Result<Vec<f64>> {
    let mut values = try_filled("image", width * height, f64::NAN)?;
    for (i, z) in values.iter_mut().enumerate() {
        if channels.alpha.is_some_and(|k| sample(i, k) == 0.0) {
            continue;
        }
        let first = sample(i, 0);
        let same = |other: f64| other == first || other.is_nan() && first.is_nan();
        if !(1..channels.colours).all(|k| same(sample(i, k))) {
            return Err(coloured(i, width));
        }
        *z = first;
    }
    Ok(values)
}

/// Creates the error for a picture with colours, which cannot be read as heights; it names the first coloured
/// pixel.
fn coloured(pixel: usize, width: usize) -> Error {
    let reason = format!(
        "the pixel at row {}, column {} has a colour, from which no height follows; \
         grey images are read (grey, or RGB and palettes with grey pixels only); read a photo of a page as a photo",
        pixel / width,
        pixel % width
    );
    not_read(reason)
}

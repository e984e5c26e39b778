//! Converts the samples of a decoded picture to heights and colours, and reports errors, for several decoders.

use crate::error::{Error, Result, checked_cells, try_filled};
use crate::files::image_format::Format;
use crate::files::images::decoded::{StoredImage, coloured};
use crate::files::images::photo::PhotoFile;
use crate::files::number_type::NumberType;
use crate::heights::heightfield::HeightImage;
use crate::math::lanes;

/// Layout of a pixel's samples: the first `colours` samples are one of grey or three of colour; `alpha` is the index of
/// the alpha sample.
pub(super) struct Channels {
    pub(super) colours: usize,
    pub(super) alpha: Option<usize>,
}

/// Reads the grey values of an image, whose samples `sample(pixel, channel)` returns; a pixel with an alpha of 0
/// becomes NaN, no data.
pub(super) fn grey(
    format: Format,
    (width, height): (usize, usize),
    channels: &Channels,
    sample: impl Fn(usize, usize) -> f64,
) -> Result<Vec<f64>> {
    let mut values = try_filled(format.title(), width * height, f64::NAN)?;
    for (i, z) in values.iter_mut().enumerate() {
        if channels.alpha.is_some_and(|k| sample(i, k) == 0.0) {
            continue;
        }
        let first = sample(i, 0);
        let same = |other: f64| other == first || other.is_nan() && first.is_nan();
        if !(1..channels.colours).all(|k| same(sample(i, k))) {
            return Err(coloured(format, i, width));
        }
        *z = first;
    }
    Ok(values)
}

/// Converts a decoded photo to a grey image.
pub(super) fn from_photo(format: Format, photo: &PhotoFile) -> Result<StoredImage> {
    let size = (photo.width, photo.height);
    checked_cells(format.title(), size.1, size.0)?;
    let channels = Channels {
        colours: 3,
        alpha: Some(3),
    };
    let values = grey(format, size, &channels, |i, k| photo.rgba[4 * i + k].into())?;
    Ok(StoredImage {
        assumptions: photo.assumptions.clone(),
        ..StoredImage::new(format, size, values, NumberType::U8)
    })
}

/// Converts the heights of an image to 32-bit floats, which is all that EXR and most readers of TIFF support.
pub(super) fn narrowed(what: &'static str, image: &HeightImage) -> Result<Vec<f32>> {
    let mut heights = try_filled(what, image.values().len(), 0f32)?;
    for (i, (narrow, z)) in heights.iter_mut().zip(image.values()).enumerate() {
        *narrow = lanes::single(*z);
        if narrow.is_infinite() {
            return Err(Error::NotFinite {
                what,
                value: f64::from(*narrow),
                row: i / image.width(),
                col: i % image.width(),
                advice: "heights beyond 3.4e38 do not fit into its 32-bit floats; scale them down \
                         or write NPY",
            });
        }
    }
    Ok(heights)
}

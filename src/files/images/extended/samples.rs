//! Converts the samples of a decoded picture to heights and colours, and reports errors, for several decoders.

use crate::error::{Error, Result, checked_cells, try_filled};
use crate::files::images::decoded::{StoredImage, coloured};
pub(super) use crate::files::images::failure::{check_length, damaged, unsupported};
use crate::files::images::format::Format;
use crate::files::images::photo::PhotoFile;
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
            return Err(coloured(format.title(), i, width));
        }
        *z = first;
    }
    Ok(values)
}

/// Converts 8-bit samples, with `colours` colour samples and perhaps one of alpha per pixel, to a decoded grey image.
pub(crate) fn picture(
    format: Format,
    size: (usize, usize),
    samples: &[u8],
    stride: usize,
) -> Result<StoredImage> {
    let (colours, alpha) = match stride {
        2 | 4 => (stride - 1, Some(stride - 1)),
        _ => (stride, None),
    };
    let values = grey(format, size, &Channels { colours, alpha }, |i, k| {
        samples[stride * i + k].into()
    })?;
    Ok(StoredImage::new(format, size, values, "u8"))
}

/// Converts a decoded photo to a grey image.
pub(super) fn from_photo(format: Format, photo: &PhotoFile) -> Result<StoredImage> {
    let size = (photo.width, photo.height);
    checked_cells(format.title(), size.1, size.0)?;
    Ok(StoredImage {
        assumptions: photo.assumptions.clone(),
        ..picture(format, size, &photo.rgba, 4)?
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

/// Reserves memory for a file of a given number of bytes; an error if there is not enough memory.
pub(super) fn room(what: &'static str, bytes: usize) -> Result<Vec<u8>> {
    let mut file = Vec::new();
    file.try_reserve_exact(bytes)
        .map_err(|_| Error::OutOfMemory { what, bytes })?;
    Ok(file)
}

//! Converts the samples of a decoded picture to heights and colours, and reports errors, for several decoders.

use crate::error::{Error, Result, try_filled};
use crate::files::images::decoded::{Decoded, assumed_levels, coloured, suggested_scale};
pub(super) use crate::files::images::failure::{check_length, damaged, unsupported};
use crate::files::images::format::Format;
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

/// Computes the difference between the largest and the smallest value of an integer type, given by its name; `None`
/// for floats.
fn integer_range(data_type: &str) -> Option<f64> {
    let bits = data_type.strip_prefix(['u', 'i'])?;
    Some(bits.parse::<i32>().ok()?).map(|bits| 2f64.powi(bits) - 1.0)
}

/// Returns the height scale for pixel values of a given type where the file records none.
pub(super) fn default_scale(
    (width, height): (usize, usize),
    pixel_size: f64,
    data_type: &str,
) -> f64 {
    integer_range(data_type).map_or(1.0, |range| {
        pixel_size * suggested_scale(width, height, range)
    })
}

/// Converts 8-bit samples, with `colours` colour samples and perhaps one of alpha per pixel, to a decoded grey image.
pub(crate) fn picture(
    format: Format,
    size: (usize, usize),
    samples: &[u8],
    stride: usize,
) -> Result<Decoded> {
    let (colours, alpha) = match stride {
        2 | 4 => (stride - 1, Some(stride - 1)),
        _ => (stride, None),
    };
    let values = grey(format, size, &Channels { colours, alpha }, |i, k| {
        samples[stride * i + k].into()
    })?;
    Ok(Decoded {
        format,
        width: size.0,
        height: size.1,
        values,
        pixel_size: 1.0,
        unit: None,
        height_scale: default_scale(size, 1.0, "u8"),
        data_type: "u8",
        georeference: None,
        assumptions: vec![assumed_levels()],
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

//! Converts photos to heights, and heights to numbers of 32 bits, for several formats.

use crate::error::{Error, Result, checked_cells, try_filled};
use crate::files::images::decoded::StoredImage;
use crate::files::images::grey::{Channels, grey};
use crate::files::images::photo::PhotoFile;
use crate::files::number_type::NumberType;
use crate::heights::heightfield::HeightImage;
use crate::math::lanes;

/// Converts a decoded photo to a grey image.
pub(super) fn from_photo(photo: &PhotoFile) -> Result<StoredImage> {
    let size = (photo.width, photo.height);
    checked_cells("image", size.1, size.0)?;
    let channels = Channels {
        colours: 3,
        alpha: Some(3),
    };
    let values = grey(size, &channels, |i, k| photo.rgba[4 * i + k].into())?;
    Ok(StoredImage {
        assumptions: photo.assumptions.clone(),
        ..StoredImage::new(size, values, NumberType::U8)
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

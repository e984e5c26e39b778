//! Decodes PNG photos by the `png` crate, row by row, so that large ones need no more memory than what is kept of them.

use ::png::{ColorType, Transformations};

use super::exif::PhotoTags;
use super::pixels::{MAX_FILE_PIXELS, PhotoFile, PhotoPixels};
use crate::error::Result;
use crate::files::failure::not_read;
use crate::files::images::png::{Pixels, failed, open};

/// Transformations by which all PNG files become 8-bit grey or colours with alpha.
fn transformations() -> Transformations {
    Transformations::normalize_to_color8() | Transformations::ALPHA
}

pub(super) fn decode(bytes: &[u8]) -> Result<PhotoFile> {
    let (mut reader, size) = open(bytes, transformations(), usize::MAX)?;
    // Refuses photos of too many pixels.
    let mut pixels = PhotoPixels::new(size)?;
    let tags = if reader.info().interlaced {
        let Pixels {
            reader, samples, ..
        } = Pixels::decode(bytes, transformations(), MAX_FILE_PIXELS)?;
        pixels.push_rows(&samples);
        tags(reader.info())
    } else {
        let mut line = Vec::new();
        while let Some(row) = reader.next_row().map_err(failed)? {
            pixels.push_row(row.data(), &mut line);
        }
        // Reads to the end of the file: a truncated file must be an error, and metadata may follow the pixels.
        reader.finish().map_err(failed)?;
        tags(reader.info())
    };
    // After the transformations only these two colour types remain.
    let known = [ColorType::GrayscaleAlpha, ColorType::Rgba];
    if !known.contains(&reader.output_color_type().0) {
        return Err(not_read("its colours could not be converted"));
    }
    pixels.finish(&tags)
}

fn tags(info: &::png::Info<'_>) -> PhotoTags {
    PhotoTags::read(info.exif_metadata.as_deref())
}

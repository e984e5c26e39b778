//! Decodes WebP pictures by the `image-webp` crate.

use std::io::Cursor;

use image_webp::{DecodingError, WebPDecoder};

use super::samples::{damaged, picture, unsupported};
use crate::error::{Result, checked_cells, try_filled};
use crate::files::images::decoded::StoredImage;
use crate::files::images::format::Format;
use crate::files::images::photo::{PhotoFile, PhotoPixels, PhotoTags};

/// Maximum memory that the WebP decoder may allocate for metadata, in bytes.
const MAX_DECODER_BYTES: usize = 1 << 24;

pub(super) fn decode(bytes: &[u8]) -> Result<StoredImage> {
    let mut decoder = open(bytes)?;
    let (width, height) = decoder.dimensions();
    let size = (width as usize, height as usize);
    checked_cells("WebP image", size.1, size.0)?;
    let (samples, stride) = samples(&mut decoder)?;
    picture(Format::WebP, size, &samples, stride)
}

pub(crate) fn decode_photo(bytes: &[u8]) -> Result<PhotoFile> {
    let mut decoder = open(bytes)?;
    let (width, height) = decoder.dimensions();
    let mut pixels = PhotoPixels::new([width as usize, height as usize])?;
    // Damaged metadata need not mean a damaged picture.
    let exif = decoder.exif_metadata().ok().flatten();
    pixels.push_rows(&samples(&mut decoder)?.0);
    pixels.finish(&PhotoTags::read(exif.as_deref()))
}

fn open(bytes: &[u8]) -> Result<WebPDecoder<Cursor<&[u8]>>> {
    // The decoder fills in missing data at the end; the header has the length.
    let length = bytes.get(4..8).map_or(0, |length| {
        u32::from_le_bytes([length[0], length[1], length[2], length[3]])
    });
    if bytes.len() < length as usize {
        return Err(damaged(Format::WebP, "it is cut short"));
    }
    let mut decoder = WebPDecoder::new(Cursor::new(bytes)).map_err(failed)?;
    decoder.set_memory_limit(MAX_DECODER_BYTES);
    if decoder.is_animated() {
        return Err(unsupported(
            Format::WebP,
            "an animation; only still pictures are read",
        ));
    }
    Ok(decoder)
}

/// Decodes the samples of a WebP file, and their number per pixel.
fn samples(decoder: &mut WebPDecoder<Cursor<&[u8]>>) -> Result<(Vec<u8>, usize)> {
    let stride = if decoder.has_alpha() { 4 } else { 3 };
    let (width, height) = decoder.dimensions();
    let mut samples = try_filled("WebP image", stride * width as usize * height as usize, 0u8)?;
    decoder.read_image(&mut samples).map_err(failed)?;
    Ok((samples, stride))
}

fn failed(error: DecodingError) -> crate::error::Error {
    match error {
        DecodingError::UnsupportedFeature(what) => unsupported(Format::WebP, what),
        other => damaged(Format::WebP, other),
    }
}

//! Decodes WebP pictures by the `image-webp` crate.

use std::io::Cursor;

use image_webp::{DecodingError, WebPDecoder};

use super::samples::{damaged, picture, rgba_of, unsupported};
use crate::error::{Result, checked_cells, try_filled};
use crate::files::images::decoded::Decoded;
use crate::files::images::format::Format;
use crate::files::images::photo::PhotoFile;

/// Maximum memory that the WebP decoder may allocate for metadata, in bytes.
const MAX_DECODER_BYTES: usize = 1 << 24;

pub(super) fn decode(bytes: &[u8]) -> Result<Decoded> {
    let (samples, stride, size) = pixels(bytes)?;
    picture(Format::WebP, size, &samples, stride)
}

pub(super) fn decode_photo(bytes: &[u8]) -> Result<PhotoFile> {
    let (samples, stride, size) = pixels(bytes)?;
    Ok(PhotoFile::new(
        size,
        rgba_of(Format::WebP, &samples, stride)?,
    ))
}

/// Decodes a WebP file: returns its samples, the number of samples per pixel, and width and height in pixels.
fn pixels(bytes: &[u8]) -> Result<(Vec<u8>, usize, (usize, usize))> {
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
    let (width, height) = decoder.dimensions();
    let (width, height) = (width as usize, height as usize);
    let len = checked_cells("WebP image", height, width)?;
    let stride = if decoder.has_alpha() { 4 } else { 3 };
    let mut samples = try_filled("WebP image", stride * len, 0u8)?;
    decoder.read_image(&mut samples).map_err(failed)?;
    Ok((samples, stride, (width, height)))
}

fn failed(error: DecodingError) -> crate::error::Error {
    match error {
        DecodingError::UnsupportedFeature(what) => unsupported(Format::WebP, what),
        other => damaged(Format::WebP, other),
    }
}

//! Decodes WebP pictures by the `image-webp` crate.

use std::io::Cursor;

use image_webp::{DecodingError, WebPDecoder};

use crate::error::{Result, try_filled};
use crate::files::failure::{damaged, not_read, undecodable};
use crate::files::images::photo::{PhotoFile, PhotoPixels, PhotoTags};

/// Maximum memory that the WebP decoder may allocate for metadata, in bytes.
const MAX_DECODER_BYTES: usize = 1 << 24;

pub(crate) fn decode_photo(bytes: &[u8]) -> Result<PhotoFile> {
    let mut decoder = open(bytes)?;
    let (width, height) = decoder.dimensions();
    let mut pixels = PhotoPixels::new([width as usize, height as usize])?;
    // Damaged metadata need not mean a damaged picture.
    let exif = decoder.exif_metadata().ok().flatten();
    let stride = if decoder.has_alpha() { 4 } else { 3 };
    let mut samples = try_filled("WebP image", stride * width as usize * height as usize, 0u8)?;
    decoder.read_image(&mut samples).map_err(failed)?;
    pixels.push_rows(&samples);
    pixels.finish(&PhotoTags::read(exif.as_deref()))
}

fn open(bytes: &[u8]) -> Result<WebPDecoder<Cursor<&[u8]>>> {
    // The decoder fills in missing data at the end; the header has the length.
    let length = bytes.get(4..8).map_or(0, |length| {
        u32::from_le_bytes([length[0], length[1], length[2], length[3]])
    });
    if bytes.len() < length as usize {
        return Err(damaged("it is cut short"));
    }
    let mut decoder = WebPDecoder::new(Cursor::new(bytes)).map_err(failed)?;
    decoder.set_memory_limit(MAX_DECODER_BYTES);
    if decoder.is_animated() {
        return Err(not_read("an animation; only still pictures are read"));
    }
    Ok(decoder)
}

fn failed(error: DecodingError) -> crate::error::Error {
    match error {
        DecodingError::UnsupportedFeature(what) => not_read(what),
        other => undecodable(other),
    }
}

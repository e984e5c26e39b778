//! Decodes the first picture of GIF files by the `gif` crate.

use std::io::Cursor;

use ::gif::{ColorOutput, DecodeOptions, DecodingError, MemoryLimit};

use super::exif::PhotoTags;
use super::pixels::{MAX_FILE_PIXELS, PhotoFile, PhotoPixels};
use crate::error::{Error, Result, try_filled};
use crate::files::failure::undecodable;

pub(super) fn decode(bytes: &[u8]) -> Result<PhotoFile> {
    let mut options = DecodeOptions::new();
    options.set_color_output(ColorOutput::RGBA);
    options.check_frame_consistency(true);
    if let Some(limit) = std::num::NonZeroU64::new(4 * MAX_FILE_PIXELS as u64) {
        options.set_memory_limit(MemoryLimit::Bytes(limit));
    }
    let mut decoder = options.read_info(Cursor::new(bytes)).map_err(failed)?;
    let [width, height] = [decoder.width(), decoder.height()].map(usize::from);
    let mut pixels = PhotoPixels::new([width, height])?;
    let frame = decoder.read_next_frame().map_err(failed)?;
    let frame = frame.ok_or(Error::Empty { what: "GIF image" })?;
    // The picture may cover a part of the canvas.
    let mut line = try_filled("GIF image", 4 * width, 0)?;
    let [left, top, columns, rows] =
        [frame.left, frame.top, frame.width, frame.height].map(usize::from);
    let mut own = frame.buffer.chunks_exact((4 * columns).max(1));
    let mut buffer = Vec::new();
    for row in 0..height {
        line.fill(0);
        if (top..top + rows).contains(&row)
            && let Some(samples) = own.next()
        {
            line[4 * left..4 * (left + columns)].copy_from_slice(samples);
        }
        pixels.push_row(&line, &mut buffer);
    }
    pixels.finish(&PhotoTags::read(None))
}

fn failed(error: DecodingError) -> Error {
    undecodable(error)
}

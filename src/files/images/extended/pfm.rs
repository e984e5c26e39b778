//! Reads portable float maps (PFM), the bottom row first, and portable grey maps (PGM): words for kind, size and scale, then
//! the pixels.

use crate::error::Result;
use crate::files::failure::damaged;
use crate::files::images::decoded::StoredImage;
use crate::files::images::grey::{Channels, grey};
use crate::files::images::raw_pixels::raw_pixels;
use crate::files::number_type::NumberType;

/// Maximum length of a number in the header, in bytes.
const MAX_NUMBER_BYTES: usize = 32;

/// Decodes a portable float map.
pub(super) fn decode(bytes: &[u8]) -> Result<StoredImage> {
    let colours = if bytes.starts_with(b"PF") { 3 } else { 1 };
    let mut head = Header(&bytes[2..]);
    let (width, height) = head.size()?;
    let scale: f64 = head.number("scale", |scale: &f64| scale.is_finite() && *scale != 0.0)?;
    // A negative scale says that the bytes are little-endian.
    let numbers = raw_pixels(
        (colours * width, height),
        head.0,
        NumberType::F32,
        scale > 0.0,
    )?;
    let channels = Channels {
        colours,
        alpha: None,
    };
    let values = grey((width, height), &channels, |i, k| {
        let (row, col) = (height - 1 - i / width, i % width);
        numbers[colours * (row * width + col) + k]
    })?;
    Ok(StoredImage {
        height_scale: Some(scale.abs()),
        ..StoredImage::new((width, height), values, NumberType::F32)
    })
}

/// Decodes a portable grey map: levels of one or two bytes, the larger first, or in text.
pub(super) fn decode_pgm(bytes: &[u8]) -> Result<StoredImage> {
    let mut head = Header(&bytes[2..]);
    let size = head.size()?;
    let white: u16 = head.number("level of white", |white| *white > 0)?;
    let number_type = if white > 255 {
        NumberType::U16
    } else {
        NumberType::U8
    };
    let values = if bytes.starts_with(b"P2") {
        // A level takes a byte at least, which limits the memory for them.
        let mut levels = raw_pixels(size, head.0, NumberType::U8, true)?;
        for level in &mut levels {
            *level = head.number::<u16>("level", |level| *level <= white)?.into();
        }
        levels
    } else {
        raw_pixels(size, head.0, number_type, true)?
    };
    Ok(StoredImage::new(size, values, number_type))
}

/// Bytes of a file after the part of its header that was read.
struct Header<'a>(&'a [u8]);

impl Header<'_> {
    /// Reads the next number, which is good; one byte of white space or a line's end ends it, as what follows may look like more.
    fn number<T: std::str::FromStr>(
        &mut self,
        what: &str,
        is_good: impl Fn(&T) -> bool,
    ) -> Result<T> {
        let mut start = self.0.trim_ascii_start();
        while start.starts_with(b"#") {
            let end = start.iter().position(|byte| *byte == b'\n');
            start = start[end.unwrap_or(start.len())..].trim_ascii_start();
        }
        let length = (start.iter().take(MAX_NUMBER_BYTES + 1))
            .position(u8::is_ascii_whitespace)
            .or(Some(start.len()).filter(|length| (1..=MAX_NUMBER_BYTES).contains(length)))
            .ok_or_else(|| damaged("its header is cut short"))?;
        let end = 1 + usize::from(start[length..].starts_with(b"\r\n"));
        self.0 = &start[(length + end).min(start.len())..];
        let word = String::from_utf8_lossy(&start[..length]);
        let number = word.parse().ok().filter(is_good);
        number.ok_or_else(|| damaged(format!("its {what} is `{word}`")))
    }

    /// Reads columns and rows.
    fn size(&mut self) -> Result<(usize, usize)> {
        Ok((
            self.number("width", |_| true)?,
            self.number("height", |_| true)?,
        ))
    }
}

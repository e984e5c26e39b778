//! Reads portable float maps (PFM): a line each for kind, size and scale, then 32-bit floats, the bottom row first.

use super::samples::{Channels, damaged, grey};
use crate::error::{Error, Result, checked_cells};
use crate::files::images::decoded::StoredImage;
use crate::files::images::format::Format;

/// Maximum length of a number in the header of a PFM file, in bytes.
const MAX_NUMBER_BYTES: usize = 32;

pub(super) fn decode(bytes: &[u8]) -> Result<StoredImage> {
    let colours = if bytes.starts_with(b"PF") { 3 } else { 1 };
    let mut rest = &bytes[2..];
    let mut number = || -> Result<&str> {
        let start = rest.trim_ascii_start();
        let length = start
            .iter()
            .take(MAX_NUMBER_BYTES + 1)
            .position(u8::is_ascii_whitespace)
            .ok_or_else(|| damaged(Format::Pfm, "its header is cut short"))?;
        // One byte of white space ends the header: what follows may look like more of it.
        rest = &start[length + 1..];
        str::from_utf8(&start[..length]).map_err(|_| damaged(Format::Pfm, "its header is no text"))
    };
    let (width, height) = (size(number()?)?, size(number()?)?);
    let scale = number()?;
    let scale = scale
        .parse()
        .ok()
        .filter(|s: &f64| s.is_finite() && *s != 0.0)
        .ok_or_else(|| damaged(Format::Pfm, format!("its scale is `{scale}`")))?;

    let len = checked_cells("PFM image", height, width)?;
    if len == 0 {
        return Err(Error::Empty { what: "PFM image" });
    }
    let needed = 4 * colours * len;
    if rest.len() < needed {
        return Err(damaged(
            Format::Pfm,
            format!(
                "it is cut short: {width} × {height} pixels take {needed} bytes, {} are there",
                rest.len()
            ),
        ));
    }
    let sample = |i: usize, k: usize| {
        let (row, col) = (height - 1 - i / width, i % width);
        let at = 4 * (colours * (row * width + col) + k);
        let float = [rest[at], rest[at + 1], rest[at + 2], rest[at + 3]];
        // A negative scale says that the bytes are little-endian.
        f64::from(if scale < 0.0 {
            f32::from_le_bytes(float)
        } else {
            f32::from_be_bytes(float)
        })
    };
    let channels = Channels {
        colours,
        alpha: None,
    };
    let values = grey(Format::Pfm, (width, height), &channels, sample)?;
    Ok(StoredImage {
        height_scale: Some(scale.abs()),
        ..StoredImage::new(Format::Pfm, (width, height), values, "f32")
    })
}

fn size(word: &str) -> Result<usize> {
    word.parse().map_err(|_| {
        damaged(
            Format::Pfm,
            format!("its size is `{word}`, no whole number"),
        )
    })
}

//! Kinds of photo files, told by their first bytes, and what to do about those that are not read.

use crate::error::{Error, Result};
use crate::files::images::format::Format;

/// What to do about a photo that is not read.
const SAVE_AS_JPEG: &str = "save it as JPEG or PNG";

/// Tells the format of a photo's file by its first bytes.
///
/// # Errors
/// [`Error::Format`] for an empty file, [`Error::Unsupported`] for any other file, with its kind and what to do.
pub(super) fn photo_format(bytes: &[u8]) -> Result<Format> {
    if bytes.is_empty() {
        return Err(Error::Format {
            format: "a photo",
            reason: "the file is empty".into(),
        });
    }
    Format::of_photo(bytes).ok_or_else(|| unsupported(bytes))
}

/// The error for a file that is no photo that is read.
fn unsupported(bytes: &[u8]) -> Error {
    let brand = match bytes {
        [_, _, _, _, b'f', b't', b'y', b'p', brand @ ..] => brand.get(..4).unwrap_or_default(),
        _ => b"",
    };
    let (format, advice) = match (brand, bytes) {
        (b"avif" | b"avis", _) => ("AVIF", SAVE_AS_JPEG),
        (b"heic" | b"heix" | b"heim" | b"heis" | b"hevc" | b"hevx" | b"mif1" | b"msf1", _) => (
            "HEIC",
            "save it as JPEG (an iPhone shares photos as JPEG with Settings > Camera > Formats > Most Compatible)",
        ),
        (_, [b'%', b'P', b'D', b'F', ..]) => (
            "PDF",
            "save its page as a picture, for example by `pdftoppm -r 300 -jpeg file.pdf page`",
        ),
        (_, [b'\x89', b'P', b'N', b'G', ..]) => ("PNG", "it was damaged in transfer; copy it anew"),
        _ => ("this file", SAVE_AS_JPEG),
    };
    Error::Unsupported {
        format,
        reason: format!("photos are read from JPEG, PNG, WebP, GIF, BMP and TIFF files; {advice}"),
    }
}

//! Kinds of photo files, told by their first bytes, and what to do about those that are not read.

use crate::error::{Error, Result};
use crate::files::foreign::{SAVE_AS_JPEG, foreign};
use crate::files::images::format::Format;

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
    let (format, advice) = foreign(bytes).unwrap_or(("this file", SAVE_AS_JPEG));
    Error::Unsupported {
        format,
        reason: format!("photos are read from JPEG, PNG, WebP, GIF, BMP and TIFF files; {advice}"),
    }
}

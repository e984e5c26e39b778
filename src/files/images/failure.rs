//! Errors of decoders, for several formats.

use super::format::Format;
use crate::error::{Error, Result};

/// Checks that decoded data of a given number of bytes can come from a file of a given length, if the compression
/// shrinks data by a factor of at most `ratio`.
pub(super) fn check_length(format: Format, file: &[u8], needed: usize, ratio: usize) -> Result<()> {
    if needed / ratio <= file.len() {
        return Ok(());
    }
    Err(damaged(
        format,
        format!("{} bytes cannot hold that many pixels", file.len()),
    ))
}

pub(super) fn damaged(format: Format, reason: impl ToString) -> Error {
    Error::Format {
        format: format.title(),
        reason: reason.to_string(),
    }
}

pub(super) fn unsupported(format: Format, reason: impl ToString) -> Error {
    Error::Unsupported {
        format: format.title(),
        reason: reason.to_string(),
    }
}

//! Errors of readers and writers of files.

use crate::error::Error;

/// Advice to whoever has a damaged file.
#[cfg(any(feature = "formats", feature = "meshes"))]
const COPY_AGAIN: &str = "copy, download or export it again";

/// Makes the error for a file that is damaged or not of the format that it was read as, which [`in_format`] names. A reason
/// without advice, which stands behind a semicolon, gets some.
#[cfg(any(feature = "formats", feature = "meshes"))]
pub(super) fn damaged(reason: impl ToString) -> Error {
    /// Maximum number of characters that are kept of a decoder's error message: some messages quote the line, which may be
    /// the whole file.
    const MAX_MESSAGE_CHARACTERS: usize = 160;
    let said = reason.to_string();
    let words = said.split_whitespace();
    let mut reason = words.collect::<Vec<_>>().join(" ");
    if let Some((end, _)) = reason.char_indices().nth(MAX_MESSAGE_CHARACTERS) {
        reason.truncate(end);
        reason.push('…');
    }
    if !reason.contains(';') {
        reason = format!("{reason}; {COPY_AGAIN}");
    }
    Error::Format { format: "", reason }
}

/// Makes the error for a file that a decoder of another library cannot read. Its own words say more than where the file ends.
#[cfg(any(feature = "formats", feature = "meshes"))]
pub(super) fn undecodable(error: impl ToString) -> Error {
    /// Words of decoders about a file that ends too early.
    const CUT_SHORT: [&str; 10] = [
        "end of file",
        "unexpected end",
        "EOF",
        "EOCD",
        "fill whole buffer",
        "missing bytes",
        "completely read",
        "too short",
        "exceeds that of slice",
        "truncated",
    ];
    let said = error.to_string();
    if CUT_SHORT.iter().any(|words| said.contains(words)) {
        return damaged("it is cut short: it ends before all of it is there");
    }
    // What follows is no advice.
    let said = said.replace(';', ",");
    damaged(format!("a part of it cannot be read ({said})"))
}

/// Makes the error for a file with contents that are not read; [`in_format`] names its format.
#[cfg(any(feature = "formats", feature = "meshes"))]
pub(super) fn not_read(reason: impl ToString) -> Error {
    unsupported("", reason)
}

/// Returns a function that names the format in the errors of its reader, for `map_err`.
#[cfg(any(feature = "formats", feature = "meshes"))]
pub(super) fn in_format(name: impl Into<&'static str>) -> impl FnOnce(Error) -> Error {
    |mut error| {
        if let Error::Format { format, .. } | Error::Unsupported { format, .. } = &mut error {
            *format = name.into();
        }
        error
    }
}

/// Makes the error for a file with contents that are not read or written.
pub(super) fn unsupported(format: impl Into<&'static str>, reason: impl ToString) -> Error {
    Error::Unsupported {
        format: format.into(),
        reason: reason.to_string(),
    }
}

/// Maximum ratio of decoded data to the bytes of their file: more than the compression of any image format reaches.
#[cfg(feature = "formats")]
const MAX_COMPRESSION_RATIO: usize = 4096;

/// Checks that decoded data of a given number of bytes can come from a file of a given length.
#[cfg(feature = "formats")]
pub(super) fn check_length(file: &[u8], needed: usize) -> crate::Result<()> {
    if needed / MAX_COMPRESSION_RATIO <= file.len() {
        return Ok(());
    }
    let reason = format!("{} bytes cannot hold that many pixels", file.len());
    Err(damaged(reason))
}

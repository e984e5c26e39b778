//! Bytes by which formats are told.

/// Whether a file begins with given bytes, of which a `?` stands for any.
pub(super) fn begins(bytes: &[u8], magic: &[u8]) -> bool {
    bytes.len() >= magic.len() && magic.iter().zip(bytes).all(|(m, b)| *m == b'?' || m == b)
}

/// Whether a file has given bytes anywhere. Costs `O(bytes)`.
pub(super) fn contains(bytes: &[u8], part: &[u8]) -> bool {
    bytes.windows(part.len()).any(|there| there == part)
}

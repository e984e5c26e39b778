//! Pixels that a file stores as plain numbers, one after the other.

use crate::error::{Error, Result, checked_cells, try_filled};
use crate::files::failure::damaged;
use crate::files::number_type::NumberType;

/// Reads the numbers of an image's pixels, of which each has one; what follows them is left out.
///
/// # Errors
/// [`Error::Empty`] without pixels, [`Error::TooLarge`], [`Error::Format`] for too few bytes, [`Error::OutOfMemory`].
pub(super) fn raw_pixels(
    (width, height): (usize, usize),
    bytes: &[u8],
    number_type: NumberType,
    is_big_endian: bool,
) -> Result<Vec<f64>> {
    let what = "image";
    let count = checked_cells(what, height, width)?;
    if count == 0 {
        return Err(Error::Empty { what });
    }
    let size = number_type.bytes();
    let (needed, there) = (size * count, bytes.len());
    if there < needed {
        let reason = format!(
            "it is cut short: {width} × {height} numbers of type {} take {needed} bytes, {there} are there",
            number_type.name()
        );
        return Err(damaged(reason));
    }
    let mut values = try_filled(what, count, 0.0)?;
    for (value, number) in values.iter_mut().zip(bytes.chunks_exact(size)) {
        *value = number_type.value(number, is_big_endian);
    }
    Ok(values)
}

//! Turns stored pictures upright.

use crate::error::{Result, try_filled};

/// Orientation, by the TIFF format, of a picture whose rows are displayed as columns, and its columns as rows.
pub(super) const TRANSPOSED_ORIENTATION: u16 = 5;

/// Rotates or mirrors an image's values by its orientation number, so that the image is upright, and returns them with
/// the new width and height.
pub(super) fn oriented<T: Copy + Default>(
    values: Vec<T>,
    (width, height): (usize, usize),
    orientation: u16,
) -> Result<(Vec<T>, (usize, usize))> {
    if orientation == 1 {
        return Ok((values, (width, height)));
    }
    // In orientations from 5 on, stored rows are displayed as columns.
    let turned = orientation >= TRANSPOSED_ORIENTATION;
    let (cols, rows) = if turned {
        (height, width)
    } else {
        (width, height)
    };
    let mut seen = try_filled("turned image", values.len(), T::default())?;
    for (i, out) in seen.iter_mut().enumerate() {
        let (row, col) = (i / cols, i % cols);
        let (x, y) = (col, row);
        let (across, down) = (cols - 1 - col, rows - 1 - row);
        let (from_row, from_col) = match orientation {
            2 => (y, across),
            3 => (down, across),
            4 => (down, x),
            TRANSPOSED_ORIENTATION => (x, y),
            6 => (across, y),
            7 => (across, down),
            _ => (x, down),
        };
        *out = values[from_row * width + from_col];
    }
    Ok((seen, (cols, rows)))
}

//! Largest upright rectangle within a set of pixels.

use std::ops::Range;

use crate::error::{Result, try_filled};

/// Finds the rows and columns of the largest rectangle of an image whose pixels all satisfy `inside`; the first one of
/// several. Costs `O(width · height)`: for each row it finds the largest rectangle under a histogram, whose bars tell
/// how many pixels upwards are inside.
///
/// # Errors
/// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
pub(super) fn largest_rectangle(
    width: usize,
    height: usize,
    inside: impl Fn(usize) -> bool,
) -> Result<[Range<usize>; 2]> {
    let mut bars = try_filled("flat image", width, 0usize)?;
    let mut best = (0, [0..0, 0..0]);
    // Bars of growing height, each with the first column from which no bar is lower.
    let mut open: Vec<(usize, usize)> = Vec::new();
    for row in 0..height {
        for col in 0..=width {
            let bar = match bars.get_mut(col) {
                Some(bar) => {
                    *bar = if inside(row * width + col) {
                        *bar + 1
                    } else {
                        0
                    };
                    *bar
                }
                None => 0,
            };
            let mut start = col;
            while let Some((from, tall)) = open.pop_if(|(_, tall)| *tall >= bar) {
                start = from;
                let area = tall * (col - from);
                if area > best.0 {
                    best = (area, [row + 1 - tall..row + 1, from..col]);
                }
            }
            if bar > 0 {
                open.push((start, bar));
            }
        }
        open.clear();
    }
    Ok(best.1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_same_as_by_trying_all() {
        let (width, height) = (7, 6);
        let mut state = 12345u32;
        for _ in 0..200 {
            let shape: Vec<bool> = (0..width * height)
                .map(|_| {
                    state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                    state >> 30 != 0
                })
                .collect();
            let full = |rows: &Range<usize>, cols: &Range<usize>| {
                rows.clone()
                    .all(|r| cols.clone().all(|c| shape[r * width + c]))
            };
            let mut most = 0;
            for top in 0..height {
                for bottom in top + 1..=height {
                    for left in 0..width {
                        for right in left + 1..=width {
                            if full(&(top..bottom), &(left..right)) {
                                most = most.max((bottom - top) * (right - left));
                            }
                        }
                    }
                }
            }
            let [rows, cols] = largest_rectangle(width, height, |i| shape[i]).unwrap();
            assert!(full(&rows, &cols));
            assert_eq!(rows.len() * cols.len(), most);
        }
    }
}

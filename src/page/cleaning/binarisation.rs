//! Binarisation of flat pages: black ink on white paper.

use crate::error::{Result, check_photo, try_filled};

/// Radius of the window that a pixel is compared with, as a share of the page's longer side: the window is 7 mm on A4.
const WINDOW_RADIUS_SHARE: f64 = 0.012;

/// Minimum radius of the window, in pixels.
const MIN_WINDOW_RADIUS: usize = 4;

/// Sauvola's parameter k: how far below the window's mean the threshold is where the window has no contrast. 0.2 is the
/// usual value for print.
const CONTRAST_WEIGHT: f32 = 0.2;

/// Sauvola's parameter k where the light is even: paper has no grain there, so that print may be paler; a
/// trace of a sharp shadow's edge stays paper.
const EVEN_CONTRAST_WEIGHT: f32 = 0.16;

/// Standard deviation of a window of full contrast (Sauvola's parameter R), in steps of 8 bits.
const FULL_DEVIATION: f32 = 128.0;

/// Maximum luminance that is always ink where the light is even, so that large dark areas are not hollow.
const MAX_INK_LUMINANCE: u8 = 128;

/// Minimum luminance that is always paper where the light is even.
const MIN_PAPER_LUMINANCE: u8 = 235;

/// Replaces each luminance of a page (row by row from the top) by 0 for ink or 255 for paper. The threshold is
/// `m (1 + k (s / R − 1))`, with the mean `m` and the standard deviation `s` of the window around the pixel (Sauvola and
/// Pietikäinen, *Adaptive document image binarization*, 2000). With `even` light, black stays black and white stays
/// white whatever is around it. Costs `O(pixels)`, whatever the window.
///
/// # Errors
/// [`Error::Shape`](crate::Error::Shape) for a wrong number of pixels,
/// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
pub fn binarise(width: usize, height: usize, luminance: &mut [u8], even: bool) -> Result<()> {
    check_photo("flat page", height, width, luminance.len())?;
    if luminance.is_empty() {
        return Ok(());
    }
    let weight = match even {
        true => EVEN_CONTRAST_WEIGHT,
        false => CONTRAST_WEIGHT,
    };
    let share = WINDOW_RADIUS_SHARE * width.max(height) as f64;
    let radius = (share as usize).max(MIN_WINDOW_RADIUS);
    // The rows of the window that were overwritten already are kept as they were.
    let mut kept = try_filled("flat page", (radius + 1) * width, 0)?;
    let mut columns = try_filled("flat page", width, [0_u32; 2])?;
    let mut prefix = try_filled("flat page", width + 1, [0_u64; 2])?;
    let add = |columns: &mut [[u32; 2]], line: &[u8]| {
        for (sum, value) in columns.iter_mut().zip(line) {
            let value = u32::from(*value);
            sum[0] += value;
            sum[1] += value * value;
        }
    };
    for row in 0..radius.min(height) {
        add(&mut columns, &luminance[row * width..][..width]);
    }
    for row in 0..height {
        if let Some(line) = luminance.chunks_exact(width).nth(row + radius) {
            add(&mut columns, line);
        }
        if row > radius {
            let gone = &kept[(row - radius - 1) % (radius + 1) * width..][..width];
            for (sum, value) in columns.iter_mut().zip(gone) {
                let value = u32::from(*value);
                sum[0] -= value;
                sum[1] -= value * value;
            }
        }
        for (i, sum) in columns.iter().enumerate() {
            prefix[i + 1] = [0, 1].map(|k| prefix[i][k] + u64::from(sum[k]));
        }
        let rows = (row + radius + 1).min(height) - row.saturating_sub(radius);
        let line = &mut luminance[row * width..][..width];
        kept[row % (radius + 1) * width..][..width].copy_from_slice(line);
        for (col, value) in line.iter_mut().enumerate() {
            let (from, to) = (col.saturating_sub(radius), (col + radius + 1).min(width));
            let count = (rows * (to - from)) as f32;
            let [sum, squares] = [0, 1].map(|k| (prefix[to][k] - prefix[from][k]) as f32 / count);
            let deviation = (squares - sum * sum).max(0.0).sqrt();
            let threshold = sum * (1.0 + weight * (deviation / FULL_DEVIATION - 1.0));
            let ink = match *value {
                value if even && value <= MAX_INK_LUMINANCE => true,
                value if even && value >= MIN_PAPER_LUMINANCE => false,
                value => f32::from(value) < threshold,
            };
            *value = if ink { 0 } else { u8::MAX };
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A pseudo-random page of 90 by 70 pixels, and the result for it by sums over each window.
    #[test]
    fn running_sums_are_those_of_each_window() {
        let (width, height, radius) = (90, 70, MIN_WINDOW_RADIUS);
        let page: Vec<u8> = (0..width * height)
            .map(|i| ((i * 7919 + (i / 13) * 104_729) % 256) as u8)
            .collect();
        for even in [false, true] {
            let mut found = page.clone();
            binarise(width, height, &mut found, even).unwrap();
            for (i, value) in page.iter().enumerate() {
                let (x, y) = (i % width, i / width);
                let (mut count, mut sum, mut squares) = (0.0, 0.0, 0.0);
                for row in y.saturating_sub(radius)..(y + radius + 1).min(height) {
                    for col in x.saturating_sub(radius)..(x + radius + 1).min(width) {
                        let value = f64::from(page[row * width + col]);
                        count += 1.0;
                        sum += value;
                        squares += value * value;
                    }
                }
                let mean: f64 = sum / count;
                let deviation = (squares / count - mean * mean).max(0.0).sqrt();
                let k = if even { 0.16 } else { 0.2 };
                let off = f64::from(*value) - mean * (1.0 + k * (deviation / 128.0 - 1.0));
                let fixed = even && (*value <= 128 || *value >= 235);
                if off.abs() > 0.01 && !fixed {
                    assert_eq!(found[i] == 0, off < 0.0, "{x} {y}");
                }
                if fixed {
                    assert_eq!(found[i] == 0, *value <= 128, "{x} {y}");
                }
            }
        }
    }

    #[test]
    fn wrong_sizes_are_refused() {
        assert!(binarise(3, 3, &mut [0; 8], true).is_err());
    }
}

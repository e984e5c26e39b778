//! Binarisation of flat pages: black ink on white paper.

use crate::error::{Result, check_photo, try_filled};
use crate::page::outline::{closed_plane, square_extreme};

/// Radius of the square by which strokes are told from areas, as a share of the page's longer side: strokes are up to 3.5 mm wide
/// on A4.
const STROKE_RADIUS_SHARE: f64 = 0.006;

/// Minimum difference of luminance between a stroke and what is around it, of 255.
const MIN_STROKE_CONTRAST: f32 = 28.0;

/// Share of the way from what is around a stroke to the stroke's extreme at which the stroke begins: less than a half, as thin
/// strokes are paler than the thick ones beside them. Chosen by `benches/page.md`.
const STROKE_THRESHOLD_SHARE: f32 = 0.3;

/// Number of rows of a page that are binarised together, which bounds the memory.
const BAND_ROWS: usize = 512;

/// Replaces each luminance of a page (row by row from the top) by 0 for ink or 255 for paper.
///
/// A dark stroke is what the grey closing removes. It begins at a share of the way from the closing's luminance to the darkest
/// one nearby, so that pale and blurred print keep their width. Light strokes in dark areas are the same of the negative; what is
/// no stroke is ink where it is dark. Costs `O(pixels)`, whatever the width of strokes.
///
/// # Errors
/// [`Error::Shape`](crate::Error::Shape) for a wrong number of pixels,
/// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
pub fn binarise(width: usize, height: usize, luminance: &mut [u8]) -> Result<()> {
    check_photo("flat page", height, width, luminance.len())?;
    if luminance.is_empty() {
        return Ok(());
    }
    // The darkest pixel within half the radius is a stroke's own.
    let [stroke, letter] = [1.0, 0.5].map(|part| {
        let radius = part * STROKE_RADIUS_SHARE * width.max(height) as f64;
        (radius as usize).max(1)
    });
    let mut found = try_filled("flat page", luminance.len(), 0)?;
    for start in (0..height).step_by(BAND_ROWS) {
        let end = (start + BAND_ROWS).min(height);
        // A closing depends on pixels up to twice its radius away.
        let from = start.saturating_sub(2 * stroke);
        let band = &luminance[from * width..(end + 2 * stroke).min(height) * width];
        let closed = closed_plane(band, width, stroke, u8::max, u8::min);
        let opened = closed_plane(band, width, stroke, u8::min, u8::max);
        let darkest = square_extreme(band, width, letter, u8::min);
        let lightest = square_extreme(band, width, letter, u8::max);
        for i in (start - from) * width..(end - from) * width {
            let [value, paper, ground, dark, light] =
                [band[i], closed[i], opened[i], darkest[i], lightest[i]].map(f32::from);
            let is_dark_area = band[i] <= u8::MAX / 2;
            let is_ink = is_stroke(paper - value, paper - dark)
                || (is_dark_area && !is_light_stroke(value - ground, light - ground));
            found[from * width + i] = if is_ink { 0 } else { u8::MAX };
        }
    }
    luminance.copy_from_slice(&found);
    Ok(())
}

/// Whether a pixel is a dark stroke: `contrast` is its difference from the paper, `largest` that of the darkest pixel nearby.
fn is_stroke(contrast: f32, largest: f32) -> bool {
    contrast > MIN_STROKE_CONTRAST && contrast > STROKE_THRESHOLD_SHARE * largest
}

/// Whether a pixel is a light stroke on a dark ground; the border of the two is where [`is_stroke`] has it.
fn is_light_stroke(contrast: f32, largest: f32) -> bool {
    contrast > MIN_STROKE_CONTRAST && contrast > (1.0 - STROKE_THRESHOLD_SHARE) * largest
}

#[cfg(test)]
mod tests {
    use super::*;
    use oorandom::Rand64;

    /// Thin, pale and blurred strokes keep their width, light ones in a bar are read, and a tinted area is paper up to its border.
    #[test]
    fn strokes_keep_their_width_and_areas_their_kind() {
        let (width, height): (usize, usize) = (400, 1100);
        let mut random = Rand64::new(8);
        let truth = |x: usize, y: usize| -> (f64, bool) {
            let is_stroke = x % 16 < 3 && (20..380).contains(&x);
            match y {
                100..120 if is_stroke => (30.0, true),
                200..220 if is_stroke => (205.0, true),
                300..360 if is_stroke && (320..340).contains(&y) => (130.0, false),
                300..360 => (40.0, true),
                500..600 if (50..300).contains(&x) => (205.0, false),
                _ => (252.0, false),
            }
        };
        let mut page: Vec<u8> = (0..width * height)
            .map(|i| {
                let (x, y) = (i % width, i / width);
                let at = |dx: isize| truth(x.saturating_add_signed(dx).min(width - 1), y).0;
                let blurred = 0.25 * at(-1) + 0.5 * at(0) + 0.25 * at(1);
                (blurred + 4.0 * (random.rand_float() - 0.5)).round() as u8
            })
            .collect();
        binarise(width, height, &mut page).unwrap();
        let wrong = |rows: std::ops::Range<usize>| {
            let pixels = rows.len() * width;
            let wrong = (rows.start * width..rows.end * width)
                .filter(|i| (page[*i] == 0) != truth(i % width, i / width).1)
                .count();
            wrong as f64 / pixels as f64
        };
        for rows in [100..120, 200..220, 302..358, 480..620, 700..1100] {
            let share = wrong(rows.clone());
            assert!(share < 0.02, "{rows:?}: {share}");
        }
    }

    #[test]
    fn wrong_sizes_are_refused() {
        assert!(binarise(3, 3, &mut [0; 8]).is_err());
    }
}

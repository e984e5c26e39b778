//! What is printed on the page: a grid, and text.

use font8x8::UnicodeFonts;

use crate::page::HEIGHT;

/// Pixels of the page's own image across, and down.
pub const ACROSS: usize = 800;
pub const DOWN: usize = (ACROSS as f64 * HEIGHT) as usize;

/// Lines of the grid are so far apart, and so wide.
pub const GRID: f64 = 0.1;
const LINE: f64 = 0.004;

/// Height of a line of text and width of a letter.
const ROW: f64 = 0.028;
const LETTER: f64 = 0.014;

const TEXT: &str = "A developable surface can be unrolled onto the plane without any stretch. \
    Paper, card and sheet metal bend like that: straight lines run through every point. ";

/// Grey at a point of the page, 0 is ink; paper beyond it is darker, as a table.
fn grey(u: f64, v: f64) -> f64 {
    if !(0.0..=1.0).contains(&u) || !(0.0..=HEIGHT).contains(&v) {
        return 0.6;
    }
    let on_line = |t: f64| (t - (t / GRID).round() * GRID).abs() < 0.5 * LINE;
    if on_line(u) || on_line(v) {
        return 0.35;
    }
    let (row, col) = (((HEIGHT - v) / ROW) as usize, (u / LETTER) as usize);
    let letters = TEXT.as_bytes();
    let letter = letters[(row * 37 + col) % letters.len()] as char;
    let glyph = font8x8::BASIC_FONTS.get(letter).unwrap_or_default();
    let (x, y) = (
        8.0 * (u / LETTER).fract(),
        8.0 * ((HEIGHT - v) / ROW).fract(),
    );
    // A quarter of each row is space between the lines.
    let inked = y < 8.0 && glyph[(y * 1.3) as usize % 8] >> (x as usize) & 1 == 1 && y * 1.3 < 8.0;
    if inked { 0.05 } else { 0.95 }
}

/// RGBA of an image of which each pixel shows the mean of what is printed there, if it is anything.
pub fn image(width: usize, height: usize, point: impl Fn(f64, f64) -> [f64; 2]) -> Vec<u8> {
    const SAMPLES: usize = 3;
    let mut rgba = Vec::with_capacity(4 * width * height);
    for row in 0..height {
        for col in 0..width {
            let mut sum = 0.0;
            for sample in 0..SAMPLES * SAMPLES {
                let inside = |i: usize| (i as f64 + 0.5) / SAMPLES as f64;
                let [u, v] = point(
                    col as f64 + inside(sample % SAMPLES),
                    row as f64 + inside(sample / SAMPLES),
                );
                sum += grey(u, v);
            }
            let grey = (255.0 * sum / (SAMPLES * SAMPLES) as f64).round() as u8;
            rgba.extend([grey, grey, grey, 255]);
        }
    }
    rgba
}

/// The page's own image, from one that shows it elsewhere: `pixel` tells where, from its upper left
/// corner. Bilinear; what is transparent or beyond the image is white.
pub fn resampled(
    rgba: &[u8],
    [width, height]: [usize; 2],
    pixel: impl Fn([f64; 2]) -> [f64; 2],
) -> Vec<u8> {
    let grey = |x: isize, y: isize| {
        let inside = x >= 0 && y >= 0 && x < width as isize && y < height as isize;
        let at = 4 * (y * width as isize + x) as usize;
        if inside && rgba[at + 3] > 0 {
            f64::from(rgba[at])
        } else {
            255.0
        }
    };
    let mut out = Vec::with_capacity(4 * ACROSS * DOWN);
    for row in 0..DOWN {
        for col in 0..ACROSS {
            let [x, y] = pixel(point_of(col as f64 + 0.5, row as f64 + 0.5)).map(|t| t - 0.5);
            let (left, top) = (x.floor(), y.floor());
            let (s, t) = (x - left, y - top);
            let (i, j) = (left as isize, top as isize);
            let upper = (1.0 - s) * grey(i, j) + s * grey(i + 1, j);
            let lower = (1.0 - s) * grey(i, j + 1) + s * grey(i + 1, j + 1);
            let mean = ((1.0 - t) * upper + t * lower).round() as u8;
            out.extend([mean, mean, mean, 255]);
        }
    }
    out
}

/// The point of the page at a place of its image.
pub fn point_of(x: f64, y: f64) -> [f64; 2] {
    [x / ACROSS as f64, HEIGHT - y / ACROSS as f64]
}

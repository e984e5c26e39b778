//! Orientation of a page by its print: lines of text run from left to right, and the upper half has more print.

use super::planes::Planes;
use crate::dewarp::bilinear;
use crate::math::planar::distance;

/// Number of samples along the longer side of a page when the orientation of its print is determined.
const SAMPLES_ALONG_LONGER_SIDE: usize = 320;

/// Width of the strips in which rows of print are detected, in samples: narrow enough that lines may be bent.
const STRIP_SAMPLES: usize = SAMPLES_ALONG_LONGER_SIDE / 10;

/// Minimum ratio of the contrast energies across and along the lines for the print to have a direction.
/// Its row: `benches/page.md`, One rule at a time.
const MIN_ENERGY_RATIO: f64 = 1.6;

/// Minimum mean darkness of the print, in logarithmic colour, for a page to have an orientation.
const MIN_MEAN_PRINT: f64 = 0.003;

/// Contrast energy of print in one direction: the sum, over parallel strips of the image, of squared differences between
/// neighbouring values of the strip's profile, which is `length` long; all strips together are `across` wide. `print`
/// gives the print by its place along the profile and across it.
fn profile_energy(length: usize, across: usize, print: impl Fn(usize, usize) -> f32) -> f64 {
    let mut energy = 0.0;
    for start in (0..across).step_by(STRIP_SAMPLES) {
        let strip = start..(start + STRIP_SAMPLES).min(across);
        let profile: Vec<f32> = (0..length)
            .map(|i| strip.clone().map(|k| print(i, k)).sum())
            .collect();
        energy += (profile.windows(2))
            .map(|pair| f64::from(pair[1] - pair[0]).powi(2))
            .sum::<f64>();
    }
    energy
}

/// Number of corners by which the list of corners has to be rotated to begin with the upper left one of the page as it
/// is read; 0 if the print does not tell. The corners are clockwise, in pixels of the reduced photo `raw`; `clean` is
/// the same without print.
pub(super) fn quarter_turns(raw: &Planes, clean: &Planes, corners: &[[f64; 2]; 4]) -> usize {
    let [a, b, c, d] = corners;
    // Samples are about square on the page: a squeezed page would have more contrast along its lines.
    let sides = [
        distance(*a, *b) + distance(*c, *d),
        distance(*b, *c) + distance(*d, *a),
    ];
    let longer = sides[0].max(sides[1]).max(1e-9);
    let [width, height] = sides.map(|side| {
        let samples = SAMPLES_ALONG_LONGER_SIDE as f64 * side / longer;
        (samples.round() as usize).max(1)
    });
    let share = |i: usize, n: usize| (i as f64 + 0.5) / n as f64;
    let mut print = vec![0.0_f32; width * height];
    let (mut total, mut right) = (0.0, 0.0);
    for (i, value) in print.iter_mut().enumerate() {
        let (u, v) = (share(i % width, width), share(i / width, height));
        let [x, y] = bilinear([u, v], [2, 2], |i| *[a, b, d, c][i]).unwrap_or(*a);
        let pixel = |at: f64, size: usize| at.round().clamp(0.0, size as f64 - 1.0) as usize;
        let place = pixel(y, raw.height) * raw.width + pixel(x, raw.width);
        *value = clean.channels[1][place] - raw.channels[1][place];
        total += f64::from(*value);
        right += f64::from(*value) * u;
    }
    if total < MIN_MEAN_PRINT * print.len() as f64 {
        return 0;
    }
    let rows = profile_energy(height, width, |row, col| print[row * width + col]);
    let cols = profile_energy(width, height, |col, row| print[row * width + col]);
    if cols < MIN_ENERGY_RATIO * rows {
        return 0;
    }
    // Lines run down in the photo: the page's top is where there is more print, at the right or at the left.
    if right > 0.5 * total { 1 } else { 3 }
}

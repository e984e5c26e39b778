//! Orientation of a page by its print: lines of text run from left to right, and the upper half has more print.

use super::planes::Planes;

/// Number of samples along each side of a page when the orientation of its print is determined.
const SAMPLES_PER_SIDE: usize = 320;

/// Number of strips into which the page's width is divided when rows of print are detected, so that lines may be bent.
const PRINT_STRIPS: usize = 10;

/// Share of the page's side at each edge that is left out when the orientation is determined, because of shadows.
const MARGIN_SHARE: f64 = 0.05;

/// Minimum ratio of the contrast energies across and along the lines for the print to have a direction.
const MIN_ENERGY_RATIO: f64 = 1.6;

/// Minimum mean darkness of the print, in logarithmic colour, for a page to have an orientation.
const MIN_MEAN_PRINT: f64 = 0.003;

/// Contrast energy of print in one direction: the sum, over parallel strips of the image `print`, of squared
/// differences between neighbouring values of the strip's profile. `at` gives the index of a sample in `print` by its
/// place along the profile and across it.
fn profile_energy(print: &[f32], at: impl Fn(usize, usize) -> usize) -> f64 {
    let width = SAMPLES_PER_SIDE / PRINT_STRIPS;
    let mut energy = 0.0;
    for strip in 0..PRINT_STRIPS {
        let mut before = None;
        for row in 0..SAMPLES_PER_SIDE {
            let sum: f32 = (0..width).map(|k| print[at(row, strip * width + k)]).sum();
            if let Some(last) = before {
                energy += f64::from(sum - last).powi(2);
            }
            before = Some(sum);
        }
    }
    energy
}

/// Number of corners by which the list of corners has to be rotated to begin with the upper left one of the page as it
/// is read; 0 if the print does not tell. The corners are clockwise, in pixels of the reduced photo `raw`; `clean` is
/// the same without print.
pub(super) fn quarter_turns(raw: &Planes, clean: &Planes, corners: &[[f64; 2]; 4]) -> usize {
    let [a, b, c, d] = corners;
    let share = |i: usize| {
        MARGIN_SHARE + (1.0 - 2.0 * MARGIN_SHARE) * (i as f64 + 0.5) / SAMPLES_PER_SIDE as f64
    };
    let mut print = vec![0.0_f32; SAMPLES_PER_SIDE * SAMPLES_PER_SIDE];
    let (mut total, mut right) = (0.0, 0.0);
    for (i, value) in print.iter_mut().enumerate() {
        let (u, v) = (share(i % SAMPLES_PER_SIDE), share(i / SAMPLES_PER_SIDE));
        let [x, y] = [0, 1]
            .map(|k| (1.0 - v) * ((1.0 - u) * a[k] + u * b[k]) + v * ((1.0 - u) * d[k] + u * c[k]));
        let pixel = |at: f64, size: usize| at.round().clamp(0.0, size as f64 - 1.0) as usize;
        let place = pixel(y, raw.height) * raw.width + pixel(x, raw.width);
        *value = clean.channels[1][place] - raw.channels[1][place];
        total += f64::from(*value);
        right += f64::from(*value) * u;
    }
    if total < MIN_MEAN_PRINT * print.len() as f64 {
        return 0;
    }
    let rows = profile_energy(&print, |row, col| row * SAMPLES_PER_SIDE + col);
    let cols = profile_energy(&print, |row, col| col * SAMPLES_PER_SIDE + row);
    if cols < MIN_ENERGY_RATIO * rows {
        return 0;
    }
    // Lines run down in the photo: the page's top is where there is more print, at the right or at the left.
    if right > 0.5 * total { 1 } else { 3 }
}

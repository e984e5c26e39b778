//! Offsets of whole rows or columns of an image, as line sensors and interlaced ones have.
//!
//! The difference of a row to the mean of the rows beside it has a part that is common to the whole row. An offset is
//! in the left half and in the right half alike and alternates from row to row, while bends of a shape change slowly
//! from row to row, and noise differs from half to half.

use std::f64::consts::PI;

use super::heightfield::HeightImage;
use crate::error::Result;
use crate::math::statistics::median;

/// Minimum logarithm of the likelihood ratio of two halves with common offsets to independent ones
/// (`benches/scenes.md`, One constant at a time).
const MIN_LOG_LIKELIHOOD_RATIO: f64 = 8.0;

/// Length, in rows, of the windows over which the shape's part of the rows' differences is measured.
const SMOOTH_WINDOW: usize = 32;

/// Minimum ratio of the shape's spectral density to the offsets' variance: parts of the offsets that change more slowly are
/// not told from a shape, and have no least-squares solution without it.
const MIN_SHAPE_RATIO: f64 = 1e-6;

impl HeightImage {
    /// Returns the image without offsets of its rows, then without those of its columns; `None` if it has none.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub(super) fn without_line_offsets(&self) -> Result<Option<HeightImage>> {
        let [width, height] = [self.width(), self.height()];
        let rows = line_offsets(height, width, |row, col| self.values()[row * width + col]);
        let columns = line_offsets(width, height, |col, row| self.values()[row * width + col]);
        if rows.is_none() && columns.is_none() {
            return Ok(None);
        }
        let offset =
            |offsets: &Option<Vec<f64>>, line: usize| offsets.as_ref().map_or(0.0, |all| all[line]);
        let values = (0..width * height).map(|pixel| {
            let [row, col] = [pixel / width, pixel % width];
            self.values()[pixel] - offset(&rows, row) - offset(&columns, col)
        });
        let image = self.with_values(values.collect())?;
        Ok(Some(
            image.with_offset_lines([rows.is_some(), columns.is_some()]),
        ))
    }
}

/// Estimates the offset of each of `count` lines of some length; `None` where lines have no offsets of their own.
fn line_offsets(
    count: usize,
    length: usize,
    height: impl Fn(usize, usize) -> f64,
) -> Option<Vec<f64>> {
    let differences = |line: usize, half: usize| {
        let places = half * length / 2..(half + 1) * length / 2;
        let difference =
            |at: usize| height(line, at) - 0.5 * (height(line - 1, at) + height(line + 1, at));
        let mut known: Vec<f64> = places.map(difference).filter(|d| d.is_finite()).collect();
        median(&mut known)
    };
    let halves: Option<Vec<[f64; 2]>> = (1..count.checked_sub(1)?)
        .map(|line| Some([differences(line, 0)?, differences(line, 1)?]))
        .collect();
    let mut halves = halves?;
    clip(&mut halves)?;
    let sum =
        |term: &dyn Fn(usize) -> f64, from: usize| (from..halves.len()).map(term).sum::<f64>();
    let [left, right] = [0, 1].map(|half| sum(&|i| halves[i][half].powi(2), 0));
    let correlation = sum(&|i| halves[i][0] * halves[i][1], 0) / (left * right).sqrt();
    let common: Vec<f64> = halves.iter().map(|[a, b]| 0.5 * (a + b)).collect();
    let alternation = sum(&|i| common[i] * common[i - 1], 1) / sum(&|i| common[i].powi(2), 0);
    let log_ratio = -0.5 * halves.len() as f64 * (1.0 - correlation * correlation).max(1e-12).ln();
    // Differences of independent offsets have an autocorrelation of −2/3, those of a shape that bends about 1.
    let has_offsets =
        correlation > 0.0 && log_ratio > MIN_LOG_LIKELIHOOD_RATIO && alternation < 0.0;
    if !has_offsets {
        return None;
    }
    Some(wiener(&common))
}

/// Limits the values of both halves to three times the usual size, so that a crease along a row tells little; `None` if
/// most are 0.
fn clip(halves: &mut [[f64; 2]]) -> Option<()> {
    let mut sizes: Vec<f64> = halves.iter().flatten().map(|value| value.abs()).collect();
    let most = 4.5 * median(&mut sizes)?;
    halves
        .iter_mut()
        .flatten()
        .for_each(|value| *value = value.clamp(-most, most));
    (most > 0.0).then_some(())
}

/// Estimates offsets from the differences of each to the mean of its two neighbours, which the first and the last line do
/// not have: a Wiener filter. Where differences are small beside the part that the shape has, which varies slowly from row to
/// row, offsets stay 0. Linear cost.
///
/// The difference of offsets is `G o`, where `G` takes the mean of the neighbours away. With offsets of variance `S` beside a
/// shape of spectral density `N`, the best estimate minimises `‖G o − differences‖² / N + ‖o‖² / S`.
fn wiener(differences: &[f64]) -> Vec<f64> {
    let shape = smooth_density(differences);
    let steps = differences
        .windows(2)
        .map(|pair| (pair[1] - pair[0]).powi(2));
    let step = steps.sum::<f64>() / (differences.len() - 1) as f64;
    // Differences of neighbouring differences have 5 times the variance of offsets, and twice that of a shape.
    let size = (step - 2.0 * shape) / 5.0;
    if size.is_nan() || size <= 0.0 {
        return vec![0.0; differences.len() + 2];
    }
    least_offsets(differences, (shape / size).max(MIN_SHAPE_RATIO))
}

/// Spectral density of a sequence at wavelengths above [`SMOOTH_WINDOW`]: the mean square of its sums under Hann windows that
/// overlap by half. Beyond its ends the sequence is mirrored.
fn smooth_density(values: &[f64]) -> f64 {
    let window = |i: usize| 1.0 - (2.0 * PI * (i as f64 + 0.5) / SMOOTH_WINDOW as f64).cos();
    let norm: f64 = (0..SMOOTH_WINDOW).map(|i| window(i).powi(2)).sum();
    let mirrored = |i: usize| {
        let i = i % (2 * values.len());
        values[i.min(2 * values.len() - 1 - i)]
    };
    let half = SMOOTH_WINDOW / 2;
    let middles = (0..values.len() + half).step_by(half);
    let sums = middles.clone().map(|middle| {
        let first = middle + 2 * half * values.len() - half;
        let terms = (0..SMOOTH_WINDOW).map(|i| window(i) * mirrored(first + i));
        terms.sum::<f64>().powi(2) / norm
    });
    sums.sum::<f64>() / middles.count() as f64
}

/// Finds the offsets `o` that minimise `‖G o − differences‖² + ridge ‖o‖²`: a banded factorisation `L D Lᵀ` of the normal
/// equations, whose two lower diagonals are kept. There are two more offsets than differences.
fn least_offsets(differences: &[f64], ridge: f64) -> Vec<f64> {
    const ROW: [f64; 3] = [-0.5, 1.0, -0.5];
    let count = differences.len() + 2;
    let (mut bands, mut right) = (vec![[ridge, 0.0, 0.0]; count], vec![0.0; count]);
    for (first, difference) in differences.iter().enumerate() {
        for (i, a) in ROW.iter().enumerate() {
            right[first + i] += a * difference;
            for (j, b) in ROW[i..].iter().enumerate() {
                bands[first + i][j] += a * b;
            }
        }
    }
    let (mut pivots, mut x) = (vec![0.0; count], right);
    let mut lower: Vec<[f64; 2]> = vec![[0.0; 2]; count];
    for i in 0..count {
        let [mut pivot, mut next, after] = bands[i];
        if i >= 1 {
            pivot -= lower[i - 1][0].powi(2) * pivots[i - 1];
            next -= lower[i - 1][0] * lower[i - 1][1] * pivots[i - 1];
            x[i] -= lower[i - 1][0] * x[i - 1];
        }
        if i >= 2 {
            pivot -= lower[i - 2][1].powi(2) * pivots[i - 2];
            x[i] -= lower[i - 2][1] * x[i - 2];
        }
        (pivots[i], lower[i]) = (pivot, [next / pivot, after / pivot]);
    }
    for i in (0..count).rev() {
        x[i] /= pivots[i];
        for (step, factor) in lower[i].iter().enumerate() {
            x[i] -= factor * x.get(i + 1 + step).copied().unwrap_or(0.0);
        }
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;

    fn image(height: impl Fn(f64, f64) -> f64) -> HeightImage {
        let values = (0..64 * 48).map(|i| height((i % 64) as f64, (i / 64) as f64));
        HeightImage::new(64, 48, values.collect()).unwrap()
    }

    fn off(a: &HeightImage, b: &HeightImage) -> f64 {
        let pairs = a.values().iter().zip(b.values());
        let squares = pairs.map(|(a, b)| (a - b).powi(2)).sum::<f64>();
        (squares / a.values().len() as f64).sqrt()
    }

    /// Offsets of few lines and of many come out of their differences, but for a linear function, in linear time.
    #[test]
    fn offsets_solve_their_equations() {
        for count in [3, 4, 7, 200_000] {
            let mut random = oorandom::Rand64::new(6);
            let offsets: Vec<f64> = (0..count).map(|_| random.rand_float() - 0.5).collect();
            let difference = |o: &[f64]| o[1] - 0.5 * (o[0] + o[2]);
            let wanted: Vec<f64> = offsets.windows(3).map(difference).collect();
            let found = least_offsets(&wanted, 1e-9);
            for (found, wanted) in found.windows(3).map(difference).zip(&wanted) {
                assert!((found - wanted).abs() < 1e-3, "{count} {found} {wanted}");
            }
        }
    }

    fn fold(x: f64, y: f64) -> f64 {
        0.2 * (x + 0.5 * y - 30.0).abs() + 0.002 * y * y
    }

    /// Offsets of rows, of columns, and of every other row go; the fold stays.
    #[test]
    fn offsets_of_rows_and_columns_are_removed() {
        let draw = |line: f64, seed: u128| {
            2.0 * oorandom::Rand64::new(line as u128 * 7 + seed).rand_float() - 1.0
        };
        let truth = image(fold);
        let rows = image(|x, y| fold(x, y) + draw(y, 3));
        let columns = image(|x, y| fold(x, y) + draw(x, 4));
        let interlaced = image(|x, y| fold(x, y) + 0.5 * (y % 2.0) - 0.25);
        for spoilt in [rows, columns, interlaced] {
            let found = spoilt.without_line_offsets().unwrap().unwrap();
            let [before, after] = [&spoilt, &found].map(|image| off(image, &truth));
            assert!(after < 0.6 * before, "{before} {after}");
        }
    }

    #[test]
    fn shapes_and_noise_have_no_offsets() {
        let random = std::cell::RefCell::new(oorandom::Rand64::new(5));
        for image in [
            image(fold),
            image(|_, y| (0.9 * y).sin()),
            image(|_, y| (y / 4.0).floor()),
            image(|_, y| (y - 20.0).abs()),
            image(|x, y| fold(x, y) + random.borrow_mut().rand_float()),
        ] {
            assert!(image.without_line_offsets().unwrap().is_none());
        }
    }
}

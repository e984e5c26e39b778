//! Offsets of whole rows or columns of an image, as line sensors and interlaced ones have.
//!
//! The difference of a row to the mean of the rows beside it has a part that is common to the whole row. An offset is
//! in the left half and in the right half alike and alternates from row to row, while bends of a shape change slowly
//! from row to row, and noise differs from half to half.

use std::f64::consts::PI;

use super::heightfield::HeightImage;
use crate::error::Result;
use crate::math::statistics::median;

/// Minimum logarithm of the likelihood ratio of two halves with common offsets to independent ones.
const MIN_LOG_LIKELIHOOD_RATIO: f64 = 8.0;

/// Maximum autocorrelation of the differences of neighbouring rows: offsets that are independent from row to row have
/// −2/3, a shape that bends has about 1.
const MAX_ROW_AUTOCORRELATION: f64 = -0.3;

/// Minimum number of differences in each half of a row.
const MIN_HALF_ROW_PIXELS: usize = 8;

/// Share of the lowest frequencies that the shape's part of the rows' differences is measured from.
const SHAPE_FREQUENCY_SHARE: f64 = 1.0 / 16.0;

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
        let image = HeightImage::new(width, height, values.collect())?;
        Ok(Some(image.with_pixel_size(self.pixel_size())?))
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
        (known.len() >= MIN_HALF_ROW_PIXELS)
            .then(|| median(&mut known))
            .flatten()
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
    let has_offsets = correlation > 0.0
        && log_ratio > MIN_LOG_LIKELIHOOD_RATIO
        && alternation < MAX_ROW_AUTOCORRELATION;
    if !has_offsets {
        return None;
    }
    let mut offsets = wiener(&common);
    let ends = [[0, 1, 2], [count - 1, count - 2, count - 3]];
    offsets.insert(0, 0.0);
    offsets.push(0.0);
    for [end, next, after] in ends {
        let off = |line: usize, at: usize| height(line, at) - offsets[line];
        let outside = |at: usize| height(end, at) - 2.0 * off(next, at) + off(after, at);
        let mut known: Vec<f64> = (0..length).map(outside).filter(|d| d.is_finite()).collect();
        offsets[end] = median(&mut known)?;
    }
    Some(offsets)
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

/// Estimates offsets from the differences of each to the mean of its two neighbours: a Wiener filter on the cosine
/// transform. Where these are small beside the part that the shape has, which the lowest frequencies show, offsets stay 0.
fn wiener(differences: &[f64]) -> Vec<f64> {
    let count = differences.len();
    let wave = |k: usize, i: usize| {
        let scale = if k == 0 { 1.0 } else { 2.0 } / count as f64;
        scale.sqrt() * (PI * (2 * i + 1) as f64 * k as f64 / (2 * count) as f64).cos()
    };
    let gain = |k: usize| 1.0 - (PI * k as f64 / count as f64).cos();
    let coefficients: Vec<f64> = (0..count)
        .map(|k| (0..count).map(|i| wave(k, i) * differences[i]).sum())
        .collect();
    let low = ((SHAPE_FREQUENCY_SHARE * count as f64).ceil() as usize).clamp(1, count);
    let mean = |values: &mut dyn Iterator<Item = f64>, n: usize| values.sum::<f64>() / n as f64;
    let shape = mean(&mut coefficients[..low].iter().map(|c| c * c), low);
    let size = mean(
        &mut (count / 2..count)
            .map(|k| (coefficients[k].powi(2) - shape).max(0.0) / gain(k).powi(2)),
        count - count / 2,
    );
    let filtered: Vec<f64> = (0..count)
        .map(|k| {
            coefficients[k] * gain(k) * size
                / (gain(k).powi(2) * size + shape).max(f64::MIN_POSITIVE)
        })
        .collect();
    (0..count)
        .map(|i| (0..count).map(|k| wave(k, i) * filtered[k]).sum())
        .collect()
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

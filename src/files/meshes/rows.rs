//! Rows of numbers in text.

use crate::error::Result;
use crate::files::failure::damaged;

/// Parses the words of a row as numbers; errors name the row.
pub(super) fn numbers<'a>(row: usize, words: impl Iterator<Item = &'a str>) -> Result<Vec<f64>> {
    let number = |word: &'a str| {
        let reason = || format!("line {row} has {word:?} where a number should stand");
        word.parse().map_err(|_| damaged(reason()))
    };
    words.map(number).collect()
}

/// Parses a point and the numbers after it in its row.
pub(super) fn point<'a>(
    row: usize,
    words: impl Iterator<Item = &'a str>,
) -> Result<([f64; 3], Vec<f64>)> {
    let mut numbers = numbers(row, words)?;
    let point = (numbers.first_chunk().copied())
        .ok_or_else(|| damaged(format!("line {row} has too few coordinates")))?;
    numbers.drain(..point.len());
    Ok((point, numbers))
}

/// Converts a number to the whole number that it must be.
pub(super) fn whole(value: f64) -> Result<u32> {
    if value.fract() == 0.0 && (0.0..=f64::from(u32::MAX)).contains(&value) {
        return Ok(value as u32);
    }
    Err(damaged(format!(
        "{value} is no number of a vertex and no length of a list"
    )))
}

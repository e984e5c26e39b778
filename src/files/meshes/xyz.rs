//! Reads point clouds in text (XYZ): x, y, z in each line, and perhaps more.

use super::builder::MeshBuilder;
use crate::error::Result;
use crate::files::failure::damaged;
use crate::files::table::Table;
use crate::files::text::decoded;

/// Largest value of a colour of 8 bits.
const WHITE_LEVEL: f64 = 255.0;

pub(super) fn read(bytes: &[u8], parts: &mut MeshBuilder) -> Result<()> {
    let table = Table::read(&decoded(bytes))?;
    if table.cols < 3 {
        return Err(damaged(format!(
            "its lines have {} numbers, where x, y and z are three",
            table.cols
        )));
    }
    let lines = || table.values.chunks_exact(table.cols);
    let is_level = |value: &f64| value.fract() == 0.0 && (0.0..=WHITE_LEVEL).contains(value);
    let are_colours = |start: &usize| {
        (3..=table.cols.saturating_sub(3)).contains(start)
            && lines().all(|line| line[*start..start + 3].iter().all(is_level))
            && lines().any(|line| line[*start..start + 3].iter().any(|level| *level > 1.0))
    };
    // An intensity may stand before the colour, or a normal, and a normal behind it.
    let colours = [table.cols - 3, 3].into_iter().find(are_colours);
    for line in lines() {
        parts.position([line[0], line[1], line[2]])?;
        if let Some(start) = colours {
            let level = |k: usize| (line[start + k] / WHITE_LEVEL) as f32;
            parts.colors.push([0, 1, 2].map(level));
        }
    }
    Ok(())
}

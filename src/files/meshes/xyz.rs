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
        return Err(damaged(
            "XYZ",
            format!(
                "its lines have {} numbers, where x, y and z are three",
                table.cols
            ),
        ));
    }
    let lines = || table.values.chunks_exact(table.cols);
    let is_level = |value: &f64| value.fract() == 0.0 && (0.0..=WHITE_LEVEL).contains(value);
    let has_colours =
        table.cols >= 6 && lines().all(|line| line[table.cols - 3..].iter().all(is_level));
    for line in lines() {
        parts.position([line[0], line[1], line[2]])?;
        if has_colours && let Some(levels) = line.last_chunk::<3>() {
            parts
                .colors
                .push(levels.map(|level| (level / WHITE_LEVEL) as f32));
        }
    }
    Ok(())
}

//! Levelling of rows and columns by what a surface leaves of the heights along them.
//!
//! The pixels of an image show by themselves that its lines are offset, but of these offsets only the part that changes from line
//! to line ([`HeightImage::repaired`](crate::HeightImage::repaired)). The rest looks like a shape that is alike all along a line. A surface
//! of low energy follows it less than it follows shapes, and leaves some of it behind, each time that it is solved for.

use super::residual::residuals;
use crate::error::Result;
use crate::fit::input::Input;
use crate::heights::heightfield::Heightfield;
use crate::lattice::domain::Domain;
use crate::math::statistics::median;

/// Returns an input without the medians of what a surface leaves along each row, and along each column, where the lines of its image
/// are offset.
///
/// # Errors
/// Out of memory.
pub(crate) fn level_lines(input: &Input, domain: &Domain, surface: &Heightfield) -> Result<Input> {
    let lattice = *input.field.lattice();
    let [rows, cols] = [lattice.rows(), lattice.cols()];
    let mut residuals = residuals(input, domain, surface, 1.0)?;
    let mut heights = input.field.heights().to_vec();
    // Every odd row is half a spacing to the left.
    let row = |vertex: usize| vertex / cols;
    let column = |vertex: usize| 2 * (vertex % cols) + 1 - row(vertex) % 2;
    let axes: [(&dyn Fn(usize) -> usize, usize); 2] = [(&row, rows), (&column, 2 * cols)];
    for ((line, count), is_offset) in axes.into_iter().zip(input.offset_lines()) {
        if !is_offset {
            continue;
        }
        let mut lines = vec![Vec::new(); count];
        for (vertex, residual) in residuals.iter().enumerate() {
            if residual.is_finite() && !input.is_constrained(vertex) {
                lines[line(vertex)].push(*residual);
            }
        }
        let offset = |line: &mut Vec<f64>| median(line).unwrap_or(0.0);
        let offsets: Vec<f64> = lines.iter_mut().map(offset).collect();
        for vertex in (0..heights.len()).filter(|vertex| !input.is_constrained(*vertex)) {
            heights[vertex] -= offsets[line(vertex)];
            residuals[vertex] -= offsets[line(vertex)];
        }
    }
    let mut levelled = input.clone();
    levelled.field = Heightfield::new(lattice, heights)?;
    Ok(levelled)
}

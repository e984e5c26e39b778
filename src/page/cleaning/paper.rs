//! Cells of a flat page that show paper, as opposed to what is printed with an edge of its own.

use crate::page::outline::{MIN_EDGE_CONTRAST, Planes, box_mean, flood};

/// Number of cells on each side of an edge over which its whole step is measured: together 2 mm on A4.
const EDGE_REACH_CELLS: usize = 3;

/// Minimum share of an edge's step between its two next cells for the edge to be printed; a shadow's edge is wider.
const MIN_SHARP_SHARE: f32 = 0.7;

/// Maximum difference of a plain cell from the cells without strokes, in logarithms: the grain of a page of next to no print.
const MAX_PLAIN_DEPTH: f32 = 0.08;

/// Number of cells around an edge that are not taken for paper either, because they show both sides.
const MARGIN_CELLS: usize = 2;

/// Clears in `known` the cells that are not connected with most of the page by cells without a printed edge, and returns the number
/// of those left that are plain. `raw` has the logarithmic colours of the cells, `closed` those without strokes.
pub(super) fn find_paper(raw: &Planes, closed: &Planes, known: &mut [bool]) -> usize {
    let (width, height) = (closed.width, closed.height);
    let mut other: Vec<f32> = (0..known.len())
        .map(|i| f32::from(!known[i] || is_printed_edge(closed, i)))
        .collect();
    box_mean(&mut other, width, height, MARGIN_CELLS);
    // Means of whole numbers, which are zero or not.
    let is_plain = |i: &usize| other[*i] == 0.0;
    let mut seen = vec![false; known.len()];
    let mut largest = Vec::new();
    for start in 0..known.len() {
        if is_plain(&start) && !seen[start] {
            let component = flood(start, width, &mut seen, |next| is_plain(&next));
            if component.len() > largest.len() {
                largest = component;
            }
        }
    }
    known.fill(false);
    for i in &largest {
        known[*i] = true;
    }
    let depth = |i: usize| closed.channels[1][i] - raw.channels[1][i];
    (largest.iter())
        .filter(|i| depth(**i) < MAX_PLAIN_DEPTH)
        .count()
}

/// Whether a component of the colour has most of its step across a cell, along a row or a column, between the two cells next to it.
fn is_printed_edge(planes: &Planes, i: usize) -> bool {
    let (col, row) = (i % planes.width, i / planes.width);
    let step = |plane: &[f32], reach: usize, is_row: bool| {
        let (at, count, stride) = match is_row {
            true => (col, planes.width, 1),
            false => (row, planes.height, planes.width),
        };
        let (before, after) = (at.saturating_sub(reach), (at + reach).min(count - 1));
        plane[i + after * stride - at * stride] - plane[i + before * stride - at * stride]
    };
    planes.channels.iter().any(|plane| {
        [true, false].iter().any(|is_row| {
            let near = step(plane, 1, *is_row).abs();
            let whole = step(plane, EDGE_REACH_CELLS, *is_row).abs();
            near > MIN_EDGE_CONTRAST && near > MIN_SHARP_SHARE * whole
        })
    })
}

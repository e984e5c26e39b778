//! Symmetric sparse matrices, made of entries in any order.

use crate::error::{Result, try_filled};

/// A sparse matrix by rows, each with ascending columns.
pub(super) struct SparseRows {
    /// Number of the first entry of each row, and of all entries at the end.
    starts: Vec<u32>,
    columns: Vec<u32>,
    weights: Vec<f64>,
}

impl SparseRows {
    /// A matrix of `count` rows. Entries of the same row and column are added up.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub(super) fn new(count: usize, entries: &[([u32; 2], f64)]) -> Result<SparseRows> {
        // The ends of the rows, from which they are filled backwards.
        let mut places = try_filled("unrolling", count + 1, 0u32)?;
        for ([row, _], _) in entries {
            places[*row as usize] += 1;
        }
        let mut end = 0;
        for place in &mut places {
            end += *place;
            *place = end;
        }
        let mut sorted = try_filled("unrolling", entries.len(), (0u32, 0.0))?;
        for ([row, column], weight) in entries.iter().rev() {
            let place = &mut places[*row as usize];
            *place -= 1;
            sorted[*place as usize] = (*column, *weight);
        }
        let mut rows = SparseRows {
            starts: Vec::with_capacity(count + 1),
            columns: Vec::with_capacity(entries.len() / 2),
            weights: Vec::with_capacity(entries.len() / 2),
        };
        for range in places.windows(2) {
            let row = &mut sorted[range[0] as usize..range[1] as usize];
            let first = rows.columns.len();
            rows.starts.push(first as u32);
            // Stable, so that sums of more than two weights do not depend on the way of sorting.
            row.sort_by_key(|(column, _)| *column);
            for (column, weight) in row {
                match rows.columns[first..].last() {
                    Some(last) if last == column => {
                        *rows.weights.last_mut().unwrap_or(&mut 0.0) += *weight
                    }
                    _ => {
                        rows.columns.push(*column);
                        rows.weights.push(*weight);
                    }
                }
            }
        }
        rows.starts.push(rows.columns.len() as u32);
        Ok(rows)
    }

    /// Columns and weights of the entries of a row.
    pub(super) fn row(&self, row: usize) -> impl Iterator<Item = (u32, f64)> + '_ {
        let range = self.starts[row] as usize..self.starts[row + 1] as usize;
        let columns = self.columns[range.clone()].iter().copied();
        columns.zip(self.weights[range].iter().copied())
    }
}

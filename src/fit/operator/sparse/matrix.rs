//! Sparse matrices by rows, their transposes and products.

use crate::error::{Result, try_filled};
use crate::math::index::NO_INDEX;

/// Number of independent sums of an inner product.
const ROW_LANES: usize = 4;

/// A sparse matrix by rows, whose entries are numbers or small blocks of numbers.
#[derive(Debug, Clone)]
pub(crate) struct SparseMatrix<T> {
    /// Index of each row's first entry, and the number of all entries at the end.
    first: Vec<usize>,
    entries: Vec<(u32, T)>,
    columns: usize,
}

impl<T: Copy> SparseMatrix<T> {
    /// Makes a matrix of `columns` columns without rows.
    pub(crate) fn new(columns: usize) -> Self {
        SparseMatrix {
            first: vec![0],
            entries: Vec::new(),
            columns,
        }
    }

    /// Appends a row of entries with distinct columns.
    pub(crate) fn push(&mut self, entries: impl IntoIterator<Item = (u32, T)>) {
        self.entries.extend(entries);
        self.first.push(self.entries.len());
    }

    pub(super) fn rows(&self) -> usize {
        self.first.len() - 1
    }

    /// Returns the entries of a row, each with its column.
    #[inline(always)]
    pub(super) fn row(&self, row: usize) -> &[(u32, T)] {
        &self.entries[self.first[row]..self.first[row + 1]]
    }

    /// Returns the transpose, in whose rows columns ascend.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub(super) fn transpose(&self) -> Result<Self> {
        let mut first = try_filled("sparse matrix", self.columns + 1, 0)?;
        for (column, _) in &self.entries {
            first[*column as usize + 1] += 1;
        }
        for column in 0..self.columns {
            first[column + 1] += first[column];
        }
        let Some(any) = self.entries.first() else {
            return Ok(SparseMatrix {
                first,
                entries: Vec::new(),
                columns: self.rows(),
            });
        };
        let mut next = first.clone();
        let mut entries = try_filled("sparse matrix", self.entries.len(), (0, any.1))?;
        for row in 0..self.rows() {
            for (column, entry) in self.row(row) {
                let next = &mut next[*column as usize];
                entries[*next] = (row as u32, *entry);
                *next += 1;
            }
        }
        Ok(SparseMatrix {
            first,
            entries,
            columns: self.rows(),
        })
    }

    /// Returns the product with another matrix; `add` adds the product of two entries to an entry of the result.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub(super) fn multiply<U: Copy, V: Copy + Default>(
        &self,
        other: &SparseMatrix<U>,
        add: impl Fn(&mut V, &T, &U),
    ) -> Result<SparseMatrix<V>> {
        let rows = (0..self.rows()).map(|row| self.row(row).iter().copied());
        other.premultiply(rows, add)
    }

    /// Returns the product of the matrix with `rows` of entries on its left; `add` adds the product of two entries to an
    /// entry of the result.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub(super) fn premultiply<U, V: Copy + Default>(
        &self,
        rows: impl Iterator<Item = impl Iterator<Item = (u32, U)>>,
        add: impl Fn(&mut V, &U, &T),
    ) -> Result<SparseMatrix<V>> {
        let mut product = SparseMatrix::new(self.columns);
        // Index among the product's entries of each column that its last row has.
        let mut places = try_filled("sparse matrix", self.columns, NO_INDEX)?;
        let entries = &mut product.entries;
        for row in rows {
            let start = entries.len();
            for (middle, left) in row {
                for (column, right) in self.row(middle as usize) {
                    let place = &mut places[*column as usize];
                    if *place == NO_INDEX {
                        *place = (entries.len() - start) as u32;
                        entries.push((*column, V::default()));
                    }
                    add(&mut entries[start + *place as usize].1, &left, right);
                }
            }
            for (column, _) in &entries[start..] {
                places[*column as usize] = NO_INDEX;
            }
            product.first.push(entries.len());
        }
        Ok(product)
    }
}

impl SparseMatrix<f32> {
    /// Returns the inner product of a row with a vector. Sums run in a fixed number of lanes, so that they need not wait
    /// for each other.
    #[inline(always)]
    pub(super) fn row_times(&self, row: usize, x: &[f32]) -> f32 {
        let mut lanes = [0.0; ROW_LANES];
        let chunks = self.row(row).chunks_exact(ROW_LANES);
        let tail = chunks.remainder();
        for chunk in chunks {
            for (lane, (column, entry)) in lanes.iter_mut().zip(chunk) {
                *lane += entry * x[*column as usize];
            }
        }
        for (lane, (column, entry)) in lanes.iter_mut().zip(tail) {
            *lane += entry * x[*column as usize];
        }
        let [a, b, c, d] = lanes;
        (a + b) + (c + d)
    }

    /// Adds the product of the transpose with a vector to `to`.
    pub(super) fn add_transposed(&self, x: &[f32], to: &mut [f32]) {
        for (row, x) in x.iter().enumerate() {
            for (column, entry) in self.row(row) {
                to[*column as usize] += entry * x;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::DMatrix;

    use super::*;

    fn sparse(dense: &DMatrix<f32>) -> SparseMatrix<f32> {
        let mut matrix = SparseMatrix::new(dense.ncols());
        for row in dense.row_iter() {
            let entries = (0..).zip(row.iter().copied());
            matrix.push(entries.filter(|(_, entry)| *entry != 0.0));
        }
        matrix
    }

    fn dense(matrix: &SparseMatrix<f32>) -> DMatrix<f32> {
        let mut dense = DMatrix::zeros(matrix.rows(), matrix.columns);
        for row in 0..matrix.rows() {
            for (column, entry) in matrix.row(row) {
                dense[(row, *column as usize)] += entry;
            }
        }
        dense
    }

    #[test]
    fn products_and_transposes_are_those_of_dense_matrices() {
        // Small integers, of which all sums are exact; the last row and column are empty.
        let entry = |row: usize, column: usize, period: usize| match (7 * row + 5 * column) % period
        {
            1 => row as f32 - 3.0,
            2 => column as f32 + 1.0,
            _ => 0.0,
        };
        let mut a = DMatrix::from_fn(9, 14, |row, column| entry(row, column, 4));
        a.row_mut(8).fill(0.0);
        a.column_mut(13).fill(0.0);
        let b = DMatrix::from_fn(14, 6, |row, column| entry(row, column, 5));
        let (left, right) = (sparse(&a), sparse(&b));
        let product = left
            .multiply(&right, |sum: &mut f32, a, b| *sum += a * b)
            .unwrap();
        assert_eq!(dense(&product), &a * &b);
        assert_eq!(dense(&left.transpose().unwrap()), a.transpose());
        let x = DMatrix::from_fn(9, 1, |row, _| row as f32 - 4.0);
        let mut image = vec![0.0; 14];
        left.add_transposed(x.as_slice(), &mut image);
        assert_eq!(image, (a.transpose() * &x).as_slice());
        let y = DMatrix::from_fn(14, 1, |row, _| row as f32 - 6.0);
        let times: Vec<f32> = (0..9)
            .map(|row| left.row_times(row, y.as_slice()))
            .collect();
        assert_eq!(times, (a * &y).as_slice());
    }
}

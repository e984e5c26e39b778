//! Dense fronts of a sparse Cholesky factor: elimination of a front's columns, and both substitutions by them.

use wide::f32x4;

/// Columns of the factor that are eliminated together.
pub(super) struct Front {
    /// Number of the first column.
    pub start: usize,
    /// Number of columns.
    pub own: usize,
    /// Numbers of the rows further up in the order of elimination, ascending.
    pub above: Vec<u32>,
    /// The columns, one after the other: rows of the front's own columns, then those further up. The diagonal holds its inverse, and
    /// values above it have no meaning.
    pub columns: Vec<f32>,
}

impl Front {
    /// Part of a column from the diagonal on.
    fn column(&self, column: usize) -> &[f32] {
        let rows = self.own + self.above.len();
        &self.columns[column * rows..][column..rows]
    }

    /// Forward substitution by the columns of this front; `local` is space for the values at its rows.
    pub(super) fn eliminate(&self, values: &mut [f32], local: &mut Vec<f32>) {
        let own = self.start..self.start + self.own;
        local.clear();
        local.extend_from_slice(&values[own.clone()]);
        local.resize(self.own + self.above.len(), 0.0);
        for k in 0..self.own {
            let column = self.column(k);
            local[k] *= column[0];
            let factor = local[k];
            subtract(&mut local[k + 1..], factor, &column[1..]);
        }
        values[own].copy_from_slice(&local[..self.own]);
        for (row, value) in self.above.iter().zip(&local[self.own..]) {
            values[*row as usize] += value;
        }
    }

    /// Back substitution by the columns of this front; `local` is space for the values at its rows.
    pub(super) fn substitute(&self, values: &mut [f32], local: &mut Vec<f32>) {
        let own = self.start..self.start + self.own;
        local.clear();
        local.extend_from_slice(&values[own.clone()]);
        local.extend(self.above.iter().map(|row| values[*row as usize]));
        for k in (0..self.own).rev() {
            let column = self.column(k);
            local[k] = (local[k] - dot(&column[1..], &local[k + 1..])) * column[0];
        }
        values[own].copy_from_slice(&local[..self.own]);
    }
}

/// Eliminates the first `own` columns of a dense symmetric matrix of which the lower half is given, column by column.
pub(super) fn eliminate_columns(values: &mut [f32], rows: usize, own: usize) {
    for column in 0..rows {
        let (done, rest) = values.split_at_mut(column * rows);
        let target = &mut rest[column..rows];
        for source in done.chunks_exact(rows).take(own) {
            subtract(target, source[column], &source[column..]);
        }
        if column < own {
            // A vertex without triangles has no pivot, and does not move.
            let pivot = target[0];
            let inverse = if pivot > 0.0 { 1.0 / pivot.sqrt() } else { 0.0 };
            target.iter_mut().for_each(|value| *value *= inverse);
            target[0] = inverse;
        }
    }
}

/// Subtracts a multiple of a column from another one.
fn subtract(from: &mut [f32], factor: f32, column: &[f32]) {
    let ((fours, rest), (others, tail)) = (from.as_chunks_mut::<4>(), column.as_chunks::<4>());
    let factors = f32x4::splat(factor);
    for (values, entries) in fours.iter_mut().zip(others) {
        *values = (f32x4::from(*values) - factors * f32x4::from(*entries)).to_array();
    }
    for (value, entry) in rest.iter_mut().zip(tail) {
        *value -= factor * entry;
    }
}

/// Inner product of two columns; its sums are in a fixed order.
fn dot(a: &[f32], b: &[f32]) -> f32 {
    let ((fours, rest), (others, tail)) = (a.as_chunks::<4>(), b.as_chunks::<4>());
    let mut sums = f32x4::splat(0.0);
    for (x, y) in fours.iter().zip(others) {
        sums += f32x4::from(*x) * f32x4::from(*y);
    }
    let [p, q, r, s] = sums.to_array();
    let products = rest.iter().zip(tail).map(|(x, y)| x * y);
    products.sum::<f32>() + ((p + q) + (r + s))
}

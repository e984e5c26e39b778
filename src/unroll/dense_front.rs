//! Dense fronts of a sparse Cholesky factor: elimination of a front's columns, and both substitutions by them.
//!
//! All loops run down several columns at once, so that a value that has been loaded is used several times.

/// Number of columns that are used at once.
const BLOCK_COLUMNS: usize = 4;

/// Values of both coordinates of the plane.
pub(super) type Planes<T> = [T; 2];

/// Columns of the factor that are eliminated together.
pub(super) struct Front {
    /// Number of the first column.
    pub start: usize,
    /// Number of columns.
    pub own: usize,
    /// Rows of the front, ascending; the first ones are those of its columns.
    pub rows: Vec<u32>,
    /// The columns, each with a value for each row; the diagonal holds its inverse.
    pub columns: Vec<f32>,
}

impl Front {
    /// Forward substitution by the columns of this front.
    pub(super) fn eliminate(&self, values: &mut Planes<Vec<f32>>, local: &mut Planes<Vec<f32>>) {
        let (size, own) = (self.rows.len(), self.own);
        for (local, values) in local.iter_mut().zip(&*values) {
            local[..own].copy_from_slice(&values[self.start..self.start + own]);
            local[own..size].fill(0.0);
        }
        let [x, y] = local.each_mut().map(|local| &mut local[..size]);
        for k in (0..own).step_by(BLOCK_COLUMNS) {
            let end = (k + BLOCK_COLUMNS).min(own);
            // The triangle of the block's own rows.
            for i in k..end {
                let column = &self.columns[i * size..(i + 1) * size];
                (x[i], y[i]) = (x[i] * column[i], y[i] * column[i]);
                let factors = [x[i], y[i]];
                for j in i + 1..end {
                    x[j] -= factors[0] * column[j];
                    y[j] -= factors[1] * column[j];
                }
            }
            let ([done_x, x], [done_y, y]) = (split(x, end), split(y, end));
            if end == k + BLOCK_COLUMNS {
                let columns = [0, 1, 2, 3].map(|i| &self.columns[(k + i) * size..][end..size]);
                let factors = [&done_x[k..], &done_y[k..]].map(|f| [f[0], f[1], f[2], f[3]]);
                subtract_block([x, y], columns, factors);
            } else {
                for i in k..end {
                    let column = &self.columns[i * size + end..(i + 1) * size];
                    subtract([&mut *x, &mut *y], column, [done_x[i], done_y[i]]);
                }
            }
        }
        for (local, values) in local.iter().zip(values) {
            values[self.start..self.start + own].copy_from_slice(&local[..own]);
            for (row, value) in self.rows[own..].iter().zip(&local[own..]) {
                values[*row as usize] += value;
            }
        }
    }

    /// Back substitution by the columns of this front.
    pub(super) fn substitute(&self, values: &mut Planes<Vec<f32>>, local: &mut Planes<Vec<f32>>) {
        let (size, own) = (self.rows.len(), self.own);
        for (local, values) in local.iter_mut().zip(&*values) {
            local[..own].copy_from_slice(&values[self.start..self.start + own]);
            for (row, value) in self.rows[own..].iter().zip(&mut local[own..]) {
                *value = values[*row as usize];
            }
        }
        let [x, y] = local.each_mut().map(|local| &mut local[..size]);
        for k in (0..own).step_by(BLOCK_COLUMNS).rev() {
            let end = (k + BLOCK_COLUMNS).min(own);
            // Columns beyond the front's own ones are read again, without effect.
            let columns = [0, 1, 2, 3].map(|i| &self.columns[(k + i).min(end - 1) * size..][end..size]);
            let sums = dot_block(columns, [&x[end..], &y[end..]]);
            for i in (k..end).rev() {
                let column = &self.columns[i * size..(i + 1) * size];
                let mut sum = sums.map(|sums| sums[i - k]);
                for j in i + 1..end {
                    sum[0] += column[j] * x[j];
                    sum[1] += column[j] * y[j];
                }
                x[i] = (x[i] - sum[0]) * column[i];
                y[i] = (y[i] - sum[1]) * column[i];
            }
        }
        for (local, values) in local.iter().zip(values) {
            values[self.start..self.start + own].copy_from_slice(&local[..own]);
        }
    }
}

fn split(values: &mut [f32], at: usize) -> [&mut [f32]; 2] {
    let (first, second) = values.split_at_mut(at);
    [first, second]
}

/// Subtracts multiples of a column from the values of both coordinates.
fn subtract([x, y]: Planes<&mut [f32]>, column: &[f32], factors: Planes<f32>) {
    for ((x, y), entry) in x.iter_mut().zip(y).zip(column) {
        *x -= factors[0] * entry;
        *y -= factors[1] * entry;
    }
}

/// Subtracts multiples of four columns from the values of both coordinates.
fn subtract_block(
    [x, y]: Planes<&mut [f32]>,
    [a, b, c, d]: [&[f32]; BLOCK_COLUMNS],
    [[xa, xb, xc, xd], [ya, yb, yc, yd]]: Planes<[f32; BLOCK_COLUMNS]>,
) {
    let terms = a.iter().zip(b).zip(c.iter().zip(d));
    for ((x, y), ((a, b), (c, d))) in x.iter_mut().zip(y).zip(terms) {
        *x -= (xa * a + xb * b) + (xc * c + xd * d);
        *y -= (ya * a + yb * b) + (yc * c + yd * d);
    }
}

/// Number of independent sums of an inner product.
const DOT_LANES: usize = 4;

/// The sums of the values of both coordinates, weighted by each of four columns. Additions run in a fixed number of lanes,
/// so that they vectorise.
fn dot_block(
    columns: [&[f32]; BLOCK_COLUMNS],
    planes: Planes<&[f32]>,
) -> Planes<[f32; BLOCK_COLUMNS]> {
    let mut sums = [[[0.0f32; DOT_LANES]; BLOCK_COLUMNS]; 2];
    let [a, b, c, d] = columns.map(|column| column.chunks_exact(DOT_LANES));
    let [x, y] = planes.map(|plane| plane.chunks_exact(DOT_LANES));
    let tails = [a.remainder(), b.remainder(), c.remainder(), d.remainder()];
    let rests = [x.remainder(), y.remainder()];
    for ((x, y), ((a, b), (c, d))) in x.zip(y).zip(a.zip(b).zip(c.zip(d))) {
        for (sums, plane) in sums.iter_mut().zip([x, y]) {
            for (sums, column) in sums.iter_mut().zip([a, b, c, d]) {
                for lane in 0..DOT_LANES {
                    sums[lane] += column[lane] * plane[lane];
                }
            }
        }
    }
    for (sums, plane) in sums.iter_mut().zip(rests) {
        for (sums, column) in sums.iter_mut().zip(tails) {
            for (sum, (entry, value)) in sums.iter_mut().zip(column.iter().zip(plane)) {
                *sum += entry * value;
            }
        }
    }
    sums.map(|sums| sums.map(|[a, b, c, d]| (a + b) + (c + d)))
}

/// Eliminates the first columns of a dense symmetric matrix of which the lower half is given, two columns at a time.
pub(super) fn eliminate_columns(values: &mut [f32], size: usize, own: usize) {
    for k in (0..size).step_by(2) {
        let (done, rest) = values.split_at_mut(k * size);
        let done = &done[..k.min(own) * size];
        if k + 1 == size {
            subtract_columns(&mut rest[k..], done, size, k);
            scale(&mut rest[k..], k < own);
            return;
        }
        let (first, second) = rest.split_at_mut(size);
        let (first, second) = (&mut first[k..], &mut second[k + 1..size]);
        subtract_columns(&mut first[..1], done, size, k);
        subtract_column_pairs([&mut first[1..], second], done, size, k);
        scale(first, k < own);
        if k < own {
            let factor = first[1];
            for (value, entry) in second.iter_mut().zip(&first[1..]) {
                *value -= factor * entry;
            }
        }
        scale(second, k + 1 < own);
    }
}

/// Divides a column by the root of its pivot if it is eliminated; its diagonal becomes the root's inverse.
fn scale(column: &mut [f32], is_eliminated: bool) {
    if is_eliminated {
        let pivot = column[0];
        // A vertex without triangles has no pivot, and does not move.
        let inverse = if pivot > 0.0 { 1.0 / pivot.sqrt() } else { 0.0 };
        column[1..].iter_mut().for_each(|value| *value *= inverse);
        column[0] = inverse;
    }
}

/// Subtracts from column `k`, from its diagonal on, the columns that are eliminated before it.
fn subtract_columns(column: &mut [f32], done: &[f32], size: usize, k: usize) {
    for other in done.chunks_exact(size) {
        let factor = other[k];
        for (value, entry) in column.iter_mut().zip(&other[k..]) {
            *value -= factor * entry;
        }
    }
}

/// Subtracts from columns `k` and `k + 1`, both from row `k + 1` on, the columns that are eliminated before them.
fn subtract_column_pairs([x, y]: [&mut [f32]; 2], done: &[f32], size: usize, k: usize) {
    let mut blocks = done.chunks_exact(BLOCK_COLUMNS * size);
    for block in &mut blocks {
        let columns = [0, 1, 2, 3].map(|i| &block[i * size + k + 1..(i + 1) * size]);
        let factors = [k, k + 1].map(|row| [0, 1, 2, 3].map(|i| block[i * size + row]));
        subtract_block([&mut *x, &mut *y], columns, factors);
    }
    for other in blocks.remainder().chunks_exact(size) {
        subtract([&mut *x, &mut *y], &other[k + 1..], [other[k], other[k + 1]]);
    }
}

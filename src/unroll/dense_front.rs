//! Dense fronts of a sparse Cholesky factor: elimination of a front's columns, and both substitutions by them.
//!
//! Columns come in blocks of four and rows in blocks of four. All loops run down the four columns of a block at once, so that
//! a value that has been loaded is used several times.

use wide::f32x4;

/// Number of columns, and of rows, of a block.
pub(super) const BLOCK_SIDE: usize = 4;

/// Values of four consecutive rows.
pub(super) type Rows = [f32; BLOCK_SIDE];

/// Values of both coordinates of the plane.
pub(super) type Planes<T> = [T; 2];

/// Columns of the factor that are eliminated together.
///
/// The rows of a front are those of its own columns, padded to whole blocks, and then those further up in the order of
/// elimination. Rows and columns of the padding are 0.
pub(super) struct Front {
    /// Number of the first column.
    pub start: usize,
    /// Number of columns.
    pub own: usize,
    /// Numbers of the rows further up in the order of elimination, ascending.
    pub above: Vec<u32>,
    /// The columns, one after the other; the diagonal holds its inverse, and values above it have no meaning.
    pub columns: Vec<Rows>,
}

/// Number of whole blocks that hold a number of rows.
pub(super) fn blocks(rows: usize) -> usize {
    rows.div_ceil(BLOCK_SIDE)
}

impl Front {
    /// Number of blocks of rows.
    pub(super) fn row_blocks(&self) -> usize {
        blocks(self.own) + blocks(self.above.len())
    }

    /// The columns of a block, from a block of rows on.
    fn block(&self, block: usize, first: usize) -> [&[Rows]; BLOCK_SIDE] {
        let rows = self.row_blocks();
        columns_from(
            &self.columns[BLOCK_SIDE * block * rows..][..BLOCK_SIDE * rows],
            rows,
            first,
        )
    }

    /// Copies the values at the front's own rows; those of the padding and of the rows further up become 0.
    fn load(&self, values: &[f32], local: &mut [Rows]) {
        local.fill([0.0; BLOCK_SIDE]);
        let own = self.start..self.start + self.own;
        local.as_flattened_mut()[..self.own].copy_from_slice(&values[own]);
    }

    /// Forward substitution by the columns of this front.
    pub(super) fn eliminate(&self, values: &mut Planes<Vec<f32>>, local: &mut Planes<Vec<Rows>>) {
        let own = blocks(self.own);
        let [x, y] = local
            .each_mut()
            .map(|local| &mut local[..self.row_blocks()]);
        self.load(&values[0], x);
        self.load(&values[1], y);
        for block in 0..own {
            let columns = self.block(block, block);
            let (diagonal, below) = diagonal_and_below(columns);
            let ((x, rest_x), (y, rest_y)) = (split(x, block), split(y, block));
            for i in 0..BLOCK_SIDE {
                (x[i], y[i]) = (x[i] * diagonal[i][i], y[i] * diagonal[i][i]);
                for j in i + 1..BLOCK_SIDE {
                    x[j] -= x[i] * diagonal[i][j];
                    y[j] -= y[i] * diagonal[i][j];
                }
            }
            subtract_block([rest_x, rest_y], below, [*x, *y]);
        }
        for (local, values) in [x, y].into_iter().zip(values) {
            let own_values = &local.as_flattened()[..self.own];
            values[self.start..self.start + self.own].copy_from_slice(own_values);
            for (row, value) in self.above.iter().zip(local[own..].as_flattened()) {
                values[*row as usize] += value;
            }
        }
    }

    /// Back substitution by the columns of this front.
    pub(super) fn substitute(&self, values: &mut Planes<Vec<f32>>, local: &mut Planes<Vec<Rows>>) {
        let own = blocks(self.own);
        for (local, values) in local.iter_mut().zip(&*values) {
            let local = &mut local[..self.row_blocks()];
            self.load(values, local);
            let above = local[own..].as_flattened_mut();
            for (row, value) in self.above.iter().zip(above) {
                *value = values[*row as usize];
            }
        }
        let [x, y] = local
            .each_mut()
            .map(|local| &mut local[..self.row_blocks()]);
        for block in (0..own).rev() {
            let columns = self.block(block, block);
            let (diagonal, below) = diagonal_and_below(columns);
            let ((x, rest_x), (y, rest_y)) = (split(x, block), split(y, block));
            let [sum_x, sum_y] = dot_block(below, [rest_x, rest_y]);
            for i in (0..BLOCK_SIDE).rev() {
                let (mut a, mut b) = (x[i] - sum_x[i], y[i] - sum_y[i]);
                for j in i + 1..BLOCK_SIDE {
                    a -= diagonal[i][j] * x[j];
                    b -= diagonal[i][j] * y[j];
                }
                (x[i], y[i]) = (a * diagonal[i][i], b * diagonal[i][i]);
            }
        }
        for (local, values) in [x, y].into_iter().zip(values) {
            let own_values = &local.as_flattened()[..self.own];
            values[self.start..self.start + self.own].copy_from_slice(own_values);
        }
    }
}

/// Returns a block of rows and all that come after it.
fn split(values: &mut [Rows], block: usize) -> (&mut Rows, &mut [Rows]) {
    let (first, rest) = values[block..].split_at_mut(1);
    (&mut first[0], rest)
}

// Arrays are written out: a closure that maps them is not inlined everywhere, and costs more than what it does.

/// The four columns of a block of the factor, from a block of rows on.
#[inline(always)]
fn columns_from(block: &[Rows], rows: usize, first: usize) -> [&[Rows]; BLOCK_SIDE] {
    let (ab, cd) = block.split_at(2 * rows);
    let ((a, b), (c, d)) = (ab.split_at(rows), cd.split_at(rows));
    [&a[first..], &b[first..], &c[first..], &d[first..]]
}

/// Divides four columns that begin in their diagonal block into that block and what is below.
#[inline(always)]
fn diagonal_and_below(
    [a, b, c, d]: [&[Rows]; BLOCK_SIDE],
) -> ([Rows; BLOCK_SIDE], [&[Rows]; BLOCK_SIDE]) {
    let below = [&a[1..], &b[1..], &c[1..], &d[1..]];
    ([a[0], b[0], c[0], d[0]], below)
}

/// Loads four blocks of rows.
#[inline(always)]
fn vectors([a, b, c, d]: [Rows; BLOCK_SIDE]) -> [f32x4; BLOCK_SIDE] {
    [
        f32x4::from(a),
        f32x4::from(b),
        f32x4::from(c),
        f32x4::from(d),
    ]
}

/// Vectors of which all lanes are equal.
#[inline(always)]
fn splats([a, b, c, d]: [f32; BLOCK_SIDE]) -> [f32x4; BLOCK_SIDE] {
    [
        f32x4::splat(a),
        f32x4::splat(b),
        f32x4::splat(c),
        f32x4::splat(d),
    ]
}

/// Subtracts multiples of four columns from two others, or from the values of both coordinates.
#[inline(always)]
fn subtract_block(
    [x, y]: [&mut [Rows]; 2],
    [a, b, c, d]: [&[Rows]; BLOCK_SIDE],
    [xs, ys]: [[f32; BLOCK_SIDE]; 2],
) {
    let ([xa, xb, xc, xd], [ya, yb, yc, yd]) = (splats(xs), splats(ys));
    let terms = a.iter().zip(b).zip(c.iter().zip(d));
    for ((x, y), ((a, b), (c, d))) in x.iter_mut().zip(y).zip(terms) {
        let [a, b, c, d] = vectors([*a, *b, *c, *d]);
        *x = (f32x4::from(*x) - ((xa * a + xb * b) + (xc * c + xd * d))).to_array();
        *y = (f32x4::from(*y) - ((ya * a + yb * b) + (yc * c + yd * d))).to_array();
    }
}

/// The inner products of four columns and the values of both coordinates. The lanes are added in a fixed order.
#[inline(always)]
fn dot_block(
    [a, b, c, d]: [&[Rows]; BLOCK_SIDE],
    [x, y]: Planes<&[Rows]>,
) -> Planes<[f32; BLOCK_SIDE]> {
    let zero = f32x4::splat(0.0);
    let [mut xa, mut xb, mut xc, mut xd] = [zero; BLOCK_SIDE];
    let [mut ya, mut yb, mut yc, mut yd] = [zero; BLOCK_SIDE];
    let terms = a.iter().zip(b).zip(c.iter().zip(d));
    for ((x, y), ((a, b), (c, d))) in x.iter().zip(y).zip(terms) {
        let (x, y) = (f32x4::from(*x), f32x4::from(*y));
        let [a, b, c, d] = vectors([*a, *b, *c, *d]);
        (xa, xb, xc, xd) = (xa + x * a, xb + x * b, xc + x * c, xd + x * d);
        (ya, yb, yc, yd) = (ya + y * a, yb + y * b, yc + y * c, yd + y * d);
    }
    let [xa, xb, xc, xd] = f32x4::transpose([xa, xb, xc, xd]);
    let [ya, yb, yc, yd] = f32x4::transpose([ya, yb, yc, yd]);
    let (x, y) = ((xa + xb) + (xc + xd), (ya + yb) + (yc + yd));
    [x.to_array(), y.to_array()]
}

/// Eliminates the first blocks of columns of a dense symmetric matrix of which the lower half is given, column by column,
/// in `row_blocks` blocks of rows and as many of columns.
pub(super) fn eliminate_columns(values: &mut [Rows], row_blocks: usize, own_blocks: usize) {
    for target in 0..row_blocks {
        let (done, rest) = values.split_at_mut(BLOCK_SIDE * target * row_blocks);
        let mut columns = rest[..BLOCK_SIDE * row_blocks].chunks_exact_mut(row_blocks);
        let mut next = || columns.next().map_or(&mut [][..], |c| &mut c[target..]);
        let [a, b, c, d] = [next(), next(), next(), next()];
        for source in done.chunks_exact(BLOCK_SIDE * row_blocks).take(own_blocks) {
            let source = columns_from(source, row_blocks, target);
            let [ka, kb, kc, kd] = [source[0][0], source[1][0], source[2][0], source[3][0]];
            let factors = |row: usize| [ka[row], kb[row], kc[row], kd[row]];
            subtract_block([&mut *a, &mut *b], source, [factors(0), factors(1)]);
            subtract_block([&mut *c, &mut *d], source, [factors(2), factors(3)]);
        }
        if target < own_blocks {
            eliminate_block([a, b, c, d]);
        }
    }
}

/// Eliminates four columns, from their diagonal block on, from which all columns before have been subtracted.
fn eliminate_block([a, b, c, d]: [&mut [Rows]; BLOCK_SIDE]) {
    let mut diagonal = [a[0], b[0], c[0], d[0]];
    for i in 0..BLOCK_SIDE {
        let pivot = diagonal[i][i];
        // A vertex without triangles has no pivot, and does not move.
        let inverse = if pivot > 0.0 { 1.0 / pivot.sqrt() } else { 0.0 };
        diagonal[i][i] = inverse;
        for value in &mut diagonal[i][i + 1..] {
            *value *= inverse;
        }
        for k in i + 1..BLOCK_SIDE {
            for j in k..BLOCK_SIDE {
                diagonal[k][j] -= diagonal[i][k] * diagonal[i][j];
            }
        }
    }
    [a[0], b[0], c[0], d[0]] = diagonal;
    let [ra, rb] = [splats(diagonal[0]), splats(diagonal[1])];
    let [rc, rd] = [splats(diagonal[2]), splats(diagonal[3])];
    let columns = a[1..].iter_mut().zip(&mut b[1..]);
    for ((a, b), (c, d)) in columns.zip(c[1..].iter_mut().zip(&mut d[1..])) {
        let first = f32x4::from(*a) * ra[0];
        let second = (f32x4::from(*b) - first * ra[1]) * rb[1];
        let third = (f32x4::from(*c) - (first * ra[2] + second * rb[2])) * rc[2];
        let fourth = f32x4::from(*d) - ((first * ra[3] + second * rb[3]) + third * rc[3]);
        (*a, *b) = (first.to_array(), second.to_array());
        (*c, *d) = (third.to_array(), (fourth * rd[3]).to_array());
    }
}

//! Sparse Cholesky factorisation of a mesh's matrix, by nested dissection and dense fronts.
//!
//! The vertices are ordered by nested dissection (George 1973): a set of vertices is cut in two halves by position, and
//! those of one half with a neighbour in the other are eliminated after both. The factorisation is multifrontal (Duff and
//! Reid 1983): the columns that are eliminated together are a dense front, to which the fronts below it have been added.
//!
//! The matrix is factorised in double precision. The factor is kept, and systems are solved, in single precision, which
//! halves the memory that a solve reads: the error of one global step is in the next one's right-hand side.

use super::flat_triangle::Point;
use super::sparse_rows::SparseRows;
use crate::error::{Result, try_filled};
use crate::math::lanes;
use crate::math::union_find::UnionFind;

/// Maximum number of vertices of a set that is not cut in two further: a small dense front costs less than its indices.
const MAX_UNDIVIDED_VERTICES: usize = 32;

/// Factor of the diagonal of the vertex of each component that is eliminated last. The matrix is singular, as it lets all
/// vertices of a component move together; with this factor that vertex stays where it is.
const FIXED_VERTEX_FACTOR: f64 = 2.0;

/// Number of columns that are subtracted from another one at once.
const BLOCK_COLUMNS: usize = 4;

/// Number of independent sums of an inner product.
const DOT_LANES: usize = 8;

/// Values of both coordinates of the plane.
type Planes<T> = [T; 2];

/// Cholesky factor of a symmetric positive semidefinite matrix.
pub(super) struct Cholesky {
    /// Vertex at each place of the order of elimination.
    order: Vec<u32>,
    fronts: Vec<Front>,
    /// Right-hand side and solution in the order of elimination.
    values: Planes<Vec<f32>>,
    /// Values at the rows of one front.
    local: Planes<Vec<f32>>,
}

/// Columns of the factor that are eliminated together.
struct Front {
    /// Number of the first column.
    start: usize,
    /// Number of columns.
    own: usize,
    /// Rows of the front, ascending; the first ones are those of its columns.
    rows: Vec<u32>,
    /// The columns, each with a value for each row; the diagonal holds its inverse.
    columns: Vec<f32>,
}

impl Cholesky {
    /// Factorises a matrix whose rows belong to vertices at given positions.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub(super) fn new(matrix: &SparseRows, positions: &[Point]) -> Result<Cholesky> {
        let count = positions.len();
        let mut dissection = Dissection {
            matrix,
            positions,
            halves: try_filled("unrolling", count, 0)?,
            count: 0,
            order: Vec::with_capacity(count),
            starts: Vec::new(),
        };
        let mut vertices: Vec<u32> = (0..count as u32).collect();
        dissection.divide(&mut vertices);
        let Dissection { order, starts, .. } = dissection;
        let fronts = factorise(matrix, &order, &starts)?;
        let most = fronts.iter().map(|front| front.rows.len()).max();
        let zeros = |count| try_filled("unrolling", count, 0.0f32);
        let most = most.unwrap_or(0);
        Ok(Cholesky {
            fronts,
            values: [zeros(count)?, zeros(count)?],
            local: [zeros(most)?, zeros(most)?],
            order,
        })
    }

    /// Solves for both coordinates of the right-hand side at once.
    pub(super) fn solve(&mut self, right: &[Point], solution: &mut [Point]) {
        let [x, y] = &mut self.values;
        for (vertex, (x, y)) in self.order.iter().zip(x.iter_mut().zip(y)) {
            let value = right[*vertex as usize];
            (*x, *y) = (lanes::single(value.re), lanes::single(value.im));
        }
        for front in &self.fronts {
            front.eliminate(&mut self.values, &mut self.local);
        }
        for front in self.fronts.iter().rev() {
            front.substitute(&mut self.values, &mut self.local);
        }
        let [x, y] = &self.values;
        for (vertex, (x, y)) in self.order.iter().zip(x.iter().zip(y)) {
            solution[*vertex as usize] = Point::new(lanes::double(*x), lanes::double(*y));
        }
    }
}

impl Front {
    /// Forward substitution by the columns of this front.
    fn eliminate(&self, values: &mut Planes<Vec<f32>>, local: &mut Planes<Vec<f32>>) {
        let size = self.rows.len();
        let [x, y] = values;
        let [below_x, below_y] = local.each_mut().map(|local| &mut local[..size - self.own]);
        below_x.fill(0.0);
        below_y.fill(0.0);
        let range = self.start..self.start + self.own;
        let (own_x, own_y) = (&mut x[range.clone()], &mut y[range]);
        for (k, column) in self.columns.chunks_exact(size).enumerate() {
            (own_x[k], own_y[k]) = (own_x[k] * column[k], own_y[k] * column[k]);
            let factors = [own_x[k], own_y[k]];
            let (inner, outer) = column[k + 1..].split_at(self.own - k - 1);
            subtract([&mut own_x[k + 1..], &mut own_y[k + 1..]], inner, factors);
            subtract([&mut *below_x, &mut *below_y], outer, factors);
        }
        for (row, (below_x, below_y)) in self.rows[self.own..]
            .iter()
            .zip(below_x.iter().zip(&*below_y))
        {
            x[*row as usize] += below_x;
            y[*row as usize] += below_y;
        }
    }

    /// Back substitution by the columns of this front.
    fn substitute(&self, values: &mut Planes<Vec<f32>>, local: &mut Planes<Vec<f32>>) {
        let size = self.rows.len();
        let [x, y] = values;
        let [below_x, below_y] = local.each_mut().map(|local| &mut local[..size - self.own]);
        for (row, (below_x, below_y)) in self.rows[self.own..]
            .iter()
            .zip(below_x.iter_mut().zip(&mut *below_y))
        {
            (*below_x, *below_y) = (x[*row as usize], y[*row as usize]);
        }
        let range = self.start..self.start + self.own;
        let (own_x, own_y) = (&mut x[range.clone()], &mut y[range]);
        for (k, column) in self.columns.chunks_exact(size).enumerate().rev() {
            let (inner, outer) = column[k + 1..].split_at(self.own - k - 1);
            let one = dot(inner, [&own_x[k + 1..], &own_y[k + 1..]]);
            let other = dot(outer, [&*below_x, &*below_y]);
            own_x[k] = (own_x[k] - (one[0] + other[0])) * column[k];
            own_y[k] = (own_y[k] - (one[1] + other[1])) * column[k];
        }
    }
}

/// Subtracts multiples of a column from the values of both coordinates.
fn subtract([x, y]: Planes<&mut [f32]>, column: &[f32], factors: Planes<f32>) {
    for ((x, y), entry) in x.iter_mut().zip(y).zip(column) {
        *x -= factors[0] * entry;
        *y -= factors[1] * entry;
    }
}

/// The sums of the values of both coordinates, weighted by a column. Additions run in a fixed number of lanes, so that
/// they vectorise.
fn dot(column: &[f32], [x, y]: Planes<&[f32]>) -> Planes<f32> {
    let mut sums = [[0.0f32; DOT_LANES]; 2];
    let whole = column.len() / DOT_LANES * DOT_LANES;
    let chunks = column.chunks_exact(DOT_LANES);
    let planes = x.chunks_exact(DOT_LANES).zip(y.chunks_exact(DOT_LANES));
    for (column, (x, y)) in chunks.zip(planes) {
        for k in 0..DOT_LANES {
            sums[0][k] += column[k] * x[k];
            sums[1][k] += column[k] * y[k];
        }
    }
    for (k, entry) in column[whole..].iter().enumerate() {
        sums[0][k] += entry * x[whole + k];
        sums[1][k] += entry * y[whole + k];
    }
    sums.map(|[a, b, c, d, e, f, g, h]| ((a + e) + (b + f)) + ((c + g) + (d + h)))
}

/// The state of ordering the vertices by nested dissection.
struct Dissection<'a> {
    matrix: &'a SparseRows,
    positions: &'a [Point],
    /// Number of the half that each vertex was in last.
    halves: Vec<u32>,
    /// Number of halves so far.
    count: u32,
    order: Vec<u32>,
    /// First place in the order of each front.
    starts: Vec<usize>,
}

impl Dissection<'_> {
    /// Orders a set of vertices, those that part it in two halves last.
    fn divide(&mut self, vertices: &mut [u32]) {
        if vertices.len() <= MAX_UNDIVIDED_VERTICES {
            return self.add_front(vertices);
        }
        let (mut low, mut high) = (
            Point::new(f64::MAX, f64::MAX),
            Point::new(f64::MIN, f64::MIN),
        );
        for vertex in &*vertices {
            let place = self.positions[*vertex as usize];
            low = Point::new(low.re.min(place.re), low.im.min(place.im));
            high = Point::new(high.re.max(place.re), high.im.max(place.im));
        }
        let is_wide = high.re - low.re > high.im - low.im;
        let key = |vertex: &u32| {
            let place = self.positions[*vertex as usize];
            if is_wide { place.re } else { place.im }
        };
        let middle = vertices.len() / 2;
        vertices.select_nth_unstable_by(middle, |a, b| key(a).total_cmp(&key(b)).then(a.cmp(b)));
        let (left, right) = vertices.split_at_mut(middle);
        self.count += 1;
        for vertex in &*left {
            self.halves[*vertex as usize] = self.count;
        }
        // The vertices that part the halves come last.
        let mut rest = right.len();
        let mut k = 0;
        while k < rest {
            let mut columns = self.matrix.row(right[k] as usize);
            if columns.any(|(column, _)| self.halves[column as usize] == self.count) {
                rest -= 1;
                right.swap(k, rest);
            } else {
                k += 1;
            }
        }
        let (right, between) = right.split_at_mut(rest);
        self.divide(left);
        self.divide(right);
        self.add_front(between);
    }

    fn add_front(&mut self, vertices: &[u32]) {
        if !vertices.is_empty() {
            self.starts.push(self.order.len());
            self.order.extend(vertices);
        }
    }
}

/// Finds the vertex of each component that is eliminated last; returns for each place in the order of elimination whether
/// it has such a vertex.
fn last_of_components(matrix: &SparseRows, order: &[u32]) -> Result<Vec<bool>> {
    let mut components = UnionFind::new("unrolling", order.len())?;
    for vertex in 0..order.len() as u32 {
        for (other, _) in matrix.row(vertex as usize) {
            components.union(vertex, other);
        }
    }
    let mut is_seen = vec![false; order.len()];
    let mut is_last: Vec<bool> = (order.iter().rev())
        .map(|vertex| !std::mem::replace(&mut is_seen[components.find(*vertex) as usize], true))
        .collect();
    is_last.reverse();
    Ok(is_last)
}

/// Factorises a matrix front by front.
fn factorise(matrix: &SparseRows, order: &[u32], starts: &[usize]) -> Result<Vec<Front>> {
    let count = order.len();
    let mut places = try_filled("unrolling", count, 0u32)?;
    let mut front_of = try_filled("unrolling", count, 0u32)?;
    let ends: Vec<usize> = starts.iter().skip(1).copied().chain([count]).collect();
    for (number, range) in starts.iter().zip(&ends).enumerate() {
        for place in *range.0..*range.1 {
            places[order[place] as usize] = place as u32;
            front_of[place] = number as u32;
        }
    }
    // What the fronts below each front add to it: their rows further up, and a matrix for these.
    let mut below: Vec<Vec<(Vec<u32>, Vec<f64>)>> = starts.iter().map(|_| Vec::new()).collect();
    let mut fronts = Vec::with_capacity(starts.len());
    let is_last = last_of_components(matrix, order)?;
    // Place in the current front of each row.
    let mut locals = try_filled("unrolling", count, 0u32)?;
    for (number, (start, end)) in starts.iter().zip(&ends).enumerate() {
        let (start, end) = (*start, *end);
        let own = end - start;
        let updates = std::mem::take(&mut below[number]);
        let mut rows: Vec<u32> = (start as u32..end as u32).collect();
        for vertex in &order[start..end] {
            let columns = matrix.row(*vertex as usize);
            let further = columns.map(|(column, _)| places[column as usize]);
            rows.extend(further.filter(|place| *place as usize >= end));
        }
        for (others, _) in &updates {
            rows.extend(others.iter().filter(|place| **place as usize >= end));
        }
        rows[own..].sort_unstable();
        rows.dedup();
        let size = rows.len();
        for (local, row) in rows.iter().enumerate() {
            locals[*row as usize] = local as u32;
        }
        let mut values = try_filled("unrolling", size * size, 0.0)?;
        for (column, vertex) in order[start..end].iter().enumerate() {
            for (other, weight) in matrix.row(*vertex as usize) {
                let place = places[other as usize] as usize;
                if place < start + column {
                    continue;
                }
                let is_fixed = other == *vertex && is_last[start + column];
                let factor = if is_fixed { FIXED_VERTEX_FACTOR } else { 1.0 };
                values[column * size + locals[place] as usize] += factor * weight;
            }
        }
        for (others, update) in updates {
            let mut entries = update.iter();
            for (k, column) in others.iter().enumerate() {
                let column = locals[*column as usize] as usize * size;
                for (row, entry) in others[k..].iter().zip(&mut entries) {
                    values[column + locals[*row as usize] as usize] += entry;
                }
            }
        }
        eliminate_columns(&mut values, size, own);
        let rest = rows[own..].to_vec();
        if let Some(first) = rest.first() {
            let lower = (own..size).flat_map(|k| &values[k * size + k..(k + 1) * size]);
            let update = lower.copied().collect();
            below[front_of[*first as usize] as usize].push((rest, update));
        }
        let mut columns = try_filled("unrolling", own * size, 0.0f32)?;
        lanes::narrow(&values[..own * size], &mut columns);
        fronts.push(Front {
            start,
            own,
            rows,
            columns,
        });
    }
    Ok(fronts)
}

/// Eliminates the first columns of a dense symmetric matrix of which the lower half is given, column by column.
fn eliminate_columns(values: &mut [f64], size: usize, own: usize) {
    for k in 0..size {
        let (done, rest) = values.split_at_mut(k * size);
        let column = &mut rest[k..size];
        let mut blocks = done[..k.min(own) * size].chunks_exact(BLOCK_COLUMNS * size);
        for block in &mut blocks {
            let [a, b, c, d] = [0, 1, 2, 3].map(|i| &block[i * size + k..(i + 1) * size]);
            let [fa, fb, fc, fd] = [a[0], b[0], c[0], d[0]];
            let terms = a.iter().zip(b).zip(c.iter().zip(d));
            for (value, ((a, b), (c, d))) in column.iter_mut().zip(terms) {
                *value -= (fa * a + fb * b) + (fc * c + fd * d);
            }
        }
        for other in blocks.remainder().chunks_exact(size) {
            let factor = other[k];
            for (value, entry) in column.iter_mut().zip(&other[k..]) {
                *value -= factor * entry;
            }
        }
        if k < own {
            let pivot = column[0];
            // A vertex without triangles has no pivot, and does not move.
            let inverse = if pivot > 0.0 { 1.0 / pivot.sqrt() } else { 0.0 };
            column[1..].iter_mut().for_each(|value| *value *= inverse);
            column[0] = inverse;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The Laplacian of a square grid, as entries, and the positions of its vertices.
    fn grid(size: u32) -> (Vec<([u32; 2], f64)>, Vec<Point>) {
        let mut entries = Vec::new();
        let mut edge = |a: u32, b: u32| {
            entries.extend([([a, a], 1.0), ([b, b], 1.0), ([a, b], -1.0), ([b, a], -1.0)]);
        };
        for (row, col) in (0..size).flat_map(|row| (0..size).map(move |col| (row, col))) {
            let vertex = row * size + col;
            if col + 1 < size {
                edge(vertex, vertex + 1);
            }
            if row + 1 < size {
                edge(vertex, vertex + size);
            }
        }
        let place = |i: u32| Point::new(f64::from(i % size), f64::from(i / size));
        (entries, (0..size * size).map(place).collect())
    }

    #[test]
    fn solutions_on_grids_are_their_waves() {
        // The product of cosines is an eigenvector, in closed form. A second grid lies between the vertices of the first, so
        // that fronts have vertices of both; one vertex beside them has no entries.
        let size = 37u32;
        let (mut entries, mut places) = grid(size);
        let one = places.len();
        let shifted = |vertex: u32| vertex + one as u32;
        entries.extend_from_within(..);
        let half = entries.len() / 2;
        for (pair, _) in &mut entries[half..] {
            *pair = pair.map(shifted);
        }
        places.extend_from_within(..);
        for place in &mut places[one..] {
            *place += Point::new(0.3, 0.4);
        }
        places.push(Point::new(3.2, 1.1));
        let matrix = SparseRows::new(places.len(), &entries).unwrap();
        let mut factor = Cholesky::new(&matrix, &places).unwrap();
        for [p, q] in [[1, 0], [3, 2], [36, 36]] {
            let step = std::f64::consts::PI / f64::from(size);
            let [a, b] = [p, q].map(|k| f64::from(k) * step);
            let wave = |place: &Point| (a * (place.re + 0.5)).cos() * (b * (place.im + 0.5)).cos();
            let eigenvalue = 4.0 - 2.0 * a.cos() - 2.0 * b.cos();
            let count = places.len() - 1;
            let mut right: Vec<Point> = [&places[..one], &places[..one]]
                .concat()
                .iter()
                .map(|place| Point::new(wave(place), -2.0 * wave(place)))
                .collect();
            right.push(Point::default());
            let mut solution = vec![Point::default(); count + 1];
            factor.solve(&right, &mut solution);
            // The solution is unique but for a translation of each grid, which its vertex that is held limits.
            for grid in [0..one, one..count] {
                let expected: Vec<Point> =
                    right[grid.clone()].iter().map(|b| b / eigenvalue).collect();
                let found = &solution[grid];
                let shift = found[0] - expected[0];
                assert!(shift.norm() * eigenvalue < 4.0, "{p} {q}: {shift}");
                for (x, y) in found.iter().zip(&expected) {
                    assert!(
                        (x - y - shift).norm() * eigenvalue < 1e-4,
                        "{p} {q}: {x} {y}"
                    );
                }
            }
            assert_eq!(solution[count], Point::default());
        }
    }
}

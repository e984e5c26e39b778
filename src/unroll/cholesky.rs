//! Sparse Cholesky factorisation of a mesh's matrix, by nested dissection and dense fronts.
//!
//! The vertices are ordered by nested dissection (George 1973): a set of vertices is cut in two halves by position, and
//! those of one half with a neighbour in the other are eliminated after both. The factorisation is multifrontal (Duff and
//! Reid 1983): the columns that are eliminated together are a dense front, to which the fronts below it have been added.

use std::ops::{Mul, SubAssign};

use super::flat_triangle::Point;
use super::sparse_rows::SparseRows;
use crate::error::{Result, try_filled};

/// Maximum number of vertices of a set that is not cut in two further: a small dense front costs less than its indices.
const MAX_UNDIVIDED_VERTICES: usize = 32;

/// Share of its diagonal that is added to the matrix, which is singular: it lets all vertices move together.
const DIAGONAL_SHIFT: f64 = 1e-9;

/// Number of columns that are subtracted from another one at once.
const BLOCK_COLUMNS: usize = 4;

/// Number of independent sums of an inner product.
const DOT_LANES: usize = 4;

/// Cholesky factor of a symmetric positive semidefinite matrix.
pub(super) struct Cholesky {
    /// Vertex at each place of the order of elimination.
    order: Vec<u32>,
    fronts: Vec<Front>,
    /// Right-hand side and solution in the order of elimination.
    values: Vec<Point>,
    /// Values at the rows of one front.
    local: Vec<Point>,
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
    columns: Vec<f64>,
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
        Ok(Cholesky {
            fronts,
            values: try_filled("unrolling", count, Point::default())?,
            local: try_filled("unrolling", most.unwrap_or(0), Point::default())?,
            order,
        })
    }

    /// Solves for both coordinates of the right-hand side at once.
    pub(super) fn solve(&mut self, right: &[Point], solution: &mut [Point]) {
        for (value, vertex) in self.values.iter_mut().zip(&self.order) {
            *value = right[*vertex as usize];
        }
        for front in &self.fronts {
            front.eliminate(&mut self.values, &mut self.local);
        }
        for front in self.fronts.iter().rev() {
            front.substitute(&mut self.values, &mut self.local);
        }
        for (value, vertex) in self.values.iter().zip(&self.order) {
            solution[*vertex as usize] = *value;
        }
    }
}

impl Front {
    /// Forward substitution by the columns of this front.
    fn eliminate(&self, values: &mut [Point], local: &mut [Point]) {
        let size = self.rows.len();
        let below = &mut local[..size - self.own];
        below.fill(Point::default());
        let own = &mut values[self.start..self.start + self.own];
        for (k, column) in self.columns.chunks_exact(size).enumerate() {
            let value = own[k] * column[k];
            own[k] = value;
            subtract(&mut own[k + 1..], &column[k + 1..self.own], value);
            subtract(below, &column[self.own..], value);
        }
        for (row, value) in self.rows[self.own..].iter().zip(below) {
            values[*row as usize] += *value;
        }
    }

    /// Back substitution by the columns of this front.
    fn substitute(&self, values: &mut [Point], local: &mut [Point]) {
        let size = self.rows.len();
        let below = &mut local[..size - self.own];
        for (row, value) in self.rows[self.own..].iter().zip(&mut *below) {
            *value = values[*row as usize];
        }
        let own = &mut values[self.start..self.start + self.own];
        for (k, column) in self.columns.chunks_exact(size).enumerate().rev() {
            let known =
                dot(&column[k + 1..self.own], &own[k + 1..]) + dot(&column[self.own..], below);
            own[k] = (own[k] - known) * column[k];
        }
    }
}

/// Subtracts a multiple of a column from other values.
fn subtract<T: Copy + Mul<f64, Output = T> + SubAssign>(from: &mut [T], column: &[f64], factor: T) {
    for (value, entry) in from.iter_mut().zip(column) {
        *value -= factor * *entry;
    }
}

/// The sum of values, weighted by a column. Additions run in a fixed number of lanes, so that they vectorise.
fn dot(column: &[f64], values: &[Point]) -> Point {
    let mut lanes = [Point::default(); DOT_LANES];
    let (a, b) = (
        column.chunks_exact(DOT_LANES),
        values.chunks_exact(DOT_LANES),
    );
    let tail = a.remainder().iter().zip(b.remainder());
    for (a, b) in a.zip(b) {
        for (lane, (x, y)) in lanes.iter_mut().zip(a.iter().zip(b)) {
            *lane += y * *x;
        }
    }
    lanes.iter().sum::<Point>() + tail.map(|(x, y)| y * *x).sum::<Point>()
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
                let shift = if other == *vertex {
                    1.0 + DIAGONAL_SHIFT
                } else {
                    1.0
                };
                values[column * size + locals[place] as usize] += shift * weight;
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
        values.truncate(own * size);
        values.shrink_to_fit();
        fronts.push(Front {
            start,
            own,
            rows,
            columns: values,
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
            subtract(column, &other[k..], other[k]);
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
    fn solutions_on_a_grid_are_its_waves() {
        // The product of cosines is an eigenvector, in closed form; one vertex beside the grid has no entries.
        let size = 37u32;
        let (entries, mut places) = grid(size);
        places.push(Point::new(3.2, 1.1));
        let matrix = SparseRows::new(places.len(), &entries).unwrap();
        let mut factor = Cholesky::new(&matrix, &places).unwrap();
        for [p, q] in [[1, 0], [3, 2], [36, 36]] {
            let step = std::f64::consts::PI / f64::from(size);
            let [a, b] = [p, q].map(|k| f64::from(k) * step);
            let wave = |place: &Point| (a * (place.re + 0.5)).cos() * (b * (place.im + 0.5)).cos();
            let eigenvalue = 4.0 - 2.0 * a.cos() - 2.0 * b.cos();
            let count = places.len() - 1;
            let mut right: Vec<Point> = places[..count]
                .iter()
                .map(|place| Point::new(wave(place), -2.0 * wave(place)))
                .collect();
            right.push(Point::default());
            let mut solution = vec![Point::default(); count + 1];
            factor.solve(&right, &mut solution);
            for (x, b) in solution.iter().zip(&right) {
                assert!((x * eigenvalue - b).norm() < 1e-4, "{p} {q}: {x} {b}");
            }
        }
    }
}

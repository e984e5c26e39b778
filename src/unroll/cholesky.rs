//! Sparse Cholesky factorisation of a mesh's matrix, by nested dissection and dense fronts.
//!
//! The factorisation is multifrontal (Duff and Reid 1983): the columns that are eliminated together are a dense front, to
//! which the fronts below it have been added.
//!
//! Factor and solutions are in single precision, which halves the memory that a solve reads: the error of one global step is in the
//! next one's right-hand side.

use super::dense_front::{Front, eliminate_columns};
use super::nested_dissection::Order;
use super::sparse_rows::SparseRows;
use crate::error::{Result, try_filled};
use crate::math::lanes;
use crate::math::planar::Point2;
use crate::math::union_find::UnionFind;

/// Factor of the diagonal of the vertex of each component that is eliminated last. The matrix is singular, as it lets all
/// vertices of a component move together; with this factor that vertex stays where it is.
const FIXED_VERTEX_FACTOR: f64 = 2.0;

/// Cholesky factor of a symmetric positive semidefinite matrix.
pub(crate) struct Cholesky {
    /// Vertex at each place of the order of elimination.
    order: Vec<u32>,
    fronts: Vec<Front>,
    /// Right-hand side and solution in the order of elimination, for both coordinates.
    values: [Vec<f32>; 2],
}

impl Cholesky {
    /// Factorises a matrix whose rows belong to vertices at given positions.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub(super) fn new(matrix: &SparseRows, positions: &[Point2]) -> Result<Cholesky> {
        let count = positions.len();
        let Order { vertices, starts } = Order::new(matrix, positions)?;
        let fronts = factorise(matrix, &vertices, &starts)?;
        let zeros = || try_filled("unrolling", count, 0.0f32);
        Ok(Cholesky {
            fronts,
            values: [zeros()?, zeros()?],
            order: vertices,
        })
    }

    /// Solves for both coordinates of the right-hand side at once.
    pub(super) fn solve(&mut self, right: &[Point2], solution: &mut [Point2]) {
        let [x, y] = &mut self.values;
        for (vertex, (x, y)) in self.order.iter().zip(x.iter_mut().zip(y)) {
            let value = right[*vertex as usize];
            (*x, *y) = (lanes::single(value.re), lanes::single(value.im));
        }
        let mut local = Vec::new();
        for front in &self.fronts {
            for values in &mut self.values {
                front.eliminate(values, &mut local);
            }
        }
        for front in self.fronts.iter().rev() {
            for values in &mut self.values {
                front.substitute(values, &mut local);
            }
        }
        let [x, y] = &self.values;
        for (vertex, (x, y)) in self.order.iter().zip(x.iter().zip(y)) {
            solution[*vertex as usize] = Point2::new(lanes::double(*x), lanes::double(*y));
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
    let mut below: Vec<Vec<(Vec<u32>, Vec<f32>)>> = starts.iter().map(|_| Vec::new()).collect();
    let mut fronts = Vec::with_capacity(starts.len());
    let is_last = last_of_components(matrix, order)?;
    // The current front's matrix, and the place in it of each row.
    let mut space: Vec<f32> = Vec::new();
    let mut locals = try_filled("unrolling", count, 0u32)?;
    for (number, (start, end)) in starts.iter().zip(&ends).enumerate() {
        let (start, end) = (*start, *end);
        let own = end - start;
        let updates = std::mem::take(&mut below[number]);
        let mut above: Vec<u32> = Vec::new();
        for vertex in &order[start..end] {
            let columns = matrix.row(*vertex as usize);
            above.extend(columns.map(|(column, _)| places[column as usize]));
        }
        above.extend(updates.iter().flat_map(|(rows, _)| rows));
        above.retain(|place| *place as usize >= end);
        above.sort_unstable();
        above.dedup();
        let size = own + above.len();
        for (local, row) in (0..own).zip(start..) {
            locals[row] = local as u32;
        }
        for (local, row) in (own as u32..).zip(&above) {
            locals[*row as usize] = local;
        }
        if space.len() < size * size {
            space = try_filled("unrolling", size * size, 0.0)?;
        }
        let values = &mut space[..size * size];
        values.fill(0.0);
        for (column, vertex) in order[start..end].iter().enumerate() {
            for (other, weight) in matrix.row(*vertex as usize) {
                let place = places[other as usize] as usize;
                if place < start + column {
                    continue;
                }
                let is_fixed = other == *vertex && is_last[start + column];
                let factor = if is_fixed { FIXED_VERTEX_FACTOR } else { 1.0 };
                values[column * size + locals[place] as usize] += lanes::single(factor * weight);
            }
        }
        for (others, update) in updates {
            let others: Vec<u32> = others.iter().map(|row| locals[*row as usize]).collect();
            let mut entries = update.iter();
            for (k, column) in others.iter().enumerate() {
                let values = &mut values[*column as usize * size..][..size];
                for (row, entry) in others[k..].iter().zip(&mut entries) {
                    values[*row as usize] += entry;
                }
            }
        }
        eliminate_columns(values, size, own);
        if let Some(next) = above.first() {
            let mut update = Vec::with_capacity(above.len() * (above.len() + 1) / 2);
            for k in own..size {
                update.extend_from_slice(&values[k * size + k..(k + 1) * size]);
            }
            below[front_of[*next as usize] as usize].push((above.clone(), update));
        }
        let mut columns = try_filled("unrolling", own * size, 0.0)?;
        columns.copy_from_slice(&values[..own * size]);
        fronts.push(Front {
            start,
            own,
            above,
            columns,
        });
    }
    Ok(fronts)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The Laplacian of a square grid, as entries, and the positions of its vertices.
    fn grid(size: u32) -> (Vec<([u32; 2], f64)>, Vec<Point2>) {
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
        let place = |i: u32| Point2::new(f64::from(i % size), f64::from(i / size));
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
            *place += Point2::new(0.3, 0.4);
        }
        places.push(Point2::new(3.2, 1.1));
        let matrix = SparseRows::new(places.len(), &entries).unwrap();
        let mut factor = Cholesky::new(&matrix, &places).unwrap();
        for [p, q] in [[1, 0], [3, 2], [36, 36]] {
            let step = std::f64::consts::PI / f64::from(size);
            let [a, b] = [p, q].map(|k| f64::from(k) * step);
            let wave = |place: &Point2| (a * (place.re + 0.5)).cos() * (b * (place.im + 0.5)).cos();
            let eigenvalue = 4.0 - 2.0 * a.cos() - 2.0 * b.cos();
            let count = places.len() - 1;
            let mut right: Vec<Point2> = [&places[..one], &places[..one]]
                .concat()
                .iter()
                .map(|place| Point2::new(wave(place), -2.0 * wave(place)))
                .collect();
            right.push(Point2::default());
            let mut solution = vec![Point2::default(); count + 1];
            factor.solve(&right, &mut solution);
            // The solution is unique but for a translation of each grid, which its vertex that is held limits.
            for grid in [0..one, one..count] {
                let expected: Vec<Point2> =
                    right[grid.clone()].iter().map(|b| b / eigenvalue).collect();
                let found = &solution[grid];
                let shift = found[0] - expected[0];
                assert!(shift.norm() * eigenvalue < 4.0, "{p} {q}: {shift}");
                for (x, y) in found.iter().zip(&expected) {
                    assert!(
                        (x - y - shift).norm() * eigenvalue < 5e-4,
                        "{p} {q}: {x} {y}"
                    );
                }
            }
            assert_eq!(solution[count], Point2::default());
        }
    }
}

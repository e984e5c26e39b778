//! Order of elimination of a mesh's vertices by nested dissection (George 1973): a set of vertices is cut in two halves by
//! position, and those of one half with a neighbour in the other are eliminated after both.

use super::sparse_rows::SparseRows;
use crate::error::{Result, try_filled};
use crate::math::planar::Point2;

/// Maximum number of vertices of a set that is not cut in two further: a small dense front costs less than its indices.
/// `benches/patterns.md` has what others give.
const MAX_UNDIVIDED_VERTICES: usize = 32;

/// Order of elimination of a matrix's rows, in fronts of vertices that are eliminated together.
pub(super) struct Order {
    /// Vertex at each place of the order.
    pub vertices: Vec<u32>,
    /// First place in the order of each front.
    pub starts: Vec<usize>,
}

impl Order {
    /// Orders the rows of a matrix, which belong to vertices at given positions.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub(super) fn new(matrix: &SparseRows, positions: &[Point2]) -> Result<Order> {
        let count = positions.len();
        let mut dissection = Dissection {
            matrix,
            positions,
            halves: try_filled("unrolling", count, 0)?,
            count: 0,
            order: Order {
                vertices: Vec::with_capacity(count),
                starts: Vec::new(),
            },
        };
        let mut vertices: Vec<u32> = (0..count as u32).collect();
        dissection.divide(&mut vertices);
        Ok(dissection.order)
    }
}

/// The state of ordering the vertices by nested dissection.
struct Dissection<'a> {
    matrix: &'a SparseRows,
    positions: &'a [Point2],
    /// Number of the half that each vertex was in last.
    halves: Vec<u32>,
    /// Number of halves so far.
    count: u32,
    order: Order,
}

impl Dissection<'_> {
    /// Orders a set of vertices, those that part it in two halves last.
    fn divide(&mut self, vertices: &mut [u32]) {
        if vertices.len() <= MAX_UNDIVIDED_VERTICES {
            return self.add_front(vertices);
        }
        let (mut low, mut high) = (
            Point2::new(f64::MAX, f64::MAX),
            Point2::new(f64::MIN, f64::MIN),
        );
        for vertex in &*vertices {
            let place = self.positions[*vertex as usize];
            low = Point2::new(low.re.min(place.re), low.im.min(place.im));
            high = Point2::new(high.re.max(place.re), high.im.max(place.im));
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
            self.order.starts.push(self.order.vertices.len());
            self.order.vertices.extend(vertices);
        }
    }
}

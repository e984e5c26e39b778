//! The cells that fields of an unrolling live on: a lattice with padding all around, and the way
//! from one to that of twice the spacing.

/// Padding, enough for a coarse vertex beyond the border and its neighbours to have cells.
const TOP: usize = 1;
const BOTTOM: usize = 2;
const LEFT: usize = 2;
const RIGHT: usize = 4;

/// A padded lattice of `rows × cols` vertices.
///
/// Coarse vertex `(r, c)` is fine vertex `(2r, 2c − (r odd))`, and every other fine vertex is the
/// midpoint of a coarse edge.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Grid {
    rows: usize,
    cols: usize,
}

/// Offsets to the neighbours in the rows above and below; those in the row itself are ±1.
#[derive(Debug, Clone, Copy)]
pub(super) struct Offsets {
    pub north_west: isize,
    pub north_east: isize,
    pub south_west: isize,
    pub south_east: isize,
}

impl Offsets {
    /// W, E, NW, NE, SW, SE.
    pub(super) fn all(self) -> [isize; 6] {
        [
            -1,
            1,
            self.north_west,
            self.north_east,
            self.south_west,
            self.south_east,
        ]
    }
}

impl Grid {
    pub(super) fn new(rows: usize, cols: usize) -> Self {
        Grid { rows, cols }
    }

    /// The grid of twice the spacing, large enough for every fine triangle to lie in one of its.
    pub(super) fn coarse(self) -> Self {
        Grid::new(self.rows / 2 + 1, self.cols / 2 + 2)
    }

    pub(super) fn rows(self) -> usize {
        self.rows
    }

    pub(super) fn cols(self) -> usize {
        self.cols
    }

    /// Cells from one row to the next.
    pub(super) fn stride(self) -> usize {
        LEFT + self.cols + RIGHT
    }

    /// Cells with padding.
    pub(super) fn cells(self) -> usize {
        (TOP + self.rows + BOTTOM) * self.stride()
    }

    pub(super) fn cell(self, row: usize, col: usize) -> usize {
        (row + TOP) * self.stride() + col + LEFT
    }

    /// Row and column of a cell that is not padding.
    pub(super) fn vertex(self, cell: usize) -> (usize, usize) {
        (cell / self.stride() - TOP, cell % self.stride() - LEFT)
    }

    /// The cells of a row without padding.
    pub(super) fn row(self, row: usize) -> std::ops::Range<usize> {
        let start = self.cell(row, 0);
        start..start + self.cols
    }

    /// Offsets from the cells of a row.
    pub(super) fn offsets(self, row: usize) -> Offsets {
        let stride = self.stride() as isize;
        // On odd rows, which are shifted to the left, the eastern neighbours have the same column.
        let east = if row % 2 == 1 { 0 } else { 1 };
        Offsets {
            north_west: -stride + east - 1,
            north_east: -stride + east,
            south_west: stride + east - 1,
            south_east: stride + east,
        }
    }

    /// The cell of this grid at the coarse vertex `(row, col)`, which may be a padding cell.
    pub(super) fn below(self, row: usize, col: usize) -> usize {
        (2 * row + TOP) * self.stride() + 2 * col + LEFT - row % 2
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lattice::hexagonal::Lattice;

    #[test]
    fn coarse_vertices_and_all_their_neighbours_have_cells() {
        for (rows, cols) in [(1, 1), (2, 3), (7, 4), (12, 9), (13, 16)] {
            let fine = Grid::new(rows, cols);
            let coarse = fine.coarse();
            for row in 0..coarse.rows() {
                for col in 0..coarse.cols() {
                    let cell = fine.below(row, col) as isize;
                    // Coarse rows are even fine rows.
                    for offset in fine.offsets(2 * row).all() {
                        assert!((0..fine.cells() as isize).contains(&(cell + offset)));
                    }
                }
            }
        }
    }

    #[test]
    fn offsets_are_those_of_the_lattice() {
        let lattice = Lattice::new(6, 7, 1.0).unwrap();
        let grid = Grid::new(6, 7);
        for row in 0..6 {
            for col in 0..7 {
                let neighbours = lattice.neighbours(row, col);
                for (neighbour, offset) in neighbours.into_iter().zip(grid.offsets(row).all()) {
                    if let Some((r, c)) = neighbour {
                        assert_eq!(
                            grid.cell(row, col) as isize + offset,
                            grid.cell(r, c) as isize
                        );
                    }
                }
            }
        }
    }
}

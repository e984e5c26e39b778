//! A hexagonal lattice with padding on all sides, and the one of twice its spacing.

/// Number of rows of padding above the lattice. All padding is as wide as a coarse vertex beyond the border, and its
/// neighbours, need.
const PADDING_ROWS_ABOVE: usize = 1;

/// Number of rows of padding below the lattice.
const PADDING_ROWS_BELOW: usize = 2;

/// Number of columns of padding to the left of the lattice.
const PADDING_COLUMNS_LEFT: usize = 2;

/// Number of columns of padding to the right of the lattice.
const PADDING_COLUMNS_RIGHT: usize = 4;

/// A lattice of `rows × cols` vertices with padding around it, so that every vertex has neighbours.
///
/// Coarse vertex `(r, c)` is fine vertex `(2r, 2c − (r odd))`, and every other fine vertex is the
/// midpoint of a coarse edge.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct PaddedLattice {
    rows: usize,
    cols: usize,
}

/// Index offsets from a cell of the padded lattice to its neighbours in the rows above and below. The neighbours in the
/// cell's own row are at ±1.
#[derive(Debug, Clone, Copy)]
pub(super) struct Offsets {
    pub north_west: isize,
    pub north_east: isize,
    pub south_west: isize,
    pub south_east: isize,
}

impl Offsets {
    /// Returns the index offsets from a cell to its six neighbours, in the order W, E, NW, NE, SW, SE.
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

impl PaddedLattice {
    pub(super) fn new(rows: usize, cols: usize) -> Self {
        PaddedLattice { rows, cols }
    }

    /// Creates the lattice of twice the spacing, large enough for every fine triangle to lie in a coarse one.
    pub(super) fn coarse(self) -> Self {
        PaddedLattice::new(self.rows / 2 + 1, self.cols / 2 + 2)
    }

    pub(super) fn rows(self) -> usize {
        self.rows
    }

    pub(super) fn cols(self) -> usize {
        self.cols
    }

    /// Returns the number of cells from one row of the padded lattice to the next.
    pub(super) fn stride(self) -> usize {
        PADDING_COLUMNS_LEFT + self.cols + PADDING_COLUMNS_RIGHT
    }

    /// Returns the number of cells of the lattice, padding included.
    pub(super) fn cells(self) -> usize {
        (PADDING_ROWS_ABOVE + self.rows + PADDING_ROWS_BELOW) * self.stride()
    }

    /// Returns the cell, an index into the padded lattice, of a vertex given by row and column.
    pub(super) fn cell(self, row: usize, col: usize) -> usize {
        (row + PADDING_ROWS_ABOVE) * self.stride() + col + PADDING_COLUMNS_LEFT
    }

    /// Returns row and column of the vertex at a cell (index into the padded lattice) that is not padding.
    pub(super) fn vertex(self, cell: usize) -> (usize, usize) {
        (
            cell / self.stride() - PADDING_ROWS_ABOVE,
            cell % self.stride() - PADDING_COLUMNS_LEFT,
        )
    }

    /// Returns the range of the cells of a row, without padding.
    pub(super) fn row(self, row: usize) -> std::ops::Range<usize> {
        let start = self.cell(row, 0);
        start..start + self.cols
    }

    /// Returns the index offsets from a cell in a given row to the cell's neighbours.
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

    /// Returns the cell of this lattice, which may be padding, at a vertex of the [coarse](PaddedLattice::coarse) one.
    pub(super) fn cell_of_coarse(self, row: usize, col: usize) -> usize {
        (2 * row + PADDING_ROWS_ABOVE) * self.stride() + 2 * col + PADDING_COLUMNS_LEFT - row % 2
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lattice::hexagonal::Lattice;

    #[test]
    fn coarse_vertices_and_all_their_neighbours_have_cells() {
        for (rows, cols) in [(1, 1), (2, 3), (7, 4), (12, 9), (13, 16)] {
            let fine = PaddedLattice::new(rows, cols);
            let coarse = fine.coarse();
            for row in 0..coarse.rows() {
                for col in 0..coarse.cols() {
                    let cell = fine.cell_of_coarse(row, col) as isize;
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
        let grid = PaddedLattice::new(6, 7);
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

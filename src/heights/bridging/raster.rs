//! Raster of lattice vertices or pixels with a margin around it, and the neighbours of each cell.

use crate::error::{Result, try_filled};
use crate::lattice::hexagonal::{NEIGHBOUR_DIRECTIONS, ROW_SPACING};

/// A raster of cells (lattice vertices or pixels) in rows, with a margin on all sides, so that neighbours are at index
/// offsets that depend only on the parity of the row.
pub(super) struct Raster {
    hexagonal: bool,
    rows: usize,
    cols: usize,
    /// Width of the margin on each side, in cells; even, so that rows keep their parity.
    margin: usize,
    pub stride: usize,
    pub height: usize,
    /// Index offsets from a cell to its neighbours: for even and for odd rows.
    offsets: [Vec<isize>; 2],
}

impl Raster {
    pub(super) fn hexagonal(rows: usize, cols: usize, width: usize) -> Result<Self> {
        Raster::new(true, rows, cols, width)
    }

    pub(super) fn square(rows: usize, cols: usize, width: usize) -> Result<Self> {
        Raster::new(false, rows, cols, width)
    }

    /// Makes a raster with a margin slightly wider than `width`, the maximum width of a hole.
    fn new(hexagonal: bool, rows: usize, cols: usize, width: usize) -> Result<Self> {
        let margin = (width + 4).next_multiple_of(2);
        let mut raster = Raster {
            hexagonal,
            rows,
            cols,
            margin,
            stride: cols + 2 * margin,
            height: rows + 2 * margin,
            offsets: Default::default(),
        };
        raster.offsets = [false, true].map(|odd| {
            let steps = raster.steps(odd).into_iter();
            steps.map(|step| raster.offset(step)).collect()
        });
        Ok(raster)
    }

    pub(super) fn cells(&self) -> usize {
        self.stride * self.height
    }

    /// Copies values of the data to the padded raster, with the value `beyond` in the margin.
    pub(super) fn padded(&self, values: &[f64], beyond: f64) -> Result<Vec<f64>> {
        let mut padded = try_filled("bridged holes", self.cells(), beyond)?;
        for (row, values) in values.chunks(self.cols).enumerate() {
            let start = (row + self.margin) * self.stride + self.margin;
            padded[start..start + self.cols].copy_from_slice(values);
        }
        Ok(padded)
    }

    /// Index in the data's arrays of a cell of the padded raster that is not in the margin.
    pub(super) fn index(&self, cell: usize) -> usize {
        let (row, col) = (
            cell / self.stride - self.margin,
            cell % self.stride - self.margin,
        );
        row * self.cols + col
    }

    /// Whether a cell of the padded raster belongs to the data, not to the margin.
    pub(super) fn is_inside(&self, cell: usize) -> bool {
        let (row, col) = (cell / self.stride, cell % self.stride);
        let within = |i: usize, n: usize| (self.margin..self.margin + n).contains(&i);
        within(row, self.rows) && within(col, self.cols)
    }

    /// Index offset that corresponds to a step of some rows and columns.
    fn offset(&self, [row, col]: [isize; 2]) -> isize {
        row * self.stride as isize + col
    }

    /// Steps, as rows and columns, from a cell in an even or odd row to its neighbours, ordered by angle.
    pub(super) fn steps(&self, odd: bool) -> Vec<[isize; 2]> {
        let row = isize::from(odd);
        match self.hexagonal {
            true => [1, 3, 2, 0, 4, 5]
                .map(|k: usize| NEIGHBOUR_DIRECTIONS[k].step(row, 0))
                .map(|(r, c)| [r - row, c])
                .to_vec(),
            false => {
                let around = [
                    (0, 1),
                    (-1, 1),
                    (-1, 0),
                    (-1, -1),
                    (0, -1),
                    (1, -1),
                    (1, 0),
                    (1, 1),
                ];
                around.map(|(r, c)| [r, c]).to_vec()
            }
        }
    }

    /// Index offsets from a cell to the cells one step further outwards, when a region grows by its `k`-th step (from
    /// 1): for even and for odd rows. On pixels every other step goes along rows and columns only: eight corners are
    /// rounder than four.
    pub(super) fn step_offsets(&self, k: usize) -> [Vec<isize>; 2] {
        [false, true].map(|odd| {
            let straight =
                |[r, c]: &[isize; 2]| self.hexagonal || k.is_multiple_of(2) || r * c == 0;
            let steps = self.steps(odd).into_iter().filter(straight);
            steps.map(|step| self.offset(step)).collect()
        })
    }

    pub(super) fn is_odd(&self, cell: usize) -> bool {
        (cell / self.stride) % 2 == 1
    }

    /// Number of a cell's neighbours.
    pub(super) fn directions(&self) -> usize {
        self.offsets[0].len()
    }

    /// The neighbour of a cell in a direction, counted by angle, so that opposite ones are half of all apart.
    pub(super) fn neighbour(&self, cell: usize, direction: usize) -> usize {
        let offsets = &self.offsets[usize::from(self.is_odd(cell))];
        cell.wrapping_add_signed(offsets[direction])
    }

    pub(super) fn neighbours(&self, cell: usize) -> impl Iterator<Item = usize> {
        let offsets = &self.offsets[usize::from(self.is_odd(cell))];
        offsets.iter().map(move |o| cell.wrapping_add_signed(*o))
    }

    /// Position of the cell that is some rows and columns away from one in an even or odd row, in distances between
    /// neighbours.
    pub(super) fn place(&self, odd: bool, [row, col]: [isize; 2]) -> [f64; 2] {
        let shift = |odd: bool| if odd { 0.5 } else { 0.0 };
        match self.hexagonal {
            true => {
                let there = odd ^ (row.rem_euclid(2) == 1);
                [
                    col as f64 - shift(there) + shift(odd),
                    -(row as f64) * ROW_SPACING,
                ]
            }
            false => [col as f64, -(row as f64)],
        }
    }

    /// Index offsets to the other cells of each smallest shape two cells across that has a cell as a corner: triangles
    /// on the lattice, a square on pixels.
    pub(super) fn pairs(&self, odd: bool) -> Vec<Vec<isize>> {
        let steps: Vec<isize> = self
            .steps(odd)
            .into_iter()
            .map(|s| self.offset(s))
            .collect();
        match self.hexagonal {
            true => (0..6).map(|k| vec![steps[k], steps[(k + 1) % 6]]).collect(),
            false => (0..8)
                .step_by(2)
                .map(|k| vec![steps[k], steps[k + 1], steps[(k + 2) % 8]])
                .collect(),
        }
    }
}

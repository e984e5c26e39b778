//! A raster of vertices or pixels with a margin around it, and the neighbours of each cell.

use crate::error::{Result, try_filled};
use crate::lattice::hexagonal::{NEIGHBOUR_DIRECTIONS, ROW_SPACING};

/// A raster of cells in rows, counted over the padded box, so that neighbours are at offsets that depend on the
/// parity of the row alone.
pub(super) struct Raster {
    hexagonal: bool,
    rows: usize,
    cols: usize,
    /// Number of cells beyond the data on each side, which is even.
    margin: usize,
    pub stride: usize,
    pub height: usize,
    /// Offsets to the neighbours, from even and from odd rows.
    offsets: [Vec<isize>; 2],
}

impl Raster {
    pub(super) fn hexagonal(rows: usize, cols: usize, width: usize) -> Result<Self> {
        Raster::new(true, rows, cols, width)
    }

    pub(super) fn square(rows: usize, cols: usize, width: usize) -> Result<Self> {
        Raster::new(false, rows, cols, width)
    }

    /// A raster with a margin a little wider than `width`.
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

    /// Copies the values of the data to the padded box, with the value `beyond` in the margin.
    pub(super) fn padded(&self, values: &[f64], beyond: f64) -> Result<Vec<f64>> {
        let mut padded = try_filled("bridged holes", self.cells(), beyond)?;
        for (row, values) in values.chunks(self.cols).enumerate() {
            let start = (row + self.margin) * self.stride + self.margin;
            padded[start..start + self.cols].copy_from_slice(values);
        }
        Ok(padded)
    }

    /// Index in the data's arrays of a cell that is not in the margin.
    pub(super) fn index(&self, cell: usize) -> usize {
        let (row, col) = (
            cell / self.stride - self.margin,
            cell % self.stride - self.margin,
        );
        row * self.cols + col
    }

    /// Whether a cell is not in the margin.
    pub(super) fn is_inside(&self, cell: usize) -> bool {
        let (row, col) = (cell / self.stride, cell % self.stride);
        let within = |i: usize, n: usize| (self.margin..self.margin + n).contains(&i);
        within(row, self.rows) && within(col, self.cols)
    }

    /// Offset from a cell in an even or odd row to another one some rows and columns away.
    fn offset(&self, [row, col]: [isize; 2]) -> isize {
        row * self.stride as isize + col
    }

    /// Steps in rows and columns to the neighbours, from a row of this parity, in the order of their angles.
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

    /// Offsets to the cells of the `k`-th step outwards, counted from 1, from even and from odd rows. On pixels
    /// every other step goes along rows and columns alone: eight corners are rounder than four.
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

    pub(super) fn neighbours(&self, cell: usize) -> impl Iterator<Item = usize> {
        let offsets = &self.offsets[usize::from(self.is_odd(cell))];
        offsets.iter().map(move |o| cell.wrapping_add_signed(*o))
    }

    /// Position of a cell some rows and columns away from one in a row of this parity, in distances between
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

    /// Offsets to the other cells of the smallest shapes that are two across and have a cell as one corner:
    /// triangles, or a square.
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

//! The matrix of the global step: the cotangent Laplacian of the surface, with a weight for each edge
//! of the lattice (Pinkall and Polthier 1993).
//!
//! The lattice's triangles nest in those of the lattice of twice the spacing. So the Galerkin
//! matrix of linear interpolation also has a weight for each edge: each fine edge is
//! parallel to one coarse edge, sees half its difference, and adds a quarter of its weight to it.

use super::lattice_triangles::LatticeTriangles;
use super::padded_lattice::PaddedLattice;
use crate::error::{Result, try_filled};
use crate::math::lanes;
use wide::f32x4;

/// The cotangent Laplacian of a heightfield on the padded lattice, stored as the weights of the edges from each cell to
/// its neighbours in the east, south-west and south-east.
#[derive(Debug, Clone)]
pub(super) struct Laplacian {
    pub grid: PaddedLattice,
    east: Vec<f32>,
    south_west: Vec<f32>,
    south_east: Vec<f32>,
    diagonal: Vec<f32>,
    /// Inverse of the matrix's diagonal; 0 at vertices without edges.
    pub inverse: Vec<f32>,
    /// Upper bound of the eigenvalues of the matrix divided by its diagonal (`D⁻¹A`).
    pub largest: f32,
}

impl Laplacian {
    /// Creates the cotangent Laplacian of a heightfield's triangles.
    pub(super) fn new(triangles: &LatticeTriangles) -> Result<Self> {
        let grid = triangles.grid;
        let mut out = Laplacian::zero(grid)?;
        for row in 0..grid.rows() {
            let offsets = grid.offsets(row);
            for cell in grid.row(row) {
                let [down, side] = &triangles.of[cell];
                let sw = cell.wrapping_add_signed(offsets.south_west);
                let [down, side] = [down.weights, side.weights].map(|w| w.map(lanes::single));
                out.south_west[cell] += down[0];
                out.east[sw] += down[1];
                out.south_east[cell] += down[2] + side[0];
                out.south_west[cell + 1] += side[1];
                out.east[cell] += side[2];
            }
        }
        out.set_diagonal();
        Ok(out)
    }

    /// Computes the Galerkin matrix on the lattice of twice the spacing, for functions that are linear on its
    /// triangles.
    pub(super) fn coarse(&self) -> Result<Self> {
        let fine = self.grid;
        let grid = fine.coarse();
        let mut out = Laplacian::zero(grid)?;
        for row in 0..grid.rows() {
            // Coarse rows are even fine rows.
            let offsets = fine.offsets(2 * row);
            for (col, cell) in grid.row(row).enumerate() {
                let a = fine.cell_of_coarse(row, col);
                let at = |offset: isize| a.wrapping_add_signed(offset);
                let (sw, se) = (at(offsets.south_west), at(offsets.south_east));
                let (ne, w, e) = (at(offsets.north_east), at(-1), at(1));
                // The two halves of the edge, and what is parallel on either side.
                let quarter = |weights: &[f32], edges: [usize; 4]| -> f32 {
                    0.25 * edges.iter().map(|edge| weights[*edge]).sum::<f32>()
                };
                out.east[cell] = quarter(&self.east, [a, e, se, ne]);
                out.south_west[cell] = quarter(&self.south_west, [a, sw, se, w]);
                out.south_east[cell] = quarter(&self.south_east, [a, se, e, sw]);
            }
        }
        out.set_diagonal();
        Ok(out)
    }

    /// Creates the Laplacian of a lattice without edges, all of whose entries are 0.
    fn zero(grid: PaddedLattice) -> Result<Self> {
        let zeros = || try_filled("unrolling", grid.cells(), 0.0);
        Ok(Laplacian {
            grid,
            east: zeros()?,
            south_west: zeros()?,
            south_east: zeros()?,
            diagonal: zeros()?,
            inverse: zeros()?,
            largest: 2.0,
        })
    }

    /// Computes each diagonal entry as the sum of the weights of the vertex's edges, and bounds the eigenvalues.
    fn set_diagonal(&mut self) {
        let grid = self.grid;
        let mut largest = 0.0f32;
        for row in 0..grid.rows() {
            let offsets = grid.offsets(row);
            for cell in grid.row(row) {
                let ne = cell.wrapping_add_signed(offsets.north_east);
                let nw = cell.wrapping_add_signed(offsets.north_west);
                let weights = [
                    self.east[cell],
                    self.east[cell - 1],
                    self.south_west[cell],
                    self.south_west[ne],
                    self.south_east[cell],
                    self.south_east[nw],
                ];
                let sum: f32 = weights.iter().sum();
                if sum > 0.0 {
                    self.diagonal[cell] = sum;
                    self.inverse[cell] = 1.0 / sum;
                    let magnitudes: f32 = weights.iter().map(|w| w.abs()).sum();
                    largest = largest.max(1.0 + magnitudes / sum);
                }
            }
        }
        // Gershgorin's bound; and 3, for each triangle's own matrix has that trace over its own
        // diagonal.
        self.largest = largest.min(3.0);
    }

    /// Makes one damped Jacobi step, which smooths the error: `next ← x + ω D⁻¹ (b − A x)`.
    pub(super) fn smooth(&self, omega: f32, b: &[f32], x: &[f32], next: &mut [f32]) {
        for row in 0..self.grid.rows() {
            let cells = self.grid.row(row);
            let near = RowStencil::new(self, row, x);
            let (b, inverse) = (&b[cells.clone()], &self.inverse[cells.clone()]);
            let next = &mut next[cells];
            let (blocks, tail) = next.as_chunks_mut::<CELLS_PER_VECTOR>();
            let mut first = 0;
            for next in blocks {
                let (b, inverse) = (load(b, first), load(inverse, first));
                let step = f32x4::splat(omega) * inverse * (b - near.products(first));
                *next = (load(near.centre, first) + step).to_array();
                first += CELLS_PER_VECTOR;
            }
            for (i, next) in (first..).zip(tail) {
                *next = near.centre[i] + omega * inverse[i] * (b[i] - near.product(i));
            }
        }
    }

    /// Computes the residual of the linear system: `out ← b − A x`.
    pub(super) fn residual(&self, b: &[f32], x: &[f32], out: &mut [f32]) {
        for row in 0..self.grid.rows() {
            let cells = self.grid.row(row);
            let near = RowStencil::new(self, row, x);
            let (b, out) = (&b[cells.clone()], &mut out[cells]);
            near.write_products(out);
            for (out, b) in out.iter_mut().zip(b) {
                *out = b - *out;
            }
        }
    }

    /// Computes the product of matrix and vector: `out ← A x`. Returns `x·Ax`.
    pub(super) fn apply(&self, x: &[f32], out: &mut [f32]) -> f64 {
        let mut product = 0.0;
        for row in 0..self.grid.rows() {
            let cells = self.grid.row(row);
            let out = &mut out[cells.clone()];
            RowStencil::new(self, row, x).write_products(out);
            product += lanes::dot(&x[cells], out);
        }
        product
    }
}

/// Number of cells of a row whose products are computed at once.
const CELLS_PER_VECTOR: usize = 4;

/// Loads consecutive values of a row.
#[inline(always)]
fn load(values: &[f32], first: usize) -> f32x4 {
    match values[first..].first_chunk::<CELLS_PER_VECTOR>() {
        Some(lanes) => f32x4::from(*lanes),
        None => f32x4::splat(0.0),
    }
}

/// One row of the matrix and of the vector that it is applied to, as slices of the row's length.
struct RowStencil<'a> {
    diagonal: &'a [f32],
    /// Weights of the matrix's edges from each vertex of the row to its neighbours W, E, NW, NE, SW, SE.
    weights: [&'a [f32]; 6],
    centre: &'a [f32],
    /// Values of the vector at the neighbours W, E, NW, NE, SW, SE of each vertex of the row.
    values: [&'a [f32]; 6],
}

impl<'a> RowStencil<'a> {
    #[inline(always)]
    fn new(matrix: &'a Laplacian, row: usize, x: &'a [f32]) -> Self {
        let cells = matrix.grid.row(row);
        let offsets = matrix.grid.offsets(row);
        let n = cells.len();
        let at = |field: &'a [f32], offset: isize| -> &'a [f32] {
            &field[cells.start.wrapping_add_signed(offset)..][..n]
        };
        RowStencil {
            diagonal: at(&matrix.diagonal, 0),
            weights: [
                at(&matrix.east, -1),
                at(&matrix.east, 0),
                at(&matrix.south_east, offsets.north_west),
                at(&matrix.south_west, offsets.north_east),
                at(&matrix.south_west, 0),
                at(&matrix.south_east, 0),
            ],
            centre: at(x, 0),
            values: offsets.all().map(|offset| at(x, offset)),
        }
    }

    #[inline(always)]
    fn product(&self, i: usize) -> f32 {
        let ([a, b, c, d, e, f], [p, q, r, s, t, u]) = (self.weights, self.values);
        let around = (a[i] * p[i] + b[i] * q[i]) + (c[i] * r[i] + d[i] * s[i]);
        self.diagonal[i] * self.centre[i] - (around + (e[i] * t[i] + f[i] * u[i]))
    }

    /// Computes the products of [`CELLS_PER_VECTOR`] cells at once. The compiler for wasm does not vectorise [`RowStencil::product`].
    #[inline(always)]
    fn products(&self, first: usize) -> f32x4 {
        let ([a, b, c, d, e, f], [p, q, r, s, t, u]) = (self.weights, self.values);
        let at = first;
        let around = (load(a, at) * load(p, at) + load(b, at) * load(q, at))
            + (load(c, at) * load(r, at) + load(d, at) * load(s, at));
        let further = load(e, at) * load(t, at) + load(f, at) * load(u, at);
        load(self.diagonal, at) * load(self.centre, at) - (around + further)
    }

    /// Writes the product of each cell of the row.
    #[inline(always)]
    fn write_products(&self, out: &mut [f32]) {
        let (blocks, tail) = out.as_chunks_mut::<CELLS_PER_VECTOR>();
        let mut first = 0;
        for out in blocks {
            *out = self.products(first).to_array();
            first += CELLS_PER_VECTOR;
        }
        for (i, out) in (first..).zip(tail) {
            *out = self.product(i);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::unroll::multigrid::interpolate;

    /// A bumpy surface with a hole and a ragged edge.
    fn triangles(rows: usize, cols: usize) -> LatticeTriangles {
        let grid = PaddedLattice::new(rows, cols);
        let mut heights = vec![f64::NAN; grid.cells()];
        for row in 0..rows {
            for (col, cell) in grid.row(row).enumerate() {
                let hole = row.abs_diff(5) < 2 && col.abs_diff(4) < 2;
                if !hole && (row * 7 + col * 3) % 11 > 0 {
                    heights[cell] = (0.8 * row as f64).sin() + (0.5 * col as f64).cos();
                }
            }
        }
        LatticeTriangles::new(grid, &heights, |_| true).unwrap()
    }

    #[test]
    fn the_coarse_matrix_is_that_of_linear_interpolation() {
        for (rows, cols) in [(12, 9), (13, 10), (9, 14), (10, 13)] {
            let fine = Laplacian::new(&triangles(rows, cols)).unwrap();
            let coarse = fine.coarse().unwrap();
            let mut x = vec![0.0f32; coarse.grid.cells()];
            for row in 0..coarse.grid.rows() {
                for (col, cell) in coarse.grid.row(row).enumerate() {
                    x[cell] = ((3 * row + 5 * col) % 7) as f32 - 3.0;
                }
            }
            let mut above = vec![0.0f32; fine.grid.cells()];
            interpolate(coarse.grid, &x, fine.grid, &mut above);
            let mut out = above.clone();
            let energy = fine.apply(&above, &mut out);
            let mut out = x.clone();
            let expected = coarse.apply(&x, &mut out);
            assert!(
                (energy - expected).abs() < 1e-4 * energy,
                "{energy} {expected}"
            );
        }
    }

    #[test]
    fn the_matrix_is_the_derivative_of_the_energy() {
        // With every triangle's rotation held, the energy is quadratic and its matrix the Laplacian:
        // translations do nothing, and scaling the plan costs what scaling the triangles does.
        let triangles = triangles(12, 9);
        let matrix = Laplacian::new(&triangles).unwrap();
        let ones = vec![1.0f32; triangles.grid.cells()];
        let mut out = ones.clone();
        matrix.apply(&ones, &mut out);
        for row in 0..triangles.grid.rows() {
            for cell in triangles.grid.row(row) {
                assert!(out[cell].abs() < 1e-5, "{}", out[cell]);
            }
        }
        assert!(matrix.largest >= 1.5 && matrix.largest <= 3.0);
    }
}

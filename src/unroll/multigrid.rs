//! The global step on lattices: conjugate gradients, preconditioned by a multigrid V-cycle.
//!
//! Both coordinates of the plane are solved for at once, as two right-hand sides of one system, in
//! single precision: the error of one step is in the next one's right-hand side.

use super::laplacian::Laplacian;
use super::padded_lattice::PaddedLattice;
use crate::error::{Result, try_filled};
use crate::math::lanes;

/// A field of plane vectors on the padded lattice: one array for each of the two coordinates.
pub(super) type PlaneField = [Vec<f32>; 2];

/// One lattice of the multigrid hierarchy with the fields that a V-cycle needs.
#[derive(Debug, Clone)]
struct MultigridLevel {
    matrix: Laplacian,
    right: PlaneField,
    solution: PlaneField,
    spare: Vec<f32>,
}

/// Solver of the global step's linear system: conjugate gradients with a multigrid V-cycle as preconditioner.
#[derive(Debug, Clone)]
pub(super) struct GlobalStep {
    /// Levels of the hierarchy, the finest first. The finest level's right-hand side is the residual of the conjugate
    /// gradients.
    levels: Vec<MultigridLevel>,
    direction: PlaneField,
    image: PlaneField,
    correction: PlaneField,
}

/// Weights of the two Jacobi steps of a smoothing pair, in units of one over the matrix's largest eigenvalue: the
/// inverse roots of the Chebyshev polynomial on the upper three quarters of the spectrum.
const SMOOTHER_WEIGHTS: [f32; 2] = [1.0 / (0.625 + 0.265_165), 1.0 / (0.625 - 0.265_165)];

/// Number of pairs of smoothing steps on the coarsest lattice of the hierarchy, which has a few cells.
const COARSEST_SMOOTHING_PAIRS: usize = 8;

impl GlobalStep {
    pub(super) fn new(matrix: Laplacian) -> Result<Self> {
        let mut levels = vec![MultigridLevel::new(matrix)?];
        while let Some(MultigridLevel { matrix, .. }) = levels.last()
            && matrix.grid.rows().min(matrix.grid.cols()) > 5
        {
            levels.push(MultigridLevel::new(matrix.coarse()?)?);
        }
        let cells = levels[0].matrix.grid.cells();
        Ok(GlobalStep {
            levels,
            direction: zero_field(cells)?,
            image: zero_field(cells)?,
            correction: zero_field(cells)?,
        })
    }

    /// Returns the right-hand side, to be written before [`GlobalStep::solve`], which overwrites it.
    pub(super) fn right_hand_side_mut(&mut self) -> &mut PlaneField {
        &mut self.levels[0].right
    }

    /// Solves the global step's linear system by some iterations of conjugate gradients from 0, and returns the
    /// solution.
    pub(super) fn solve(&mut self, iterations: usize) -> &PlaneField {
        let mut previous = 0.0;
        for field in &mut self.correction {
            field.fill(0.0);
        }
        for _ in 0..iterations {
            self.v_cycle();
            let MultigridLevel {
                matrix,
                right,
                solution,
                ..
            } = &mut self.levels[0];
            let grid = matrix.grid;
            let product = dot(grid, right, solution);
            let beta = if previous > 0.0 {
                (product / previous) as f32
            } else {
                0.0
            };
            let mut curvature = 0.0;
            let planes = self.direction.iter_mut().zip(&mut self.image);
            for ((direction, image), solution) in planes.zip(&*solution) {
                for (p, s) in direction.iter_mut().zip(solution) {
                    *p = s + beta * *p;
                }
                curvature += matrix.apply(direction, image);
            }
            if !(curvature > 0.0 && product > 0.0) {
                break; // nothing is left
            }
            let alpha = (product / curvature) as f32;
            for (correction, direction) in self.correction.iter_mut().zip(&self.direction) {
                add_scaled(correction, alpha, direction);
            }
            for (residual, image) in right.iter_mut().zip(&self.image) {
                add_scaled(residual, -alpha, image);
            }
            previous = product;
        }
        &self.correction
    }

    /// Applies one multigrid V-cycle, an approximate, symmetric inverse of the matrix, to the right-hand side.
    fn v_cycle(&mut self) {
        let last = self.levels.len() - 1;
        for i in 0..last {
            let (finer, coarser) = self.levels.split_at_mut(i + 1);
            let (fine, coarse) = (&mut finer[i], &mut coarser[0]);
            for k in 0..2 {
                fine.smooth_from_zero(k);
                fine.matrix
                    .residual(&fine.right[k], &fine.solution[k], &mut fine.spare);
                restrict(
                    fine.matrix.grid,
                    &fine.spare,
                    coarse.matrix.grid,
                    &mut coarse.right[k],
                );
            }
        }
        for k in 0..2 {
            let coarsest = &mut self.levels[last];
            coarsest.smooth_from_zero(k);
            (1..COARSEST_SMOOTHING_PAIRS).for_each(|_| coarsest.smooth(k));
        }
        for i in (0..last).rev() {
            let (finer, coarser) = self.levels.split_at_mut(i + 1);
            let (fine, coarse) = (&mut finer[i], &coarser[0]);
            for k in 0..2 {
                let (below, above) = (coarse.matrix.grid, fine.matrix.grid);
                interpolate(below, &coarse.solution[k], above, &mut fine.solution[k]);
                fine.smooth(k);
            }
        }
    }
}

impl MultigridLevel {
    fn new(matrix: Laplacian) -> Result<Self> {
        let cells = matrix.grid.cells();
        Ok(MultigridLevel {
            matrix,
            right: zero_field(cells)?,
            solution: zero_field(cells)?,
            spare: try_filled("unrolling", cells, 0.0)?,
        })
    }

    /// Makes a pair of damped Jacobi smoothing steps for one coordinate, from 0.
    fn smooth_from_zero(&mut self, k: usize) {
        let [first, second] = SMOOTHER_WEIGHTS.map(|weight| weight / self.matrix.largest);
        let inverse = self.matrix.inverse.iter().zip(&self.right[k]);
        for (x, (d, b)) in self.spare.iter_mut().zip(inverse) {
            *x = first * d * b;
        }
        // Clears the padding, too, where interpolation may have written.
        self.solution[k].fill(0.0);
        self.matrix
            .smooth(second, &self.right[k], &self.spare, &mut self.solution[k]);
    }

    /// Makes a pair of damped Jacobi smoothing steps for one coordinate of the solution.
    fn smooth(&mut self, k: usize) {
        let [first, second] = SMOOTHER_WEIGHTS.map(|weight| weight / self.matrix.largest);
        self.matrix
            .smooth(second, &self.right[k], &self.solution[k], &mut self.spare);
        self.matrix
            .smooth(first, &self.right[k], &self.spare, &mut self.solution[k]);
    }
}

/// Creates a field of plane vectors that are all 0.
fn zero_field(cells: usize) -> Result<PlaneField> {
    Ok([
        try_filled("unrolling", cells, 0.0)?,
        try_filled("unrolling", cells, 0.0)?,
    ])
}

/// Adds a multiple of one field to another: `to ← to + factor · values`.
fn add_scaled(to: &mut [f32], factor: f32, values: &[f32]) {
    for (x, v) in to.iter_mut().zip(values) {
        *x += factor * v;
    }
}

/// Computes the scalar product of two fields, without the padding.
fn dot(grid: PaddedLattice, a: &PlaneField, b: &PlaneField) -> f64 {
    let rows = (0..grid.rows()).map(|row| grid.row(row));
    rows.map(|cells| {
        let product = |k: usize| lanes::dot(&a[k][cells.clone()], &b[k][cells.clone()]);
        product(0) + product(1)
    })
    .sum()
}

/// Prolongation: adds to a field on the fine lattice the linear interpolation of a field on the coarse lattice.
pub(super) fn interpolate(
    coarse: PaddedLattice,
    values: &[f32],
    fine: PaddedLattice,
    out: &mut [f32],
) {
    for row in 0..coarse.rows() {
        let (near, below) = (coarse.offsets(row), fine.offsets(2 * row));
        for (col, cell) in coarse.row(row).enumerate() {
            let a = fine.cell_of_coarse(row, col);
            let value = values[cell];
            out[a] += value;
            let halves = [
                (1, 1),
                (near.south_west, below.south_west),
                (near.south_east, below.south_east),
            ];
            for (coarse, fine) in halves {
                let other = values[cell.wrapping_add_signed(coarse)];
                out[a.wrapping_add_signed(fine)] += 0.5 * (value + other);
            }
        }
    }
}

/// Restriction, the transpose of [`interpolate`]: overwrites a field on the coarse lattice with weighted sums of a
/// field on the fine lattice.
fn restrict(fine: PaddedLattice, values: &[f32], coarse: PaddedLattice, out: &mut [f32]) {
    for row in 0..coarse.rows() {
        let offsets = fine.offsets(2 * row).all();
        for (col, cell) in coarse.row(row).enumerate() {
            let a = fine.cell_of_coarse(row, col);
            let around: f32 = (offsets.iter())
                .map(|offset| values[a.wrapping_add_signed(*offset)])
                .sum();
            out[cell] = values[a] + 0.5 * around;
        }
    }
}

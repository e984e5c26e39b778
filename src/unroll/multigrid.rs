//! The global step: conjugate gradients on a correction, preconditioned by a V-cycle over the
//! lattices of twice, four times … the spacing.
//!
//! Both coordinates of the plane are solved for at once, as two right-hand sides of one system, in
//! single precision: what one step leaves is in the next one's right-hand side.

use super::grid::Grid;
use super::laplacian::Laplacian;
use crate::error::{Result, try_filled};
use crate::math::lanes;

/// The two coordinates, each a field over the padded cells.
pub(super) type Plane = [Vec<f32>; 2];

#[derive(Debug, Clone)]
struct Level {
    matrix: Laplacian,
    right: Plane,
    solution: Plane,
    spare: Vec<f32>,
}

#[derive(Debug, Clone)]
pub(super) struct GlobalStep {
    /// The finest first. Its right-hand side is the residual of the conjugate gradients.
    levels: Vec<Level>,
    direction: Plane,
    image: Plane,
    correction: Plane,
}

/// Damping of a pair of smoothing steps: the roots of the Chebyshev polynomial on the upper three
/// quarters of the spectrum, in units of its end.
const DAMPING: [f32; 2] = [1.0 / (0.625 + 0.265_165), 1.0 / (0.625 - 0.265_165)];

/// Pairs of smoothing steps on the coarsest lattice, which has a few cells.
const COARSEST: usize = 8;

impl GlobalStep {
    pub(super) fn new(matrix: Laplacian) -> Result<Self> {
        let mut levels = vec![Level::new(matrix)?];
        while let Some(Level { matrix, .. }) = levels.last()
            && matrix.grid.rows().min(matrix.grid.cols()) > 5
        {
            levels.push(Level::new(matrix.coarse()?)?);
        }
        let cells = levels[0].matrix.grid.cells();
        Ok(GlobalStep {
            levels,
            direction: plane(cells)?,
            image: plane(cells)?,
            correction: plane(cells)?,
        })
    }

    /// The right-hand side, to be written before [`GlobalStep::solve`], which uses it up.
    pub(super) fn right(&mut self) -> &mut Plane {
        &mut self.levels[0].right
    }

    /// The correction after some iterations.
    pub(super) fn solve(&mut self, iterations: usize) -> &Plane {
        let mut previous = 0.0;
        for field in &mut self.correction {
            field.fill(0.0);
        }
        for _ in 0..iterations {
            self.cycle();
            let Level {
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
                add(correction, alpha, direction);
            }
            for (residual, image) in right.iter_mut().zip(&self.image) {
                add(residual, -alpha, image);
            }
            previous = product;
        }
        &self.correction
    }

    /// One V-cycle: an approximate, symmetric inverse applied to the right-hand side.
    fn cycle(&mut self) {
        let last = self.levels.len() - 1;
        for i in 0..last {
            let (finer, coarser) = self.levels.split_at_mut(i + 1);
            let (fine, coarse) = (&mut finer[i], &mut coarser[0]);
            for k in 0..2 {
                fine.start(k);
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
            coarsest.start(k);
            (1..COARSEST).for_each(|_| coarsest.smooth(k));
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

impl Level {
    fn new(matrix: Laplacian) -> Result<Self> {
        let cells = matrix.grid.cells();
        Ok(Level {
            matrix,
            right: plane(cells)?,
            solution: plane(cells)?,
            spare: try_filled("unrolling", cells, 0.0)?,
        })
    }

    /// A pair of smoothing steps from zero.
    fn start(&mut self, k: usize) {
        let [first, second] = DAMPING.map(|damping| damping / self.matrix.largest);
        let inverse = self.matrix.inverse.iter().zip(&self.right[k]);
        for (x, (d, b)) in self.spare.iter_mut().zip(inverse) {
            *x = first * d * b;
        }
        // Padding too, where interpolation may have left something.
        self.solution[k].fill(0.0);
        self.matrix
            .smooth(second, &self.right[k], &self.spare, &mut self.solution[k]);
    }

    /// A pair of smoothing steps.
    fn smooth(&mut self, k: usize) {
        let [first, second] = DAMPING.map(|damping| damping / self.matrix.largest);
        self.matrix
            .smooth(second, &self.right[k], &self.solution[k], &mut self.spare);
        self.matrix
            .smooth(first, &self.right[k], &self.spare, &mut self.solution[k]);
    }
}

fn plane(cells: usize) -> Result<Plane> {
    Ok([
        try_filled("unrolling", cells, 0.0)?,
        try_filled("unrolling", cells, 0.0)?,
    ])
}

fn add(to: &mut [f32], factor: f32, values: &[f32]) {
    for (x, v) in to.iter_mut().zip(values) {
        *x += factor * v;
    }
}

fn dot(grid: Grid, a: &Plane, b: &Plane) -> f64 {
    let rows = (0..grid.rows()).map(|row| grid.row(row));
    rows.map(|cells| {
        let product = |k: usize| lanes::dot(&a[k][cells.clone()], &b[k][cells.clone()]);
        product(0) + product(1)
    })
    .sum()
}

/// Adds to the fine field what is linear between the values of the coarse one.
pub(super) fn interpolate(coarse: Grid, values: &[f32], fine: Grid, out: &mut [f32]) {
    for row in 0..coarse.rows() {
        let (near, below) = (coarse.offsets(row), fine.offsets(2 * row));
        for (col, cell) in coarse.row(row).enumerate() {
            let a = fine.below(row, col);
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

/// The transpose of [`interpolate`], in the place of what was there.
fn restrict(fine: Grid, values: &[f32], coarse: Grid, out: &mut [f32]) {
    for row in 0..coarse.rows() {
        let offsets = fine.offsets(2 * row).all();
        for (col, cell) in coarse.row(row).enumerate() {
            let a = fine.below(row, col);
            let around: f32 = (offsets.iter())
                .map(|offset| values[a.wrapping_add_signed(*offset)])
                .sum();
            out[cell] = values[a] + 0.5 * around;
        }
    }
}

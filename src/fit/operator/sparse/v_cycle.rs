//! Multigrid V-cycle, the solver of the z-step on large meshes.
//!
//! The coarse stiffness matrices are Galerkin products `PᵀCᵀCP`, so that the coarse correction does not overshoot, whatever
//! the interpolation `P`. Chebyshev's polynomial smooths before and after the correction. It is scaled by a diagonal
//! matrix that bounds the level's matrix from above, because an estimate of the largest eigenvalue may be too small
//! beside creases, and the cycle would not be positive definite.
//!
//! So the V-cycle is the exact solution for a symmetric matrix `M` in the place of the z-step's matrix `A`, with `M − A`
//! positive semidefinite. A z-step of one V-cycle minimises ADMM's Lagrangian plus `½‖z − zₖ‖²` in the norm of `M − A`,
//! and ADMM converges with it as with exact z-steps (proximal ADMM; Fazel, Pong, Sun and Tseng 2013).

use std::sync::Arc;

use super::matrix::SparseMatrix;
use super::{EntryGroup, SparseOperator, normal};
use crate::error::{Result, try_filled};
use crate::fit::operator::Operator;

/// Interpolations from each level's unknowns to those of the next finer level, the finest first.
pub(crate) type Interpolations = [Arc<SparseMatrix<f32>>];

/// Number of smoothing steps of a V-cycle on each level before and after the coarse correction (`benches/whole.md`, V-cycles).
const SMOOTHING_STEPS: usize = 1;

/// Ratio of the largest to the smallest eigenvalue whose error the smoother reduces; the coarse level reduces the errors of
/// smaller eigenvalues (`benches/whole.md`, V-cycles).
const SMOOTHED_EIGENVALUE_RATIO: f32 = 16.0;

/// Number of smoothing steps on the coarsest level of a V-cycle.
const BOTTOM_STEPS: usize = 6;

/// Ratio of the largest to the smallest eigenvalue whose error the steps on the coarsest level reduce.
const BOTTOM_EIGENVALUE_RATIO: f32 = 40.0;

/// V-cycle on the levels of a mesh.
#[derive(Debug, Clone)]
pub(super) struct VCycle {
    /// Levels, the finest first.
    levels: Vec<Level>,
    /// Factor of the stiffness matrices.
    rho: f32,
}

/// One level of a V-cycle with its work vectors. Its matrix is the diagonal `fidelity` plus ρ times the stiffness.
#[derive(Debug, Clone)]
struct Level {
    /// Stiffness matrix `PᵀCᵀCP`; `None` on the finest level, where it is the operator's.
    stiffness: Option<Arc<SparseMatrix<f32>>>,
    /// Interpolation from the next coarser level's unknowns; `None` on the coarsest level.
    interpolation: Option<Arc<SparseMatrix<f32>>>,
    /// Diagonal matrix that bounds the stiffness matrix from above.
    stiffness_bound: Vec<f32>,
    fidelity: Vec<f32>,
    /// Inverse of the diagonal matrix that bounds the level's matrix from above, and 0 at constrained vertices.
    inverse: Vec<f32>,
    right: Vec<f32>,
    x: Vec<f32>,
    step: Vec<f32>,
    image: Vec<f32>,
}

/// Multiplies an operator's rows, scaled by the roots of their weights, with an interpolation.
fn interpolated_rows(
    operator: &SparseOperator,
    interpolation: &SparseMatrix<f32>,
) -> Result<SparseMatrix<[f32; 3]>> {
    let weights = operator.single_rho_weights.iter().enumerate();
    let rows = weights.map(|(stencil, weight)| {
        let root = weight.sqrt();
        let lanes = move |four: &EntryGroup<f32>| {
            let EntryGroup { vertices, entries } = *four;
            std::array::from_fn::<_, { super::ROW_GROUP_ENTRIES }, _>(|lane| {
                (vertices[lane], entries.map(|row| root * row[lane]))
            })
        };
        operator.single.row(stencil).iter().flat_map(lanes)
    });
    interpolation.premultiply(rows, |sum: &mut [f32; 3], row, factor| {
        for (sum, entry) in sum.iter_mut().zip(row) {
            *sum += entry * factor;
        }
    })
}

/// Returns the Galerkin product `PᵀKP` of a matrix with an interpolation.
fn galerkin(
    matrix: &SparseMatrix<f32>,
    interpolation: &SparseMatrix<f32>,
) -> Result<SparseMatrix<f32>> {
    let add = |sum: &mut f32, a: &f32, b: &f32| *sum += a * b;
    let right = matrix.multiply(interpolation, add)?;
    interpolation.transpose()?.multiply(&right, add)
}

/// Computes an upper bound, as a diagonal matrix, of the Galerkin product of a diagonal matrix.
fn lump(diagonal: &[f32], interpolation: &SparseMatrix<f32>, coarse: &mut [f32]) {
    coarse.fill(0.0);
    for (row, entry) in diagonal.iter().enumerate() {
        let own = interpolation.row(row);
        let total: f32 = own.iter().map(|(_, factor)| factor.abs()).sum();
        for (column, factor) in own {
            coarse[*column as usize] += entry * total * factor.abs();
        }
    }
}

impl VCycle {
    /// Makes the levels for an operator and the interpolations from its coarser levels.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub(super) fn new(operator: &SparseOperator, interpolations: &Interpolations) -> Result<Self> {
        let mut levels: Vec<Level> = Vec::new();
        let mut stiffness: Option<Arc<SparseMatrix<f32>>> = None;
        for interpolation in interpolations.iter().map(Some).chain([None]) {
            let next = match (interpolation, &stiffness) {
                (Some(interpolation), Some(stiffness)) => {
                    Some(Arc::new(galerkin(stiffness, interpolation)?))
                }
                (Some(interpolation), None) => {
                    let rows = interpolated_rows(operator, interpolation)?;
                    let add = |sum: &mut f32, a: &[f32; 3], b: &[f32; 3]| {
                        *sum += a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
                    };
                    Some(Arc::new(rows.transpose()?.multiply(&rows, add)?))
                }
                (None, _) => None,
            };
            levels.push(Level::new(operator, stiffness, interpolation.cloned())?);
            stiffness = next;
        }
        Ok(VCycle { levels, rho: 0.0 })
    }

    /// Takes over ρ and the fidelity's part of the finest matrix; vertices without an `inverse` diagonal are constrained.
    pub(super) fn set_matrix(&mut self, rho: f32, fidelity: &[f32], inverse: &[f32]) {
        self.rho = rho;
        self.levels[0].fidelity.copy_from_slice(fidelity);
        for k in 0..self.levels.len() {
            let (finer, coarser) = self.levels.split_at_mut(k);
            let level = &mut coarser[0];
            if let Some(finer) = finer.last()
                && let Some(interpolation) = &finer.interpolation
            {
                lump(&finer.fidelity, interpolation, &mut level.fidelity);
            }
            let entries = level.fidelity.iter().zip(&level.stiffness_bound);
            for (inverse, (fidelity, stiffness)) in level.inverse.iter_mut().zip(entries) {
                let entry = fidelity + rho * stiffness;
                *inverse = if entry > 0.0 { 1.0 / entry } else { 0.0 };
            }
        }
        for (own, inverse) in self.levels[0].inverse.iter_mut().zip(inverse) {
            if *inverse == 0.0 {
                *own = 0.0;
            }
        }
    }

    /// Adds the V-cycle's approximate solution for a residual to `to`.
    pub(super) fn add_solution(
        &mut self,
        operator: &SparseOperator,
        residual: &[f32],
        to: &mut [f32],
    ) {
        self.levels[0].right.copy_from_slice(residual);
        self.run(operator, 0);
        for (to, more) in to.iter_mut().zip(&self.levels[0].x) {
            *to += more;
        }
    }

    fn run(&mut self, operator: &SparseOperator, k: usize) {
        let rho = self.rho;
        let level = &mut self.levels[k];
        let Some(interpolation) = level.interpolation.clone() else {
            return level.smooth(operator, rho, true, BOTTOM_STEPS, BOTTOM_EIGENVALUE_RATIO);
        };
        let (steps, ratio) = (SMOOTHING_STEPS, SMOOTHED_EIGENVALUE_RATIO);
        level.smooth(operator, rho, true, steps, ratio);
        level.compute_residual(operator, rho);
        let [level, coarse, ..] = &mut self.levels[k..] else {
            return;
        };
        coarse.right.fill(0.0);
        interpolation.add_transposed(&level.image, &mut coarse.right);
        self.run(operator, k + 1);
        let [level, coarse, ..] = &mut self.levels[k..] else {
            return;
        };
        for (row, x) in level.x.iter_mut().enumerate() {
            if level.inverse[row] > 0.0 {
                *x += interpolation.row_times(row, &coarse.x);
            }
        }
        level.smooth(operator, rho, false, steps, ratio);
    }
}

impl Level {
    fn new(
        operator: &SparseOperator,
        stiffness: Option<Arc<SparseMatrix<f32>>>,
        interpolation: Option<Arc<SparseMatrix<f32>>>,
    ) -> Result<Self> {
        let count = match &stiffness {
            Some(stiffness) => stiffness.rows(),
            None => operator.vertex_cells(),
        };
        let zeros = || try_filled("multigrid", count, 0.0f32);
        let mut stiffness_bound = zeros()?;
        match &stiffness {
            Some(stiffness) => {
                for (row, entry) in stiffness_bound.iter_mut().enumerate() {
                    *entry = stiffness.row(row).iter().map(|(_, a)| a.abs()).sum();
                }
            }
            None => operator.bound_normal(&mut stiffness_bound),
        }
        Ok(Level {
            stiffness,
            interpolation,
            stiffness_bound,
            fidelity: zeros()?,
            inverse: zeros()?,
            right: zeros()?,
            x: zeros()?,
            step: zeros()?,
            image: zeros()?,
        })
    }

    /// Computes the product of the level's matrix with `x` and writes it to `image`.
    fn multiply(&mut self, operator: &SparseOperator, rho: f32) {
        let Level { image, x, .. } = self;
        match &self.stiffness {
            Some(stiffness) => {
                for (row, image) in image.iter_mut().enumerate() {
                    *image = stiffness.row_times(row, x);
                }
            }
            None => normal(&operator.single, &operator.single_rho_weights, x, image),
        }
        for (i, image) in image.iter_mut().enumerate() {
            *image = self.fidelity[i] * x[i] + rho * *image;
        }
    }

    /// Writes the residual of `x` to `image`.
    fn compute_residual(&mut self, operator: &SparseOperator, rho: f32) {
        self.multiply(operator, rho);
        for (image, right) in self.image.iter_mut().zip(&self.right) {
            *image = right - *image;
        }
    }

    /// Takes steps of Chebyshev's iteration, from 0 or from `x` as it is.
    fn smooth(
        &mut self,
        operator: &SparseOperator,
        rho: f32,
        is_from_zero: bool,
        steps: usize,
        ratio: f32,
    ) {
        // Scaled by the bound's inverse, the matrix has no eigenvalue above 1.
        let smallest = 1.0 / ratio;
        let (middle, half) = (0.5 * (1.0 + smallest), 0.5 * (1.0 - smallest));
        let sigma = middle / half;
        let mut last = 1.0 / sigma;
        for k in 0..steps {
            if k == 0 && is_from_zero {
                self.x.fill(0.0);
                self.image.copy_from_slice(&self.right);
            } else {
                self.compute_residual(operator, rho);
            }
            let (old, new) = if k == 0 {
                (0.0, 1.0 / middle)
            } else {
                let next = 1.0 / (2.0 * sigma - last);
                let factors = (next * last, 2.0 * next / half);
                last = next;
                factors
            };
            for (i, x) in self.x.iter_mut().enumerate() {
                let step = &mut self.step[i];
                *step = old * *step + new * self.inverse[i] * self.image[i];
                *x += *step;
            }
        }
    }
}

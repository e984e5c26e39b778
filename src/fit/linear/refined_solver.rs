//! Conjugate gradients in double precision for the z-step's linear system.
//!
//! Without a fidelity term everywhere, its condition number grows with the fourth power of the domain's size in
//! cells, and single precision does not resolve the smooth part of the residual any more. A V-cycle in single
//! precision is a good preconditioner all the same.

use super::multigrid::Multigrid;
use crate::error::{Result, try_filled};
use crate::fit::heightfields::Problem;
use crate::lattice::stencil::{Ring, Rolling, weights_of};
use crate::math::lanes;

/// Conjugate gradients in double precision for the z-step's system `A x = b`, `A = 2λw + ρCᵀC`, over the vertices that
/// are not constrained.
pub(crate) struct RefinedSolver {
    /// Residual `b − A x`, to be written before a solve; 0 outside the domain's active vertices.
    pub residual: Vec<f64>,
    direction: Vec<f64>,
    image: Vec<f64>,
    single: Vec<f32>,
    rolling: Rolling<f64>,
}

impl RefinedSolver {
    /// Allocates the solver of a problem, with a residual of 0.
    pub(crate) fn new(problem: &Problem) -> Result<Self> {
        let cells = problem.operator.domain.cells();
        let zeros = || try_filled("conjugate gradients", cells, 0.0);
        Ok(RefinedSolver {
            residual: zeros()?,
            direction: zeros()?,
            image: zeros()?,
            single: try_filled("conjugate gradients", cells, 0.0)?,
            rolling: Rolling::new(&problem.operator.domain),
        })
    }

    /// Sets the residual to `2λw z̃ − A z`: that of the z-step at heights `z` with Hessians and dual 0.
    pub(crate) fn start(&mut self, problem: &Problem, rho: f64, z: &[f64]) {
        self.direction.copy_from_slice(z);
        self.apply(problem, rho);
        let fidelity = 2.0 * problem.lambda;
        for cell in problem.operator.domain.active().cells() {
            let given = fidelity * problem.fidelity.at(cell) * problem.target[cell];
            self.residual[cell] = given - self.image[cell];
        }
    }

    /// Improves `x` by conjugate gradients until the residual's [`distance`](Self::distance) is at most a goal, or for
    /// a maximum number of steps. Returns the number of steps taken.
    pub(crate) fn solve(
        &mut self,
        problem: &Problem,
        rho: f64,
        multigrid: &mut Multigrid,
        x: &mut [f64],
        (goal, steps): (f64, usize),
    ) -> usize {
        for cell in &problem.constrained {
            self.residual[*cell as usize] = 0.0;
        }
        let cells = || problem.operator.domain.active().cells();
        let mut previous = 0.0;
        for step in 0..steps {
            let size = largest(&self.residual);
            if self.distance(problem, multigrid) <= goal {
                return step;
            }
            // The residual is scaled to unit size, so that it stays in the range of single precision.
            for cell in cells() {
                self.single[cell] = lanes::single(self.residual[cell] / size);
            }
            let unit = size / multigrid.matrix().diagonal;
            let preconditioned = multigrid.precondition(&mut self.single);
            let value = |cell: usize| unit * lanes::double(preconditioned[cell]);
            let product: f64 = cells().map(|c| self.residual[c] * value(c)).sum();
            let beta = if step > 0 { product / previous } else { 0.0 };
            for cell in cells() {
                self.direction[cell] = value(cell) + beta * self.direction[cell];
            }
            let curvature = self.apply(problem, rho);
            if !(product > 0.0 && curvature > 0.0) {
                return step;
            }
            let alpha = product / curvature;
            for cell in cells() {
                x[cell] += alpha * self.direction[cell];
                self.residual[cell] -= alpha * self.image[cell];
            }
            for cell in &problem.constrained {
                self.residual[*cell as usize] = 0.0;
            }
            previous = product;
        }
        steps
    }

    /// Measures the residual: the largest distance by which the residual at a single vertex would move its height if no
    /// other moved. This does not depend on weights of many orders of magnitude.
    pub(crate) fn distance(&self, problem: &Problem, multigrid: &Multigrid) -> f64 {
        let inverse = &multigrid.matrix().inverse_diagonal;
        let cells = problem.operator.domain.active().cells();
        let moved = cells.map(|cell| (self.residual[cell] * lanes::double(inverse[cell])).abs());
        moved.fold(0.0, f64::max)
    }

    /// Computes `image = A direction`, and returns the product of both vectors.
    fn apply(&mut self, problem: &Problem, rho: f64) -> f64 {
        let RefinedSolver {
            direction,
            image,
            rolling,
            ..
        } = self;
        let (domain, map) = (&problem.operator.domain, problem.operator.map);
        let fidelity = 2.0 * problem.lambda;
        let images = domain.bands().split(image);
        let mut states: Vec<_> = images.map(|image| (image, 0.0)).collect();
        rolling.sweep(
            domain,
            &mut states,
            |_, row, weights| {
                for run in domain.interior().row(row) {
                    let ring = Ring::new(direction, domain, row, *run);
                    let [w1, w2, w3] = weights_of(weights, domain, row, *run);
                    for i in 0..w1.len() {
                        let [d1, d2, d3] = map.normal(ring.differences(i));
                        (w1[i], w2[i], w3[i]) = (rho * d1, rho * d2, rho * d3);
                    }
                }
            },
            |(image, product), row, sums| {
                for run in domain.active().row(row) {
                    let sum = sums.run(*run);
                    let weight = problem.fidelity.run(*run);
                    let direction = &direction[run.start..run.end];
                    for (i, image) in image.run_mut(*run).iter_mut().enumerate() {
                        let value = fidelity * weight[i] * direction[i] + sum.at(i);
                        *image = value;
                        *product += direction[i] * value;
                    }
                }
            },
        );
        states.iter().map(|(_, product)| product).sum()
    }
}

/// Returns the largest absolute value.
fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0f64, |m, v| m.max(v.abs()))
}

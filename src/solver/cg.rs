//! Conjugate gradients for the z-step, matrix-free, with Jacobi's preconditioner:
//!
//! ```text
//! A z = b,   A = 2λ + ρ CᵀC,   b = 2λ z̃ + Cᵀ(ρH − Y)
//! ```
//!
//! What is solved is the correction `A δ = b − A z`. Its right-hand side is made
//! in double precision, so the correction itself can live in single precision:
//! half the memory traffic, twice the lanes, and the errors of one z-step are
//! the next one's right-hand side. The system is scaled to a unit diagonal and
//! heights of unit size, so that no λ, ρ or spacing leaves the range of `f32`.
//!
//! An iteration makes two passes over memory: one that finds the direction and
//! applies `A` to it, one that moves.

use super::lanes;
use super::problem::Problem;
use crate::domain::{Domain, Role, Run};
use crate::error::{Result, try_filled};
use crate::stencil::{Ring, Rolling, weights_of};

#[derive(Debug, Clone)]
pub(crate) struct ConjugateGradients {
    /// `b − A z`, in the system's scale: whoever changes `b` or `z` writes it
    /// (times [`Self::residual_scale`]) and calls [`Self::restart`].
    pub residual: Vec<f32>,
    correction: Vec<f32>,
    direction: Vec<f32>,
    image: Vec<f32>,
    inverse_diagonal: Vec<f32>,
    rolling: Rolling<f32>,
    matrix: Matrix,
    /// Heights of size 1 in the system's scale.
    unit: f64,
    /// `r·M⁻¹r`.
    energy: f64,
    /// Factor of the previous direction in the next one.
    beta: f32,
}

/// `A`, divided by the diagonal that it has away from the boundary.
#[derive(Debug, Clone, Copy)]
struct Matrix {
    scale: f64,
    fidelity: f32,
    /// The weights of `d_k` and of `d₁ + d₂ + d₃` in `ρ C^T C`.
    own: f32,
    sum: f32,
}

impl Matrix {
    fn new(problem: &Problem, rho: f64) -> Self {
        let [own, other, _] = problem.map.normal([1.0, 0.0, 0.0]).map(|q| rho * q);
        let diagonal = 2.0 * problem.lambda + diagonal(own, other, true, 6);
        Matrix {
            scale: 1.0 / diagonal,
            fidelity: (2.0 * problem.lambda / diagonal) as f32,
            own: ((own - other) / diagonal) as f32,
            sum: (other / diagonal) as f32,
        }
    }
}

/// The diagonal of a quadratic form in the second differences, with `own` on
/// and `other` off its own diagonal, at a vertex that is the centre of a
/// stencil or not and a neighbour in `stencils` others.
fn diagonal(own: f64, other: f64, centre: bool, stencils: usize) -> f64 {
    let as_centre = if centre {
        4.0 * (3.0 * own + 6.0 * other)
    } else {
        0.0
    };
    as_centre + stencils as f64 * own
}

impl ConjugateGradients {
    pub(crate) fn new(problem: &Problem, rho: f64) -> Result<Self> {
        let zeros = || try_filled("conjugate gradients", problem.domain.cells(), 0.0);
        let largest = problem.target.iter().fold(0.0f64, |m, z| m.max(z.abs()));
        let mut cg = ConjugateGradients {
            residual: zeros()?,
            correction: zeros()?,
            direction: zeros()?,
            image: zeros()?,
            inverse_diagonal: zeros()?,
            rolling: Rolling::new(&problem.domain),
            matrix: Matrix::new(problem, rho),
            unit: if largest > 0.0 { largest } else { 1.0 },
            energy: 0.0,
            beta: 0.0,
        };
        cg.set_rho(problem, rho);
        Ok(cg)
    }

    /// Changes `A`; the residual must be made anew.
    pub(crate) fn set_rho(&mut self, problem: &Problem, rho: f64) {
        self.matrix = Matrix::new(problem, rho);
        let domain = &problem.domain;
        let [own, other, _] = problem.map.normal([1.0, 0.0, 0.0]).map(|q| rho * q);
        let interior = |cell: usize| domain.roles()[cell] == Role::Interior;
        for row in 1..=domain.rows() {
            let offsets = domain.neighbour_offsets(row);
            for &Run { start, end } in domain.active().row(row) {
                for cell in start..end {
                    let stencils = offsets
                        .iter()
                        .filter(|o| interior(cell.wrapping_add_signed(**o)))
                        .count();
                    let value =
                        2.0 * problem.lambda + diagonal(own, other, interior(cell), stencils);
                    self.inverse_diagonal[cell] = (1.0 / (value * self.matrix.scale)) as f32;
                }
            }
        }
    }

    /// Factor from `b − A z` to the system's scale.
    pub(crate) fn residual_scale(&self) -> f64 {
        self.matrix.scale / self.unit
    }

    /// Starts anew from the residual that was just written.
    pub(crate) fn restart(&mut self, domain: &Domain) {
        self.beta = 0.0;
        self.energy = 0.0;
        for &Run { start, end } in domain.active().all() {
            self.correction[start..end].fill(0.0);
            self.energy += lanes::weighted_square(
                &self.residual[start..end],
                &self.inverse_diagonal[start..end],
            );
        }
    }

    /// The residual's size in the preconditioner's norm, relative to that of `2λ z̃`.
    pub(crate) fn relative_residual(&self, problem: &Problem) -> f64 {
        let reference: f64 = problem
            .domain
            .active()
            .cells()
            .map(|cell| problem.target[cell].powi(2) * f64::from(self.inverse_diagonal[cell]))
            .sum();
        let scale = f64::from(self.matrix.fidelity) / self.unit;
        (self.energy / (scale * scale * reference)).sqrt()
    }

    /// Current `r·M⁻¹r`.
    pub(crate) fn energy(&self) -> f64 {
        self.energy
    }

    /// Adds the correction found so far to `z`.
    pub(crate) fn correct(&self, domain: &Domain, z: &mut [f64]) {
        for &Run { start, end } in domain.active().all() {
            for (z, delta) in z[start..end].iter_mut().zip(&self.correction[start..end]) {
                *z += self.unit * f64::from(*delta);
            }
        }
    }

    /// One iteration on the correction. Returns `false`, and changes nothing,
    /// when the residual is zero.
    pub(crate) fn step(&mut self, problem: &Problem) -> bool {
        if self.energy <= 0.0 {
            return false;
        }
        let curvature = self.apply_to_direction(&problem.domain);
        if curvature <= 0.0 {
            return false;
        }
        let alpha = (self.energy / curvature) as f32;
        let mut energy = 0.0;
        for &Run { start, end } in problem.domain.active().all() {
            let correction = &mut self.correction[start..end];
            let n = correction.len();
            let residual = &mut self.residual[start..end][..n];
            let direction = &self.direction[start..end][..n];
            let image = &self.image[start..end][..n];
            let inverse = &self.inverse_diagonal[start..end][..n];
            for i in 0..n {
                correction[i] += alpha * direction[i];
                residual[i] -= alpha * image[i];
            }
            energy += lanes::weighted_square(residual, inverse);
        }
        self.beta = (energy / self.energy) as f32;
        self.energy = energy;
        true
    }

    /// Makes the next direction `p`, writes `A p`, returns `p·A p`.
    fn apply_to_direction(&mut self, domain: &Domain) -> f64 {
        let Self {
            residual,
            direction,
            image,
            inverse_diagonal,
            rolling,
            beta,
            matrix,
            ..
        } = self;
        let (beta, matrix) = (*beta, *matrix);
        let next_direction = |direction: &mut [f32], row: usize| {
            for &Run { start, end } in domain.active().row(row) {
                let direction = &mut direction[start..end];
                let n = direction.len();
                let residual = &residual[start..end][..n];
                let inverse = &inverse_diagonal[start..end][..n];
                for i in 0..n {
                    direction[i] = inverse[i] * residual[i] + beta * direction[i];
                }
            }
        };
        let mut curvature = 0.0;
        rolling.sweep(
            domain,
            direction,
            |direction, row, weights| {
                // The differences of this row need the directions of the row below it.
                if row == 1 {
                    next_direction(direction, row);
                }
                if row < domain.rows() {
                    next_direction(direction, row + 1);
                }
                for run in domain.interior().row(row) {
                    let ring = Ring::new(direction, domain, row, *run);
                    let [w1, w2, w3] = weights_of(weights, domain, row, *run);
                    for i in 0..w1.len() {
                        let [d1, d2, d3] = ring.differences(i);
                        let sum = matrix.sum * (d1 + d2 + d3);
                        w1[i] = matrix.own * d1 + sum;
                        w2[i] = matrix.own * d2 + sum;
                        w3[i] = matrix.own * d3 + sum;
                    }
                }
            },
            |direction, row, sums| {
                for run in domain.active().row(row) {
                    let sum = sums.run(*run);
                    let direction = &direction[run.start..run.end];
                    let n = direction.len();
                    let image = &mut image[run.start..run.end][..n];
                    for i in 0..n {
                        image[i] = matrix.fidelity * direction[i] + sum.at(i);
                    }
                    curvature += lanes::dot(direction, image);
                }
            },
        );
        curvature
    }
}

//! Conjugate gradients for the z-step, matrix-free, with Jacobi's preconditioner:
//!
//! ```text
//! A z = b,   A = 2λ + ρ CᵀC,   b = 2λ z̃ + Cᵀ(ρH − Y)
//! ```
//!
//! An iteration makes two passes over memory: one that finds the direction and
//! applies `A` to it, one that moves.

use super::lanes;
use super::problem::Problem;
use crate::domain::{Domain, Run};
use crate::error::{Result, try_filled};
use crate::stencil::{Ring, Rolling};

#[derive(Debug, Clone)]
pub(crate) struct ConjugateGradients {
    /// `b − A z`; whoever changes `b` or `z` writes it and calls [`Self::restart`].
    pub residual: Vec<f64>,
    direction: Vec<f64>,
    image: Vec<f64>,
    inverse_diagonal: Vec<f64>,
    rolling: Rolling,
    /// `r·M⁻¹r`.
    energy: f64,
    /// Factor of the previous direction in the next one.
    beta: f64,
    rho: f64,
}

impl ConjugateGradients {
    pub(crate) fn new(problem: &Problem, rho: f64) -> Result<Self> {
        let zeros = || try_filled("conjugate gradients", problem.domain.cells(), 0.0);
        let mut cg = ConjugateGradients {
            residual: zeros()?,
            direction: zeros()?,
            image: zeros()?,
            inverse_diagonal: zeros()?,
            rolling: Rolling::new(&problem.domain),
            energy: 0.0,
            beta: 0.0,
            rho,
        };
        cg.set_rho(problem, rho);
        Ok(cg)
    }

    /// Changes `A`; the residual must be made anew.
    pub(crate) fn set_rho(&mut self, problem: &Problem, rho: f64) {
        self.rho = rho;
        let domain = &problem.domain;
        // eᵀC ᵀCe, where the vertex is the centre of a stencil and where it is a neighbour.
        let form = |d: [f64; 3]| -> f64 {
            let q = problem.map.normal(d);
            d[0] * q[0] + d[1] * q[1] + d[2] * q[2]
        };
        let (centre, neighbour) = (form([-2.0; 3]), form([1.0, 0.0, 0.0]));
        let interior = |cell: usize| f64::from(domain.roles()[cell] == crate::Role::Interior);
        for row in 1..=domain.rows() {
            let offsets = domain.neighbour_offsets(row);
            for cell in cells(domain.active().row(row)) {
                let count: f64 = offsets
                    .iter()
                    .map(|o| interior(cell.wrapping_add_signed(*o)))
                    .sum();
                let diagonal = centre * interior(cell) + neighbour * count;
                self.inverse_diagonal[cell] = 1.0 / (2.0 * problem.lambda + rho * diagonal);
            }
        }
    }

    /// Starts anew from the residual that was just written.
    pub(crate) fn restart(&mut self, domain: &Domain) {
        self.beta = 0.0;
        self.energy = self.residual_energy(domain);
    }

    fn residual_energy(&self, domain: &Domain) -> f64 {
        let runs = domain.active().all().iter();
        runs.map(|run| {
            let (r, m) = (
                &self.residual[run.start..run.end],
                &self.inverse_diagonal[run.start..run.end],
            );
            lanes::sum(r.len(), |i| r[i] * r[i] * m[i])
        })
        .sum()
    }

    /// The residual's size in the preconditioner's norm, `√(r·M⁻¹r)`.
    pub(crate) fn residual_norm(&self) -> f64 {
        self.energy.sqrt()
    }

    /// The size of a right-hand side `2λ z̃` in the same norm.
    pub(crate) fn reference_norm(&self, problem: &Problem) -> f64 {
        let runs = problem.domain.active().all().iter();
        let sum: f64 = runs
            .map(|run| {
                let (t, m) = (
                    &problem.target[run.start..run.end],
                    &self.inverse_diagonal[run.start..run.end],
                );
                lanes::sum(t.len(), |i| t[i] * t[i] * m[i])
            })
            .sum();
        2.0 * problem.lambda * sum.sqrt()
    }

    /// One iteration on `z`. Returns `false`, and changes nothing, when the
    /// residual is zero.
    pub(crate) fn step(&mut self, problem: &Problem, z: &mut [f64]) -> bool {
        if self.energy <= 0.0 {
            return false;
        }
        let curvature = self.apply_to_direction(problem);
        if curvature <= 0.0 {
            return false;
        }
        let alpha = self.energy / curvature;
        let mut energy = 0.0;
        for &Run { start, end } in problem.domain.active().all() {
            let z = &mut z[start..end];
            let n = z.len();
            let residual = &mut self.residual[start..end][..n];
            let direction = &self.direction[start..end][..n];
            let image = &self.image[start..end][..n];
            let inverse = &self.inverse_diagonal[start..end][..n];
            energy += lanes::sum(n, |i| {
                z[i] += alpha * direction[i];
                let r = residual[i] - alpha * image[i];
                residual[i] = r;
                r * r * inverse[i]
            });
        }
        self.beta = energy / self.energy;
        self.energy = energy;
        true
    }

    /// Makes the next direction `p`, writes `A p`, returns `p·A p`.
    fn apply_to_direction(&mut self, problem: &Problem) -> f64 {
        let Self {
            residual,
            direction,
            image,
            inverse_diagonal,
            rolling,
            beta,
            rho,
            ..
        } = self;
        let domain = &problem.domain;
        let (beta, rho, fidelity) = (*beta, *rho, 2.0 * problem.lambda);
        let next_direction = |direction: &mut [f64], row: usize| {
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
                    let (col, n) = (run.start - row * domain.stride(), run.end - run.start);
                    let [w1, w2, w3] = weights;
                    let (w1, w2, w3) = (
                        &mut w1[col..][..n],
                        &mut w2[col..][..n],
                        &mut w3[col..][..n],
                    );
                    for i in 0..n {
                        let [q1, q2, q3] = problem.map.normal(ring.differences(i));
                        (w1[i], w2[i], w3[i]) = (rho * q1, rho * q2, rho * q3);
                    }
                }
            },
            |direction, row, sums| {
                for run in domain.active().row(row) {
                    let sum = sums.run(*run);
                    let direction = &direction[run.start..run.end];
                    let n = direction.len();
                    let image = &mut image[run.start..run.end][..n];
                    curvature += lanes::sum(n, |i| {
                        let value = fidelity * direction[i] + sum.at(i);
                        image[i] = value;
                        direction[i] * value
                    });
                }
            },
        );
        curvature
    }
}

fn cells(runs: &[Run]) -> impl Iterator<Item = usize> + '_ {
    runs.iter().flat_map(|run| run.start..run.end)
}

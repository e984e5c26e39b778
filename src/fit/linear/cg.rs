//! Conjugate gradients for the z-step on a lattice, matrix-free, preconditioned by a multigrid V-cycle:
//!
//! ```text
//! A z = b,   A = 2λ + ρ CᵀC,   b = 2λ z̃ + Cᵀ(ρH − Y)
//! ```
//!
//! The system is solved for the correction `A δ = b − A z`. Its right-hand side is made in double precision, so
//! that the correction itself can be in single precision: half the memory traffic, twice the lanes, and the
//! errors of one z-step are corrected in the next one. Heights are scaled to unit size, which keeps every
//! number within the range of `f32`.

use std::sync::Arc;

use super::grid::part;
use super::multigrid::Multigrid;
use super::refined_solver::RefinedSolver;
use super::z_step_solver::{CgCriteria, SolvableOperator, ZStepSolver};
use crate::error::{Result, try_filled};
use crate::fit::heightfields::Problem;
use crate::fit::operator::Operator;
use crate::fit::operator::lattice::LatticeOperator;
use crate::lattice::domain::Domain;
use crate::math::{fork, lanes};

/// Preconditioned conjugate gradients in single precision for the z-step on a lattice.
#[derive(Debug, Clone)]
pub(crate) struct ConjugateGradients {
    residual: Vec<f32>,
    correction: Vec<f32>,
    direction: Vec<f32>,
    image: Vec<f32>,
    /// Buffer for one lattice row in double precision, for each band.
    rows: Vec<Vec<f64>>,
    multigrid: Multigrid,
    rho: f64,
    /// Largest absolute input height, by which heights in the linear system are divided.
    unit: f64,
    /// Squared residual `‖r‖²` in the norm of the matrix's inverse diagonal.
    energy: f64,
    /// Product `r·M⁻¹r` of residual and preconditioned residual in the iteration before; 0 before the first.
    previous: f64,
}

impl ConjugateGradients {
    /// Makes the solver for a problem on the first of `domains`, each of which has twice the spacing of the one before.
    pub(crate) fn new(problem: &Problem, domains: &[Arc<Domain>], rho: f64) -> Result<Self> {
        let domain = &problem.operator.domain;
        let zeros = || try_filled("conjugate gradients", domain.cells(), 0.0);
        let largest = problem.target.iter().fold(0.0f64, |m, z| m.max(z.abs()));
        Ok(ConjugateGradients {
            residual: zeros()?,
            correction: zeros()?,
            direction: zeros()?,
            image: zeros()?,
            rows: vec![vec![0.0; domain.stride()]; domain.bands().len()],
            multigrid: Multigrid::new(problem, domains, rho)?,
            rho,
            unit: if largest > 0.0 { largest } else { 1.0 },
            energy: 0.0,
            previous: 0.0,
        })
    }
}

impl SolvableOperator for LatticeOperator {
    type Solver = ConjugateGradients;
}

impl ZStepSolver<LatticeOperator> for ConjugateGradients {
    fn set_rho(&mut self, rho: f64) {
        self.rho = rho;
        self.multigrid.set(rho);
    }

    fn residual(&mut self) -> &mut [f32] {
        &mut self.residual
    }

    fn residual_scale(&self) -> f64 {
        1.0 / (self.multigrid.matrix().diagonal * self.unit)
    }

    fn restart(&mut self, operator: &LatticeOperator) {
        self.previous = 0.0;
        self.multigrid.matrix().pin(&mut self.residual);
        let (bands, vertices) = (operator.bands(), operator.vertices());
        let (residual, inverse) = (&self.residual, &self.multigrid.matrix().inverse_diagonal);
        let corrections = bands.split(&mut self.correction);
        let mut states: Vec<_> = corrections.map(|correction| (correction, 0.0)).collect();
        fork::for_each(&mut states, |band, (correction, energy)| {
            for run in bands.runs(vertices, band) {
                correction.run_mut(*run).fill(0.0);
                *energy += lanes::weighted_square(part(residual, *run), part(inverse, *run));
            }
        });
        self.energy = states.iter().map(|(_, energy)| energy).sum();
    }

    fn energy(&self) -> f64 {
        self.energy
    }

    fn relative_residual(&self, problem: &Problem) -> f64 {
        let matrix = self.multigrid.matrix();
        let squares = problem.operator.vertices().cells().map(|cell| {
            let weight = 2.0 * problem.lambda * problem.fidelity.at(cell);
            let b = weight * self.residual_scale() * problem.target[cell];
            b * b * lanes::double(matrix.inverse_diagonal[cell])
        });
        (self.energy / squares.sum::<f64>()).sqrt()
    }

    fn correct(&mut self, operator: &LatticeOperator, z: &mut [f64]) {
        let (bands, vertices) = (operator.bands(), operator.vertices());
        let (correction, unit) = (&self.correction, self.unit);
        let mut states: Vec<_> = bands.split(z).zip(&mut self.rows).collect();
        fork::for_each(&mut states, |band, (z, row)| {
            for run in bands.runs(vertices, band) {
                let wide = &mut row[..run.len()];
                lanes::widen(part(correction, *run), wide);
                for (z, delta) in z.run_mut(*run).iter_mut().zip(wide) {
                    *z += unit * *delta;
                }
            }
        });
    }

    fn step(&mut self, operator: &LatticeOperator) -> bool {
        if self.energy <= 0.0 {
            return false;
        }
        let (bands, vertices) = (operator.bands(), operator.vertices());
        let preconditioned = self.multigrid.precondition(&mut self.residual);
        let residual = &self.residual;
        let mut products = vec![0.0; bands.len()];
        fork::for_each(&mut products, |band, product| {
            for run in bands.runs(vertices, band) {
                *product += lanes::dot(part(residual, *run), part(preconditioned, *run));
            }
        });
        let product: f64 = products.iter().sum();
        let beta = if self.previous > 0.0 {
            (product / self.previous) as f32
        } else {
            0.0
        };
        let mut directions: Vec<_> = bands.split(&mut self.direction).collect();
        fork::for_each(&mut directions, |band, direction| {
            for run in bands.runs(vertices, band) {
                let preconditioned = part(preconditioned, *run);
                for (p, s) in direction.run_mut(*run).iter_mut().zip(preconditioned) {
                    *p = s + beta * *p;
                }
            }
        });
        let matrix = self.multigrid.matrix_mut();
        let curvature = matrix.apply(&self.direction, &mut self.image);
        if !(curvature > 0.0 && product > 0.0) {
            return false;
        }
        let alpha = (product / curvature) as f32;
        let (direction, image) = (&self.direction, &self.image);
        let corrections = bands.split(&mut self.correction);
        let mut states: Vec<_> = corrections
            .zip(bands.split(&mut self.residual))
            .map(|(correction, residual)| (correction, residual, 0.0))
            .collect();
        fork::for_each(&mut states, |band, (correction, residual, energy)| {
            for run in bands.runs(vertices, band) {
                let correction = correction.run_mut(*run);
                let residual = residual.run_mut(*run);
                let (direction, image) = (part(direction, *run), part(image, *run));
                for i in 0..correction.len() {
                    correction[i] += alpha * direction[i];
                    residual[i] -= alpha * image[i];
                }
                *energy += lanes::weighted_square(residual, part(&matrix.inverse_diagonal, *run));
            }
        });
        self.energy = states.iter().map(|(.., energy)| energy).sum();
        self.previous = product;
        true
    }

    fn solve_precisely(
        &mut self,
        problem: &Problem,
        residual: &mut Vec<f64>,
        x: &mut [f64],
        criteria: CgCriteria,
    ) -> Result<usize> {
        let mut precise = RefinedSolver::new(problem)?;
        std::mem::swap(&mut precise.residual, residual);
        let goal = criteria.tolerance * precise.distance(problem, &self.multigrid);
        let limits = (goal, criteria.max_iterations);
        let iterations = precise.solve(problem, self.rho, &mut self.multigrid, x, limits);
        *residual = precise.residual;
        Ok(iterations)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fit::coarsen::coarsen;
    use crate::fit::coordinates::Coordinates;
    use crate::{Heightfield, Input, Lattice, Options};

    /// A disk with a hole, and its coarser lattices.
    fn lattices(cols: usize) -> (Heightfield, Vec<Arc<Domain>>) {
        let lattice = Lattice::new(cols, cols, 1.0 / cols as f64).unwrap();
        let field = Heightfield::from_fn(lattice, |x, y| {
            let hole = (x - 0.6).hypot(y + 0.4) < 0.1;
            if hole || (x - 0.5).hypot(y + 0.45) > 0.45 {
                f64::NAN
            } else {
                (9.0 * x).sin() + (301.0 * x * y).sin()
            }
        })
        .unwrap();
        let whole = field.clone();
        let mut domains = Vec::new();
        let mut input = Input::new(field);
        while let Ok(domain) = input.domain() {
            input = coarsen(&input, &domain).unwrap();
            domains.push(Arc::new(domain));
        }
        (whole, domains)
    }

    #[test]
    fn the_number_of_iterations_does_not_depend_on_the_size() {
        for cols in [40, 80, 160] {
            let (field, domains) = lattices(cols);
            let input = Input::new(field);
            let coordinates = Coordinates::new(&input, &domains[0], 1.0);
            let options = Options::paper().lambda(1e4);
            let problem = Problem::new(&input, domains[0].clone(), &coordinates, &options).unwrap();
            let rho = 4.0 * problem.operator.spacing;
            let mut cg = ConjugateGradients::new(&problem, &domains, rho).unwrap();
            // Plain conjugate gradients would need about √κ times as many as this.
            for cell in problem.operator.domain.active().cells() {
                cg.residual[cell] = problem.target[cell] as f32;
            }
            cg.restart(&problem.operator);
            let first = cg.energy();
            let mut steps = 0;
            while cg.energy() > 1e-8 * first {
                assert!(cg.step(&problem.operator));
                steps += 1;
                assert!(steps <= 12, "{cols}: {:e}", cg.energy() / first);
            }
        }
    }
}

//! The z-step's solver for operators given as a sparse matrix: V-cycles where there are coarser levels, and conjugate
//! gradients with Jacobi's preconditioner where there are none.
//!
//! The V-cycle is taken as it is, without a line search: then ADMM converges with a single V-cycle in each z-step (see
//! [`v_cycle`](super::v_cycle)), and one product with the matrix is saved.

use super::v_cycle::{Interpolations, VCycle};
use super::{MAX_RUN_LENGTH, SparseOperator, normal};
use crate::error::{Result, try_filled};
use crate::fit::energy::problem::Problem;
use crate::fit::linear::z_step_solver::{CgCriteria, SolvableOperator, ZStepSolver};
use crate::fit::operator::Operator;
use crate::math::lanes;

/// Number of Jacobi-preconditioned iterations in one step of the z-step's solver: together they do about as much as a
/// V-cycle on a small mesh, for which ADMM's schedule is made (`benches/whole.md`).
const JACOBI_STEPS: usize = 12;

/// The z-step's matrix `A = 2λw + ρCᵀC`, scaled so that its largest diagonal entry is 1.
#[derive(Debug, Clone)]
struct System {
    rho: f64,
    /// Fidelity weight `2λw` of each vertex, a part of the diagonal.
    fidelity: Vec<f64>,
    normal: Vec<f64>,
    /// Largest diagonal entry of the unscaled matrix, by which the matrix is divided.
    diagonal: f64,
    /// Inverse of the scaled diagonal, and 0 at constrained vertices, which stay as they are by that.
    inverse: Vec<f64>,
    constrained: Vec<u32>,
}

impl System {
    fn set_rho(&mut self, rho: f64) {
        self.rho = rho;
        let entries = self.fidelity.iter().zip(&self.normal);
        let entries = entries.map(|(fidelity, normal)| fidelity + rho * normal);
        self.diagonal = entries.clone().fold(f64::MIN_POSITIVE, f64::max);
        for (inverse, entry) in self.inverse.iter_mut().zip(entries) {
            *inverse = if entry > 0.0 {
                self.diagonal / entry
            } else {
                0.0
            };
        }
        for vertex in &self.constrained {
            self.inverse[*vertex as usize] = 0.0;
        }
    }
}

/// State of preconditioned conjugate gradients for the z-step, in single precision.
#[derive(Debug, Clone)]
struct Gradients {
    residual: Vec<f32>,
    solution: Vec<f32>,
    direction: Vec<f32>,
    image: Vec<f32>,
    /// Scaled fidelity weights; with `rho`, the factor of `CᵀC`, and `inverse`, the inverse diagonal, this is the
    /// scaled matrix.
    fidelity: Vec<f32>,
    rho: f32,
    inverse: Vec<f32>,
    /// Product `r·M⁻¹r` of residual and preconditioned residual; `previous` is the one of the iteration before, and 0
    /// before the first.
    energy: f64,
    previous: f64,
}

impl Gradients {
    fn new(operator: &SparseOperator, system: &System) -> Result<Self> {
        let zeros = || try_filled("conjugate gradients", operator.vertex_cells(), 0.0);
        let mut gradients = Gradients {
            residual: zeros()?,
            solution: zeros()?,
            direction: zeros()?,
            image: zeros()?,
            fidelity: zeros()?,
            rho: 0.0,
            inverse: zeros()?,
            energy: 0.0,
            previous: 0.0,
        };
        gradients.take(operator, system);
        Ok(gradients)
    }

    /// Takes over the values of a system's matrix, in single precision, in which the operator's rows are scaled.
    fn take(&mut self, operator: &SparseOperator, system: &System) {
        self.rho = lanes::single(system.rho / (system.diagonal * operator.spacing.powi(4)));
        for vertex in 0..self.inverse.len() {
            self.fidelity[vertex] = lanes::single(system.fidelity[vertex] / system.diagonal);
            self.inverse[vertex] = lanes::single(system.inverse[vertex]);
        }
    }

    /// Starts conjugate gradients with the residual as it is, and 0 as the solution.
    fn start(&mut self) {
        self.solution.fill(0.0);
        self.direction.fill(0.0);
        self.previous = 0.0;
        self.measure();
    }

    /// Computes the residual of the solution so far, for the right-hand side `right`.
    fn compute_residual(&mut self, operator: &SparseOperator, right: &[f32]) {
        let weights = &operator.single_rho_weights;
        normal(&operator.single, weights, &self.solution, &mut self.image);
        for (i, residual) in self.residual.iter_mut().enumerate() {
            let image = self.fidelity[i] * self.solution[i] + self.rho * self.image[i];
            *residual = right[i] - image;
        }
        self.measure();
    }

    fn measure(&mut self) {
        let residuals = self.residual.chunks(MAX_RUN_LENGTH);
        self.energy = residuals
            .zip(self.inverse.chunks(MAX_RUN_LENGTH))
            .map(|(residual, inverse)| lanes::weighted_square(residual, inverse))
            .sum();
    }

    /// Takes one conjugate-gradient iteration; returns `false` if nothing is left to improve.
    fn step(&mut self, operator: &SparseOperator) -> bool {
        if self.energy <= 0.0 {
            return false;
        }
        let beta = if self.previous > 0.0 {
            self.energy / self.previous
        } else {
            0.0
        };
        let beta = lanes::single(beta);
        for (i, direction) in self.direction.iter_mut().enumerate() {
            *direction = self.inverse[i] * self.residual[i] + beta * *direction;
        }
        let weights = &operator.single_rho_weights;
        normal(&operator.single, weights, &self.direction, &mut self.image);
        for (i, image) in self.image.iter_mut().enumerate() {
            *image = self.fidelity[i] * self.direction[i] + self.rho * *image;
        }
        let directions = self.direction.chunks(MAX_RUN_LENGTH);
        let curvature: f64 = directions
            .zip(self.image.chunks(MAX_RUN_LENGTH))
            .map(|(direction, image)| lanes::dot(direction, image))
            .sum();
        if curvature.is_nan() || curvature <= 0.0 {
            return false;
        }
        let alpha = lanes::single(self.energy / curvature);
        for (i, residual) in self.residual.iter_mut().enumerate() {
            self.solution[i] += alpha * self.direction[i];
            *residual -= alpha * self.image[i];
        }
        self.previous = self.energy;
        self.measure();
        true
    }
}

/// Solver of the z-step for a [`SparseOperator`].
#[derive(Debug, Clone)]
pub(crate) struct SparseGradients {
    system: System,
    gradients: Gradients,
    /// Residual as written by the caller, in single precision.
    residual: Vec<f32>,
    /// Whether ρ has changed since the matrix was made.
    stale: bool,
    /// Largest absolute target height, by which heights in the linear system are divided.
    unit: f64,
    v_cycle: Option<VCycle>,
    /// Whether a V-cycle has moved the solution since the residual was computed.
    has_moved: bool,
}

impl SparseGradients {
    /// Makes the solver with V-cycles, unless there are no `interpolations` from coarser levels.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub(crate) fn with_v_cycle(
        problem: &Problem<SparseOperator>,
        rho: f64,
        interpolations: &Interpolations,
    ) -> Result<Self> {
        let mut solver = SparseGradients::new(problem, rho)?;
        if !interpolations.is_empty() {
            solver.v_cycle = Some(VCycle::new(&problem.operator, interpolations)?);
            solver.set_v_cycle_matrix();
        }
        Ok(solver)
    }

    /// Hands the matrix over to the V-cycle, if there is one.
    fn set_v_cycle_matrix(&mut self) {
        if let Some(v_cycle) = &mut self.v_cycle {
            let own = &self.gradients;
            v_cycle.set_matrix(own.rho, &own.fidelity, &own.inverse);
        }
    }

    pub(crate) fn new(problem: &Problem<SparseOperator>, rho: f64) -> Result<Self> {
        let operator = &problem.operator;
        let cells = operator.vertex_cells();
        let mut fidelity = try_filled("conjugate gradients", cells, 0.0)?;
        for vertex in operator.vertices().cells() {
            fidelity[vertex] = 2.0 * problem.lambda * problem.fidelity.at(vertex);
        }
        let mut system = System {
            rho,
            fidelity,
            normal: operator.normal_diagonal()?,
            diagonal: 1.0,
            inverse: try_filled("conjugate gradients", cells, 0.0)?,
            constrained: problem.constrained.clone(),
        };
        system.set_rho(rho);
        let largest = problem.target.iter().fold(0.0f64, |m, z| m.max(z.abs()));
        Ok(SparseGradients {
            gradients: Gradients::new(operator, &system)?,
            system,
            stale: false,
            residual: try_filled("conjugate gradients", cells, 0.0)?,
            unit: if largest > 0.0 { largest } else { 1.0 },
            v_cycle: None,
            has_moved: false,
        })
    }
}

impl SolvableOperator for SparseOperator {
    type Solver = SparseGradients;
}

impl ZStepSolver<SparseOperator> for SparseGradients {
    fn set_rho(&mut self, rho: f64) {
        self.system.set_rho(rho);
        self.stale = true;
    }

    fn residual(&mut self) -> &mut [f32] {
        &mut self.residual
    }

    fn residual_scale(&self) -> f64 {
        1.0 / (self.system.diagonal * self.unit)
    }

    fn restart(&mut self, operator: &SparseOperator) {
        if std::mem::take(&mut self.stale) {
            self.gradients.take(operator, &self.system);
            self.set_v_cycle_matrix();
        }
        self.gradients.residual.copy_from_slice(&self.residual);
        self.gradients.start();
        self.has_moved = false;
    }

    fn energy(&self) -> f64 {
        self.gradients.energy
    }

    fn relative_residual(&self, problem: &Problem<SparseOperator>) -> f64 {
        let squares = problem.operator.vertices().cells().map(|vertex| {
            let b = self.system.fidelity[vertex] * self.residual_scale() * problem.target[vertex];
            b * b * self.system.inverse[vertex]
        });
        (self.gradients.energy / squares.sum::<f64>()).sqrt()
    }

    fn step(&mut self, operator: &SparseOperator) -> bool {
        let Some(v_cycle) = &mut self.v_cycle else {
            let done = (0..JACOBI_STEPS).take_while(|_| self.gradients.step(operator));
            return done.count() > 0;
        };
        if std::mem::replace(&mut self.has_moved, true) {
            self.gradients.compute_residual(operator, &self.residual);
        }
        let own = &mut self.gradients;
        v_cycle.add_solution(operator, &own.residual, &mut own.solution);
        true
    }

    fn correct(&mut self, operator: &SparseOperator, z: &mut [f64]) {
        for vertex in operator.vertices().cells() {
            z[vertex] += self.unit * lanes::double(self.gradients.solution[vertex]);
        }
    }

    fn solve_precisely(
        &mut self,
        problem: &Problem<SparseOperator>,
        residual: &mut Vec<f64>,
        x: &mut [f64],
        criteria: CgCriteria,
    ) -> Result<usize> {
        let (operator, system) = (&problem.operator, &self.system);
        let mut gradients = Gradients::new(operator, system)?;
        let mut step = try_filled("conjugate gradients", x.len(), 0.0)?;
        let mut image = step.clone();
        let (mut goal, mut done) = (None, 0);
        while done < JACOBI_STEPS * criteria.max_iterations {
            // The largest distance by which the residual at a single vertex would move its height if no other moved.
            let moved = residual.iter().zip(&system.inverse);
            let distance = moved.fold(0.0, |most, (r, inverse)| {
                f64::max(most, (r * inverse).abs())
            });
            if distance <= *goal.get_or_insert(criteria.tolerance * distance) {
                break;
            }
            for (to, from) in gradients.residual.iter_mut().zip(&*residual) {
                *to = lanes::single(from / distance);
            }
            gradients.start();
            let first = gradients.energy;
            while gradients.energy > criteria.tolerance * first && gradients.step(operator) {
                done += 1;
            }
            for (step, single) in step.iter_mut().zip(&gradients.solution) {
                *step = distance / system.diagonal * lanes::double(*single);
            }
            normal(&operator.double, &operator.rho_weights, &step, &mut image);
            for (i, step) in step.iter().enumerate() {
                x[i] += step;
                residual[i] -= system.fidelity[i] * step + system.rho * image[i];
            }
            if gradients.energy >= first {
                break;
            }
        }
        Ok(done.div_ceil(JACOBI_STEPS))
    }
}

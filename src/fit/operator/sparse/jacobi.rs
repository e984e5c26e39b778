//! The z-step of a sparse matrix: conjugate gradients with Jacobi's preconditioner.

use super::SparseOperator;
use crate::error::{Result, try_filled};
use crate::fit::energy::problem::Problem;
use crate::fit::operator::{Operator, Solver};
use crate::math::lanes;

/// Iterations of a step: together they do about as much as a V-cycle, for which ADMM's schedule is.
const STEPS: usize = 6;

/// `A = 2λw + ρCᵀC`, scaled so that its largest diagonal entry is 1.
#[derive(Debug, Clone)]
struct System {
    rho: f64,
    /// `2λw`, and the diagonal of `CᵀC`.
    fidelity: Vec<f64>,
    normal: Vec<f64>,
    /// The largest diagonal entry, by which all is divided.
    diagonal: f64,
    /// One over the diagonal; 0 at constrained vertices, which so stay as they are.
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

/// A run of conjugate gradients.
#[derive(Debug, Clone)]
struct Gradients {
    residual: Vec<f64>,
    solution: Vec<f64>,
    direction: Vec<f64>,
    image: Vec<f64>,
    matrices: Vec<f64>,
    /// `r·M⁻¹r`, and that of the iteration before; 0 before the first.
    energy: f64,
    previous: f64,
}

impl Gradients {
    fn new(operator: &SparseOperator) -> Result<Self> {
        let zeros = || try_filled("conjugate gradients", operator.vertex_cells(), 0.0);
        Ok(Gradients {
            residual: zeros()?,
            solution: zeros()?,
            direction: zeros()?,
            image: zeros()?,
            matrices: operator.scratch()?,
            energy: 0.0,
            previous: 0.0,
        })
    }

    /// Begins with the residual as it is, of the solution 0.
    fn start(&mut self, system: &System) {
        self.solution.fill(0.0);
        self.direction.fill(0.0);
        self.previous = 0.0;
        self.measure(system);
    }

    fn measure(&mut self, system: &System) {
        let squares = self.residual.iter().zip(&system.inverse);
        self.energy = squares.map(|(r, inverse)| r * r * inverse).sum();
    }

    /// One iteration; `false` if there is nothing left to do.
    fn step(&mut self, system: &System, operator: &SparseOperator) -> bool {
        if self.energy <= 0.0 {
            return false;
        }
        let beta = if self.previous > 0.0 {
            self.energy / self.previous
        } else {
            0.0
        };
        for (i, direction) in self.direction.iter_mut().enumerate() {
            *direction = system.inverse[i] * self.residual[i] + beta * *direction;
        }
        operator.normal(&self.direction, &mut self.matrices, &mut self.image);
        let mut curvature = 0.0;
        for (i, image) in self.image.iter_mut().enumerate() {
            let direction = self.direction[i];
            *image = (system.fidelity[i] * direction + system.rho * *image) / system.diagonal;
            curvature += direction * *image;
        }
        // As what a NaN is not.
        if !(curvature > 0.0 && self.energy > 0.0) {
            return false;
        }
        let alpha = self.energy / curvature;
        for (i, residual) in self.residual.iter_mut().enumerate() {
            self.solution[i] += alpha * self.direction[i];
            *residual -= alpha * self.image[i];
        }
        self.previous = self.energy;
        self.measure(system);
        true
    }

    /// By how much the residual would move a height on its own, at most.
    fn distance(&self, system: &System) -> f64 {
        let moved = self.residual.iter().zip(&system.inverse);
        let moved = moved.map(|(r, inverse)| (r * inverse).abs());
        moved.fold(0.0, f64::max)
    }
}

#[derive(Debug, Clone)]
pub(crate) struct JacobiGradients {
    system: System,
    gradients: Gradients,
    /// What is written by others.
    residual: Vec<f32>,
    /// Heights of size 1 in the system's scale.
    unit: f64,
}

impl JacobiGradients {
    pub(super) fn new(problem: &Problem<SparseOperator>, rho: f64) -> Result<Self> {
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
        Ok(JacobiGradients {
            system,
            gradients: Gradients::new(operator)?,
            residual: try_filled("conjugate gradients", cells, 0.0)?,
            unit: if largest > 0.0 { largest } else { 1.0 },
        })
    }
}

impl Solver<SparseOperator> for JacobiGradients {
    fn set_rho(&mut self, rho: f64) {
        self.system.set_rho(rho);
    }

    fn residual(&mut self) -> &mut [f32] {
        &mut self.residual
    }

    fn residual_scale(&self) -> f64 {
        1.0 / (self.system.diagonal * self.unit)
    }

    fn restart(&mut self, _: &SparseOperator) {
        lanes::widen(&self.residual, &mut self.gradients.residual);
        self.gradients.start(&self.system);
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
        let done = (0..STEPS).take_while(|_| self.gradients.step(&self.system, operator));
        done.count() > 0
    }

    fn correct(&mut self, operator: &SparseOperator, z: &mut [f64]) {
        for vertex in operator.vertices().cells() {
            z[vertex] += self.unit * self.gradients.solution[vertex];
        }
    }

    fn solve_precisely(
        &mut self,
        problem: &Problem<SparseOperator>,
        residual: &mut Vec<f64>,
        x: &mut [f64],
        (tolerance, steps): (f64, usize),
    ) -> Result<usize> {
        let mut gradients = Gradients::new(&problem.operator)?;
        for (to, from) in gradients.residual.iter_mut().zip(&*residual) {
            *to = from / self.system.diagonal;
        }
        gradients.start(&self.system);
        let goal = tolerance * gradients.distance(&self.system);
        let mut done = 0;
        while done < STEPS * steps && gradients.distance(&self.system) > goal {
            if !gradients.step(&self.system, &problem.operator) {
                break;
            }
            done += 1;
        }
        for (x, more) in x.iter_mut().zip(&gradients.solution) {
            *x += more;
        }
        Ok(done.div_ceil(STEPS))
    }
}

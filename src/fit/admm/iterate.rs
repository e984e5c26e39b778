//! The iterate of ADMM, and the update of Hessians and dual (paper, Eq. 18 and 19).
//!
//! Both equations are about one matrix `V = Y + ρH` at each stencil: for the nuclear norm, the dual `Y = ρU` is
//! the projection of `V` onto the dual ball, and `ρH = V − Y` its soft threshold
//! ([`spectral_penalty`](crate::fit::energy::spectral_penalty) has the other energies). So `Y` is feasible by
//! construction, and nothing else has to be stored.

use super::matrix_field::{MatrixBand, MatrixField};
use crate::error::{Result, try_filled};
use crate::fit::energy::problem::Problem;
use crate::fit::energy::spectral_penalty::{AnyPenalty, NuclearNorm, PenaltyKind, SpectralPenalty};
use crate::fit::linear::z_step_solver::{SolvableOperator, ZStepSolver};
use crate::fit::operator::{Hessians, Matrices, Sums};
use crate::lattice::bands::BandSlice;
use crate::math::sym2::Sym2;
use crate::math::{fork, lanes};

/// Number of sums over stencils, and of sums over vertices, that a certificate is computed from.
pub(super) const CERTIFICATE_SUMS: usize = 6;

/// Buffers for the terms of a certificate's sums along one run of stencils or vertices.
pub(super) type SumTerms = [Vec<f64>; CERTIFICATE_SUMS];

/// Iterate of ADMM: heights `z` at the operator's vertices and one matrix `V = Y + ρH` at each stencil, which holds
/// dual `Y` and Hessian `H`.
#[derive(Debug, Clone)]
pub(crate) struct Iterate<O: SolvableOperator> {
    pub z: Vec<f64>,
    pub(crate) v: MatrixField<f64>,
    pub rho: f64,
    pub(super) scratch: O::Scratch<f64>,
    /// Buffers of each band for the terms of a certificate: of its sums over stencils and of its sums over vertices.
    pub(super) terms: Vec<[SumTerms; 2]>,
}

/// Replaces `V = Y + ρH` by `Y + factor · ρH` at each stencil.
fn rescale<O: SolvableOperator>(
    v: &mut MatrixField<f64>,
    problem: &Problem<O>,
    penalty: impl SpectralPenalty,
    factor: f64,
) {
    let operator = &problem.operator;
    let mut states: Vec<_> = v.split(operator.bands()).collect();
    fork::for_each(&mut states, |band, v| {
        for run in operator.bands().runs(operator.stencils(), band) {
            let weight = problem.weight.run(*run);
            let mut v = v.run(*run);
            for (i, weight) in weight.iter().enumerate() {
                let value = v.get(i);
                let dual = penalty.dual(value, *weight);
                v.set(i, dual + (value - dual).scale(factor));
            }
        }
    });
}

/// The part of one band in the update of Hessians and dual: arrays that it reads and writes.
struct Update<'a> {
    v: MatrixBand<'a, f64>,
    /// Residual of the next z-step.
    residual: BandSlice<'a, f32>,
    /// Buffer for squared changes along one run of stencils.
    squares: &'a mut [f64],
    /// Buffer for the residual along one run of vertices, in double precision.
    wide: &'a mut [f64],
    /// Sum of the squared changes of the Hessians, times ρ².
    change: f64,
}

impl<O: SolvableOperator> Iterate<O> {
    /// Makes the first iterate of a solve: `z` is the input `z̃`, Hessians `H` and dual `U` are 0.
    pub(crate) fn new(problem: &Problem<O>, rho: f64) -> Result<Self> {
        let operator = &problem.operator;
        let row = |_| vec![0.0; operator.longest_run()];
        let terms = || std::array::from_fn(|_| std::array::from_fn(row));
        let mut z = try_filled("heights", operator.vertex_cells(), 0.0)?;
        z.copy_from_slice(&problem.target);
        Ok(Iterate {
            z,
            v: MatrixField::new(operator.stencil_cells())?,
            rho,
            scratch: operator.scratch()?,
            terms: (0..operator.bands().len()).map(|_| terms()).collect(),
        })
    }

    /// Restarts ADMM's iterate from other heights `z`, with Hessians and dual 0.
    pub(super) fn reset(&mut self, z: &[f64]) {
        self.z.copy_from_slice(z);
        self.v.0.iter_mut().for_each(|values| values.fill(0.0));
    }

    /// Changes the penalty parameter ρ and keeps Hessians `H` and dual `Y`.
    pub(crate) fn set_rho(&mut self, problem: &Problem<O>, rho: f64) {
        let (penalty, factor) = (self.penalty(problem), rho / self.rho);
        rescale(&mut self.v, problem, penalty, factor);
        self.rho = rho;
    }

    /// Computes the matrices `V = Y + ρH` for another ρ, with this iterate's Hessians `H` and dual `Y`.
    pub(crate) fn v_with_rho(&self, problem: &Problem<O>, rho: f64) -> Result<MatrixField<f64>> {
        let mut v = MatrixField::new(problem.operator.stencil_cells())?;
        for (to, from) in v.0.iter_mut().zip(&self.v.0) {
            to.copy_from_slice(from);
        }
        rescale(&mut v, problem, self.penalty(problem), rho / self.rho);
        Ok(v)
    }

    /// Returns the dual `Y` and the Hessian `H` at a stencil, which is given by its cell.
    pub(crate) fn matrices(&self, problem: &Problem<O>, cell: usize) -> (Sym2, Sym2) {
        let v = self.v.get(cell);
        let weight = problem.weight.at(cell);
        let dual = self.penalty(problem).dual(v, weight);
        let rho = self.rho * problem.operator.rho_share(cell);
        (dual, (v - dual).scale(1.0 / rho))
    }

    /// Sets the dual and the Hessian at a stencil whose factor of ρ is 1.
    pub(crate) fn set_matrices(&mut self, cell: usize, dual: Sym2, hessian: Sym2) {
        self.v.set(cell, dual + hessian.scale(self.rho));
    }

    /// Sets the dual and the Hessian at a stencil that has a factor of ρ of its own, as those of meshes.
    pub(crate) fn set_matrices_with_rho_share(
        &mut self,
        problem: &Problem<O>,
        cell: usize,
        [dual, hessian]: [Sym2; 2],
    ) {
        let rho_share = problem.operator.rho_share(cell);
        self.set_matrices(cell, dual, hessian.scale(rho_share));
    }

    /// Updates Hessians and dual (paper, Eq. 18 and 19) with the over-relaxation `relaxation`, and writes the residual
    /// `b − A z = 2λ(z̃ − z) + Cᵀ(ρH − Y − ρCz)`, from which the next z-step starts, to its solver, all in one pass.
    /// With relaxation 0, `H` and `Y` stay as they are.
    pub(crate) fn update(&mut self, problem: &Problem<O>, relaxation: f64, solver: &mut O::Solver) {
        match problem.kind {
            PenaltyKind::Nuclear => {
                self.update_under::<false>(NuclearNorm, problem, relaxation, solver)
            }
            PenaltyKind::Huber(bends) => {
                self.update_under::<false>(bends.penalty(self.rho), problem, relaxation, solver)
            }
            // One kernel serves all other cases: less code, and measuring costs little.
            _ => self.update_and_measure(problem, relaxation, solver),
        };
    }

    /// Updates as [`Self::update`] does, and returns `ρ‖ΔH‖`, the norm of the Hessians' change times ρ.
    pub(crate) fn update_and_measure(
        &mut self,
        problem: &Problem<O>,
        relaxation: f64,
        solver: &mut O::Solver,
    ) -> f64 {
        self.update_under::<true>(self.penalty(problem), problem, relaxation, solver)
    }

    /// Returns the spectral penalty of the problem's Hessians for the iterate's ρ.
    pub(super) fn penalty(&self, problem: &Problem<O>) -> AnyPenalty {
        AnyPenalty::new(problem.kind, self.rho)
    }

    fn update_under<const MEASURE: bool>(
        &mut self,
        penalty: impl SpectralPenalty,
        problem: &Problem<O>,
        relaxation: f64,
        solver: &mut O::Solver,
    ) -> f64 {
        let Iterate {
            z,
            v,
            rho,
            scratch,
            terms,
        } = self;
        let (z, rho) = (z.as_slice(), *rho);
        let fidelity = 2.0 * problem.lambda;
        let scale = solver.residual_scale();
        let bands = problem.operator.bands();
        let residuals = bands.split(solver.residual());
        let mut states: Vec<_> = v
            .split(bands)
            .zip(residuals)
            .zip(terms)
            .map(|((v, residual), [[squares, ..], [wide, ..]])| Update {
                v,
                residual,
                squares,
                wide,
                change: 0.0,
            })
            .collect();
        problem.operator.sweep(
            scratch,
            z,
            &mut states,
            |state, run, hessians, mut matrices| {
                let (mut v, squares) = (state.v.run(run), &mut *state.squares);
                let weight = problem.weight.run(run);
                let n = run.end - run.start;
                for i in 0..n {
                    let rho = rho * problem.operator.rho_share(run.start + i);
                    let hessian = Sym2::from_coordinates(hessians.at(i)).scale(rho);
                    let old = v.get(i);
                    let old_dual = penalty.dual(old, weight[i]);
                    let step = hessian - old + old_dual;
                    let new = old + step.scale(relaxation);
                    v.set(i, new);
                    let dual = penalty.dual(new, weight[i]);
                    if MEASURE {
                        let moved = new - dual - old + old_dual;
                        squares[i] = problem.operator.area(run.start + i) * moved.dot(moved);
                    }
                    matrices.set(i, (new - dual - dual - hessian).coordinates());
                }
                if MEASURE {
                    state.change += lanes::sum(&squares[..n]);
                }
            },
            |state, run, sums| {
                let n = run.end - run.start;
                let z = &z[run.start..][..n];
                let target = &problem.target[run.start..][..n];
                let wide = &mut state.wide[..n];
                let weight = problem.fidelity.run(run);
                for i in 0..n {
                    let value = fidelity * (weight[i] * (target[i] - z[i])) + sums.at(i);
                    wide[i] = scale * value;
                }
                lanes::narrow(wide, state.residual.run_mut(run));
            },
        );
        let change: f64 = states.iter().map(|state| state.change).sum();
        drop(states);
        solver.restart(&problem.operator);
        change.sqrt()
    }
}

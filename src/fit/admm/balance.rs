//! Balancing of a dual: a correction after which it satisfies the optimality condition of a surface `z`, and its dual
//! bound.
//!
//! Where vertices have no fidelity term of their own, `CᵀY` must all but vanish for the bound `D(Y)` to be worth
//! anything, and ADMM's dual comes close to that only in the end. So it is balanced first: with a stiffness `κ`
//! and `(2λw + κCᵀC) q = −(2λw(z − z̃) + CᵀY)`, which is one more z-step, `Y + κCq` and `z + q` satisfy the
//! condition exactly. The new dual is then scaled back into the dual ball.

use super::certificate::{dual_bound, total};
use super::iterate::Iterate;
use super::matrix_field::MatrixBand;
use crate::error::{Result, try_filled};
use crate::fit::energy::problem::Problem;
use crate::fit::energy::spectral_penalty::SpectralPenalty;
use crate::fit::linear::z_step_solver::{CgCriteria, SolvableOperator, ZStepSolver};
use crate::fit::operator::{Hessians, Matrices, Sums};
use crate::lattice::bands::BandSlice;
use crate::math::sym2::Sym2;

/// Stopping criteria of the conjugate gradients that balance a dual.
const BALANCE_CRITERIA: CgCriteria = CgCriteria {
    tolerance: 1e-9,
    max_iterations: 100,
};

/// A balanced dual: corrected so that `CᵀY` vanishes at vertices without a fidelity term, where the dual bound would be
/// −∞ otherwise.
pub(super) struct Balanced {
    /// Dual bound of the balanced dual: a lower bound of the optimal objective.
    pub bound: f64,
    /// Number of conjugate-gradient iterations that the balancing took.
    pub iterations: usize,
    q: Vec<f64>,
}

/// Balances the iterate's dual: corrects it so that it satisfies the optimality condition of the surface `z`, by a
/// linear solve with a z-step `solver` whose ρ is set to `stiffness`, and computes its dual bound.
pub(super) fn balanced_bound<O: SolvableOperator>(
    iterate: &mut Iterate<O>,
    problem: &Problem<O>,
    z: &[f64],
    stiffness: f64,
    solver: &mut O::Solver,
) -> Result<Balanced> {
    let zeros = || try_filled("certificate", problem.operator.vertex_cells(), 0.0);
    let (mut q, mut residual) = (zeros()?, zeros()?);
    iterate.balance(problem, z, &q, stiffness, &mut residual);
    let iterations = solver.solve_precisely(problem, &mut residual, &mut q, BALANCE_CRITERIA)?;
    let bound = iterate.balance(problem, z, &q, stiffness, &mut residual);
    Ok(Balanced {
        bound,
        iterations,
        q,
    })
}

/// The part of one band in balancing: arrays that it reads and writes, and its sums.
struct Balance<'a> {
    v: MatrixBand<'a, f64>,
    /// Residual of the optimality condition.
    residual: BandSlice<'a, f64>,
    /// Largest size of a dual matrix.
    excess: f64,
    /// Sums of the conjugates, of `⟨CᵀY, z̃⟩`, and of `(CᵀY)²` over the weights.
    sums: [f64; 3],
}

impl<O: SolvableOperator> Iterate<O> {
    /// Replaces the iterate's dual by the balanced one.
    pub(super) fn set_balanced_dual(
        &mut self,
        problem: &Problem<O>,
        stiffness: f64,
        Balanced { q, .. }: &Balanced,
    ) {
        let penalty = self.penalty(problem);
        problem.operator.hessians(q, |stencil, hessian| {
            let dual = penalty.dual(self.v.get(stencil), problem.weight.at(stencil));
            self.v.set(stencil, dual + hessian.scale(stiffness));
        });
    }

    /// Computes the dual bound `D(t(Y + κCq))` for the best feasible factor `t`, and writes the residual `−(2λw(z + q −
    /// z̃) + Cᵀ(Y + κCq))` of the optimality condition to `residual`.
    fn balance(
        &mut self,
        problem: &Problem<O>,
        z: &[f64],
        q: &[f64],
        stiffness: f64,
        residual: &mut [f64],
    ) -> f64 {
        let penalty = self.penalty(problem);
        let Iterate { v, scratch, .. } = self;
        let fidelity = 2.0 * problem.lambda;
        let bands = problem.operator.bands();
        let mut states: Vec<_> = v
            .split(bands)
            .zip(bands.split(residual))
            .map(|(v, residual)| Balance {
                v,
                residual,
                excess: 0.0,
                sums: [0.0; 3],
            })
            .collect();
        problem.operator.sweep(
            scratch,
            q,
            &mut states,
            |state, run, hessians, mut matrices| {
                let v = state.v.run(run);
                let weight = problem.weight.run(run);
                for (i, weight) in weight.iter().enumerate() {
                    let change = Sym2::from_coordinates(hessians.at(i)).scale(stiffness);
                    let y = penalty.dual(v.get(i), *weight) + change;
                    matrices.set(i, y.coordinates());
                    state.excess = state.excess.max(penalty.size(y, *weight));
                    state.sums[0] +=
                        problem.operator.area(run.start + i) * penalty.conjugate(y, *weight);
                }
            },
            |state, run, sums| {
                let residual = state.residual.run_mut(run);
                let weight = problem.fidelity.run(run);
                let inverse = problem.inverse_fidelity.run(run);
                for (i, vertex) in (run.start..run.end).enumerate() {
                    let adjoint = sums.at(i);
                    let offset = z[vertex] + q[vertex] - problem.target[vertex];
                    let gradient = fidelity * (weight[i] * offset) + adjoint;
                    residual[i] = -gradient;
                    state.sums[1] += adjoint * problem.target[vertex];
                    state.sums[2] += adjoint * adjoint * inverse[i];
                }
            },
        );
        let excess = states
            .iter()
            .fold(0.0f64, |most, band| most.max(band.excess));
        let [conjugate, inner, quadratic] = total(states.iter().map(|band| band.sums));
        let largest = if excess > 0.0 {
            penalty.largest() / excess
        } else {
            f64::INFINITY
        };
        dual_bound(problem, inner, quadratic, conjugate, largest)
    }
}

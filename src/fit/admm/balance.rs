//! A dual that satisfies the optimality condition of `z`, and its certificate.
//!
//! Where vertices have no fidelity term of their own, `CᵀY` must all but vanish
//! for the bound `D(Y)` to say anything, and ADMM's dual comes close to that
//! only in the end. So it is balanced first: with a stiffness `κ` and
//! `(2λw + κCᵀC) q = −(2λw(z − z̃) + CᵀY)`, one more z-step as it were, `Y + κCq`
//! and `z + q` satisfy the condition exactly. What is left is to scale the new
//! dual back into the ball.

use super::state::{State, dual_bound};
use crate::error::{Result, try_filled};
use crate::fit::energy::problem::Problem;
use crate::fit::energy::spectral_penalty::SpectralPenalty;
use crate::fit::linear::zstep::{Solvable, Solver};
use crate::fit::operator::{Hessians, Matrices, Sums};
use crate::math::sym2::Sym2;

/// Residual at which the dual is balanced, relative to the first, and largest number of iterations.
pub(super) const BALANCE_LIMITS: (f64, usize) = (1e-9, 100);

pub(super) struct Balanced {
    /// A lower bound of the optimum.
    pub bound: f64,
    /// Conjugate-gradient iterations that it took.
    pub steps: usize,
    q: Vec<f64>,
}

/// Balances the iterate's dual about the surface `z`. The matrix of the `solver` is that of the
/// stiffness.
pub(super) fn balanced_bound<O: Solvable>(
    state: &mut State<O>,
    problem: &Problem<O>,
    z: &[f64],
    stiffness: f64,
    solver: &mut O::Solver,
    enough: (f64, usize),
) -> Result<Balanced> {
    let zeros = || try_filled("certificate", problem.operator.vertex_cells(), 0.0);
    let (mut q, mut residual) = (zeros()?, zeros()?);
    state.balance(problem, z, &q, stiffness, &mut residual);
    let steps = solver.solve_precisely(problem, &mut residual, &mut q, enough)?;
    let bound = state.balance(problem, z, &q, stiffness, &mut residual);
    Ok(Balanced { bound, steps, q })
}

impl<O: Solvable> State<O> {
    /// Goes on from the balanced dual.
    pub(super) fn take_balanced(
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

    /// `D(t(Y + κCq))` for the best feasible `t`; the residual
    /// `−(2λw(z + q − z̃) + Cᵀ(Y + κCq))` goes to `residual`.
    fn balance(
        &mut self,
        problem: &Problem<O>,
        z: &[f64],
        q: &[f64],
        stiffness: f64,
        residual: &mut [f64],
    ) -> f64 {
        let penalty = self.penalty(problem);
        let State { v, scratch, .. } = self;
        let fidelity = 2.0 * problem.lambda;
        let (mut excess, mut conjugate) = (0.0f64, 0.0);
        let (mut inner, mut quadratic) = (0.0, 0.0);
        problem.operator.sweep(
            scratch,
            q,
            v,
            |v, run, hessians, mut matrices| {
                let v = v.run(run);
                let weight = problem.weight.run(run);
                for (i, weight) in weight.iter().enumerate() {
                    let change = Sym2::from_coordinates(hessians.at(i)).scale(stiffness);
                    let y = penalty.dual(v.get(i), *weight) + change;
                    matrices.set(i, y.coordinates());
                    excess = excess.max(penalty.size(y, *weight));
                    conjugate +=
                        problem.operator.area(run.start + i) * penalty.conjugate(y, *weight);
                }
            },
            |_, run, sums| {
                let weight = problem.fidelity.run(run);
                let inverse = problem.inverse_fidelity.run(run);
                for (i, vertex) in (run.start..run.end).enumerate() {
                    let adjoint = sums.at(i);
                    let offset = z[vertex] + q[vertex] - problem.target[vertex];
                    let gradient = fidelity * (weight[i] * offset) + adjoint;
                    residual[vertex] = -gradient;
                    inner += adjoint * problem.target[vertex];
                    quadratic += adjoint * adjoint * inverse[i];
                }
            },
        );
        let largest = if excess > 0.0 {
            penalty.largest() / excess
        } else {
            f64::INFINITY
        };
        dual_bound(problem, inner, quadratic, conjugate, largest)
    }
}

//! A certificate where some vertices have no fidelity term of their own.
//!
//! There `CᵀY` must all but vanish for the bound `D(Y)` to say anything, and
//! ADMM's dual comes close to that only in the end. So it is balanced first:
//! with `A q = −(2λw(z − z̃) + CᵀY)`, one more z-step as it were, `Y + ρCq` and
//! `z + q` satisfy the optimality condition of `z` exactly. What is left is to
//! scale the new dual back into the ball.

use super::state::{State, dual_bound};
use crate::error::{Result, try_filled};
use crate::fit::energy::law::Law;
use crate::fit::energy::problem::Problem;
use crate::fit::linear::cg::ConjugateGradients;
use crate::fit::linear::precise::Precise;
use crate::lattice::stencil::{Ring, weights_of};

/// Residual at which the dual is balanced, relative to the first, and most iterations.
const ENOUGH: (f64, usize) = (1e-9, 100);

/// A lower bound of the optimum. The iterations that it takes are added to `iterations`.
pub(crate) fn balanced_bound(
    state: &mut State,
    problem: &Problem,
    cg: &mut ConjugateGradients,
    iterations: &mut usize,
) -> Result<f64> {
    let mut q = try_filled("certificate", problem.domain.cells(), 0.0)?;
    let mut precise = Precise::new(problem)?;
    let rho = state.rho;
    state.balance(problem, &q, &mut precise.residual);
    *iterations += precise.solve(problem, rho, cg.multigrid(), &mut q, ENOUGH);
    Ok(state.balance(problem, &q, &mut precise.residual))
}

impl State {
    /// `D(t(Y + ρCq))` for the best feasible `t`; the residual
    /// `−(2λw(z + q − z̃) + Cᵀ(Y + ρCq))` goes to `residual`.
    fn balance(&mut self, problem: &Problem, q: &[f64], residual: &mut [f64]) -> f64 {
        let law = self.law(problem);
        let State {
            z, v, rho, rolling, ..
        } = self;
        let (domain, rho) = (&problem.domain, *rho);
        let fidelity = 2.0 * problem.lambda;
        let (mut excess, mut conjugate) = (0.0f64, 0.0);
        let (mut inner, mut quadratic) = (0.0, 0.0);
        rolling.sweep(
            domain,
            v,
            |v, row, weights| {
                for run in domain.interior().row(row) {
                    let ring = Ring::new(q, domain, row, *run);
                    let v = v.run(*run);
                    let [w1, w2, w3] = weights_of(weights, domain, row, *run);
                    let weight = problem.weight.run(domain, row, *run);
                    for i in 0..w1.len() {
                        let change = problem.map.hessian(ring.differences(i)).scale(rho);
                        let y = law.dual(v.get(i), weight[i]) + change;
                        (w1[i], w2[i], w3[i]) = problem.map.adjoint(y).into();
                        excess = excess.max(law.size(y, weight[i]));
                        conjugate += law.conjugate(y, weight[i]);
                    }
                }
            },
            |_, row, sums| {
                for run in domain.active().row(row) {
                    let sum = sums.run(*run);
                    let weight = problem.fidelity.run(domain, row, *run);
                    let inverse = problem.inverse_fidelity.run(domain, row, *run);
                    for (i, cell) in (run.start..run.end).enumerate() {
                        let adjoint = sum.at(i);
                        let offset = z[cell] + q[cell] - problem.target[cell];
                        let gradient = fidelity * (weight[i] * offset) + adjoint;
                        residual[cell] = -gradient;
                        inner += adjoint * problem.target[cell];
                        quadratic += adjoint * adjoint * inverse[i];
                    }
                }
            },
        );
        let largest = if excess > 0.0 {
            law.largest() / excess
        } else {
            f64::INFINITY
        };
        dual_bound(problem, inner, quadratic, conjugate, largest)
    }
}

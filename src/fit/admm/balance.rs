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
use crate::fit::energy::law::Law;
use crate::fit::energy::problem::Problem;
use crate::fit::linear::multigrid::Multigrid;
use crate::fit::linear::precise::Precise;
use crate::lattice::stencil::{Ring, weights_of};

/// Residual at which the dual is balanced, relative to the first, and most iterations.
pub(super) const ENOUGH: (f64, usize) = (1e-9, 100);

pub(super) struct Balanced {
    /// A lower bound of the optimum.
    pub bound: f64,
    /// Conjugate-gradient iterations that it took.
    pub steps: usize,
    q: Vec<f64>,
}

/// Balances the iterate's dual about the surface `z`. The matrix of `multigrid` is that of the
/// stiffness.
pub(super) fn balanced_bound(
    state: &mut State,
    problem: &Problem,
    z: &[f64],
    stiffness: f64,
    multigrid: &mut Multigrid,
    enough: (f64, usize),
) -> Result<Balanced> {
    let mut q = try_filled("certificate", problem.domain.cells(), 0.0)?;
    let mut precise = Precise::new(problem)?;
    state.balance(problem, z, &q, stiffness, &mut precise.residual);
    let steps = precise.solve(problem, stiffness, multigrid, &mut q, enough);
    let bound = state.balance(problem, z, &q, stiffness, &mut precise.residual);
    Ok(Balanced { bound, steps, q })
}

impl State {
    /// Goes on from the balanced dual.
    pub(super) fn take_balanced(
        &mut self,
        problem: &Problem,
        stiffness: f64,
        Balanced { q, .. }: &Balanced,
    ) {
        let law = self.law(problem);
        let domain = &problem.domain;
        for row in 1..=domain.rows() {
            for run in domain.interior().row(row) {
                let ring = Ring::new(q, domain, row, *run);
                let weight = problem.weight.run(domain, row, *run);
                let mut v = self.v.run(*run);
                for (i, weight) in weight.iter().enumerate() {
                    let change = problem.map.hessian(ring.differences(i)).scale(stiffness);
                    v.set(i, law.dual(v.get(i), *weight) + change);
                }
            }
        }
    }

    /// `D(t(Y + κCq))` for the best feasible `t`; the residual
    /// `−(2λw(z + q − z̃) + Cᵀ(Y + κCq))` goes to `residual`.
    fn balance(
        &mut self,
        problem: &Problem,
        z: &[f64],
        q: &[f64],
        stiffness: f64,
        residual: &mut [f64],
    ) -> f64 {
        let law = self.law(problem);
        let State { v, rolling, .. } = self;
        let domain = &problem.domain;
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
                        let change = problem.map.hessian(ring.differences(i)).scale(stiffness);
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

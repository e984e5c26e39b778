//! The ADMM iterate and the two passes over it: the update of Hessians and
//! dual, and the certificate.
//!
//! Paper, Eq. 18 and 19, in the form of one matrix `V = Y + ρH` per interior
//! vertex, from which both follow: the dual `Y = ρU` is the projection of `V`
//! onto the dual ball, and `ρH = V − Y` its soft threshold. So `Y` is feasible
//! by construction, and nothing else has to be stored.

use super::cg::ConjugateGradients;
use super::lanes;
use super::problem::Problem;
use crate::domain::Run;
use crate::error::{Result, try_filled};
use crate::spectral::Sym2;
use crate::stencil::{Ring, Rolling};

/// `z` and `V` on the padded box.
#[derive(Debug, Clone)]
pub(crate) struct State {
    pub z: Vec<f64>,
    v: MatrixField,
    pub rho: f64,
    rolling: Rolling,
}

/// A symmetric matrix per cell, each coordinate of [`Sym2`] contiguous.
#[derive(Debug, Clone)]
struct MatrixField {
    mean: Vec<f64>,
    diff: Vec<f64>,
    off: Vec<f64>,
}

/// One run of a [`MatrixField`].
struct MatrixRun<'a> {
    mean: &'a mut [f64],
    diff: &'a mut [f64],
    off: &'a mut [f64],
}

impl MatrixField {
    #[inline(always)]
    fn run(&mut self, run: Run) -> MatrixRun<'_> {
        let n = run.end - run.start;
        MatrixRun {
            mean: &mut self.mean[run.start..][..n],
            diff: &mut self.diff[run.start..][..n],
            off: &mut self.off[run.start..][..n],
        }
    }
}

impl MatrixRun<'_> {
    #[inline(always)]
    fn get(&self, i: usize) -> Sym2 {
        Sym2 {
            mean: self.mean[i],
            diff: self.diff[i],
            off: self.off[i],
        }
    }

    #[inline(always)]
    fn set(&mut self, i: usize, value: Sym2) {
        self.mean[i] = value.mean;
        self.diff[i] = value.diff;
        self.off[i] = value.off;
    }
}

/// What one pass over an iterate finds out about it.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Certificate {
    /// `λ Σ (z − z̃)²`.
    pub fidelity: f64,
    /// `Σ ‖Cz‖_*`.
    pub nuclear_norm: f64,
    /// `D(tY)`, with the best `t` between 0 and 1: a lower bound of the optimum.
    pub dual_bound: f64,
    /// `‖Cz − H‖`, and the larger of `‖Cz‖` and `‖H‖`.
    pub primal_residual: f64,
    pub primal_size: f64,
    /// `‖2λ(z − z̃) + CᵀY‖`, which is `ρ‖CᵀΔH‖` for exact z-steps, and `‖CᵀY‖`.
    pub dual_residual: f64,
    pub dual_size: f64,
}

impl Certificate {
    pub(crate) fn objective(&self) -> f64 {
        self.fidelity + self.nuclear_norm
    }
}

impl State {
    /// `z = z̃`, `H = U = 0`.
    pub(crate) fn new(problem: &Problem, rho: f64) -> Result<Self> {
        let zeros = || try_filled("Hessians and dual", problem.domain.cells(), 0.0);
        let mut z = try_filled("heights", problem.domain.cells(), 0.0)?;
        z.copy_from_slice(&problem.target);
        Ok(State {
            z,
            v: MatrixField {
                mean: zeros()?,
                diff: zeros()?,
                off: zeros()?,
            },
            rho,
            rolling: Rolling::new(&problem.domain),
        })
    }

    /// Changes ρ, leaving `H` and `Y` as they are.
    pub(crate) fn set_rho(&mut self, problem: &Problem, rho: f64) {
        let factor = rho / self.rho;
        self.rho = rho;
        for run in problem.domain.interior().all() {
            let mut v = self.v.run(*run);
            for i in 0..v.mean.len() {
                let value = v.get(i);
                let dual = value.clamp(1.0);
                v.set(i, dual + (value - dual).scale(factor));
            }
        }
    }

    /// H-step and dual update with the given over-relaxation, then the residual
    /// `b − A z = 2λ(z̃ − z) + Cᵀ(ρH − Y − ρCz)` that the next z-step starts
    /// from, in one pass. Relaxation 0 leaves `H` and `Y` as they are.
    pub(crate) fn update(
        &mut self,
        problem: &Problem,
        relaxation: f64,
        cg: &mut ConjugateGradients,
    ) {
        let State { z, v, rho, rolling } = self;
        let (z, rho) = (z.as_slice(), *rho);
        let domain = &problem.domain;
        let (map, fidelity) = (problem.map, 2.0 * problem.lambda);
        let residual = &mut cg.residual;
        rolling.sweep(
            domain,
            v,
            |v, row, weights| {
                for run in domain.interior().row(row) {
                    let ring = Ring::new(z, domain, row, *run);
                    let mut v = v.run(*run);
                    let (col, n) = (run.start - row * domain.stride(), run.end - run.start);
                    let [w1, w2, w3] = weights;
                    let (w1, w2, w3) = (
                        &mut w1[col..][..n],
                        &mut w2[col..][..n],
                        &mut w3[col..][..n],
                    );
                    for i in 0..n {
                        let hessian = map.hessian(ring.differences(i)).scale(rho);
                        let old = v.get(i);
                        let step = hessian - old + old.clamp(1.0);
                        let new = old + step.scale(relaxation);
                        v.set(i, new);
                        let dual = new.clamp(1.0);
                        let [q1, q2, q3] = map.adjoint(new - dual - dual - hessian);
                        (w1[i], w2[i], w3[i]) = (q1, q2, q3);
                    }
                }
            },
            |_, row, sums| {
                for run in domain.active().row(row) {
                    let sum = sums.run(*run);
                    let n = run.end - run.start;
                    let z = &z[run.start..][..n];
                    let target = &problem.target[run.start..][..n];
                    let residual = &mut residual[run.start..][..n];
                    for i in 0..n {
                        residual[i] = fidelity * (target[i] - z[i]) + sum.at(i);
                    }
                }
            },
        );
        cg.restart(domain);
    }

    /// Objective, dual bound and residuals, in one pass.
    pub(crate) fn certify(&mut self, problem: &Problem) -> Certificate {
        let State { z, v, rho, rolling } = self;
        let (z, inverse_rho) = (z.as_slice(), 1.0 / *rho);
        let domain = &problem.domain;
        let (map, fidelity) = (problem.map, 2.0 * problem.lambda);
        let (mut nuclear, mut primal, mut image, mut split) = (0.0, 0.0, 0.0, 0.0);
        let (mut distance, mut inner, mut dual_size, mut dual) = (0.0, 0.0, 0.0, 0.0);
        rolling.sweep(
            domain,
            v,
            |v, row, weights| {
                for run in domain.interior().row(row) {
                    let ring = Ring::new(z, domain, row, *run);
                    let v = v.run(*run);
                    let (col, n) = (run.start - row * domain.stride(), run.end - run.start);
                    let [w1, w2, w3] = weights;
                    let (w1, w2, w3) = (
                        &mut w1[col..][..n],
                        &mut w2[col..][..n],
                        &mut w3[col..][..n],
                    );
                    nuclear += lanes::sum(n, |i| map.hessian(ring.differences(i)).nuclear_norm());
                    primal += lanes::sum(n, |i| {
                        let value = v.get(i);
                        let h = (value - value.clamp(1.0)).scale(inverse_rho);
                        let gap = map.hessian(ring.differences(i)) - h;
                        gap.dot(gap)
                    });
                    image += lanes::sum(n, |i| {
                        let hessian = map.hessian(ring.differences(i));
                        hessian.dot(hessian)
                    });
                    split += lanes::sum(n, |i| {
                        let value = v.get(i);
                        let y = value.clamp(1.0);
                        let [q1, q2, q3] = map.adjoint(y);
                        (w1[i], w2[i], w3[i]) = (q1, q2, q3);
                        let h = (value - y).scale(inverse_rho);
                        h.dot(h)
                    });
                }
            },
            |_, row, sums| {
                for run in domain.active().row(row) {
                    let sum = sums.run(*run);
                    let n = run.end - run.start;
                    let z = &z[run.start..][..n];
                    let target = &problem.target[run.start..][..n];
                    distance += lanes::sum(n, |i| (z[i] - target[i]) * (z[i] - target[i]));
                    inner += lanes::sum(n, |i| sum.at(i) * target[i]);
                    dual_size += lanes::sum(n, |i| sum.at(i) * sum.at(i));
                    dual += lanes::sum(n, |i| {
                        let gradient = fidelity * (z[i] - target[i]) + sum.at(i);
                        gradient * gradient
                    });
                }
            },
        );
        // D(tY) = t⟨CᵀY, z̃⟩ − t²‖CᵀY‖²/4λ is concave in t, and tY is feasible up to t = 1.
        let t = if dual_size > 0.0 {
            (fidelity * inner / dual_size).clamp(0.0, 1.0)
        } else {
            0.0
        };
        Certificate {
            fidelity: problem.lambda * distance,
            nuclear_norm: nuclear,
            dual_bound: t * inner - t * t * dual_size / (2.0 * fidelity),
            primal_residual: primal.sqrt(),
            primal_size: image.sqrt().max(split.sqrt()),
            dual_residual: dual.sqrt(),
            dual_size: dual_size.sqrt(),
        }
    }
}

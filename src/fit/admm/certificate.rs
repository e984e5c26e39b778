//! The certificate of ADMM's iterate: objective, dual bound and residuals.

use super::iterate::{CERTIFICATE_SUMS, Iterate, SumTerms};
use super::matrix_field::MatrixBand;
use crate::fit::energy::problem::Problem;
use crate::fit::energy::spectral_penalty::{NuclearNorm, PenaltyKind, SpectralPenalty};
use crate::fit::linear::z_step_solver::SolvableOperator;
use crate::fit::operator::{Hessians, Matrices, Sums};
use crate::math::lanes;
use crate::math::sym2::Sym2;

/// Returns the first `n` entries of each buffer for a sum's terms.
#[inline(always)]
fn terms_of(terms: &mut SumTerms, n: usize) -> [&mut [f64]; CERTIFICATE_SUMS] {
    terms.each_mut().map(|row| &mut row[..n])
}

/// Adds the terms of one run of vertices or stencils to the certificate's sums.
fn add_sums<const N: usize>(sums: &mut [f64; CERTIFICATE_SUMS], terms: [&mut [f64]; N]) {
    for (sum, terms) in sums.iter_mut().zip(terms) {
        *sum += lanes::sum(terms);
    }
}

/// Adds the sums of all bands.
pub(super) fn total<const N: usize>(bands: impl Iterator<Item = [f64; N]>) -> [f64; N] {
    bands.fold([0.0; N], |sums, band| {
        std::array::from_fn(|k| sums[k] + band[k])
    })
}

/// The part of an iterate in one band, and what the certificate sums up there.
struct BandSums<'a> {
    v: MatrixBand<'a, f64>,
    stencil_terms: &'a mut SumTerms,
    vertex_terms: &'a mut SumTerms,
    over_stencils: [f64; CERTIFICATE_SUMS],
    over_vertices: [f64; CERTIFICATE_SUMS],
}

/// Objective, dual bound and residuals of an iterate of ADMM, from which its duality gap follows.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Certificate {
    /// Fidelity `λ Σ w (z − z̃)²`, with the vertices' weights `w`.
    pub fidelity: f64,
    /// Penalty `Σ ω f(Cz)` of the Hessians, with the stencils' weights `ω`: the nuclear norm or another energy `f`.
    pub nuclear_norm: f64,
    /// Dual bound `D(tY)` with the best factor `t`: a certified lower bound of the optimal objective.
    pub dual_bound: f64,
    /// Norm `‖Cz − H‖` of the primal residual.
    pub primal_residual: f64,
    /// The larger of `‖Cz‖` and `‖H‖`, to which the primal residual is compared.
    pub primal_size: f64,
    /// Norm `‖2λ(z − z̃) + CᵀY‖` of the dual residual, which is `ρ‖CᵀΔH‖` for exact z-steps.
    pub dual_residual: f64,
    /// Norm `‖CᵀY‖`, to which the dual residual is compared.
    pub dual_size: f64,
    /// Norm `‖Y‖` of the dual.
    pub dual_norm: f64,
    /// Part `Σ (2λw(z − z̃) + CᵀY)² / 4λw` of the absolute duality gap `P − D` that the dual residual causes.
    pub dual_cost: f64,
}

impl Certificate {
    /// Objective `P`: the sum of fidelity and penalty.
    pub(crate) fn objective(&self) -> f64 {
        self.fidelity + self.nuclear_norm
    }
}

impl<O: SolvableOperator> Iterate<O> {
    /// Computes the iterate's objective, dual bound and residuals in one pass over the vertices.
    pub(crate) fn certify(&mut self, problem: &Problem<O>) -> Certificate {
        match problem.kind {
            PenaltyKind::Nuclear => self.certify_under(NuclearNorm, problem),
            _ => self.certify_under(self.penalty(problem), problem),
        }
    }

    fn certify_under(
        &mut self,
        penalty: impl SpectralPenalty,
        problem: &Problem<O>,
    ) -> Certificate {
        let Iterate {
            z,
            v,
            rho,
            scratch,
            terms,
        } = self;
        let (z, inverse_rho) = (z.as_slice(), 1.0 / *rho);
        let fidelity = 2.0 * problem.lambda;
        let bands = v.split(problem.operator.bands());
        let mut states: Vec<_> = bands
            .zip(terms)
            .map(|(v, [stencil_terms, vertex_terms])| BandSums {
                v,
                stencil_terms,
                vertex_terms,
                over_stencils: [0.0; CERTIFICATE_SUMS],
                over_vertices: [0.0; CERTIFICATE_SUMS],
            })
            .collect();
        problem.operator.sweep(
            scratch,
            z,
            &mut states,
            |state, run, hessians, mut matrices| {
                let v = state.v.run(run);
                let weight = problem.weight.run(run);
                let n = run.end - run.start;
                let [t1, t2, t3, t4, t5, t6] = terms_of(state.stencil_terms, n);
                for i in 0..n {
                    let hessian = Sym2::from_coordinates(hessians.at(i));
                    let value = v.get(i);
                    let y = penalty.dual(value, weight[i]);
                    matrices.set(i, y.coordinates());
                    let rho_share = problem.operator.rho_share(run.start + i);
                    let h = (value - y).scale(inverse_rho / rho_share);
                    let gap = hessian - h;
                    let area = problem.operator.area(run.start + i);
                    t1[i] = area * penalty.value(hessian, weight[i]);
                    t2[i] = area * gap.dot(gap);
                    t3[i] = area * hessian.dot(hessian);
                    t4[i] = area * h.dot(h);
                    t5[i] = area * y.dot(y);
                    t6[i] = area * penalty.conjugate(y, weight[i]);
                }
                add_sums(&mut state.over_stencils, [t1, t2, t3, t4, t5, t6]);
            },
            |state, run, sums| {
                let n = run.end - run.start;
                let z = &z[run.start..][..n];
                let target = &problem.target[run.start..][..n];
                let weight = problem.fidelity.run(run);
                let inverse = problem.inverse_fidelity.run(run);
                let [t1, t2, t3, t4, t5, t6] = terms_of(state.vertex_terms, n);
                for i in 0..n {
                    let offset = z[i] - target[i];
                    let adjoint = sums.at(i);
                    let gradient = fidelity * (weight[i] * offset) + adjoint;
                    let square = adjoint * adjoint;
                    // Nothing is asked of the gradient at constrained vertices.
                    let asked = inverse[i] > 0.0;
                    t1[i] = weight[i] * (offset * offset);
                    t2[i] = adjoint * target[i];
                    t3[i] = square * inverse[i];
                    t4[i] = if asked { gradient * gradient } else { 0.0 };
                    t5[i] = if asked { square } else { 0.0 };
                    t6[i] = gradient * gradient * inverse[i];
                }
                add_sums(&mut state.over_vertices, [t1, t2, t3, t4, t5, t6]);
            },
        );
        let [nuclear, primal, image, split, dual_norm, conjugate] =
            total(states.iter().map(|state| state.over_stencils));
        let [distance, inner, quadratic, dual, dual_size, cost] =
            total(states.iter().map(|state| state.over_vertices));
        let bound = dual_bound(problem, inner, quadratic, conjugate, penalty.largest());
        Certificate {
            fidelity: problem.lambda * distance - problem.offset,
            nuclear_norm: nuclear,
            dual_bound: bound,
            primal_residual: primal.sqrt(),
            primal_size: image.sqrt().max(split.sqrt()),
            dual_residual: dual.sqrt(),
            dual_size: dual_size.sqrt(),
            dual_norm: dual_norm.sqrt(),
            dual_cost: cost / (4.0 * problem.lambda),
        }
    }
}

/// Computes the dual bound `D(tY) = t⟨CᵀY, z̃⟩ − t²(Σ (CᵀY)²/4λw + Σ (ωf)*(Y))` for the best factor `t` up to
/// `largest`: the bound is concave in `t`, because the conjugates are 0 or quadratic. `inner`, `quadratic` and
/// `conjugate` are the three sums. Where they overflow, `t` is 0. The bound is finite, and at least 0 before the
/// problem's constant offset is subtracted.
pub(super) fn dual_bound<O: SolvableOperator>(
    problem: &Problem<O>,
    inner: f64,
    quadratic: f64,
    conjugate: f64,
    largest: f64,
) -> f64 {
    let square = quadratic / (4.0 * problem.lambda) + conjugate;
    // With NaN as the larger one of two, the other is taken.
    let t = (inner / (2.0 * square)).max(0.0).min(largest);
    let bound = t * inner - t * t * square;
    let bound = if square >= 0.0 && bound > 0.0 && bound.is_finite() {
        bound
    } else {
        0.0
    };
    bound - problem.offset
}

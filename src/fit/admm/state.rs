//! The ADMM iterate and the two passes over it: the update of Hessians and
//! dual, and the certificate.
//!
//! Paper, Eq. 18 and 19, in the form of one matrix `V = Y + ρH` per stencil, from which both follow: for the nuclear norm, the dual `Y = ρU` is the
//! projection of `V` onto the dual ball, and `ρH = V − Y` its soft threshold
//! (`penalty` has the other energies). So `Y` is feasible by construction, and
//! nothing else has to be stored.

use crate::error::{Result, try_filled};
use crate::fit::energy::problem::Problem;
use crate::fit::energy::spectral_penalty::{AnyPenalty, NuclearNorm, PenaltyKind, SpectralPenalty};
use crate::fit::linear::zstep::{Solvable, Solver};
use crate::fit::operator::{Hessians, Matrices, Sums};
use crate::lattice::runs::Run;
use crate::math::lanes;
use crate::math::sym2::Sym2;

/// `z` at the operator's vertices and `V` at its stencils.
#[derive(Debug, Clone)]
pub(crate) struct State<O: Solvable> {
    pub z: Vec<f64>,
    pub(crate) v: MatrixField,
    pub rho: f64,
    pub(super) scratch: O::Scratch<f64>,
    /// A run of what the certificate sums, over matrices and over heights.
    pub(super) terms: [Terms; 2],
}

type Terms = [Vec<f64>; CERTIFICATE_SUMS];

/// Number of sums over matrices, and as many over heights, that a certificate takes.
const CERTIFICATE_SUMS: usize = 6;

/// The first `n` terms of each sum.
#[inline(always)]
fn terms_of(terms: &mut Terms, n: usize) -> [&mut [f64]; CERTIFICATE_SUMS] {
    terms.each_mut().map(|row| &mut row[..n])
}

fn add_sums<const N: usize>(sums: &mut [f64; CERTIFICATE_SUMS], terms: [&mut [f64]; N]) {
    for (sum, terms) in sums.iter_mut().zip(terms) {
        *sum += lanes::sum(terms);
    }
}

/// A symmetric matrix per stencil, each coordinate of [`Sym2`] contiguous.
#[derive(Debug, Clone)]
pub(crate) struct MatrixField {
    mean: Vec<f64>,
    diff: Vec<f64>,
    off: Vec<f64>,
}

/// One run of a [`MatrixField`].
pub(super) struct MatrixRun<'a> {
    mean: &'a mut [f64],
    diff: &'a mut [f64],
    off: &'a mut [f64],
}

impl MatrixField {
    /// Zeros.
    pub(super) fn new<O: Solvable>(problem: &Problem<O>) -> Result<Self> {
        let cells = problem.operator.stencil_cells();
        let zeros = || try_filled("Hessians and dual", cells, 0.0);
        Ok(MatrixField {
            mean: zeros()?,
            diff: zeros()?,
            off: zeros()?,
        })
    }

    pub(crate) fn get(&self, cell: usize) -> Sym2 {
        Sym2 {
            mean: self.mean[cell],
            diff: self.diff[cell],
            off: self.off[cell],
        }
    }

    pub(crate) fn set(&mut self, cell: usize, value: Sym2) {
        self.mean[cell] = value.mean;
        self.diff[cell] = value.diff;
        self.off[cell] = value.off;
    }

    /// From `V = Y + ρH` to `Y + factor · ρH`.
    fn rescale<O: Solvable>(
        &mut self,
        problem: &Problem<O>,
        penalty: impl SpectralPenalty,
        factor: f64,
    ) {
        for run in problem.operator.stencils().all() {
            let weight = problem.weight.run(*run);
            let mut v = self.run(*run);
            for (i, weight) in weight.iter().enumerate() {
                let value = v.get(i);
                let dual = penalty.dual(value, *weight);
                v.set(i, dual + (value - dual).scale(factor));
            }
        }
    }

    #[inline(always)]
    pub(super) fn run(&mut self, run: Run) -> MatrixRun<'_> {
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
    pub(super) fn get(&self, i: usize) -> Sym2 {
        Sym2 {
            mean: self.mean[i],
            diff: self.diff[i],
            off: self.off[i],
        }
    }

    #[inline(always)]
    pub(super) fn set(&mut self, i: usize, value: Sym2) {
        self.mean[i] = value.mean;
        self.diff[i] = value.diff;
        self.off[i] = value.off;
    }
}

/// What one pass over an iterate finds out about it.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Certificate {
    /// `λ Σ w (z − z̃)²`.
    pub fidelity: f64,
    /// `Σ ω f(Cz)`.
    pub nuclear_norm: f64,
    /// `D(tY)` with the best `t`: a lower bound of the optimum.
    pub dual_bound: f64,
    /// `‖Cz − H‖`, and the larger of `‖Cz‖` and `‖H‖`.
    pub primal_residual: f64,
    pub primal_size: f64,
    /// `‖2λ(z − z̃) + CᵀY‖`, which is `ρ‖CᵀΔH‖` for exact z-steps, and `‖CᵀY‖`.
    pub dual_residual: f64,
    pub dual_size: f64,
    /// `‖Y‖`.
    pub dual_norm: f64,
    /// `Σ (2λw(z − z̃) + CᵀY)² / 4λw`: what the dual residual contributes to the gap.
    pub dual_cost: f64,
}

impl Certificate {
    pub(crate) fn objective(&self) -> f64 {
        self.fidelity + self.nuclear_norm
    }
}

impl<O: Solvable> State<O> {
    /// `z = z̃`, `H = U = 0`.
    pub(crate) fn new(problem: &Problem<O>, rho: f64) -> Result<Self> {
        let operator = &problem.operator;
        let mut z = try_filled("heights", operator.vertex_cells(), 0.0)?;
        z.copy_from_slice(&problem.target);
        Ok(State {
            z,
            v: MatrixField::new(problem)?,
            rho,
            scratch: operator.scratch()?,
            terms: std::array::from_fn(|_| {
                std::array::from_fn(|_| vec![0.0; operator.longest_run()])
            }),
        })
    }

    /// From another `z`, with `H = U = 0`.
    pub(crate) fn start_again(&mut self, z: &[f64]) {
        self.z.copy_from_slice(z);
        let MatrixField { mean, diff, off } = &mut self.v;
        for coordinate in [mean, diff, off] {
            coordinate.fill(0.0);
        }
    }

    /// Changes ρ, leaving `H` and `Y` as they are.
    pub(crate) fn set_rho(&mut self, problem: &Problem<O>, rho: f64) {
        self.v
            .rescale(problem, self.penalty(problem), rho / self.rho);
        self.rho = rho;
    }

    /// `V` of the same `H` and `Y` at another ρ.
    pub(crate) fn v_at(&self, problem: &Problem<O>, rho: f64) -> Result<MatrixField> {
        let mut v = MatrixField::new(problem)?;
        for (to, from) in [
            (&mut v.mean, &self.v.mean),
            (&mut v.diff, &self.v.diff),
            (&mut v.off, &self.v.off),
        ] {
            to.copy_from_slice(from);
        }
        v.rescale(problem, self.penalty(problem), rho / self.rho);
        Ok(v)
    }

    /// `Y` and `H` at a stencil.
    pub(crate) fn matrices(&self, problem: &Problem<O>, cell: usize) -> (Sym2, Sym2) {
        let v = self.v.get(cell);
        let weight = problem.weight.at(cell);
        let dual = self.penalty(problem).dual(v, weight);
        let rho = self.rho * problem.operator.rho_share(cell);
        (dual, (v - dual).scale(1.0 / rho))
    }

    /// Sets both at a stencil of the usual penalty.
    pub(crate) fn set_matrices(&mut self, cell: usize, dual: Sym2, hessian: Sym2) {
        self.v.set(cell, dual + hessian.scale(self.rho));
    }

    /// Sets both at a stencil.
    pub(crate) fn set_matrices_of(
        &mut self,
        problem: &Problem<O>,
        cell: usize,
        [dual, hessian]: [Sym2; 2],
    ) {
        let rho_share = problem.operator.rho_share(cell);
        self.set_matrices(cell, dual, hessian.scale(rho_share));
    }

    /// H-step and dual update with the given over-relaxation, then the residual
    /// `b − A z = 2λ(z̃ − z) + Cᵀ(ρH − Y − ρCz)` that the next z-step starts
    /// from, in one pass. Relaxation 0 leaves `H` and `Y` as they are.
    pub(crate) fn update(&mut self, problem: &Problem<O>, relaxation: f64, solver: &mut O::Solver) {
        match problem.kind {
            PenaltyKind::Nuclear => {
                self.update_of::<false>(NuclearNorm, problem, relaxation, solver)
            }
            PenaltyKind::Huber(bends) => {
                self.update_of::<false>(bends.penalty(self.rho), problem, relaxation, solver)
            }
            // One kernel for all the others: less code, and measuring costs little.
            _ => self.update_and_measure(problem, relaxation, solver),
        };
    }

    /// The same; returns `ρ‖ΔH‖`, the change of the Hessians.
    pub(crate) fn update_and_measure(
        &mut self,
        problem: &Problem<O>,
        relaxation: f64,
        solver: &mut O::Solver,
    ) -> f64 {
        self.update_of::<true>(self.penalty(problem), problem, relaxation, solver)
    }

    pub(super) fn penalty(&self, problem: &Problem<O>) -> AnyPenalty {
        AnyPenalty::new(problem.kind, self.rho)
    }

    fn update_of<const MEASURE: bool>(
        &mut self,
        penalty: impl SpectralPenalty,
        problem: &Problem<O>,
        relaxation: f64,
        solver: &mut O::Solver,
    ) -> f64 {
        let State {
            z,
            v,
            rho,
            scratch,
            terms,
        } = self;
        let [[squares, ..], [wide, ..]] = terms;
        let mut change = 0.0;
        let (z, rho) = (z.as_slice(), *rho);
        let fidelity = 2.0 * problem.lambda;
        let scale = solver.residual_scale();
        let residual = solver.residual();
        problem.operator.sweep(
            scratch,
            z,
            v,
            |v, run, hessians, mut matrices| {
                let mut v = v.run(run);
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
                    change += lanes::sum(&squares[..n]);
                }
            },
            |_, run, sums| {
                let n = run.end - run.start;
                let z = &z[run.start..][..n];
                let target = &problem.target[run.start..][..n];
                let wide = &mut wide[..n];
                let weight = problem.fidelity.run(run);
                for i in 0..n {
                    let value = fidelity * (weight[i] * (target[i] - z[i])) + sums.at(i);
                    wide[i] = scale * value;
                }
                lanes::narrow(wide, &mut residual[run.start..][..n]);
            },
        );
        solver.restart(&problem.operator);
        change.sqrt()
    }

    /// Objective, dual bound and residuals, in one pass.
    pub(crate) fn certify(&mut self, problem: &Problem<O>) -> Certificate {
        match problem.kind {
            PenaltyKind::Nuclear => self.certify_of(NuclearNorm, problem),
            _ => self.certify_of(self.penalty(problem), problem),
        }
    }

    fn certify_of(&mut self, penalty: impl SpectralPenalty, problem: &Problem<O>) -> Certificate {
        let State {
            z,
            v,
            rho,
            scratch,
            terms,
        } = self;
        let (z, inverse_rho) = (z.as_slice(), 1.0 / *rho);
        let fidelity = 2.0 * problem.lambda;
        let (mut stencil_sums, mut vertex_sums) =
            ([0.0; CERTIFICATE_SUMS], [0.0; CERTIFICATE_SUMS]);
        let [stencil_terms, vertex_terms] = terms;
        problem.operator.sweep(
            scratch,
            z,
            v,
            |v, run, hessians, mut matrices| {
                let v = v.run(run);
                let weight = problem.weight.run(run);
                let n = run.end - run.start;
                let [t1, t2, t3, t4, t5, t6] = terms_of(stencil_terms, n);
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
                add_sums(&mut stencil_sums, [t1, t2, t3, t4, t5, t6]);
            },
            |_, run, sums| {
                let n = run.end - run.start;
                let z = &z[run.start..][..n];
                let target = &problem.target[run.start..][..n];
                let weight = problem.fidelity.run(run);
                let inverse = problem.inverse_fidelity.run(run);
                let [t1, t2, t3, t4, t5, t6] = terms_of(vertex_terms, n);
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
                add_sums(&mut vertex_sums, [t1, t2, t3, t4, t5, t6]);
            },
        );
        let [nuclear, primal, image, split, dual_norm, conjugate] = stencil_sums;
        let [distance, inner, quadratic, dual, dual_size, cost] = vertex_sums;
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

/// `D(tY) = t⟨CᵀY, z̃⟩ − t²(Σ (CᵀY)²/4λw + Σ (ωf)*(Y))` for the best `t` up to
/// `largest`: it is concave in `t`, and the conjugates are 0 or quadratic. Where that
/// overflows, what is left is `t = 0`. Always finite, and never below 0 but for the problem's offset.
pub(super) fn dual_bound<O: Solvable>(
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

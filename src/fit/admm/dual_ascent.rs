//! Dual ascent: accelerated projected gradient steps that improve the dual of an ADMM iterate, for a better dual bound.
//!
//! The dual of ADMM is slow to follow the highest frequencies where the surface bends: the noise that a finer
//! lattice adds costs the bound many iterations after the objective has settled. Gradient ascent follows these
//! frequencies fast and low ones slowly. With `z_Y = z̃ − CᵀY/2λ`, which minimises the
//! Lagrangian, `∇D(Y) = C z_Y`, and `Y ← P(Y + τ C z_Y)` with `τ = 2λ/‖CᵀC‖` and momentum (Beck and
//! Teboulle 2009) takes a few steps to what ADMM needs tens of iterations for. ADMM itself keeps its
//! own dual: going on from the better one saves it no iteration.
//!
//! The steps run in single precision, heights in units of `1/2λh²`, in which `τC` has no units; the bound is
//! evaluated in double precision.

use super::certificate::{dual_bound, total};
use super::iterate::{Iterate, SumTerms};
use super::matrix_field::{MatrixBand, MatrixField, MatrixRun};
use crate::error::{Result, try_filled};
use crate::fit::energy::problem::Problem;
use crate::fit::energy::spectral_penalty::{NuclearNorm, PenaltyKind, SpectralPenalty};
use crate::fit::linear::z_step_solver::SolvableOperator;
use crate::fit::operator::{Hessians as _, Matrices as _, Sums as _};
use crate::lattice::per_cell::PerCell;
use crate::lattice::runs::Run;
use crate::math::fork;
use crate::math::lanes::{self, narrow, widen};
use crate::math::sym2::clamp;

/// Number of gradient steps of a dual ascent from one evaluation of the dual bound to the next; each step costs a third
/// to a fourth of an ADMM iteration (`benches/choices.md`, One constant at a time).
const STEPS_PER_EVALUATION: usize = 8;

/// Maximum ratio of the increase that is still missing from the dual bound to its last increase at which the ascent
/// continues: each evaluation increases the bound by about half of what the one before did
/// (`benches/choices.md`, One constant at a time).
const EXTRAPOLATION_FACTOR: f64 = 1.5;

/// Momentum of the `k`-th step of accelerated gradient ascent (Beck and Teboulle), as a share of the step before.
fn momentum(k: usize) -> f32 {
    k as f32 / (k as f32 + 3.0)
}

/// Cost of [`STEPS_PER_EVALUATION`] dual ascent steps and one evaluation of the bound, in conjugate-gradient
/// iterations.
pub(super) const EVALUATION_COST_CG_ITERATIONS: usize = 5;

/// Progress of a dual ascent: its goal, and the dual bounds evaluated so far.
#[derive(Debug, Clone, Default)]
struct AscentProgress {
    /// Dual bound at which the ascent ends.
    goal: f64,
    /// Largest dual bound so far.
    best: f64,
    /// Dual bound of the last evaluation.
    last: f64,
    evaluations: usize,
}

/// A dual ascent from the dual of an ADMM iterate, with its buffers.
#[derive(Debug, Clone)]
pub(super) struct DualAscent<O: SolvableOperator> {
    progress: AscentProgress,
    /// Dual `Y` after the last step.
    last: MatrixField<f32>,
    /// Dual `Y` extrapolated by the momentum, from which the next step starts.
    ahead: MatrixField<f32>,
    /// Heights `z_Y = z̃ − CᵀY/2λ` for `Y = 0`.
    base: Vec<f32>,
    /// Heights `z_Y = z̃ − CᵀY/2λ` of the extrapolated dual.
    heights: Vec<f32>,
    /// For each vertex 0 if it is constrained, so that its height stays, and 1 otherwise.
    mobility: PerCell<f32>,
    /// Weight `ω` of each stencil's penalty in the energy.
    weight: PerCell<f32>,
    scratch: O::Scratch<f32>,
    /// Buffer of each band for the matrices of one run of stencils, in double precision.
    rows: Vec<[Vec<f64>; 3]>,
}

impl<O: SolvableOperator> DualAscent<O> {
    /// Allocates the buffers for dual ascents on a problem.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub(super) fn new(problem: &Problem<O>) -> Result<Self> {
        let operator = &problem.operator;
        let zeros = |cells| try_filled("bound", cells, 0.0);
        let matrices = || MatrixField::new(operator.stencil_cells());
        let row = || std::array::from_fn(|_| vec![0.0; operator.longest_run()]);
        let mut mobility = PerCell::same(operator.longest_run(), 1.0);
        if !problem.constrained.is_empty() {
            let mut each = try_filled("bound", operator.vertex_cells(), 1.0)?;
            for cell in &problem.constrained {
                each[*cell as usize] = 0.0;
            }
            mobility = PerCell::Each(each);
        }
        Ok(DualAscent {
            progress: AscentProgress::default(),
            last: matrices()?,
            ahead: matrices()?,
            base: zeros(operator.vertex_cells())?,
            heights: zeros(operator.vertex_cells())?,
            mobility,
            weight: PerCell::same(operator.longest_run(), 1.0),
            scratch: operator.scratch()?,
            rows: (0..operator.bands().len()).map(|_| row()).collect(),
        })
    }

    /// Begins a dual ascent from the iterate's dual. The ascent ends when the dual bound reaches the `goal`, or is
    /// predicted not to. `bound` is the largest dual bound so far.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub(super) fn start_dual_ascent(
        &mut self,
        iterate: &mut Iterate<O>,
        problem: &Problem<O>,
        bound: f64,
        goal: f64,
    ) -> Result<()> {
        self.set_dual(iterate, problem)?;
        self.progress = AscentProgress {
            goal,
            best: bound,
            last: f64::NEG_INFINITY,
            evaluations: 0,
        };
        Ok(())
    }

    /// Takes [`STEPS_PER_EVALUATION`] gradient steps and evaluates the dual bound. Returns the largest bound once the
    /// ascent is over, and `None` before.
    pub(super) fn evaluate_bound(
        &mut self,
        iterate: &mut Iterate<O>,
        problem: &Problem<O>,
    ) -> Option<f64> {
        match problem.kind {
            PenaltyKind::Huber(bends) => {
                let unit = problem.operator.spacing().powi(4);
                let tau = 2.0 * problem.lambda * unit / f64::from(problem.operator.norm());
                let step = bends.single(tau);
                self.take_steps(&problem.operator, move |v, weight| step.dual(v, weight));
            }
            // The projection onto the dual ball, matrices of spectral norm at most the stencil's weight.
            _ => self.take_steps(&problem.operator, clamp),
        }
        let next = self.bound(iterate, problem);
        let search = &mut self.progress;
        search.evaluations += 1;
        search.best = search.best.max(next);
        let in_reach = search.goal - next <= EXTRAPOLATION_FACTOR * (next - search.last);
        search.last = next;
        let over = search.best >= search.goal || !in_reach;
        over.then_some(search.best)
    }

    /// Takes the gradient steps up to the next evaluation of the dual bound. Each is followed by the `proximal` map of the
    /// penalty's convex conjugate, of a matrix, given by its coordinates, and the weight of its stencil.
    fn take_steps(
        &mut self,
        operator: &O,
        proximal: impl Fn([f32; 3], f32) -> [f32; 3] + Copy + Sync,
    ) {
        let before = self.progress.evaluations * STEPS_PER_EVALUATION;
        for step in before..before + STEPS_PER_EVALUATION {
            self.take_step(operator, proximal, momentum(step));
        }
    }

    /// Sets the starting point of the ascent to the dual of ADMM's iterate. Where vertices have fidelity weights below
    /// 1, part of the iterate's `z` replaces `z̃`, so that a step need not be smaller.
    fn set_dual(&mut self, iterate: &mut Iterate<O>, problem: &Problem<O>) -> Result<()> {
        let penalty = iterate.penalty(problem);
        problem.weight.narrow_into(&mut self.weight)?;
        let spacing = problem.operator.spacing();
        let unit = 2.0 * problem.lambda * spacing * spacing;
        let operator = &problem.operator;
        let bands = operator.bands();
        let z = &iterate.z;
        let mut states: Vec<_> = bands.split(&mut self.base).zip(&mut self.rows).collect();
        fork::for_each(&mut states, |band, (to, row)| {
            for run in bands.runs(operator.vertices(), band) {
                let Run { start, end } = *run;
                let weight = problem.fidelity.run(*run);
                let (z, target) = (&z[start..end], &problem.target[start..end]);
                let [base, ..] = row_of(row, end - start);
                for i in 0..base.len() {
                    base[i] = unit * (z[i] + weight[i] * (target[i] - z[i]));
                }
                narrow(base, to.run_mut(*run));
            }
        });
        let to = self.last.split(bands).zip(self.ahead.split(bands));
        let from = iterate.v.split(bands).zip(&mut self.rows);
        let mut states: Vec<_> = from.zip(to).collect();
        fork::for_each(&mut states, |band, ((v, row), (last, ahead))| {
            for run in bands.runs(operator.stencils(), band) {
                let v = v.run(*run);
                let weight = problem.weight.run(*run);
                let mut wide = MatrixRun(row_of(row, weight.len()));
                for (i, weight) in weight.iter().enumerate() {
                    wide.set(i, penalty.dual(v.get(i), *weight));
                }
                for to in [&mut *last, &mut *ahead] {
                    for (from, to) in wide.0.iter().zip(to.run(*run).0) {
                        narrow(from, to);
                    }
                }
            }
        });
        Ok(())
    }

    /// Takes one gradient step of the dual in one pass over the vertices.
    fn take_step(
        &mut self,
        operator: &O,
        proximal: impl Fn([f32; 3], f32) -> [f32; 3] + Sync,
        momentum: f32,
    ) {
        let DualAscent {
            last,
            ahead,
            base,
            heights,
            mobility,
            weight,
            scratch,
            ..
        } = self;
        let share = 1.0 / operator.norm();
        let bands = operator.bands();
        let mut states: Vec<_> = last.split(bands).zip(ahead.split(bands)).collect();
        operator.sweep_back(
            scratch,
            heights,
            &mut states,
            |(_, ahead), run, mut matrices| {
                let [mean, diff, off] = ahead.run(run).0;
                for i in 0..mean.len() {
                    matrices.set(i, [mean[i], diff[i], off[i]]);
                }
            },
            |_, run, sums, heights| {
                let mobility = mobility.run(run);
                let base = &base[run.start..run.end];
                for i in 0..heights.len() {
                    heights[i] = base[i] - mobility[i] * sums.at(i);
                }
            },
            |(last, ahead), run, hessians| {
                let weight = weight.run(run);
                let ([l1, l2, l3], [a1, a2, a3]) = (last.run(run).0, ahead.run(run).0);
                for i in 0..weight.len() {
                    let [g1, g2, g3] = hessians.at(i);
                    let up = |from: f32, gradient: f32| from + gradient * share;
                    let [n1, n2, n3] =
                        proximal([up(a1[i], g1), up(a2[i], g2), up(a3[i], g3)], weight[i]);
                    a1[i] = n1 + momentum * (n1 - l1[i]);
                    a2[i] = n2 + momentum * (n2 - l2[i]);
                    a3[i] = n3 + momentum * (n3 - l3[i]);
                    (l1[i], l2[i], l3[i]) = (n1, n2, n3);
                }
            },
        );
    }

    /// Computes the dual bound `D` of the dual after the last step, in double precision.
    fn bound(&mut self, iterate: &mut Iterate<O>, problem: &Problem<O>) -> f64 {
        let DualAscent { last, rows, .. } = self;
        let penalty = iterate.penalty(problem);
        let Iterate {
            z, scratch, terms, ..
        } = iterate;
        let bands = problem.operator.bands();
        let mut states: Vec<_> = (last.split(bands))
            .zip(rows)
            .zip(terms)
            .map(|((last, wide), terms)| BoundSums {
                last,
                wide,
                terms,
                sums: [0.0; 3],
            })
            .collect();
        let costs = problem.kind != PenaltyKind::Nuclear;
        // The Hessians of `z` are not used.
        problem.operator.sweep(
            scratch,
            z,
            &mut states,
            |state, run, _, mut matrices| {
                let [[conjugates, ..], _] = &mut *state.terms;
                let weight = problem.weight.run(run);
                let n = weight.len();
                let mut wide = MatrixRun(row_of(state.wide, n));
                let single = state.last.run(run);
                for (from, to) in single.0.into_iter().zip(wide.0.iter_mut()) {
                    widen(from, to);
                }
                for i in 0..n {
                    // Rounding to single precision may have left the dual just infeasible.
                    let dual = NuclearNorm.dual(wide.get(i), weight[i]);
                    matrices.set(i, dual.coordinates());
                    if costs {
                        let area = problem.operator.area(run.start + i);
                        conjugates[i] = area * penalty.conjugate(dual, weight[i]);
                    }
                }
                if costs {
                    state.sums[0] += lanes::sum(&conjugates[..n]);
                }
            },
            |state, run, sums| {
                let [_, [inners, quadratics, ..]] = &mut *state.terms;
                let n = run.end - run.start;
                let target = &problem.target[run.start..][..n];
                let inverse = problem.inverse_fidelity.run(run);
                let (inners, quadratics) = (&mut inners[..n], &mut quadratics[..n]);
                for i in 0..n {
                    let adjoint = sums.at(i);
                    inners[i] = adjoint * target[i];
                    quadratics[i] = adjoint * adjoint * inverse[i];
                }
                state.sums[1] += lanes::sum(inners);
                state.sums[2] += lanes::sum(quadratics);
            },
        );
        let [conjugate, inner, quadratic] = total(states.iter().map(|state| state.sums));
        dual_bound(problem, inner, quadratic, conjugate, 1.0)
    }
}

/// The part of one band in an evaluation of the dual bound: arrays that it reads, and its sums.
struct BoundSums<'a> {
    last: MatrixBand<'a, f32>,
    wide: &'a mut [Vec<f64>; 3],
    terms: &'a mut [SumTerms; 2],
    /// Sums of the conjugates, of `⟨CᵀY, z̃⟩`, and of `(CᵀY)²` over the weights.
    sums: [f64; 3],
}

/// Returns the first `n` values of each coordinate in a buffer of matrices.
#[inline(always)]
fn row_of(row: &mut [Vec<f64>; 3], n: usize) -> [&mut [f64]; 3] {
    row.each_mut().map(|values| &mut values[..n])
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::fit::coordinates::Coordinates;
    use crate::{Domain, Heightfield, Input, Lattice, Options};

    /// Rows that alternate by so little that no dual is saturated: the best surface is flat, and
    /// the optimum what all of the alternation costs. From `Y = 0`, a few steps reach nearly all of it.
    #[test]
    fn a_few_steps_find_what_high_frequencies_cost() {
        let lattice = Lattice::new(40, 40, 1.0).unwrap();
        let height = |_: f64, y: f64| {
            if (y / 0.75f64.sqrt()).round() % 2.0 == 0.0 {
                1e-3
            } else {
                -1e-3
            }
        };
        let input = Input::new(Heightfield::from_fn(lattice, height).unwrap());
        let domain = Arc::new(Domain::new(input.field()).unwrap());
        let coordinates = Coordinates::new(&input, &domain, 1.0);
        let problem = Problem::new(
            &input,
            domain.clone(),
            &coordinates,
            &Options::paper().lambda(1.0),
        )
        .unwrap();
        let mut iterate = Iterate::new(&problem, 1.0).unwrap();
        let mut ascent = DualAscent::new(&problem).unwrap();
        let inside: f64 = domain
            .active()
            .cells()
            .map(|cell| problem.target[cell].powi(2))
            .sum();
        ascent
            .start_dual_ascent(&mut iterate, &problem, 0.0, inside)
            .unwrap();
        let bound = loop {
            if let Some(bound) = ascent.evaluate_bound(&mut iterate, &problem) {
                break bound;
            }
        };
        assert!(
            bound > 0.9 * inside && bound <= inside,
            "{bound} of {inside}"
        );
    }
}

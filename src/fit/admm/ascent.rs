//! A better bound from the same iterate.
//!
//! The dual of ADMM is slow to follow the highest frequencies where the surface bends: the noise
//! that a finer lattice adds costs the bound many iterations after the objective has settled. For
//! gradient ascent it is the other way round. With `z_Y = z̃ − CᵀY/2λ`, which minimises the
//! Lagrangian, `∇D(Y) = C z_Y`, and `Y ← P(Y + τ C z_Y)` with `τ = 2λ/‖CᵀC‖` and momentum (Beck and
//! Teboulle 2009) takes a few steps to what ADMM needs tens of iterations for. ADMM itself keeps its
//! own dual: going on from the better one saves it no iteration.
//!
//! The steps run in single precision, heights in units of `1/2λh²`, in which `τC` has no units; what
//! bound they come to is found out in double precision.

use super::state::{State, dual_bound};
use crate::error::{Result, try_filled};
use crate::fit::energy::problem::Problem;
use crate::fit::energy::spectral_penalty::{HuberStep, NuclearNorm, PenaltyKind, SpectralPenalty};
use crate::fit::linear::zstep::Solvable;
use crate::fit::operator::{Hessians as _, Matrices as _, Sums as _};
use crate::lattice::per_cell::PerCell;
use crate::lattice::runs::Run;
use crate::math::lanes::{self, narrow, widen};
use crate::math::sym2::{Sym2, clamp};

/// Number of ascent steps from one evaluation of the bound to the next; each costs a third to a fourth of an
/// iteration of ADMM.
const STEPS_PER_LOOK: usize = 8;

/// Least and largest number of evaluations of the bound. After the least the missing gap must be in reach:
/// each evaluation finds about half of what the last one did.
const LOOK_LIMITS: [usize; 2] = [2, 8];

/// Factor by which the missing gap may exceed the last gain of the bound for the ascent to go on.
const REACH_FACTOR: f64 = 1.5;

/// Share of the last step that the `k`-th one starts ahead with. On a scan, ten steps come
/// furthest with 0.7, fifty with what grows to 0.95.
fn momentum(k: usize) -> f32 {
    (k as f32 / (k as f32 + 3.0)).clamp(0.7, 0.95)
}

/// Cost of one evaluation of the bound, in conjugate-gradient iterations.
pub(crate) const LOOK_CG_ITERATIONS: usize = 5;

/// How far a search has come: bounds wanted, found, and found last, and looks so far.
#[derive(Debug, Clone, Default)]
struct Search {
    goal: f64,
    best: f64,
    last: f64,
    looks: usize,
}

#[derive(Debug, Clone)]
pub(crate) struct Ascent<O: Solvable> {
    search: Search,
    /// `Y` after the last step, and further on in its direction, where the next one starts.
    last: Matrices<f32>,
    ahead: Matrices<f32>,
    /// `z_Y` for `Y = 0`, and of what lies ahead.
    base: Vec<f32>,
    heights: Vec<f32>,
    /// 0 at constrained vertices, which stay where they are.
    mobility: PerCell<f32>,
    /// The energy's `ω`.
    weight: PerCell<f32>,
    scratch: O::Scratch<f32>,
    /// A run in double precision.
    row: Matrices<f64>,
}

/// What follows a gradient step: the proximal map of the conjugates.
trait Proximal: Copy {
    fn apply(self, v: [f32; 3], weight: f32) -> [f32; 3];
}

/// Of the nuclear norm: the projection.
#[derive(Clone, Copy)]
struct Projection;

impl Proximal for Projection {
    #[inline(always)]
    fn apply(self, v: [f32; 3], weight: f32) -> [f32; 3] {
        clamp(v, weight)
    }
}

impl Proximal for HuberStep<f32> {
    #[inline(always)]
    fn apply(self, v: [f32; 3], weight: f32) -> [f32; 3] {
        self.dual(v, weight)
    }
}

/// Symmetric matrices, a vector for each coordinate of [`Sym2`].
type Matrices<T> = [Vec<T>; 3];

#[inline(always)]
fn run_of<T>(matrices: &mut Matrices<T>, Run { start, end }: Run) -> [&mut [T]; 3] {
    matrices.each_mut().map(|values| &mut values[start..end])
}

impl<O: Solvable> Ascent<O> {
    pub(crate) fn new(problem: &Problem<O>) -> Result<Self> {
        let operator = &problem.operator;
        let zeros = |cells| try_filled("bound", cells, 0.0);
        let matrices = || {
            let zeros = || zeros(operator.stencil_cells());
            Ok([zeros()?, zeros()?, zeros()?])
        };
        let mut mobility = PerCell::same(operator.longest_run(), 1.0);
        if !problem.constrained.is_empty() {
            let mut each = try_filled("bound", operator.vertex_cells(), 1.0)?;
            for cell in &problem.constrained {
                each[*cell as usize] = 0.0;
            }
            mobility = PerCell::Each(each);
        }
        Ok(Ascent {
            search: Search::default(),
            last: matrices()?,
            ahead: matrices()?,
            base: zeros(operator.vertex_cells())?,
            heights: zeros(operator.vertex_cells())?,
            mobility,
            weight: PerCell::same(operator.longest_run(), 1.0),
            scratch: operator.scratch()?,
            row: std::array::from_fn(|_| vec![0.0; operator.longest_run()]),
        })
    }

    /// Begins a search for a better bound, from the iterate's dual: until it reaches the `goal` or
    /// will not. The `bound` is the best one so far.
    ///
    /// # Errors
    /// Out of memory.
    pub(crate) fn begin(
        &mut self,
        state: &mut State<O>,
        problem: &Problem<O>,
        bound: f64,
        goal: f64,
    ) -> Result<()> {
        self.start(state, problem)?;
        self.search = Search {
            goal,
            best: bound,
            last: f64::NEG_INFINITY,
            looks: 0,
        };
        Ok(())
    }

    /// A few steps more, which cost about [`LOOK_CG_ITERATIONS`] conjugate-gradient iterations; the best bound
    /// once the search is over.
    pub(crate) fn look(&mut self, state: &mut State<O>, problem: &Problem<O>) -> Option<f64> {
        match problem.kind {
            PenaltyKind::Huber(bends) => {
                let unit = problem.operator.spacing().powi(4);
                let tau = 2.0 * problem.lambda * unit / f64::from(problem.operator.norm());
                self.steps(&problem.operator, bends.single(tau));
            }
            _ => self.steps(&problem.operator, Projection),
        }
        let next = self.bound(state, problem);
        let [least, most] = LOOK_LIMITS;
        let search = &mut self.search;
        search.looks += 1;
        search.best = search.best.max(next);
        let in_reach = search.goal - next <= REACH_FACTOR * (next - search.last);
        search.last = next;
        let over = search.best >= search.goal
            || search.looks >= least && !in_reach
            || search.looks >= most;
        over.then_some(search.best)
    }

    fn steps(&mut self, operator: &O, proximal: impl Proximal) {
        let before = self.search.looks * STEPS_PER_LOOK;
        for step in before..before + STEPS_PER_LOOK {
            self.step(operator, proximal, momentum(step));
        }
    }

    /// From the dual of ADMM. Where fidelity is weighted, part of `z` takes the place of `z̃`, so that
    /// a step need not be smaller.
    fn start(&mut self, state: &mut State<O>, problem: &Problem<O>) -> Result<()> {
        let penalty = state.penalty(problem);
        problem.weight.narrow_into(&mut self.weight)?;
        let spacing = problem.operator.spacing();
        let unit = 2.0 * problem.lambda * spacing * spacing;
        for run in problem.operator.vertices().all() {
            let Run { start, end } = *run;
            let weight = problem.fidelity.run(*run);
            let (z, target) = (&state.z[start..end], &problem.target[start..end]);
            let [base, ..] = row_of(&mut self.row, end - start);
            for i in 0..base.len() {
                base[i] = unit * (z[i] + weight[i] * (target[i] - z[i]));
            }
            narrow(base, &mut self.base[start..end]);
        }
        for run in problem.operator.stencils().all() {
            let v = state.v.run(*run);
            let weight = problem.weight.run(*run);
            let [mean, diff, off] = row_of(&mut self.row, weight.len());
            for i in 0..weight.len() {
                let dual = penalty.dual(v.get(i), weight[i]);
                (mean[i], diff[i], off[i]) = dual.coordinates().into();
            }
            for to in [&mut self.last, &mut self.ahead] {
                for (from, to) in [&*mean, diff, off].into_iter().zip(run_of(to, *run)) {
                    narrow(from, to);
                }
            }
        }
        Ok(())
    }

    /// One step, in one pass.
    fn step(&mut self, operator: &O, proximal: impl Proximal, momentum: f32) {
        let Ascent {
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
        operator.sweep_back(
            scratch,
            heights,
            &mut (last, ahead),
            |(_, ahead), run, mut matrices| {
                let [mean, diff, off] = run_of(ahead, run);
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
                let ([l1, l2, l3], [a1, a2, a3]) = (run_of(last, run), run_of(ahead, run));
                for i in 0..weight.len() {
                    let [g1, g2, g3] = hessians.at(i);
                    let up = |from: f32, gradient: f32| from + gradient * share;
                    let [n1, n2, n3] =
                        proximal.apply([up(a1[i], g1), up(a2[i], g2), up(a3[i], g3)], weight[i]);
                    a1[i] = n1 + momentum * (n1 - l1[i]);
                    a2[i] = n2 + momentum * (n2 - l2[i]);
                    a3[i] = n3 + momentum * (n3 - l3[i]);
                    (l1[i], l2[i], l3[i]) = (n1, n2, n3);
                }
            },
        );
    }

    /// `D` of the dual after the last step.
    fn bound(&mut self, state: &mut State<O>, problem: &Problem<O>) -> f64 {
        let Ascent {
            last, row: wide, ..
        } = self;
        let penalty = state.penalty(problem);
        let State {
            z, scratch, terms, ..
        } = state;
        let [[conjugates, ..], [inners, quadratics, ..]] = terms;
        let (mut inner, mut quadratic, mut conjugate) = (0.0, 0.0, 0.0);
        let costs = problem.kind != PenaltyKind::Nuclear;
        // Of the Hessians of `z` there is no use here.
        problem.operator.sweep(
            scratch,
            z,
            &mut (last, wide),
            |(last, wide), run, _, mut matrices| {
                let weight = problem.weight.run(run);
                let n = weight.len();
                let mut wide = row_of(wide, n);
                for (from, to) in run_of(last, run).into_iter().zip(&mut wide) {
                    widen(from, to);
                }
                let [mean, diff, off] = wide;
                for i in 0..n {
                    let (mean, diff, off) = (mean[i], diff[i], off[i]);
                    // Single precision may have ended just outside.
                    let dual = NuclearNorm.dual(Sym2 { mean, diff, off }, weight[i]);
                    matrices.set(i, dual.coordinates());
                    if costs {
                        let area = problem.operator.area(run.start + i);
                        conjugates[i] = area * penalty.conjugate(dual, weight[i]);
                    }
                }
                if costs {
                    conjugate += lanes::sum(&conjugates[..n]);
                }
            },
            |_, run, sums| {
                let n = run.end - run.start;
                let target = &problem.target[run.start..][..n];
                let inverse = problem.inverse_fidelity.run(run);
                let (inners, quadratics) = (&mut inners[..n], &mut quadratics[..n]);
                for i in 0..n {
                    let adjoint = sums.at(i);
                    inners[i] = adjoint * target[i];
                    quadratics[i] = adjoint * adjoint * inverse[i];
                }
                inner += lanes::sum(inners);
                quadratic += lanes::sum(quadratics);
            },
        );
        dual_bound(problem, inner, quadratic, conjugate, 1.0)
    }
}

/// The first `n` values of each coordinate.
#[inline(always)]
fn row_of(row: &mut Matrices<f64>, n: usize) -> [&mut [f64]; 3] {
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
        let mut state = State::new(&problem, 1.0).unwrap();
        let mut ascent = Ascent::new(&problem).unwrap();
        let inside: f64 = domain
            .active()
            .cells()
            .map(|cell| problem.target[cell].powi(2))
            .sum();
        ascent.begin(&mut state, &problem, 0.0, inside).unwrap();
        let bound = loop {
            if let Some(bound) = ascent.look(&mut state, &problem) {
                break bound;
            }
        };
        assert!(
            bound > 0.9 * inside && bound <= inside,
            "{bound} of {inside}"
        );
    }
}

//! A better bound from the same iterate.
//!
//! The dual of ADMM is slow to follow the highest frequencies where the surface bends: the noise
//! that a finer lattice adds costs the bound many iterations after the objective has settled. For
//! gradient ascent it is the other way round. With `z_Y = z̃ − CᵀY/2λ`, which minimises the
//! Lagrangian, `∇D(Y) = C z_Y`, and `Y ← P(Y + τ C z_Y)` with `τ = 2λ/‖CᵀC‖` and momentum (Beck and
//! Teboulle 2009) takes a few steps to what ADMM needs tens of iterations for. ADMM itself keeps its
//! own dual: going on from the better one saves it no iteration.

use super::lanes;
use super::law::{Law, Nuclear};
use super::problem::Problem;
use super::state::{MatrixField, State, dual_bound};
use crate::error::{Result, try_filled};
use crate::stencil::{Ring, weights_of};

/// Steps at most, and the share of the gap that one has to close for the next to be taken: a
/// step costs less than an iteration.
const STEPS: usize = 16;
const WORTHWHILE: f64 = 0.03;

/// `h⁴‖CᵀC‖` of the unbounded lattice, where two of the three second differences are at their
/// largest and the third vanishes; of a part of it no more.
const NORM: f64 = 256.0 / 9.0;

/// Share of the last step that the next one starts ahead with. On a noisy page this and 0.85 took
/// fewer steps than 0, 0.3, 0.5 and the sequence of Beck and Teboulle.
const MOMENTUM: f64 = 0.7;

// In double precision, although single would do: V8's optimising compiler (Node 20) gets the vectorised
// conversions of these loops wrong, while its baseline compiler and the scalar code agree with native.

#[derive(Debug, Clone)]
pub(crate) struct Ascent {
    /// `Y` after the last step, and further on in its direction, where the next one starts.
    last: MatrixField,
    ahead: MatrixField,
    /// `z_Y` of the latter.
    heights: Vec<f64>,
}

impl Ascent {
    pub(crate) fn new(problem: &Problem) -> Result<Self> {
        Ok(Ascent {
            last: MatrixField::new(problem)?,
            ahead: MatrixField::new(problem)?,
            heights: try_filled("bound", problem.domain.cells(), 0.0)?,
        })
    }

    /// The best bound on the way from the iterate's dual, or the `bound` known already, until it
    /// reaches `goal` or no longer gets much closer to `objective`.
    pub(crate) fn climb(
        &mut self,
        state: &mut State,
        problem: &Problem,
        [bound, goal, objective]: [f64; 3],
    ) -> f64 {
        self.start(state, problem);
        let mut best = self.bound(state, problem);
        for _ in 0..STEPS {
            if best >= goal {
                break;
            }
            self.step(problem);
            let next = self.bound(state, problem);
            let worthwhile = next - best >= WORTHWHILE * (objective - best);
            best = best.max(next);
            if !worthwhile {
                break;
            }
        }
        best.max(bound)
    }

    fn start(&mut self, state: &mut State, problem: &Problem) {
        let domain = &problem.domain;
        for row in 1..=domain.rows() {
            for run in domain.interior().row(row) {
                let v = state.v.run(*run);
                let (mut last, mut ahead) = (self.last.run(*run), self.ahead.run(*run));
                for (i, weight) in problem.weight.run(domain, row, *run).iter().enumerate() {
                    let dual = Nuclear.dual(v.get(i), *weight);
                    last.set(i, dual);
                    ahead.set(i, dual);
                }
            }
        }
    }

    /// `D` of the dual that lies ahead; its `z_Y` for the next step. Where fidelity is weighted, part
    /// of `z` takes the place of `z̃`, so that the step need not be smaller.
    fn bound(&mut self, state: &mut State, problem: &Problem) -> f64 {
        let Ascent { ahead, heights, .. } = self;
        let State {
            z, rolling, terms, ..
        } = state;
        let (domain, map) = (&problem.domain, problem.map);
        let step = 0.5 / problem.lambda;
        let [_, [inners, quadratics, ..]] = terms;
        let (mut inner, mut quadratic) = (0.0, 0.0);
        rolling.sweep(
            domain,
            ahead,
            |ahead, row, weights| {
                for run in domain.interior().row(row) {
                    let dual = ahead.run(*run);
                    let [w1, w2, w3] = weights_of(weights, domain, row, *run);
                    for i in 0..w1.len() {
                        (w1[i], w2[i], w3[i]) = map.adjoint(dual.get(i)).into();
                    }
                }
            },
            |_, row, sums| {
                for run in domain.active().row(row) {
                    let sum = sums.run(*run);
                    let n = run.end - run.start;
                    let z = &z[run.start..][..n];
                    let target = &problem.target[run.start..][..n];
                    let heights = &mut heights[run.start..][..n];
                    let weight = problem.fidelity.run(domain, row, *run);
                    let inverse = problem.inverse_fidelity.run(domain, row, *run);
                    let (inners, quadratics) = (&mut inners[..n], &mut quadratics[..n]);
                    for i in 0..n {
                        let adjoint = sum.at(i);
                        // Constrained cells stay where they are.
                        let moved = if inverse[i] > 0.0 {
                            step * adjoint
                        } else {
                            0.0
                        };
                        heights[i] = z[i] + weight[i] * (target[i] - z[i]) - moved;
                        inners[i] = adjoint * target[i];
                        quadratics[i] = adjoint * adjoint * inverse[i];
                    }
                    inner += lanes::sum(inners);
                    quadratic += lanes::sum(quadratics);
                }
            },
        );
        dual_bound(problem, inner, quadratic, 0.0, 1.0)
    }

    fn step(&mut self, problem: &Problem) {
        let (domain, map) = (&problem.domain, problem.map);
        let length = 2.0 * problem.lambda * problem.spacing.powi(4) / NORM;
        for row in 1..=domain.rows() {
            for run in domain.interior().row(row) {
                let ring = Ring::new(&self.heights, domain, row, *run);
                let (mut last, mut ahead) = (self.last.run(*run), self.ahead.run(*run));
                let weight = problem.weight.run(domain, row, *run);
                for (i, weight) in weight.iter().enumerate() {
                    let gradient = map.hessian(ring.differences(i));
                    let next = Nuclear.dual(ahead.get(i) + gradient.scale(length), *weight);
                    let further = next + (next - last.get(i)).scale(MOMENTUM);
                    last.set(i, next);
                    ahead.set(i, Nuclear.dual(further, *weight));
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::solver::frame::Frame;
    use crate::{Domain, Heightfield, Input, Lattice, Normalization, Options};

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
        let frame = Frame::new(&input, &domain, Normalization::Off);
        let problem = Problem::new(
            &input,
            domain.clone(),
            &frame,
            &Options::default().lambda(1.0),
        )
        .unwrap();
        let mut state = State::new(&problem, 1.0).unwrap();
        let mut ascent = Ascent::new(&problem).unwrap();
        let inside: f64 = domain
            .active()
            .cells()
            .map(|cell| problem.target[cell].powi(2))
            .sum();
        let bound = ascent.climb(&mut state, &problem, [0.0, f64::INFINITY, inside]);
        assert!(
            bound > 0.9 * inside && bound <= inside,
            "{bound} of {inside}"
        );
    }
}

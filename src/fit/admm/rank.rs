//! Rank reduction: brings the Hessians of the final surface to the rank of ADMM's `H`.
//!
//! ADMM's `H` has rank one almost everywhere long before the Hessians `Cz` of its heights have: the smaller
//! eigenvalues left in `Cz` are primal residual. Heights whose Hessians have rank one are found by alternating
//! projections (Cadzow, Signal Enhancement: A Composite Property Mapping Algorithm, 1988): the excess part `N` of
//! `Cz` is removed as far as heights allow, in the norm of the z-step,
//!
//! ```text
//! z ← z − A⁻¹ Cᵀ ρN,   A = 2λw + ρCᵀC,
//! ```
//!
//! with the z-step's solver and with momentum. A large smaller eigenvalue, as where creases meet, is no residual:
//! beyond a limit, which is lowered with each step, its weight falls with its size.

use super::iterate::Iterate;
use crate::error::{Result, try_filled};
use crate::fit::energy::problem::Problem;
use crate::fit::linear::z_step_solver::{SolvableOperator, ZStepSolver};
use crate::fit::operator::{Hessians, Matrices, Sums};
use crate::math::lanes;
use crate::math::real::larger;
use crate::math::sym2::Sym2;

/// Number of steps of a rank reduction, each of which costs about as much as an iteration of ADMM
/// (`benches/choices.md`, One constant at a time).
const RANK_STEPS: usize = 8;

/// Threshold of the Hessians' smaller eigenvalues in the first step of a rank reduction, in medians of their absolute
/// values; beyond it, they are removed less.
const FIRST_EIGENVALUE_LIMIT: f64 = 1.2;

/// Factor by which the threshold of the smaller eigenvalues changes from step to step (`benches/choices.md`, The rank of the surface).
const LIMIT_FACTOR: f64 = 0.7;

/// Over-relaxation factor of a rank reduction step: heights can follow only a part of a change of their Hessians
/// (`benches/choices.md`, The rank of the surface).
const RANK_OVER_RELAXATION: f64 = 2.0;

/// Stride between the stencils whose smaller eigenvalues the median is computed of.
const MEDIAN_SAMPLE_STRIDE: usize = 7;

/// State of a rank reduction between two steps.
#[derive(Debug, Clone)]
pub(super) struct RankReduction {
    /// Heights of the surface extrapolated by the momentum, from which the next step starts.
    start: Vec<f64>,
    /// Heights of the surface after the last step of the rank reduction.
    z: Vec<f64>,
    /// Absolute value of a Hessian's smaller eigenvalue beyond which the eigenvalue is removed the less the larger it
    /// is.
    limit: f64,
    steps: usize,
}

impl RankReduction {
    /// Begins rank reduction of the surface `z`; `None` where its Hessians have rank one already.
    pub(super) fn new<O: SolvableOperator>(
        problem: &Problem<O>,
        z: &[f64],
    ) -> Result<Option<Self>> {
        let mut sizes = Vec::new();
        let mut count = 0;
        problem.operator.hessians(z, |_, hessian| {
            if count % MEDIAN_SAMPLE_STRIDE == 0 {
                sizes.push(lesser_eigenvalue(hessian).0.abs());
            }
            count += 1;
        });
        let middle = sizes.len() / 2;
        if middle == 0 {
            return Ok(None);
        }
        let (_, median, _) = sizes.select_nth_unstable_by(middle, f64::total_cmp);
        if !(*median > 0.0 && median.is_finite()) {
            return Ok(None);
        }
        let copy = || -> Result<Vec<f64>> {
            let mut copy = try_filled("surface", z.len(), 0.0)?;
            copy.copy_from_slice(z);
            Ok(copy)
        };
        Ok(Some(RankReduction {
            start: copy()?,
            z: copy()?,
            limit: FIRST_EIGENVALUE_LIMIT * *median,
            steps: 0,
        }))
    }

    /// Takes one step of the rank reduction, which costs one conjugate-gradient iteration. Returns the surface after
    /// the last step, and `None` before.
    pub(super) fn step<O: SolvableOperator>(
        &mut self,
        problem: &Problem<O>,
        iterate: &mut Iterate<O>,
        solver: &mut O::Solver,
    ) -> Option<&[f64]> {
        iterate.reduce_rank(problem, &self.start, self.limit, solver);
        solver.step(&problem.operator);
        solver.correct(&problem.operator, &mut self.start);
        // Nesterov's momentum.
        let momentum = self.steps as f64 / (self.steps as f64 + 3.0);
        for (start, z) in self.start.iter_mut().zip(&mut self.z) {
            let before = std::mem::replace(z, *start);
            *start += momentum * (*z - before);
        }
        self.steps += 1;
        self.limit *= LIMIT_FACTOR;
        (self.steps == RANK_STEPS).then_some(self.z.as_slice())
    }
}

/// Returns the eigenvalue of smaller magnitude of a Hessian, and the sign of the other one.
#[inline(always)]
fn lesser_eigenvalue(hessian: Sym2) -> (f64, f64) {
    let sign = 1f64.copysign(hessian.mean);
    (hessian.mean - sign * hessian.radius(), sign)
}

/// Returns the part of a Hessian that its smaller eigenvalue contributes, reduced where that eigenvalue exceeds the
/// `limit`.
#[inline(always)]
fn lesser_part(hessian: Sym2, limit: f64) -> Sym2 {
    let (value, sign) = lesser_eigenvalue(hessian);
    let share = limit / larger(value.abs(), limit);
    let half = 0.5 * value * (share * share);
    let radius = hessian.radius();
    let factor = if radius > 0.0 {
        -sign * half / radius
    } else {
        0.0
    };
    Sym2 {
        mean: half,
        diff: factor * hessian.diff,
        off: factor * hessian.off,
    }
}

impl<O: SolvableOperator> Iterate<O> {
    /// Writes the residual `−ρCᵀN` of the next z-step to the solver, where `N` is the part of the surface's Hessians
    /// that their smaller eigenvalues contribute.
    fn reduce_rank(&mut self, problem: &Problem<O>, z: &[f64], limit: f64, solver: &mut O::Solver) {
        let Iterate {
            rho,
            scratch,
            terms,
            ..
        } = self;
        let factor = -RANK_OVER_RELAXATION * *rho * solver.residual_scale();
        let residuals = problem.operator.bands().split(solver.residual());
        let mut states: Vec<_> = residuals
            .zip(terms)
            .map(|(residual, [_, [wide, ..]])| (residual, wide))
            .collect();
        problem.operator.sweep(
            scratch,
            z,
            &mut states,
            |_, run, hessians, mut matrices| {
                for i in 0..run.end - run.start {
                    let hessian = Sym2::from_coordinates(hessians.at(i));
                    matrices.set(i, lesser_part(hessian, limit).coordinates());
                }
            },
            |(residual, wide), run, sums| {
                let wide = &mut wide[..run.end - run.start];
                for (i, value) in wide.iter_mut().enumerate() {
                    *value = factor * sums.at(i);
                }
                lanes::narrow(wide, residual.run_mut(run));
            },
        );
        solver.restart(&problem.operator);
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))] // proptest is native
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn check_rest(hessian: Sym2, limit: f64) {
        let by_size = |h: Sym2| {
            let [a, b] = h.eigenvalues();
            if a.abs() > b.abs() { [a, b] } else { [b, a] }
        };
        let [larger, smaller] = by_size(hessian);
        let part = lesser_part(hessian, limit);
        let [value, none] = by_size(part);
        let expected = smaller * (limit / smaller.abs()).min(1.0).powi(2);
        assert!(none.abs() < 1e-12 && (value.abs() - expected.abs()).abs() < 1e-12);
        let [first, rest] = by_size(hessian - part);
        assert!((first.abs() - larger.abs()).abs() < 1e-12);
        assert!((rest.abs() - (smaller - expected).abs()).abs() < 1e-12);
    }

    #[test]
    fn where_one_eigenvalue_is_zero_nothing_is_removed() {
        // Once found by the test below.
        check_rest(Sym2::new(-2.9425950423175116, 0.0, 0.0), 0.01);
    }

    proptest! {
        /// Where both eigenvalues are alike, half of each.
        #[test]
        fn alike_eigenvalues_come_down_alike(value in -5.0..5.0f64) {
            let part = lesser_part(Sym2::new(value, 0.0, value), 8.0);
            prop_assert_eq!(part.eigenvalues(), [0.5 * value; 2]);
        }

        /// The part that is removed has all of the smaller eigenvalue within the limit, and less of a larger one.
        #[test]
        fn what_is_left_has_the_larger_eigenvalue_alone(
            xx in -5.0..5.0f64, xy in -5.0..5.0f64, yy in -5.0..5.0f64, limit in 0.01..8.0f64,
        ) {
            for hessian in [Sym2::new(xx, xy, yy), Sym2::new(0.0, xy, 0.0)] {
                check_rest(hessian, limit);
            }
        }
    }
}

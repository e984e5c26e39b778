//! The optimisation problem of a heightfield: the energy under the operator of its lattice.

use std::sync::Arc;

use super::admm::{iterate, solver};
use super::coordinates::Coordinates;
use super::energy::problem;
use super::energy::spectral_penalty::PenaltyKind;
use super::input::Input;
use super::operator::lattice::{LatticeOperator, position};
use super::options::Options;
use crate::error::{Error, Result, try_filled};
use crate::lattice::domain::Domain;

pub(crate) type Problem = problem::Problem<LatticeOperator>;
pub(crate) type Iterate = iterate::Iterate<LatticeOperator>;
pub(crate) type AdmmSolver = solver::AdmmSolver<LatticeOperator>;

/// Maximum absolute value of heights and Hessians, whose squares are summed and multiplied by λ.
const MAX_MAGNITUDE: f64 = 1e130;

/// Maximum spacing of a lattice in normalised coordinates; the minimum is one over it.
const MAX_SPACING: f64 = 1e50;

impl Problem {
    /// Makes the problem of an input on a domain, in normalised coordinates.
    pub(crate) fn new(
        input: &Input,
        domain: Arc<Domain>,
        coordinates: &Coordinates,
        options: &Options,
    ) -> Result<Self> {
        let mut target = try_filled("input heights", domain.cells(), 0.0)?;
        let mut largest = 0.0f64;
        for cell in domain.active().cells() {
            let height = input.field().heights()[domain.lattice_index(cell)];
            target[cell] = coordinates.inward(position(&domain, cell), height);
            largest = largest.max((coordinates.scale * height).abs());
        }
        let operator = LatticeOperator::new(domain.clone(), coordinates);
        let spacing = operator.spacing;
        check_range(&domain, input.field().heights(), &target, largest, spacing)?;
        let mut problem = Problem::unweighted(
            operator,
            options.lambda_or_default().value(),
            target,
            PenaltyKind::from_options(options),
        );
        problem.set_fidelity(
            |cell| input.weight(domain.lattice_index(cell)),
            |cell| input.is_constrained(domain.lattice_index(cell)),
            options.tie_break_or_default(),
        )?;
        problem.set_input_normal_weights(options.energy_or_default())?;
        // Each Hessian is a handful of heights over h², each with its own rounding error.
        problem.set_rounding(largest);
        Ok(problem)
    }

    /// Computes the penalty `Σ ω f(H)` of the input, summed separately for each of several `parts`; `part` gives the
    /// number of the part that a vertex's cell belongs to.
    pub(crate) fn smoothness_by(&self, parts: usize, part: impl Fn(usize) -> usize) -> Vec<f64> {
        let mut sums = vec![0.0; parts];
        self.each_cost(&self.target, |cell, cost| sums[part(cell)] += cost);
        sums
    }

    /// Calls `write` with row and column of each active vertex and its height in the user's units, which is converted
    /// from `z`.
    pub(crate) fn write_heights(&self, z: &[f64], mut write: impl FnMut((usize, usize), f64)) {
        let LatticeOperator {
            domain,
            coordinates,
            ..
        } = &self.operator;
        for cell in domain.active().cells() {
            let height = coordinates.outward(position(domain, cell), z[cell]);
            write(domain.lattice_vertex(cell), height);
        }
    }
}

/// Checks that squares of heights and Hessians, summed and times any λ, are neither rounded to 0 nor infinite. Heights
/// that differ from a plane by rounding errors only are accepted. `target` has the heights in normalised coordinates,
/// `largest` is the largest without the plane subtracted, `h` the normalised spacing.
///
/// # Errors
/// [`Error::Overflow`] or [`Error::Underflow`].
fn check_range(
    domain: &Domain,
    heights: &[f64],
    target: &[f64],
    largest: f64,
    h: f64,
) -> Result<()> {
    let spacing = domain.lattice().spacing();
    let cells = || domain.active().cells();
    let finite = cells().all(|cell| target[cell].is_finite());
    let bend = cells().fold(0.0f64, |m, cell| m.max(target[cell].abs()));
    let hessian = |height: f64| height / (h * h);
    let affine = bend <= problem::HESSIAN_ROUNDING_UNITS * f64::EPSILON * largest
        && largest >= 1.0 / MAX_MAGNITUDE;
    let zero = bend == 0.0 && cells().all(|cell| heights[domain.lattice_index(cell)] == 0.0);
    // As what a NaN is not.
    let small_enough = h >= 1.0 / MAX_SPACING && largest.max(hessian(largest)) <= MAX_MAGNITUDE;
    if !(finite && small_enough) {
        return Err(Error::Overflow { spacing });
    }
    let large_enough = affine || zero || bend.min(hessian(bend)) >= 1.0 / MAX_MAGNITUDE;
    if h > MAX_SPACING || !large_enough {
        return Err(Error::Underflow { spacing });
    }
    Ok(())
}

//! Warm starts: the results of an earlier solve, from which another one starts.

use std::mem::discriminant;
use std::ops::RangeInclusive;
use std::sync::Arc;

use super::admm::parameters::AdmmParameters;
use super::components::Components;
use super::heightfields::{Iterate, Problem};
use super::multilevel::Answer;
use super::operator::lattice::position;
use super::thin_plate::InitialGuess;
use crate::error::Result;
use crate::lattice::domain::{Domain, Role};

/// Range of the ratio of the new λ to the earlier one in which the earlier result may be a better start than a coarse
/// lattice.
const WARM_START_LAMBDA_RATIOS: RangeInclusive<f64> = 0.4..=3.0;

/// Results of the last finished solve, from which another one may start.
#[derive(Debug, Clone)]
pub(super) struct WarmStart {
    pub domain: Arc<Domain>,
    pub components: Components,
    pub answers: Vec<Answer>,
    pub lambda: f64,
}

impl WarmStart {
    /// Sets the target heights of a problem's free vertices to the thin plate of the earlier solve, if it is known for
    /// each of them; otherwise returns the plane as the initial guess. `corner` is as in [`iterate`](Self::iterate).
    pub(super) fn thin_plate(&self, problem: &mut Problem, corner: (usize, usize)) -> InitialGuess {
        let domain = &problem.operator.domain;
        let known = problem.free.iter().map(|cell| {
            let cell = *cell as usize;
            let (row, col) = domain.lattice_vertex(cell);
            let (answer, old) = self.find((row + corner.0, col + corner.1))?;
            let operator = &answer.problem.operator;
            let place = position(&operator.domain, old);
            let z = operator
                .coordinates
                .outward(place, answer.problem.target[old]);
            Some((
                cell,
                problem
                    .operator
                    .coordinates
                    .inward(position(domain, cell), z),
            ))
        });
        match known.collect::<Option<Vec<_>>>() {
            Some(heights) => {
                for (cell, z) in heights {
                    problem.target[cell] = z;
                }
                InitialGuess::Earlier
            }
            None => InitialGuess::Plane,
        }
    }

    /// Makes the first iterate of a problem from the earlier solve, or `None` where a coarse lattice is a better start.
    /// `corner` is row and column of the vertex of the whole lattice that is vertex `(0, 0)` of the problem's.
    pub(super) fn iterate(
        &self,
        problem: &Problem,
        parameters: &AdmmParameters,
        corner: (usize, usize),
    ) -> Result<Option<Iterate>> {
        let ratio = problem.lambda / self.lambda;
        let Some(first) = self.answers.first() else {
            return Ok(None);
        };
        let alike = discriminant(&problem.kind) == discriminant(&first.problem.kind);
        if !alike || !WARM_START_LAMBDA_RATIOS.contains(&ratio) {
            return Ok(None);
        }
        // The last ρ suits the end of a solve, not its beginning.
        let rho = first.initial_rho;
        let mut iterate = Iterate::new(problem, rho)?;
        let mut found = 0;
        for cell in problem.operator.domain.active().cells() {
            let (row, col) = problem.operator.domain.lattice_vertex(cell);
            let vertex = (row + corner.0, col + corner.1);
            let Some((answer, old)) = self.find(vertex) else {
                continue;
            };
            found += 1;
            let (from, to) = (
                &answer.problem.operator.coordinates,
                &problem.operator.coordinates,
            );
            let z = from.outward(
                position(&answer.problem.operator.domain, old),
                answer.iterate.z[old],
            );
            iterate.z[cell] = to.inward(position(&problem.operator.domain, cell), z);
            let interior = |domain: &Domain, cell: usize| domain.roles()[cell] == Role::Interior;
            if interior(&problem.operator.domain, cell)
                && interior(&answer.problem.operator.domain, old)
            {
                let (dual, hessian) = answer.iterate.matrices(&answer.problem, old);
                // Hessians are inversely proportional to lengths.
                iterate.set_matrices(cell, dual, hessian.scale(from.scale / to.scale));
            }
        }
        for cell in &problem.constrained {
            iterate.z[*cell as usize] = problem.target[*cell as usize];
        }
        if found == 0 || !problem.has_weak_fidelity && parameters.is_far(&iterate.certify(problem))
        {
            return Ok(None);
        }
        Ok(Some(iterate))
    }

    /// Returns the result of the component that a vertex of the whole lattice is in, and the vertex's cell in that
    /// component's domain.
    fn find(&self, (row, col): (usize, usize)) -> Option<(&Answer, usize)> {
        let cell = self.domain.cell((row as isize, col as isize))?;
        if !self.domain.roles()[cell].is_active() {
            return None;
        }
        let number = self.components.component(cell);
        let answer = self.answers.get(number)?;
        let (top, left) = self.components.corner(number);
        let own = ((row - top) as isize, (col - left) as isize);
        Some((answer, answer.problem.operator.domain.cell(own)?))
    }
}

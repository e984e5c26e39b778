//! Initial heights of free vertices: those of the thin plate through the given heights.

use std::sync::Arc;

use super::admm::parameters::AdmmParameters;
use super::admm::solver::initial_rho;
use super::heightfields::Problem;
use super::linear::multigrid::Multigrid;
use super::linear::refined_solver::RefinedSolver;
use crate::error::Result;
use crate::lattice::domain::Domain;

/// Initial guess for the thin plate's heights at free vertices, which also says how accurate the plate has to be.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum InitialGuess {
    /// Height 0 in normalised coordinates, which is the best-fit plane. Each pass ends at a share of its own first
    /// residual, because the last digits count where few heights are given.
    Plane,
    /// Thin plate of an earlier solve, which the target heights `z̃` hold: for previews, which need not be accurate.
    /// There is one pass, which ends at a share of the best-fit plane's residual.
    Earlier,
}

/// Residual at which a pass of conjugate gradients for the thin plate ends, relative to the pass's first residual
/// (`benches/choices.md`, One constant at a time).
const PASS_RESIDUAL: f64 = 1e-10;

/// Residual at which the pass from an earlier thin plate ends, relative to that of the best-fit plane.
const PLANE_RESIDUAL: f64 = 1e-7;

/// Number of passes for the thin plate. In each the tie-break weight pulls free vertices towards the plate of the pass
/// before: after this many it has no influence (`benches/choices.md`, One constant at a time).
const TIE_BREAK_PASSES: usize = 3;

/// Maximum number of conjugate-gradient iterations in a pass for the thin plate.
const MAX_PASS_ITERATIONS: usize = 200;

/// Sets the target heights `z̃` of free vertices to the thin plate through the given heights, the minimiser of `λ Σ w(z
/// − z̃)² + ρ/2 Σ ‖H‖_F²`: the tie-break weight pulls towards it, and the solve starts from it. It is the z-step with
/// Hessians and dual 0, solved to the end. Returns the number of conjugate-gradient iterations.
pub(crate) fn fill(
    problem: &mut Problem,
    domains: &[Arc<Domain>],
    parameters: &AdmmParameters,
    guess: InitialGuess,
) -> Result<usize> {
    let rho = initial_rho(parameters, problem);
    let mut multigrid = Multigrid::new(problem, domains, rho)?;
    let mut precise = RefinedSolver::new(problem)?;
    let given = problem.target.clone();
    for cell in &problem.free {
        problem.target[*cell as usize] = 0.0;
    }
    let mut z = problem.target.clone();
    precise.start(problem, rho, &z);
    let rough = PLANE_RESIDUAL * precise.distance(problem, &multigrid);
    let passes = match guess {
        InitialGuess::Plane => TIE_BREAK_PASSES,
        InitialGuess::Earlier => {
            z.copy_from_slice(&given);
            problem.target = given;
            1
        }
    };
    let mut steps = 0;
    for _ in 0..passes {
        precise.start(problem, rho, &z);
        let goal = match guess {
            InitialGuess::Plane => PASS_RESIDUAL * precise.distance(problem, &multigrid),
            InitialGuess::Earlier => rough,
        };
        steps += precise.solve(
            problem,
            rho,
            &mut multigrid,
            &mut z,
            (goal, MAX_PASS_ITERATIONS),
        );
        for cell in &problem.free {
            problem.target[*cell as usize] = z[*cell as usize];
        }
    }
    Ok(steps)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fit::coarsen::coarsen;
    use crate::fit::coordinates::Coordinates;
    use crate::{Heightfield, Input, Lattice, Options};

    /// A square sheet on the ground that a pin in its middle holds up.
    fn tent(pin: f64) -> (Problem, Vec<Arc<Domain>>, AdmmParameters) {
        let n = 41;
        let lattice = Lattice::new(n, n, 1.0).unwrap();
        let rim = |i: usize| i == 0 || i == n - 1;
        let heights = (0..n * n).map(|i| match (i / n, i % n) {
            (row, col) if rim(row) || rim(col) => 0.0,
            (20, 20) => pin,
            _ => f64::NAN,
        });
        let pins = Heightfield::new(lattice, heights.collect()).unwrap();
        let input = Input::design(pins, None).unwrap();
        let mut domains = vec![Arc::new(input.domain().unwrap())];
        let mut coarse = input.clone();
        for _ in 0..2 {
            coarse = coarsen(&coarse, domains.last().unwrap()).unwrap();
            domains.push(Arc::new(coarse.domain().unwrap()));
        }
        let options = Options::paper().lambda(1e6);
        // Planes are taken away from both alike.
        let coordinates = Coordinates::new(&input, &domains[0], 1.0 / n as f64);
        let problem = Problem::new(&input, domains[0].clone(), &coordinates, &options).unwrap();
        (problem, domains, AdmmParameters::new(&options))
    }

    #[test]
    fn a_plate_whose_pin_is_moved_is_found_from_the_last_one() {
        let (mut problem, domains, parameters) = tent(10.0);
        let first = fill(&mut problem, &domains, &parameters, InitialGuess::Plane).unwrap();
        let last = problem.target;
        let (mut cold, ..) = tent(10.4);
        fill(&mut cold, &domains, &parameters, InitialGuess::Plane).unwrap();
        let (mut warm, ..) = tent(10.4);
        for cell in warm.free.clone() {
            warm.target[cell as usize] = last[cell as usize];
        }
        let steps = fill(&mut warm, &domains, &parameters, InitialGuess::Earlier).unwrap();
        assert!(2 * steps < first, "{steps} instead of {first}");
        let off = |a: &[f64], b: &[f64]| {
            let pairs = a.iter().zip(b);
            pairs.fold(0.0f64, |most, (a, b)| most.max((a - b).abs()))
        };
        let moved = off(&cold.target, &last);
        let error = off(&cold.target, &warm.target);
        assert!(error < 1e-3 * moved, "{error:e} of {moved:e}");
    }
}

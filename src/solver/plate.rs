//! Heights for free vertices: those of the thin plate through what is given.

use std::sync::Arc;

use super::cg::ConjugateGradients;
use super::law::Kind;
use super::problem::Problem;
use super::schedule::Plan;
use super::state::State;
use crate::domain::Domain;
use crate::error::Result;

/// Rounds of conjugate gradients, each from a residual in double precision.
const ROUNDS: usize = 20;

/// Iterations in a round, at most: single precision carries no further.
const STEPS: usize = 12;

/// Squared residuals at which a round and the whole are done, relative to the first.
const ROUND: f64 = 1e-6;
const DONE: f64 = 1e-16;

/// Sets `z̃` at the free vertices of a problem to the minimiser of
/// `λ Σ w(z − z̃)² + ρ/2 Σ ‖H‖_F²` over what is given: the plate that ties are
/// broken towards, and the surface that the solve starts from. It is the z-step
/// about `H = Y = 0`, solved to the end.
pub(crate) fn fill(problem: &mut Problem, domains: &[Arc<Domain>], plan: &Plan) -> Result<()> {
    let rho = plan.first_rho(problem);
    let kind = std::mem::replace(&mut problem.kind, Kind::Nuclear);
    // From the plane that the frame has taken away.
    for cell in &problem.free {
        problem.target[*cell as usize] = 0.0;
    }
    let mut state = State::new(problem, rho)?;
    let mut cg = ConjugateGradients::new(problem, domains, rho)?;
    let mut first = 0.0;
    for round in 0..ROUNDS {
        // What the tie break pulls towards is where the plate is now, so that it has no say.
        for cell in &problem.free {
            problem.target[*cell as usize] = state.z[*cell as usize];
        }
        state.update(problem, 0.0, &mut cg);
        let start = cg.energy();
        if round == 0 {
            first = start;
        }
        if start <= DONE * first {
            break;
        }
        for _ in 0..STEPS {
            if cg.energy() <= ROUND * start || !cg.step(&problem.domain) {
                break;
            }
        }
        cg.correct(&problem.domain, &mut state.z);
    }
    for cell in &problem.free {
        problem.target[*cell as usize] = state.z[*cell as usize];
    }
    problem.kind = kind;
    Ok(())
}

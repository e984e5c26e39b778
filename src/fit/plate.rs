//! Heights for free vertices: those of the thin plate through what is given.

use std::sync::Arc;

use super::admm::schedule::Plan;
use super::heightfields::Problem;
use super::linear::multigrid::Multigrid;
use super::linear::precise::Precise;
use crate::error::Result;
use crate::lattice::domain::Domain;

/// Residual at which a pass is done, relative to its first, and most iterations.
const ENOUGH: (f64, usize) = (1e-10, 200);

/// Passes in which the tie break pulls towards the last one's plate: then it has no say.
const PASSES: usize = 3;

/// Sets `z̃` at the free vertices of a problem to the minimiser of
/// `λ Σ w(z − z̃)² + ρ/2 Σ ‖H‖_F²` over what is given: the plate that ties are
/// broken towards, and the surface that the solve starts from. It is the z-step
/// about `H = Y = 0`, solved to the end.
pub(crate) fn fill(problem: &mut Problem, domains: &[Arc<Domain>], plan: &Plan) -> Result<()> {
    let rho = plan.first_rho(problem);
    // From the plane that the coordinates has taken away.
    for cell in &problem.free {
        problem.target[*cell as usize] = 0.0;
    }
    let mut z = problem.target.clone();
    let mut multigrid = Multigrid::new(problem, domains, rho)?;
    let mut precise = Precise::new(problem)?;
    for _ in 0..PASSES {
        precise.start(problem, rho, &z);
        precise.solve(problem, rho, &mut multigrid, &mut z, ENOUGH);
        for cell in &problem.free {
            problem.target[*cell as usize] = z[*cell as usize];
        }
    }
    Ok(())
}

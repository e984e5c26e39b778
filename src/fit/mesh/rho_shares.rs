//! Factors of ADMM's penalty parameter ρ for stencils at creases of a mesh.
//!
//! One ρ suits all stencils with about the same ratio of dual and Hessian. Where smooth regions of the surface meet,
//! the Hessian is large and its cost is small: the usual ρ would hold the Hessian of the iteration before there, and
//! the fold would take many iterations to move.

use super::linearisation::Problem;
use crate::fit::energy::spectral_penalty::PenaltyKind;

/// Sets each stencil's factor of ρ by its penalty weight.
pub(super) fn set_rho_shares(problem: &mut Problem) {
    if let PenaltyKind::Huber(bends) = problem.kind {
        let weight = &problem.weight;
        let of = |stencil| share(weight.at(stencil), bends.flatness);
        problem.operator.set_rho_shares(of);
    }
}

/// Returns the factor of ADMM's penalty parameter ρ for a stencil of penalty weight ω. The dual is at most ω, and ω was
/// chosen as one over the Hessian's size, so that the ratio of dual and Hessian falls with ω². Where ω exceeds the
/// slope of the penalty at 0 (`flatness`), the dual would depend on ρ, and the factor is 1.
fn share(weight: f64, flatness: f64) -> f64 {
    let least = weight / flatness.min(1.0);
    if least < 1.0 { least * least } else { 1.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fit::energy::spectral_penalty::{HuberParameters, SpectralPenalty};
    use crate::math::sym2::Sym2;

    /// `Y` follows from `V` without ρ wherever ρ has a share: so one penalty does for all stencils.
    #[test]
    fn the_dual_does_not_depend_on_the_penalty_where_it_is_less() {
        let (flatness, delta) = (0.3, 0.07);
        let bends = HuberParameters { flatness, delta };
        let mut shared = 0;
        for weight in [0.01, 0.05, 0.2, 0.299, 0.31, 0.6, 1.0] {
            let rho = 0.8;
            let own = rho * share(weight, flatness);
            shared += usize::from(own < rho);
            for v in [Sym2::new(0.3, 0.1, -0.2), Sym2::new(2.0, -0.7, 0.4)] {
                let duals = [rho, own].map(|rho| bends.penalty(rho).dual(v, weight));
                let [a, b] = duals.map(|dual| dual.entries());
                assert_eq!(a, b, "of {weight}");
            }
        }
        assert_eq!(shared, 4);
        assert_eq!(share(0.5, 0.0), 1.0);
    }
}

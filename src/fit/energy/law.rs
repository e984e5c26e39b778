//! The closed-form steps of each energy.
//!
//! An energy is a sum of `ω f(H)` over interior vertices. All that ADMM needs
//! of `f` is the step `V = Y + ρH ↦ Y`, where `H` minimises
//! `ω f(H) + ρ/2 ‖H − V/ρ‖²`: the dual `Y` is then a subgradient of `ω f` at `H`.
//! All that the certificate needs is the conjugate `(ωf)*(Y)`.

use crate::fit::options::Energy;
use crate::math::sym2::Sym2;

pub(crate) trait Law: Copy {
    /// The largest [`Law::size`] of a feasible dual: 1, or infinity if all are.
    fn largest(self) -> f64 {
        1.0
    }

    /// `Y` from `V`, for the weight `ω`.
    fn dual(self, v: Sym2, weight: f64) -> Sym2;
    /// `ω f(H)`.
    fn value(self, hessian: Sym2, weight: f64) -> f64;
    /// In the dual norm, relative to the weight.
    fn size(self, dual: Sym2, weight: f64) -> f64;
    /// `(ωf)*(Y)`, where it is finite.
    fn conjugate(self, dual: Sym2, weight: f64) -> f64;
}

/// `‖H‖_*`: the projection onto eigenvalues within ±ω (paper, App. D).
#[derive(Clone, Copy)]
pub(crate) struct Nuclear;

impl Law for Nuclear {
    #[inline(always)]
    fn dual(self, v: Sym2, weight: f64) -> Sym2 {
        v.clamp(weight)
    }
    #[inline(always)]
    fn value(self, hessian: Sym2, weight: f64) -> f64 {
        weight * hessian.nuclear_norm()
    }
    #[inline(always)]
    fn size(self, dual: Sym2, weight: f64) -> f64 {
        dual.spectral_norm() / weight
    }
    #[inline(always)]
    fn conjugate(self, _: Sym2, _: f64) -> f64 {
        0.0
    }
}

/// `‖H‖_F`: the projection onto the ball of radius ω.
#[derive(Clone, Copy)]
pub(crate) struct Frobenius;

impl Law for Frobenius {
    #[inline(always)]
    fn dual(self, v: Sym2, weight: f64) -> Sym2 {
        let size = v.dot(v).sqrt();
        v.scale(if size > weight { weight / size } else { 1.0 })
    }
    #[inline(always)]
    fn value(self, hessian: Sym2, weight: f64) -> f64 {
        weight * hessian.dot(hessian).sqrt()
    }
    #[inline(always)]
    fn size(self, dual: Sym2, weight: f64) -> f64 {
        dual.dot(dual).sqrt() / weight
    }
    #[inline(always)]
    fn conjugate(self, _: Sym2, _: f64) -> f64 {
        0.0
    }
}

/// `‖H‖_*²`. At the minimiser every eigenvalue of `H` is that of `V/ρ` shrunk by
/// `2ωs/ρ`, where `s = ‖H‖_*`, so that `Y` is `V` with eigenvalues cut off at
/// `2ωs`; `s` follows by summing over the eigenvalues that are left, both or one.
#[derive(Clone, Copy)]
pub(crate) struct SquaredNuclear {
    pub rho: f64,
}

impl Law for SquaredNuclear {
    fn largest(self) -> f64 {
        f64::INFINITY
    }
    #[inline(always)]
    fn dual(self, v: Sym2, weight: f64) -> Sym2 {
        let both = v.nuclear_norm() / (self.rho + 4.0 * weight);
        let one = v.spectral_norm() / (self.rho + 2.0 * weight);
        let s = if both > one { both } else { one };
        v.clamp(2.0 * weight * s)
    }
    #[inline(always)]
    fn value(self, hessian: Sym2, weight: f64) -> f64 {
        let norm = hessian.nuclear_norm();
        weight * norm * norm
    }
    #[inline(always)]
    fn size(self, _: Sym2, _: f64) -> f64 {
        0.0
    }
    #[inline(always)]
    fn conjugate(self, dual: Sym2, weight: f64) -> f64 {
        let norm = dual.spectral_norm();
        norm * norm / (4.0 * weight)
    }
}

/// Which law an energy follows; its weights ω are another matter.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    Nuclear,
    Frobenius,
    SquaredNuclear,
}

impl Energy {
    pub(crate) fn kind(self) -> Kind {
        match self {
            Energy::Nuclear | Energy::SecondFormOfInput | Energy::SecondForm => Kind::Nuclear,
            Energy::Frobenius => Kind::Frobenius,
            Energy::SquaredNuclear => Kind::SquaredNuclear,
        }
    }
}

/// The law of a kind, looked up at every vertex. Kernels that are seldom run, or
/// seldom for another energy than the nuclear norm, are compiled for this alone:
/// a version for each law, which is what inlining comes to, would make the wasm a
/// quarter larger.
#[derive(Clone, Copy)]
pub(crate) struct Any {
    pub kind: Kind,
    pub rho: f64,
}

/// Calls the same method of the law itself.
macro_rules! the_law {
    ($any:expr, |$law:ident| $call:expr) => {
        match $any.kind {
            Kind::Nuclear => {
                let $law = Nuclear;
                $call
            }
            Kind::Frobenius => {
                let $law = Frobenius;
                $call
            }
            Kind::SquaredNuclear => {
                let $law = SquaredNuclear { rho: $any.rho };
                $call
            }
        }
    };
}

impl Law for Any {
    fn largest(self) -> f64 {
        the_law!(self, |law| law.largest())
    }
    #[inline(never)]
    fn dual(self, v: Sym2, weight: f64) -> Sym2 {
        the_law!(self, |law| law.dual(v, weight))
    }
    #[inline(never)]
    fn value(self, hessian: Sym2, weight: f64) -> f64 {
        the_law!(self, |law| law.value(hessian, weight))
    }
    #[inline(never)]
    fn size(self, dual: Sym2, weight: f64) -> f64 {
        the_law!(self, |law| law.size(dual, weight))
    }
    #[inline(never)]
    fn conjugate(self, dual: Sym2, weight: f64) -> f64 {
        the_law!(self, |law| law.conjugate(dual, weight))
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))] // proptest is native
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// `H` minimises `ω f(H) + ρ/2 ‖H − V/ρ‖²`, and Fenchel's inequality is an
    /// equality for `(H, Y)` and holds for every other pair.
    fn check(
        law: impl Law,
        [v, other]: [Sym2; 2],
        weight: f64,
        rho: f64,
    ) -> Result<(), TestCaseError> {
        let dual = law.dual(v, weight);
        let hessian = (v - dual).scale(1.0 / rho);
        let energy = |h: Sym2| {
            let distance = h - v.scale(1.0 / rho);
            law.value(h, weight) + 0.5 * rho * distance.dot(distance)
        };
        let size = 1.0 + energy(hessian) + energy(other);
        prop_assert!(energy(hessian) <= energy(hessian + other) + 1e-12 * size);
        prop_assert!(energy(hessian) <= energy(other) + 1e-12 * size);
        let slack = |h: Sym2| law.value(h, weight) + law.conjugate(dual, weight) - h.dot(dual);
        prop_assert!(slack(hessian).abs() <= 1e-11 * size, "{}", slack(hessian));
        prop_assert!(slack(other) >= -1e-11 * size);
        Ok(())
    }

    fn matrix() -> impl Strategy<Value = Sym2> {
        prop_oneof![
            prop::array::uniform3(-5.0..5.0f64).prop_map(|[a, b, c]| Sym2::new(a, b, c)),
            (-5.0..5.0f64).prop_map(|a| Sym2::new(a, 0.0, a)),
            (-5.0..5.0f64).prop_map(|a| Sym2::new(a, 0.0, 0.0)),
            Just(Sym2::default()),
        ]
    }

    proptest! {
        #[test]
        fn steps_minimise_and_duals_are_subgradients(
            v in matrix(), other in matrix(), weight in 0.01..3.0f64, rho in 0.01..10.0f64,
        ) {
            check(Nuclear, [v, other], weight, rho)?;
            check(Frobenius, [v, other], weight, rho)?;
            check(SquaredNuclear { rho }, [v, other], weight, rho)?;
        }
    }
}

//! The closed-form steps of each energy.
//!
//! An energy is a sum of `ω f(H)` over interior vertices. All that ADMM needs
//! of `f` is the step `V = Y + ρH ↦ Y`, where `H` minimises
//! `ω f(H) + ρ/2 ‖H − V/ρ‖²`: the dual `Y` is then a subgradient of `ω f` at `H`.
//! All that the certificate needs is the conjugate `(ωf)*(Y)`.

use crate::fit::options::{Bending, Energy, Options};
use crate::math::lanes::single;
use crate::math::real::{Real, larger, smaller};
use crate::math::sym2::{Sym2, clamp};

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

/// `φ(‖H‖_*)`, where `φ` has the slope `min(α + s/δ, ω)`: the weight is no factor, it is where the
/// slope ends. A Huber function for `α = 0`, and `ω` times the nuclear norm for `α ≥ ω`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Bends {
    /// `α`, the slope at 0.
    pub flatness: f64,
    /// `δ`, a curvature.
    pub delta: f64,
}

impl Bends {
    pub(crate) fn of(options: &Options) -> Self {
        let Bending {
            bend_radius,
            flatness,
            ..
        } = Bending::SMOOTH.within(options);
        Bends {
            flatness,
            delta: 1.0 / bend_radius,
        }
    }

    /// `φ′(s)` with `ω = 1`.
    pub(crate) fn slope(self, s: f64) -> f64 {
        smaller(self.flatness + s / self.delta, 1.0)
    }

    pub(crate) fn law(self, rho: f64) -> Huber {
        Huber {
            bends: self,
            steps: self.steps(rho),
        }
    }

    fn steps(self, rho: f64) -> HuberStep<f64> {
        let c = rho * self.delta;
        HuberStep {
            flatness: self.flatness,
            c,
            both: 2.0 / (2.0 + c),
            one: 1.0 / (1.0 + c),
        }
    }

    /// The step `V ↦ Y` in single precision.
    pub(crate) fn single(self, rho: f64) -> HuberStep<f32> {
        let HuberStep {
            flatness,
            c,
            both,
            one,
        } = self.steps(rho);
        HuberStep {
            flatness: single(flatness),
            c: single(c),
            both: single(both),
            one: single(one),
        }
    }
}

/// The step of [`Huber`] at one ρ: with `c = ρδ`, `Y` is `V` with its eigenvalues cut off at
/// `φ′(‖H‖_*)`, which follows by summing over the eigenvalues that are left, both or one, as for
/// [`SquaredNuclear`].
#[derive(Debug, Clone, Copy)]
pub(crate) struct HuberStep<T> {
    flatness: T,
    c: T,
    /// `2/(2 + c)` and `1/(1 + c)`.
    both: T,
    one: T,
}

impl<T: Real> HuberStep<T> {
    #[inline(always)]
    pub(crate) fn dual(self, v: [T; 3], weight: T) -> [T; 3] {
        let [mean, diff, off] = v;
        let radius = (diff * diff + off * off).sqrt();
        let mean = larger(mean, -mean);
        let least = smaller(self.flatness, weight);
        let added = self.c * least;
        let both = (larger(mean, radius) + T::HALF * added) * self.both;
        let one = (mean + radius + added) * self.one;
        clamp(v, smaller(weight, larger(least, larger(both, one))))
    }
}

/// The law of [`Bends`] at one ρ.
#[derive(Clone, Copy)]
pub(crate) struct Huber {
    bends: Bends,
    steps: HuberStep<f64>,
}

impl Law for Huber {
    #[inline(always)]
    fn dual(self, v: Sym2, weight: f64) -> Sym2 {
        let [mean, diff, off] = self.steps.dual([v.mean, v.diff, v.off], weight);
        Sym2 { mean, diff, off }
    }
    #[inline(always)]
    fn value(self, hessian: Sym2, weight: f64) -> f64 {
        let Bends { flatness, delta } = self.bends;
        let s = hessian.nuclear_norm();
        let least = smaller(flatness, weight);
        // Beyond `(ω − a)δ` the slope is ω.
        let bent = smaller(s, (weight - least) * delta);
        least * bent + 0.5 * bent * (bent / delta) + weight * (s - bent)
    }
    /// At least 1: `(ωf)*(tY) ≤ t² (ωf)*(Y)` for `t ≤ 1` only.
    #[inline(always)]
    fn size(self, dual: Sym2, weight: f64) -> f64 {
        larger(dual.spectral_norm() / weight, 1.0)
    }
    #[inline(always)]
    fn conjugate(self, dual: Sym2, weight: f64) -> f64 {
        let Bends { flatness, delta } = self.bends;
        let above = larger(dual.spectral_norm() - smaller(flatness, weight), 0.0);
        0.5 * delta * above * above
    }
}

/// Which law an energy follows; its weights ω are another matter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Kind {
    Nuclear,
    Frobenius,
    SquaredNuclear,
    Huber(Bends),
}

impl Kind {
    pub(crate) fn of(options: &Options) -> Self {
        match options.energy_or_default() {
            Energy::Nuclear | Energy::SecondFormOfInput | Energy::SecondForm => Kind::Nuclear,
            Energy::Frobenius => Kind::Frobenius,
            Energy::SquaredNuclear => Kind::SquaredNuclear,
            Energy::Huber => Kind::Huber(Bends::of(options)),
        }
    }
}

/// The law of a kind, looked up at every vertex. Kernels that are seldom run, or
/// seldom for another energy than the nuclear norm, are compiled for this alone:
/// a version for each law, which is what inlining comes to, would make the wasm a
/// quarter larger.
#[derive(Clone, Copy)]
pub(crate) enum Any {
    Nuclear,
    Frobenius,
    SquaredNuclear(SquaredNuclear),
    Huber(Huber),
}

impl Any {
    pub(crate) fn new(kind: Kind, rho: f64) -> Self {
        match kind {
            Kind::Nuclear => Any::Nuclear,
            Kind::Frobenius => Any::Frobenius,
            Kind::SquaredNuclear => Any::SquaredNuclear(SquaredNuclear { rho }),
            Kind::Huber(bends) => Any::Huber(bends.law(rho)),
        }
    }
}

/// Calls the same method of the law itself.
macro_rules! the_law {
    ($any:expr, |$law:ident| $call:expr) => {
        match $any {
            Any::Nuclear => {
                let $law = Nuclear;
                $call
            }
            Any::Frobenius => {
                let $law = Frobenius;
                $call
            }
            Any::SquaredNuclear($law) => $call,
            Any::Huber($law) => $call,
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
            delta in 0.01..10.0f64,
        ) {
            check(Nuclear, [v, other], weight, rho)?;
            check(Frobenius, [v, other], weight, rho)?;
            check(SquaredNuclear { rho }, [v, other], weight, rho)?;
            for flatness in [0.0, 0.3, 1.0] {
                check(Bends { flatness, delta }.law(rho), [v, other], weight, rho)?;
            }
        }
    }
}

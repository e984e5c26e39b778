//! Spectral penalties of the Hessian: proximal step, value and convex conjugate of each in closed form.
//!
//! An energy is a sum of `ω f(H)` over interior vertices, where `f` depends on the eigenvalues of `H`. ADMM
//! needs the step `V = Y + ρH ↦ Y` alone, where `H` minimises `ω f(H) + ρ/2 ‖H − V/ρ‖²`: the dual `Y` is then a
//! subgradient of `ω f` at `H`. The certificate needs the value of `f` and the conjugate `(ωf)*(Y)`.

use crate::fit::options::{Energy, HuberOptions, Options};
use crate::math::lanes::single;
use crate::math::real::{Real, larger, smaller};
use crate::math::sym2::{Sym2, clamp};

/// A penalty `f` of the Hessian that depends on its eigenvalues alone, with its proximal step and its convex conjugate.
pub(crate) trait SpectralPenalty: Copy + Sync {
    /// Maximum of [`SpectralPenalty::size`] at which a dual is feasible: 1, or infinity if every dual is feasible.
    fn largest(self) -> f64 {
        1.0
    }

    /// Returns the dual `Y` that the proximal step splits off `V = Y + ρH`, for a stencil of penalty weight `ω`.
    fn dual(self, v: Sym2, weight: f64) -> Sym2;
    /// Returns the penalty `ω f(H)` of a Hessian.
    fn value(self, hessian: Sym2, weight: f64) -> f64;
    /// Returns the size of a dual in the dual norm, relative to the stencil's weight.
    fn size(self, dual: Sym2, weight: f64) -> f64;
    /// Returns the convex conjugate `(ωf)*(Y)` of the penalty, where it is finite.
    fn conjugate(self, dual: Sym2, weight: f64) -> f64;
}

/// Penalty by the nuclear norm `‖H‖_*`. Its dual step projects onto matrices with eigenvalues within ±ω (paper, App.
/// D).
#[derive(Clone, Copy)]
pub(crate) struct NuclearNorm;

impl SpectralPenalty for NuclearNorm {
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

/// Penalty by the Frobenius norm `‖H‖_F`. Its dual step projects onto the ball of radius ω.
#[derive(Clone, Copy)]
pub(crate) struct FrobeniusNorm;

impl SpectralPenalty for FrobeniusNorm {
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

/// Penalty by the squared nuclear norm `‖H‖_*²`. At the minimiser every eigenvalue of `H` is the corresponding one of
/// `V/ρ` shrunk by `2ωs/ρ`, where `s = ‖H‖_*`, so that `Y` is `V` with eigenvalues clamped to `±2ωs`; `s` follows from
/// the sum over the eigenvalues that are left, both or one.
#[derive(Clone, Copy)]
pub(crate) struct SquaredNuclearNorm {
    pub rho: f64,
}

impl SpectralPenalty for SquaredNuclearNorm {
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

/// Parameters of the Huber penalty `φ(‖H‖_*)`, where `φ` has the slope `min(α + s/δ, ω)`: the weight `ω` is no factor,
/// but the maximum of the slope. It is a Huber function for `α = 0`, and `ω` times the nuclear norm for `α ≥ ω`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct HuberParameters {
    /// Flatness `α`: the slope of the penalty at 0.
    pub flatness: f64,
    /// Curvature `δ` at which the slope of the penalty would reach `α + 1`: one over the bend radius.
    pub delta: f64,
}

impl HuberParameters {
    /// Takes the parameters from the options of a solve, with defaults where none are given.
    pub(crate) fn from_options(options: &Options) -> Self {
        let HuberOptions {
            bend_radius,
            flatness,
            ..
        } = HuberOptions::SMOOTH.within(options);
        HuberParameters {
            flatness,
            delta: 1.0 / bend_radius,
        }
    }

    /// Returns the slope `φ′(s)` of the penalty at the nuclear norm `s`, for the weight `ω = 1`.
    pub(crate) fn slope(self, s: f64) -> f64 {
        smaller(self.flatness + s / self.delta, 1.0)
    }

    /// Makes the penalty with these parameters for one ρ.
    pub(crate) fn penalty(self, rho: f64) -> HuberPenalty {
        HuberPenalty {
            bends: self,
            steps: self.steps(rho),
        }
    }

    /// Makes the dual step for one ρ, in double precision.
    fn steps(self, rho: f64) -> HuberStep<f64> {
        let c = rho * self.delta;
        HuberStep {
            flatness: self.flatness,
            c,
            both: 2.0 / (2.0 + c),
            one: 1.0 / (1.0 + c),
        }
    }

    /// Makes the dual step for one ρ, in single precision.
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

/// Step from `V = Y + ρH` to the dual `Y` of [`HuberPenalty`] for one ρ: with `c = ρδ`, `Y` is `V` with its eigenvalues
/// clamped to `±φ′(‖H‖_*)`, where `‖H‖_*` follows from the sum over the eigenvalues of `V` beyond that limit, both or
/// one.
#[derive(Debug, Clone, Copy)]
pub(crate) struct HuberStep<T> {
    flatness: T,
    c: T,
    /// Factor `2/(2 + c)` of the step where both eigenvalues are beyond the limit that they are clamped to.
    both: T,
    /// Factor `1/(1 + c)` of the step where one eigenvalue is beyond the limit that they are clamped to.
    one: T,
}

impl<T: Real> HuberStep<T> {
    /// Returns the dual of the matrix `v`, both by the coordinates of [`Sym2`], for a stencil of penalty weight `ω`.
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

/// Huber penalty with given [`HuberParameters`] for one ρ.
#[derive(Clone, Copy)]
pub(crate) struct HuberPenalty {
    bends: HuberParameters,
    steps: HuberStep<f64>,
}

impl SpectralPenalty for HuberPenalty {
    #[inline(always)]
    fn dual(self, v: Sym2, weight: f64) -> Sym2 {
        let [mean, diff, off] = self.steps.dual([v.mean, v.diff, v.off], weight);
        Sym2 { mean, diff, off }
    }
    #[inline(always)]
    fn value(self, hessian: Sym2, weight: f64) -> f64 {
        let HuberParameters { flatness, delta } = self.bends;
        let s = hessian.nuclear_norm();
        let least = smaller(flatness, weight);
        // Beyond `(ω − a)δ` the slope is ω.
        let bent = smaller(s, (weight - least) * delta);
        least * bent + 0.5 * bent * (bent / delta) + weight * (s - bent)
    }
    /// Returns the size of a dual in the dual norm, and at least 1, because `(ωf)*(tY) ≤ t² (ωf)*(Y)` for `t ≤ 1` only.
    #[inline(always)]
    fn size(self, dual: Sym2, weight: f64) -> f64 {
        larger(dual.spectral_norm() / weight, 1.0)
    }
    #[inline(always)]
    fn conjugate(self, dual: Sym2, weight: f64) -> f64 {
        let HuberParameters { flatness, delta } = self.bends;
        let above = larger(dual.spectral_norm() - smaller(flatness, weight), 0.0);
        0.5 * delta * above * above
    }
}

/// Kind of the spectral penalty that an energy has, without its weights and ρ.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum PenaltyKind {
    Nuclear,
    Frobenius,
    SquaredNuclear,
    Huber(HuberParameters),
}

impl PenaltyKind {
    pub(crate) fn from_options(options: &Options) -> Self {
        match options.energy_or_default() {
            Energy::Nuclear | Energy::SecondFormOfInput | Energy::SecondForm => {
                PenaltyKind::Nuclear
            }
            Energy::Frobenius => PenaltyKind::Frobenius,
            Energy::SquaredNuclear => PenaltyKind::SquaredNuclear,
            Energy::Huber => PenaltyKind::Huber(HuberParameters::from_options(options)),
        }
    }
}

/// Spectral penalty of any kind, chosen at run time at every stencil. Kernels that run seldom, or seldom for another
/// energy than the nuclear norm, are compiled for this type only: one version for each penalty would make the wasm a
/// quarter larger.
#[derive(Clone, Copy)]
pub(crate) enum AnyPenalty {
    Nuclear,
    Frobenius,
    SquaredNuclear(SquaredNuclearNorm),
    Huber(HuberPenalty),
}

impl AnyPenalty {
    /// Makes the penalty of a kind for one ρ.
    pub(crate) fn new(kind: PenaltyKind, rho: f64) -> Self {
        match kind {
            PenaltyKind::Nuclear => AnyPenalty::Nuclear,
            PenaltyKind::Frobenius => AnyPenalty::Frobenius,
            PenaltyKind::SquaredNuclear => AnyPenalty::SquaredNuclear(SquaredNuclearNorm { rho }),
            PenaltyKind::Huber(bends) => AnyPenalty::Huber(bends.penalty(rho)),
        }
    }
}

/// Calls a method of the spectral penalty that an [`AnyPenalty`] holds.
macro_rules! the_penalty {
    ($any:expr, |$penalty:ident| $call:expr) => {
        match $any {
            AnyPenalty::Nuclear => {
                let $penalty = NuclearNorm;
                $call
            }
            AnyPenalty::Frobenius => {
                let $penalty = FrobeniusNorm;
                $call
            }
            AnyPenalty::SquaredNuclear($penalty) => $call,
            AnyPenalty::Huber($penalty) => $call,
        }
    };
}

impl SpectralPenalty for AnyPenalty {
    fn largest(self) -> f64 {
        the_penalty!(self, |penalty| penalty.largest())
    }
    #[inline(never)]
    fn dual(self, v: Sym2, weight: f64) -> Sym2 {
        the_penalty!(self, |penalty| penalty.dual(v, weight))
    }
    #[inline(never)]
    fn value(self, hessian: Sym2, weight: f64) -> f64 {
        the_penalty!(self, |penalty| penalty.value(hessian, weight))
    }
    #[inline(never)]
    fn size(self, dual: Sym2, weight: f64) -> f64 {
        the_penalty!(self, |penalty| penalty.size(dual, weight))
    }
    #[inline(never)]
    fn conjugate(self, dual: Sym2, weight: f64) -> f64 {
        the_penalty!(self, |penalty| penalty.conjugate(dual, weight))
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))] // proptest is native
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// `H` minimises `ω f(H) + ρ/2 ‖H − V/ρ‖²`, and Fenchel's inequality is an
    /// equality for `(H, Y)` and holds for every other pair.
    fn check(
        penalty: impl SpectralPenalty,
        [v, other]: [Sym2; 2],
        weight: f64,
        rho: f64,
    ) -> Result<(), TestCaseError> {
        let dual = penalty.dual(v, weight);
        let hessian = (v - dual).scale(1.0 / rho);
        let energy = |h: Sym2| {
            let distance = h - v.scale(1.0 / rho);
            penalty.value(h, weight) + 0.5 * rho * distance.dot(distance)
        };
        let size = 1.0 + energy(hessian) + energy(other);
        prop_assert!(energy(hessian) <= energy(hessian + other) + 1e-12 * size);
        prop_assert!(energy(hessian) <= energy(other) + 1e-12 * size);
        let slack =
            |h: Sym2| penalty.value(h, weight) + penalty.conjugate(dual, weight) - h.dot(dual);
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
            check(NuclearNorm, [v, other], weight, rho)?;
            check(FrobeniusNorm, [v, other], weight, rho)?;
            check(SquaredNuclearNorm { rho }, [v, other], weight, rho)?;
            for flatness in [0.0, 0.3, 1.0] {
                check(HuberParameters { flatness, delta }.penalty(rho), [v, other], weight, rho)?;
            }
        }
    }
}

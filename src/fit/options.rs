//! Options of a solve, with their defaults and ranges.

use std::str::FromStr;

use super::threads::MAX_THREADS;
use crate::error::{Error, Result};
use crate::heights::normalization::Normalization;

/// Range of the fidelity weight λ: outside of it one of the energy's two terms vanishes beside the other, even in
/// double precision.
const LAMBDA_RANGE: std::ops::RangeInclusive<f64> = 1e-12..=1e15;

/// Range of the Huber penalty's bend radius and crease radius, in normalised coordinates: from far below a spacing to
/// far beyond any surface.
const RADIUS_RANGE: std::ops::RangeInclusive<f64> = 1e-6..=1e6;

/// Maximum number of reweighting or crease passes that an option may ask for; further passes do not change the surface.
const MAX_PASSES: usize = 20;

/// Default of [`Options::gap`], the relative duality gap at which a solve stops.
pub(crate) const DEFAULT_GAP: f64 = 0.01;

/// Default of [`Options::tie_break`], the weight that holds free vertices.
const DEFAULT_TIE_BREAK: f64 = 0.01;

/// Default of [`Options::crease_passes`], the maximum number of crease passes.
pub(crate) const DEFAULT_CREASE_PASSES: usize = 2;

/// Weight λ of the fidelity term in the energy, for coordinates normalised to the unit square. The presets are the
/// paper's (Sec. 5).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub enum Lambda {
    /// λ = 10⁵: for heavy, widespread noise, or for few large patches.
    Small,
    /// λ = 10⁶: the weight of [`Options::paper`].
    Medium,
    /// λ = 10⁷: for input that is developable except for small artefacts.
    Big,
    /// Any weight λ of the squared distance from the input, from 10⁻¹² to 10¹⁵, for heights normalised to the unit square.
    Value(f64),
    /// Chosen from the input: λ follows from the size of its noise, and is corrected on a coarse lattice where the surface
    /// there is farther from the heights than noise explains. With [`Energy::Huber`] the parameters of the penalty are those
    /// that predict held-out heights best (cross-validation on a coarser lattice). Heights without noise stay within 0.2 % of
    /// their range. An input whose noise cannot be measured, such as a [design](crate::Input::design), gets
    /// [`Lambda::Medium`]. [`Report::lambda_choice`](crate::Report::lambda_choice) reports the choice.
    #[default]
    Auto,
}

impl Lambda {
    /// Returns the preset with the name `small`, `medium`, `big` or `auto`, in upper or lower case; `None` for any
    /// other name.
    pub fn named(name: &str) -> Option<Self> {
        match name.to_ascii_lowercase().as_str() {
            "small" => Some(Lambda::Small),
            "medium" => Some(Lambda::Medium),
            "big" => Some(Lambda::Big),
            "auto" => Some(Lambda::Auto),
            _ => None,
        }
    }

    /// Returns λ as a number. [`Lambda::Auto`] has none before a solve and counts as [`Lambda::Medium`].
    pub fn value(self) -> f64 {
        match self {
            Lambda::Small => 1e5,
            Lambda::Medium | Lambda::Auto => 1e6,
            Lambda::Big => 1e7,
            Lambda::Value(value) => value,
        }
    }
}

impl From<f64> for Lambda {
    fn from(value: f64) -> Self {
        Lambda::Value(value)
    }
}

#[cfg(feature = "serde")]
impl<'de> serde::Deserialize<'de> for Lambda {
    fn deserialize<D: serde::Deserializer<'de>>(
        deserializer: D,
    ) -> std::result::Result<Self, D::Error> {
        deserializer.deserialize_any(LambdaVisitor)
    }
}

/// Deserialisation visitor that reads λ as a number or the name of a preset.
#[cfg(feature = "serde")]
struct LambdaVisitor;

#[cfg(feature = "serde")]
impl serde::de::Visitor<'_> for LambdaVisitor {
    type Value = Lambda;

    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.write_str("small, medium, big, auto or a number above zero")
    }

    fn visit_f64<E>(self, value: f64) -> std::result::Result<Lambda, E> {
        Ok(Lambda::Value(value))
    }

    fn visit_i64<E>(self, value: i64) -> std::result::Result<Lambda, E> {
        Ok(Lambda::Value(value as f64))
    }

    fn visit_u64<E>(self, value: u64) -> std::result::Result<Lambda, E> {
        Ok(Lambda::Value(value as f64))
    }

    fn visit_str<E: serde::de::Error>(self, name: &str) -> std::result::Result<Lambda, E> {
        Lambda::named(name).ok_or_else(|| E::invalid_value(serde::de::Unexpected::Str(name), &self))
    }
}

impl FromStr for Lambda {
    type Err = Error;

    /// Reads λ from text: `small`, `medium`, `big`, `auto` or a number.
    fn from_str(text: &str) -> Result<Self> {
        let number = || text.parse().ok().map(Lambda::Value);
        Lambda::named(text).or_else(number).ok_or_else(|| {
            Error::option(
                "lambda",
                text,
                "must be small, medium, big, auto or a number above zero",
            )
        })
    }
}

/// Root mean square distance from the input that a surface may have.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Tolerance {
    /// A distance in the unit of the heights.
    Distance(f64),
    /// A share of the height range of the input, such as 0.005 for 0.5 %.
    Share(f64),
}

impl Tolerance {
    /// Returns the distance that is allowed for heights of a range.
    pub(crate) fn distance(self, range: f64) -> f64 {
        match self {
            Tolerance::Distance(distance) => distance,
            Tolerance::Share(share) => share * range,
        }
    }
}

impl From<f64> for Tolerance {
    fn from(distance: f64) -> Self {
        Tolerance::Distance(distance)
    }
}

impl FromStr for Tolerance {
    type Err = Error;

    /// Reads a tolerance from text: a distance in the unit of the heights, or a share of their range such as `0.5%`.
    fn from_str(text: &str) -> Result<Self> {
        let tolerance = match text.strip_suffix('%') {
            Some(percent) => percent
                .trim_end()
                .parse()
                .ok()
                .map(|x: f64| Tolerance::Share(0.01 * x)),
            None => text.parse().ok().map(Tolerance::Distance),
        };
        let is_positive = |tolerance: &Tolerance| {
            tolerance.distance(1.0) > 0.0 && tolerance.distance(1.0).is_finite()
        };
        tolerance.filter(is_positive).ok_or_else(|| {
            Error::option(
                "tolerance",
                text,
                "must be a distance above zero, or a share of the height range such as 0.5%",
            )
        })
    }
}

#[cfg(feature = "serde")]
impl<'de> serde::Deserialize<'de> for Tolerance {
    fn deserialize<D: serde::Deserializer<'de>>(
        deserializer: D,
    ) -> std::result::Result<Self, D::Error> {
        deserializer.deserialize_any(ToleranceVisitor)
    }
}

/// Deserialisation visitor that reads a tolerance as a number, or as a map with a `share` of the height range.
#[cfg(feature = "serde")]
struct ToleranceVisitor;

#[cfg(feature = "serde")]
impl<'de> serde::de::Visitor<'de> for ToleranceVisitor {
    type Value = Tolerance;

    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.write_str("a distance above zero, or a share of the height range")
    }

    fn visit_f64<E>(self, value: f64) -> std::result::Result<Tolerance, E> {
        Ok(Tolerance::Distance(value))
    }

    fn visit_i64<E>(self, value: i64) -> std::result::Result<Tolerance, E> {
        Ok(Tolerance::Distance(value as f64))
    }

    fn visit_u64<E>(self, value: u64) -> std::result::Result<Tolerance, E> {
        Ok(Tolerance::Distance(value as f64))
    }

    fn visit_map<M: serde::de::MapAccess<'de>>(
        self,
        mut map: M,
    ) -> std::result::Result<Tolerance, M::Error> {
        match map.next_entry::<String, f64>()? {
            Some((name, share)) if name == "share" => Ok(Tolerance::Share(share)),
            _ => Err(serde::de::Error::invalid_type(
                serde::de::Unexpected::Map,
                &self,
            )),
        }
    }
}

/// Schedule of a solve: how ADMM's iterations run and when they stop.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Deserialize),
    serde(rename_all = "camelCase")
)]
#[non_exhaustive]
pub enum Schedule {
    /// Default schedule: few conjugate-gradient iterations in each z-step, over-relaxation and balancing of the
    /// relative residuals; stops at the certified relative duality gap [`Options::gap`].
    #[default]
    Default,
    /// The paper's schedule (Sec. 4.1): z-steps solved to a tight tolerance, residual balancing after Boyd et al. that
    /// changes ρ at a larger ratio of the residuals; stops when the residuals are small. The duality gap is reported
    /// all the same.
    Paper,
}

impl FromStr for Schedule {
    type Err = Error;

    /// Reads a schedule from its name, `default` or `paper`.
    fn from_str(text: &str) -> Result<Self> {
        match text {
            "default" => Ok(Schedule::Default),
            "paper" => Ok(Schedule::Paper),
            _ => Err(Error::option("schedule", text, "must be default or paper")),
        }
    }
}

/// Penalty of the Hessian `H` of heights, which is minimised together with the fidelity term.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "camelCase")
)]
#[non_exhaustive]
pub enum Energy {
    /// Penalty `Σ ‖H‖_*`, the nuclear norm of the Hessian: piecewise developable surfaces (paper, Eq. 15). The default
    /// of a [design](crate::Input::design).
    Nuclear,
    /// Penalty `Σ ‖H‖_F`, the Frobenius norm of the Hessian: rounds off creases (paper, Fig. 21).
    Frobenius,
    /// Penalty `Σ ‖H‖_*²`, the squared nuclear norm of the Hessian: rounds off creases (paper, Fig. 21).
    SquaredNuclear,
    /// Penalty `Σ n₃ ‖H‖_*`, the nuclear norm of the second fundamental form, with the factor `n₃ = (1 + |∇z|²)^-½`
    /// computed from the input once: convex (paper, Fig. 7, right).
    SecondFormOfInput,
    /// Penalty `Σ n₃ ‖H‖_*` with the factor `n₃ = (1 + |∇z|²)^-½` of the surface itself, updated in each iteration: not
    /// convex (paper, Fig. 7, centre right). The duality gap is certified for the energy with the last factor kept.
    SecondForm,
    /// Huber penalty `Σ φ(‖H‖_*)`: `φ` is quadratic for small bends and linear for large ones, with the slope `min(α +
    /// s/δ, 1)` at the size `s`. The surface stays smooth where it bends smoothly, without the flat strips of the
    /// nuclear norm, and can still crease and stay developable. Up to [`Options::crease_passes`] further solves lower
    /// the cost of bends tighter than [`Options::crease_radius`], so that creases keep their angle. Objective and
    /// duality gap of the report belong to the last solve's energy. The default of every input that is not a design.
    #[default]
    Huber,
}

impl FromStr for Energy {
    type Err = Error;

    /// Reads an energy from its name: `nuclear`, `frobenius`, `squaredNuclear`, `secondFormOfInput`, `secondForm` or
    /// `huber`.
    fn from_str(text: &str) -> Result<Self> {
        match text {
            "nuclear" => Ok(Energy::Nuclear),
            "frobenius" => Ok(Energy::Frobenius),
            "squaredNuclear" => Ok(Energy::SquaredNuclear),
            "secondFormOfInput" => Ok(Energy::SecondFormOfInput),
            "secondForm" => Ok(Energy::SecondForm),
            "huber" => Ok(Energy::Huber),
            _ => Err(Error::option(
                "energy",
                text,
                "must be nuclear, frobenius, squaredNuclear, secondFormOfInput, secondForm or huber",
            )),
        }
    }
}

/// Boundary condition at the border of the surface, under [`Energy::Huber`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
pub enum Border {
    /// Free border, without bending moment. The surface of least energy is then too straight along it.
    Free,
    /// Border loaded with the bending moments found inside the surface in the pass before, continued to the border
    /// where they would not fold it. The first pass has a free border.
    #[default]
    Loaded,
}

/// Parameters of the Huber penalty ([`Energy::Huber`]): bend radius, flatness and crease radius.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct HuberOptions {
    pub bend_radius: f64,
    pub flatness: f64,
    pub crease_radius: f64,
}

impl HuberOptions {
    /// Default Huber parameters, for smooth bends, and creases that are much sharper.
    pub(crate) const SMOOTH: HuberOptions = HuberOptions {
        bend_radius: 0.1,
        flatness: 0.3,
        crease_radius: 0.1,
    };

    /// Parameters for a surface of unknown kind: never far from the best for smooth bends, for creases and for flat
    /// facets.
    pub(crate) const ANY: HuberOptions = HuberOptions {
        bend_radius: 0.2,
        flatness: 0.5,
        crease_radius: 0.1,
    };

    /// Huber parameters that make the penalty the nuclear norm: no bend has a quadratic cost, and none counts as a
    /// crease.
    pub(crate) const NUCLEAR: HuberOptions = HuberOptions {
        bend_radius: 0.1,
        flatness: 1.0,
        crease_radius: *RADIUS_RANGE.start(),
    };

    pub(crate) const fn new(bend_radius: f64, flatness: f64, crease_radius: f64) -> Self {
        HuberOptions {
            bend_radius,
            flatness,
            crease_radius,
        }
    }

    /// Returns these parameters, each replaced by the value that `options` give, if they give one.
    pub(crate) fn within(self, options: &Options) -> Self {
        HuberOptions {
            bend_radius: options.bend_radius.unwrap_or(self.bend_radius),
            flatness: options.flatness.unwrap_or(self.flatness),
            crease_radius: options.crease_radius.unwrap_or(self.crease_radius),
        }
    }

    /// Returns the options with these Huber parameters, in place of any that were given.
    pub(crate) fn of(self, options: &Options) -> Options {
        options
            .bend_radius(self.bend_radius)
            .flatness(self.flatness)
            .crease_radius(self.crease_radius)
    }
}

/// Options of a solve. `Options::default()` suits scans and other heights with noise; an option that is
/// given changes that option alone.
///
/// ```
/// use developable::{Lambda, Options};
/// let options = Options::default().lambda(Lambda::Big).gap(1e-3);
/// assert!(options.validate().is_ok());
/// assert!(options.gap(0.0).validate().is_err());
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Deserialize),
    serde(default, rename_all = "camelCase", deny_unknown_fields)
)]
pub struct Options {
    pub(crate) lambda: Option<Lambda>,
    pub(crate) tolerance: Option<Tolerance>,
    pub(crate) schedule: Schedule,
    pub(crate) gap: Option<f64>,
    pub(crate) max_iterations: usize,
    #[cfg_attr(feature = "serde", serde(rename = "normalize"))]
    pub(crate) normalization: Normalization,
    pub(crate) energy: Option<Energy>,
    pub(crate) reweighting: usize,
    pub(crate) tie_break: Option<f64>,
    pub(crate) bend_radius: Option<f64>,
    pub(crate) flatness: Option<f64>,
    pub(crate) crease_radius: Option<f64>,
    pub(crate) crease_passes: Option<usize>,
    #[cfg_attr(feature = "serde", serde(skip))]
    pub(crate) border: Option<Border>,
    #[cfg_attr(feature = "serde", serde(skip))]
    pub(crate) threads: Option<usize>,
    /// Whether the surface is only compared with others: its border bears no moments, and its rank is not reduced.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub(crate) is_trial: bool,
}

impl Default for Options {
    fn default() -> Self {
        Options {
            lambda: None,
            tolerance: None,
            schedule: Schedule::Default,
            gap: None,
            max_iterations: 20_000,
            normalization: Normalization::UnitSquare,
            energy: None,
            reweighting: 0,
            tie_break: None,
            bend_radius: None,
            flatness: None,
            crease_radius: None,
            crease_passes: None,
            border: None,
            threads: None,
            is_trial: false,
        }
    }
}

impl Options {
    /// Returns options with the paper's energy and weight: [`Energy::Nuclear`] at [`Lambda::Medium`]. Every other
    /// option has its default, [`Schedule::Default`] included.
    pub fn paper() -> Self {
        Options::default().or_paper()
    }

    /// Sets energy and λ to those of [`Options::paper`] where none are given.
    pub fn or_paper(mut self) -> Self {
        self.lambda.get_or_insert(Lambda::Medium);
        self.energy.get_or_insert(Energy::Nuclear);
        self
    }

    /// Sets the weight λ of the fidelity term; default [`Lambda::Auto`].
    pub fn lambda(mut self, lambda: impl Into<Lambda>) -> Self {
        self.lambda = Some(lambda.into());
        self
    }

    /// Sets the root mean square distance from the input that the surface may have, outliers apart: λ is then the smallest
    /// one that keeps within it. Default: none.
    pub fn tolerance(mut self, tolerance: impl Into<Tolerance>) -> Self {
        self.tolerance = Some(tolerance.into());
        self
    }

    /// Sets the schedule of the ADMM iterations; default [`Schedule::Default`].
    pub fn schedule(mut self, schedule: Schedule) -> Self {
        self.schedule = schedule;
        self
    }

    /// Sets the certified relative duality gap `(P − D)/P` at which [`Schedule::Default`] stops, between 0 and 1;
    /// default 0.01. The objective is then at most `1/(1 − gap)` times the optimum.
    pub fn gap(mut self, gap: f64) -> Self {
        self.gap = Some(gap);
        self
    }

    /// Sets the maximum number of ADMM iterations, at least 1; default 20 000.
    pub fn max_iterations(mut self, max_iterations: usize) -> Self {
        self.max_iterations = max_iterations;
        self
    }

    /// Sets the normalisation of the coordinates in which λ is stated; default [`Normalization::UnitSquare`].
    pub fn normalization(mut self, normalization: Normalization) -> Self {
        self.normalization = normalization;
        self
    }

    /// Sets the penalty of the Hessian; default [`Energy::Huber`], for a [design](crate::Input::design)
    /// [`Energy::Nuclear`].
    pub fn energy(mut self, energy: Energy) -> Self {
        self.energy = Some(energy);
        self
    }

    /// Sets the number of reweighting passes, at most 20; default 0. Each pass solves again with each vertex's penalty
    /// divided by the mean size of the Hessians around it in the solution before (iteratively reweighted nuclear norm),
    /// which undoes a part of the shrinkage of large curvatures. It pays where λ is small for the noise
    /// (`benches/choices.md`). Objective and duality gap of the report belong to the last pass's weighted energy. Not
    /// for [`Energy::Huber`], which has crease passes.
    pub fn reweighting(mut self, passes: usize) -> Self {
        self.reweighting = passes;
        self
    }

    /// Sets the weight, in place of λ, that pulls free vertices to the thin plate through the constraints; default
    /// 0.01. Without it minimisers need not be unique. It is limited to λ next to vertices with a fidelity term. An
    /// error where no vertex is free.
    pub fn tie_break(mut self, weight: f64) -> Self {
        self.tie_break = Some(weight);
        self
    }

    /// Sets the bend radius `1/δ` of [`Energy::Huber`], in normalised coordinates: the cost of tighter bends is linear,
    /// that of wider ones quadratic. Default: chosen with λ by [`Lambda::Auto`], else 0.1. The larger, the more the
    /// energy is like the nuclear norm.
    pub fn bend_radius(mut self, radius: f64) -> Self {
        self.bend_radius = Some(radius);
        self
    }

    /// Sets the flatness `α` of [`Energy::Huber`]: the slope of the penalty at 0, from 0 (nothing is exactly flat) to 1
    /// (the nuclear norm). Default: chosen with λ by [`Lambda::Auto`], else 0.3, and more where λ is large for the
    /// noise of the input.
    pub fn flatness(mut self, slope: f64) -> Self {
        self.flatness = Some(slope);
        self
    }

    /// Sets the crease radius `1/T` of [`Energy::Huber`], in normalised coordinates: bends of a smaller radius are
    /// creases. Default: chosen with λ by [`Lambda::Auto`], else 0.1.
    pub fn crease_radius(mut self, radius: f64) -> Self {
        self.crease_radius = Some(radius);
        self
    }

    /// Sets the maximum number of crease passes of [`Energy::Huber`] after the first solve, at most 20: solves that
    /// penalise sharp bends less. Default: 2, or 0 where λ is so large for the noise of the input that passes would
    /// make creases of noise. Passes end early where they hardly change the surface.
    pub fn crease_passes(mut self, passes: usize) -> Self {
        self.crease_passes = Some(passes);
        self
    }

    /// Sets the boundary condition at the border under [`Energy::Huber`]; default [`Border::Loaded`], which takes one
    /// of the [`Options::crease_passes`].
    pub fn border(mut self, border: Border) -> Self {
        self.border = Some(border);
        self
    }

    /// Sets the number of threads of the solve, from 1 to 256; default: one for each core that the process may use. No
    /// more are started than have some thousand vertices each. The surface is the same to the last bit for any number.
    pub fn threads(mut self, threads: usize) -> Self {
        self.threads = Some(threads);
        self
    }

    /// Weight λ of the fidelity term: the given one or the default.
    pub(crate) fn lambda_or_default(&self) -> Lambda {
        self.lambda.unwrap_or_default()
    }

    /// Whether λ is chosen from the input, with the options as they are.
    pub fn chooses_lambda(&self) -> bool {
        self.lambda_or_default() == Lambda::Auto
    }

    /// Certified relative duality gap to stop at: the given one or the default.
    pub(crate) fn gap_or_default(&self) -> f64 {
        self.gap.unwrap_or(DEFAULT_GAP)
    }

    /// Energy to minimise: the given one or the default.
    pub(crate) fn energy_or_default(&self) -> Energy {
        self.energy.unwrap_or_default()
    }

    /// Weight that pulls free vertices to the thin plate: the given one or the default.
    pub(crate) fn tie_break_or_default(&self) -> f64 {
        self.tie_break.unwrap_or(DEFAULT_TIE_BREAK)
    }

    /// Maximum number of crease passes: the given one or the default.
    pub(crate) fn crease_passes_or_default(&self) -> usize {
        self.crease_passes.unwrap_or(DEFAULT_CREASE_PASSES)
    }

    /// Boundary condition at the border: the given one or the default.
    pub(crate) fn border_or_default(&self) -> Border {
        self.border.unwrap_or_default()
    }

    /// Fills in the default energy where none is given: [`Energy::Nuclear`] for a design, [`Energy::Huber`] otherwise.
    pub(crate) fn with_energy_for(mut self, is_design: bool) -> Self {
        let default = match is_design {
            true => Energy::Nuclear,
            false => Energy::default(),
        };
        self.energy.get_or_insert(default);
        self
    }

    /// Checks that every option is within its range and has an effect beside the other options that are given.
    ///
    /// # Errors
    /// [`Error::Option`] with the name of the first option that fails.
    pub fn validate(&self) -> Result<()> {
        self.check_ranges()?;
        self.check_effects()
    }

    fn check_ranges(&self) -> Result<()> {
        if let Some(tolerance) = self.tolerance
            && !(tolerance.distance(1.0) > 0.0 && tolerance.distance(1.0).is_finite())
        {
            let requirement =
                "must be a distance above zero, or a share of the height range such as 0.5%";
            return Err(Error::option(
                "tolerance",
                tolerance.distance(1.0),
                requirement,
            ));
        }
        if self.tolerance.is_some() && self.lambda_or_default() != Lambda::Auto {
            return Err(Error::option(
                "tolerance",
                "given",
                "has no effect beside a number for lambda, which it decides",
            ));
        }
        let lambda = self.lambda_or_default().value();
        if !LAMBDA_RANGE.contains(&lambda) {
            return Err(Error::option(
                "lambda",
                lambda,
                "must lie between 1e-12 and 1e15",
            ));
        }
        if let Some(gap) = self.gap
            && !(gap > 0.0 && gap < 1.0)
        {
            return Err(Error::option(
                "gap",
                gap,
                "must lie between 0 and 1, both excluded",
            ));
        }
        if self.reweighting > MAX_PASSES {
            return Err(Error::option(
                "reweighting",
                self.reweighting,
                "must be at most 20",
            ));
        }
        if let Some(weight) = self.tie_break
            && !LAMBDA_RANGE.contains(&weight)
        {
            return Err(Error::option(
                "tie_break",
                weight,
                "must lie between 1e-12 and 1e15",
            ));
        }
        for (name, radius) in [
            ("bend_radius", self.bend_radius),
            ("crease_radius", self.crease_radius),
        ] {
            if radius.is_some_and(|radius| !RADIUS_RANGE.contains(&radius)) {
                return Err(Error::option(
                    name,
                    radius.unwrap_or_default(),
                    "must lie between 1e-6 and 1e6",
                ));
            }
        }
        if let Some(flatness) = self.flatness
            && !(0.0..=1.0).contains(&flatness)
        {
            return Err(Error::option(
                "flatness",
                flatness,
                "must lie between 0 and 1",
            ));
        }
        if let Some(passes) = self.crease_passes
            && passes > MAX_PASSES
        {
            return Err(Error::option("crease_passes", passes, "must be at most 20"));
        }
        if self.max_iterations == 0 {
            return Err(Error::option("max_iterations", 0, "must be at least 1"));
        }
        if let Some(threads) = self.threads
            && !(1..=MAX_THREADS).contains(&threads)
        {
            return Err(Error::option(
                "threads",
                threads,
                "must be a whole number from 1 to 256",
            ));
        }
        Ok(())
    }

    /// Returns an error for an option that has no effect beside the other options that are given.
    fn check_effects(&self) -> Result<()> {
        if let (Schedule::Paper, Some(gap)) = (self.schedule, self.gap) {
            return Err(Error::option(
                "gap",
                gap,
                "has no effect with the schedule paper, which stops on its residuals: leave one of them out",
            ));
        }
        match self.energy {
            Some(Energy::Huber) => self.check_reweighting(),
            Some(_) => self.check_huber(
                "is a parameter of the energy huber and another energy is given: leave one of them out",
            ),
            None => Ok(()),
        }
    }

    fn check_reweighting(&self) -> Result<()> {
        if self.reweighting == 0 {
            return Ok(());
        }
        Err(Error::option(
            "reweighting",
            self.reweighting,
            "must be 0 for the energy huber, which has crease passes in its place: \
             choose another energy, as nuclear",
        ))
    }

    /// Returns an error with `requirement` as its message if an option is given that only [`Energy::Huber`] has.
    fn check_huber(&self, requirement: &'static str) -> Result<()> {
        let radii_and_slope = [
            ("bend_radius", self.bend_radius),
            ("flatness", self.flatness),
            ("crease_radius", self.crease_radius),
        ];
        for (name, value) in radii_and_slope {
            if let Some(value) = value {
                return Err(Error::option(name, value, requirement));
            }
        }
        if let Some(passes) = self.crease_passes {
            return Err(Error::option("crease_passes", passes, requirement));
        }
        Ok(())
    }

    /// Returns an error for an option that has no effect on an input: [`Options::tie_break`] where no vertex is free,
    /// and parameters of another energy than the input's default where none is given.
    pub(crate) fn check_effects_on(&self, is_design: bool, has_free_vertices: bool) -> Result<()> {
        if let (Some(weight), false) = (self.tie_break, has_free_vertices) {
            return Err(Error::option(
                "tie_break",
                weight,
                "has no effect where every vertex has an input height: leave it out",
            ));
        }
        match (self.energy, is_design) {
            (None, true) => self.check_huber(
                "is a parameter of the energy huber and a design has the energy nuclear unless another one is given: \
                 give the energy huber as well",
            ),
            (None, false) => self.check_reweighting(),
            _ => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lambda_reads_names_and_numbers() {
        assert_eq!("big".parse::<Lambda>().unwrap().value(), 1e7);
        assert_eq!("3e5".parse::<Lambda>().unwrap(), Lambda::Value(3e5));
        assert_eq!("huge".parse::<Lambda>().unwrap_err().code(), "OPTION");
        assert_eq!("small".parse::<Lambda>().unwrap(), Lambda::Small);
        assert!("tiny".parse::<Lambda>().is_err());
    }

    #[test]
    #[cfg(feature = "serde")]
    fn options_are_read_from_json() {
        let read = |json: &str| serde_json::from_str::<Options>(json);
        assert_eq!(read("{}").unwrap(), Options::default());
        let given = r#"{"lambda": "big", "maxIterations": 7, "normalize": false, "energy": "secondFormOfInput", "schedule": "paper"}"#;
        let expected = Options::default()
            .lambda(Lambda::Big)
            .max_iterations(7)
            .normalization(Normalization::Off)
            .energy(Energy::SecondFormOfInput)
            .schedule(Schedule::Paper);
        assert_eq!(read(given).unwrap(), expected);
        for number in ["300000", "3e5"] {
            let options = read(&format!(r#"{{"lambda": {number}}}"#)).unwrap();
            assert_eq!(options, Options::default().lambda(3e5));
        }
        for wrong in [
            r#"{"lambda": "huge"}"#,
            r#"{"lamda": 1}"#,
            r#"{"gap": "x"}"#,
        ] {
            assert!(read(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn the_paper_fills_in_what_is_not_given() {
        assert_eq!(Options::default().or_paper(), Options::paper());
        let auto = Options::default().lambda(Lambda::Auto).or_paper();
        assert_eq!(auto.lambda_or_default(), Lambda::Auto);
        assert_eq!(auto.energy_or_default(), Energy::Nuclear);
    }

    #[test]
    fn options_out_of_range_are_named() {
        let name = |options: Options| match options.validate() {
            Err(Error::Option { name, .. }) => name,
            other => panic!("{other:?}"),
        };
        for bad in [0.0, -1.0, 1e16, f64::NAN, f64::INFINITY] {
            assert_eq!(name(Options::default().lambda(bad)), "lambda");
        }
        for bad in [0.0, 1.0, f64::NAN] {
            assert_eq!(name(Options::default().gap(bad)), "gap");
        }
        assert_eq!(name(Options::default().max_iterations(0)), "max_iterations");
    }
}

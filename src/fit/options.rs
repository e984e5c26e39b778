//! What may be chosen about a solve, with its defaults.

use std::str::FromStr;

use crate::error::{Error, Result};
use crate::heights::normalization::Normalization;

/// Beyond these even double precision sees only one of the energy's two terms.
const LAMBDAS: std::ops::RangeInclusive<f64> = 1e-12..=1e15;

/// In normalised coordinates: from far below a spacing to far beyond any surface.
const RADII: std::ops::RangeInclusive<f64> = 1e-6..=1e6;

/// More passes change nothing any more.
const MOST_PASSES: usize = 20;

/// Weight λ of the fidelity term, stated for coordinates normalised to the
/// unit square. The presets are the paper's (Sec. 5).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub enum Lambda {
    /// 10⁵: for heavy, widespread noise, or for few large patches.
    Small,
    /// 10⁶.
    #[default]
    Medium,
    /// 10⁷: for input that is developable but for small artefacts.
    Big,
    /// Any number from 10⁻¹² to 10¹⁵.
    Value(f64),
    /// From the data, for heights with noise: a first λ from how large that is, then the one that
    /// predicts best what a part of the heights are, which are held out from solves on a lattice
    /// of twice the spacing. With [`Energy::Huber`] what bends cost is chosen likewise, as far as it
    /// is not given. [`Report::lambda_choice`](crate::Report::lambda_choice) tells what was found.
    Auto,
}

impl Lambda {
    /// That of the name `small`, `medium`, `big` or `auto`.
    pub fn named(name: &str) -> Option<Self> {
        match name {
            "small" => Some(Lambda::Small),
            "medium" => Some(Lambda::Medium),
            "big" => Some(Lambda::Big),
            "auto" => Some(Lambda::Auto),
            _ => None,
        }
    }

    /// The number that stands in the energy; of [`Lambda::Auto`], which has none yet, that of
    /// [`Lambda::Medium`].
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

impl FromStr for Lambda {
    type Err = Error;

    /// Reads `small`, `medium`, `big`, `auto` or a number.
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

/// How the iterations are run and when they stop.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
pub enum Schedule {
    /// A fixed handful of conjugate-gradient iterations in each z-step,
    /// over-relaxation, balancing of the relative residuals; stops at the
    /// certified relative gap [`Options::gap`].
    #[default]
    Default,
    /// The paper's (Sec. 4.1): z-steps solved tightly, residual balancing after
    /// Boyd et al. with the loosened trigger, stops on the residuals. The gap
    /// is reported all the same.
    Paper,
}

impl FromStr for Schedule {
    type Err = Error;

    /// Reads `default` and `paper`.
    fn from_str(text: &str) -> Result<Self> {
        match text {
            "default" => Ok(Schedule::Default),
            "paper" => Ok(Schedule::Paper),
            _ => Err(Error::option("schedule", text, "must be default or paper")),
        }
    }
}

/// What is minimised besides the fidelity term.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(rename_all = "camelCase")
)]
#[non_exhaustive]
pub enum Energy {
    /// `Σ ‖H‖_*`, the nuclear norm of the Hessian: piecewise developable (paper, Eq. 15).
    #[default]
    Nuclear,
    /// `Σ ‖H‖_F`: smooth where it should crease (Fig. 21).
    Frobenius,
    /// `Σ ‖H‖_*²`: likewise (Fig. 21).
    SquaredNuclear,
    /// `Σ n₃ ‖H‖_*`, the nuclear norm of the second fundamental form, with the factor
    /// `n₃ = (1 + |∇z|²)^-½` taken from the input once: convex (Fig. 7, right).
    SecondFormOfInput,
    /// The same with the factor of the surface itself, updated in each iteration: not convex
    /// (Fig. 7, centre right). What is certified is the energy with the last factor kept.
    SecondForm,
    /// `Σ φ(‖H‖_*)`, where `φ` grows with the square of small bends and with the size of large ones,
    /// with the slope `min(α + s/δ, 1)`: smooth where the surface bends smoothly, without the flat
    /// strips that the nuclear norm makes of it, and still creased, and developable. Bends tighter
    /// than [`Options::crease_radius`] then cost less in up to [`Options::crease_passes`] further
    /// solves, so that they keep their angle. The figures of the report are those of the last one's
    /// energy.
    Huber,
}

impl FromStr for Energy {
    type Err = Error;

    /// Reads `nuclear`, `frobenius`, `squaredNuclear`, `secondFormOfInput`, `secondForm` and `huber`.
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

/// What the surface has beyond its border, under [`Energy::Huber`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
pub enum Border {
    /// Nothing. A free border bears no bending moment, so that least energy straightens a bent sheet
    /// along it.
    Free,
    /// What it has inside: in the passes after the first the border bears the moments there, as far as
    /// they would not fold the sheet.
    #[default]
    Loaded,
}

/// The three numbers of [`Energy::Huber`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Bending {
    pub bend_radius: f64,
    pub flatness: f64,
    pub crease_radius: f64,
}

impl Bending {
    /// For smooth bends, and creases that are much sharper: the default.
    pub(crate) const SMOOTH: Bending = Bending {
        bend_radius: 0.1,
        flatness: 0.3,
        crease_radius: 0.1,
    };

    /// Where it cannot be told what there is: not far from the best for any of them.
    pub(crate) const ANY: Bending = Bending {
        bend_radius: 0.2,
        flatness: 0.5,
        crease_radius: 0.1,
    };

    /// The nuclear norm: no bend costs its square, and nothing is a crease.
    pub(crate) const NUCLEAR: Bending = Bending {
        bend_radius: 0.1,
        flatness: 1.0,
        crease_radius: *RADII.start(),
    };

    pub(crate) const fn new(bend_radius: f64, flatness: f64, crease_radius: f64) -> Self {
        Bending {
            bend_radius,
            flatness,
            crease_radius,
        }
    }

    /// With what the options give in place of its own.
    pub(crate) fn within(self, options: &Options) -> Self {
        Bending {
            bend_radius: options.bend_radius.unwrap_or(self.bend_radius),
            flatness: options.flatness.unwrap_or(self.flatness),
            crease_radius: options.crease_radius.unwrap_or(self.crease_radius),
        }
    }

    /// The options with these.
    pub(crate) fn of(self, options: &Options) -> Options {
        options
            .bend_radius(self.bend_radius)
            .flatness(self.flatness)
            .crease_radius(self.crease_radius)
    }
}

/// Options of a solve; `Options::default()` suits most inputs.
///
/// ```
/// use developable::{Lambda, Options};
/// let options = Options::default().lambda(Lambda::Big).gap(1e-3);
/// assert!(options.validate().is_ok());
/// assert!(options.gap(0.0).validate().is_err());
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Options {
    pub(crate) lambda: Lambda,
    pub(crate) schedule: Schedule,
    pub(crate) gap: f64,
    pub(crate) max_iterations: usize,
    pub(crate) normalization: Normalization,
    pub(crate) energy: Energy,
    pub(crate) reweighting: usize,
    pub(crate) tie_break: f64,
    pub(crate) bend_radius: Option<f64>,
    pub(crate) flatness: Option<f64>,
    pub(crate) crease_radius: Option<f64>,
    pub(crate) crease_passes: usize,
    pub(crate) border: Border,
}

impl Default for Options {
    fn default() -> Self {
        Options {
            lambda: Lambda::Medium,
            schedule: Schedule::Default,
            gap: 0.01,
            max_iterations: 20_000,
            normalization: Normalization::UnitSquare,
            energy: Energy::Nuclear,
            reweighting: 0,
            tie_break: 0.01,
            bend_radius: None,
            flatness: None,
            crease_radius: None,
            crease_passes: 2,
            border: Border::default(),
        }
    }
}

impl Options {
    /// Weight of the fidelity term; default [`Lambda::Medium`].
    pub fn lambda(mut self, lambda: impl Into<Lambda>) -> Self {
        self.lambda = lambda.into();
        self
    }

    /// Default [`Schedule::Default`].
    pub fn schedule(mut self, schedule: Schedule) -> Self {
        self.schedule = schedule;
        self
    }

    /// Certified relative duality gap at which [`Schedule::Default`] stops,
    /// between 0 and 1; default 0.01.
    pub fn gap(mut self, gap: f64) -> Self {
        self.gap = gap;
        self
    }

    /// Most ADMM iterations, at least 1; default 20 000.
    pub fn max_iterations(mut self, max_iterations: usize) -> Self {
        self.max_iterations = max_iterations;
        self
    }

    /// Default [`Normalization::UnitSquare`].
    pub fn normalization(mut self, normalization: Normalization) -> Self {
        self.normalization = normalization;
        self
    }

    /// Default [`Energy::Nuclear`].
    pub fn energy(mut self, energy: Energy) -> Self {
        self.energy = energy;
        self
    }

    /// Passes after the first solve in which each vertex's norm is weighted by
    /// one over its size around there in the solution before, which takes away a
    /// part of the shrinkage that the energy does to large curvatures. It pays
    /// where λ is small for the noise: at 10⁴ a noisy roof comes three times
    /// closer to the truth, and a cylinder's curvature a fifth of the way; where
    /// λ is large already, noise comes back. One pass does most of it. Default
    /// 0, at most 20. The figures of the report are those of the last pass's
    /// weighted energy.
    pub fn reweighting(mut self, passes: usize) -> Self {
        self.reweighting = passes;
        self
    }

    /// Weight, in place of λ, of the squared distance from the thin plate
    /// through the constraints, at vertices that have no fidelity term of their
    /// own: without it minimisers need not be unique. Beside vertices that have
    /// one, at most λ counts. Default 0.01.
    pub fn tie_break(mut self, weight: f64) -> Self {
        self.tie_break = weight;
        self
    }

    /// For [`Energy::Huber`]: radius `1/δ` below which bends cost their size, and above which they
    /// cost their square, in normalised coordinates; default 0.1, or by [`Lambda::Auto`]. The
    /// larger, the more it is like the nuclear norm.
    pub fn bend_radius(mut self, radius: f64) -> Self {
        self.bend_radius = Some(radius);
        self
    }

    /// For [`Energy::Huber`]: the slope `α` that the cost of bends begins with, from 0 (nothing is
    /// quite flat) to 1 (the nuclear norm); default 0.3, or by [`Lambda::Auto`], and more where λ is
    /// large for the noise of the input.
    pub fn flatness(mut self, slope: f64) -> Self {
        self.flatness = Some(slope);
        self
    }

    /// For [`Energy::Huber`]: what bends more tightly than this radius `1/T` is a crease, in
    /// normalised coordinates; default 0.1, or by [`Lambda::Auto`].
    pub fn crease_radius(mut self, radius: f64) -> Self {
        self.crease_radius = Some(radius);
        self
    }

    /// For [`Energy::Huber`]: the most passes at creases after the first solve; default 2, at most
    /// 20. Passes end where they change next to nothing, and there is none where the noise of the
    /// input is too large for λ, which would make creases of it.
    pub fn crease_passes(mut self, passes: usize) -> Self {
        self.crease_passes = passes;
        self
    }

    /// What is beyond the border under [`Energy::Huber`]; default [`Border::Loaded`], which takes one of
    /// the [`Options::crease_passes`].
    pub fn border(mut self, border: Border) -> Self {
        self.border = border;
        self
    }

    /// Whether every option is within its range.
    ///
    /// # Errors
    /// [`Error::Option`] with the name of the first that is not.
    pub fn validate(&self) -> Result<()> {
        if !LAMBDAS.contains(&self.lambda.value()) {
            return Err(Error::option(
                "lambda",
                format!("{:e}", self.lambda.value()),
                "must lie between 1e-12 and 1e15",
            ));
        }
        if !(self.gap > 0.0 && self.gap < 1.0) {
            return Err(Error::option(
                "gap",
                self.gap,
                "must lie between 0 and 1, both excluded",
            ));
        }
        if self.reweighting > MOST_PASSES {
            return Err(Error::option(
                "reweighting",
                self.reweighting,
                "must be at most 20",
            ));
        }
        if !LAMBDAS.contains(&self.tie_break) {
            return Err(Error::option(
                "tie_break",
                format!("{:e}", self.tie_break),
                "must lie between 1e-12 and 1e15",
            ));
        }
        for (name, radius) in [
            ("bend_radius", self.bend_radius),
            ("crease_radius", self.crease_radius),
        ] {
            if radius.is_some_and(|radius| !RADII.contains(&radius)) {
                return Err(Error::option(
                    name,
                    format!("{:e}", radius.unwrap_or_default()),
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
        if self.crease_passes > MOST_PASSES {
            return Err(Error::option(
                "crease_passes",
                self.crease_passes,
                "must be at most 20",
            ));
        }
        if self.energy == Energy::Huber && self.reweighting > 0 {
            return Err(Error::option(
                "reweighting",
                self.reweighting,
                "must be 0 for the energy huber, which has passes at creases of its own",
            ));
        }
        if self.max_iterations == 0 {
            return Err(Error::option("max_iterations", 0, "must be at least 1"));
        }
        Ok(())
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

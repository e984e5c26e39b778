//! Options of a solve, with their defaults.

mod energy;
mod huber;
mod lambda;
mod ranges;
mod tolerance;

pub use energy::{Border, Energy, Schedule};
pub(crate) use huber::HuberOptions;
pub use lambda::Lambda;
pub(crate) use ranges::LAMBDA_RANGE;
pub use tolerance::Tolerance;

use crate::heights::normalization::Normalization;

/// Default of [`Options::gap`], the relative duality gap at which a solve stops.
pub(crate) const DEFAULT_GAP: f64 = 0.01;

/// Default of [`Options::tie_break`], the weight that holds free vertices.
const DEFAULT_TIE_BREAK: f64 = 0.01;

/// Default of [`Options::crease_passes`], the maximum number of crease passes.
pub(crate) const DEFAULT_CREASE_PASSES: usize = 2;

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
    pub(crate) max_iterations: Option<usize>,
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
            max_iterations: None,
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

    /// Sets the maximum number of ADMM iterations, at least 1; default 20 000, and 400 of these on the finest lattice for a gap that
    /// is not below the default, so that no input takes far longer than others of its size.
    pub fn max_iterations(mut self, max_iterations: usize) -> Self {
        self.max_iterations = Some(max_iterations);
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
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Error;

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

//! Patterns of one input at several λ and sizes of patches, to choose from.
//!
//! [`explore`] tries them from the surface that is nearest to the input to the plainest one, and with smaller
//! patches before larger ones. So the first plan with few enough sheets is the finest ([`finest`]).
//!
//! ```
//! use developable::explore::{ExploreOptions, explore, finest};
//! use developable::{Heightfield, Lattice};
//! # fn main() -> developable::Result<()> {
//! // A folded card with a ripple: too fine for a sheet at a large λ, gone at a small one.
//! let card = Heightfield::from_fn(Lattice::new(24, 24, 1.0 / 24.0)?, |x, y| {
//!     -0.5 * (x - 0.52).abs() + 1e-3 * (40.0 * x).sin() * (40.0 * y).sin()
//! })?;
//! let options = ExploreOptions { lambdas: vec![1e6, 1e4], smallest: vec![0.02], ..Default::default() };
//! for plan in explore(card.clone(), &options)? {
//!     let plan = plan?;
//!     let Ok(found) = &plan.outcome else { continue }; // else: why nothing lays it flat
//!     let told = &found.drawing.summary;
//!     println!("{} {} {} {} {}", plan.lambda, told.sheets, told.folds, told.cut_length, told.strain);
//! }
//! let plan = finest(explore(card, &options)?, 1)?.expect("a card is one sheet");
//! assert_eq!(plan.sheets(), Some(1));
//! # Ok(())
//! # }
//! ```

use std::vec::IntoIter;

use super::drawing::{Drawing, DrawingOptions};
use super::pattern::{Pattern, PatternOptions, pattern};
use crate::error::{Error, Result};
use crate::fit::component_solver::Status;
use crate::fit::input::Input;
use crate::fit::options::Options;
use crate::fit::solver::Solver;
use crate::heights::heightfield::Heightfield;
use crate::shape::analysis::Deviation;
use crate::shape::patches::{PatchOptions, Patches};
use web_time::Instant;

/// λ to try by default: half-decades from a surface near to the input to a plain one.
const LAMBDAS: [f64; 6] = [1e7, 3e6, 1e6, 3e5, 1e5, 3e4];

/// Minimum sizes of patches to try by default, as shares of all vertices: a factor of four from one to the next.
const SMALLEST: [f64; 3] = [0.005, 0.02, 0.08];

/// λ to try of a mesh by default, as shares of the λ that its noise asks for.
const MESH_LAMBDA_SHARES: [f64; 4] = [1.0, 0.3, 0.1, 0.03];

/// What is tried, and how.
#[derive(Debug, Clone, PartialEq)]
pub struct ExploreOptions {
    /// λ to try, in any order. Default: 1e7, 3e6, 1e6, 3e5, 1e5 and 3e4.
    pub lambdas: Vec<f64>,
    /// [Sizes that patches have at least](PatchOptions::smallest) to try, in any order. Default: 0.005, 0.02 and 0.08.
    pub smallest: Vec<f64>,
    /// Options of the solves, whose λ is replaced. Default: [`Options::paper`], whose nuclear norm makes few large
    /// sheets.
    pub solver: Options,
    /// Of the patches; their smallest size does not count.
    pub patches: PatchOptions,
    /// Of the sheets.
    pub pattern: PatternOptions,
    /// Of the drawings.
    pub drawing: DrawingOptions,
}

impl Default for ExploreOptions {
    fn default() -> Self {
        ExploreOptions {
            lambdas: LAMBDAS.into(),
            smallest: SMALLEST.into(),
            solver: Options::paper(),
            patches: PatchOptions::default(),
            pattern: PatternOptions::default(),
            drawing: DrawingOptions::default(),
        }
    }
}

impl ExploreOptions {
    /// Default options for a mesh, from the λ that its noise asks for.
    pub fn for_mesh(lambda: f64) -> Self {
        ExploreOptions {
            lambdas: MESH_LAMBDA_SHARES.map(|share| share * lambda).into(),
            ..Default::default()
        }
    }

    /// These options with what is tried in order: larger λ, and smaller patches, first.
    pub fn in_order(mut self) -> Self {
        self.lambdas.sort_by(|a, b| b.total_cmp(a));
        self.smallest.sort_by(f64::total_cmp);
        self
    }
}

/// One way to make a pattern of an input.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Plan {
    /// The surface's λ.
    pub lambda: f64,
    /// The size that patches have at least, as a share of all vertices.
    pub smallest: f64,
    /// Of the surface from the input: root of the mean square, in the input's units.
    pub distance: f64,
    /// What solve and pattern took, in seconds; the solve counts for each plan of its λ.
    pub seconds: f64,
    /// The pattern, or [`Error::NotFlat`]: a part that no cut lays flat within the limits, and where it is.
    pub outcome: Result<Found>,
}

/// The pattern of a plan.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Found {
    /// Its sheets.
    pub pattern: Pattern,
    /// As it is drawn; its `summary` has sheets, folds, lengths of cuts and strain.
    pub drawing: Drawing,
}

impl Plan {
    /// How many sheets it takes, if it lies flat.
    pub fn sheets(&self) -> Option<usize> {
        let found = self.outcome.as_ref().ok()?;
        Some(found.pattern.sheets.len())
    }
}

/// The plans of an input: those nearest to it first. Each is made when it is asked for, so that who calls may
/// stop at any of them. After an error there is none.
#[derive(Debug, Clone)]
pub struct Plans {
    input: Heightfield,
    solver: Solver,
    options: ExploreOptions,
    lambdas: IntoIter<f64>,
    smallest: IntoIter<f64>,
    /// The surface that patterns are made of at present.
    surface: Option<Fitted>,
}

#[derive(Debug, Clone)]
struct Fitted {
    lambda: f64,
    surface: Heightfield,
    distance: f64,
    seconds: f64,
}

/// Makes patterns of an input at several λ and sizes of patches: with smaller λ, and with larger patches, later.
///
/// Costs one solve for each λ, which starts from the last one, and a [`pattern`] for each plan.
///
/// # Errors
/// [`Error::Option`] if an option is out of range or nothing is to be tried, and what [`Solver::new`] has to say. The plans'
/// errors are those of [`Solver::advance`], [`Patches::new`], [`pattern`], except for what no cut makes flat, and
/// [`Drawing::new`].
pub fn explore(input: impl Into<Input>, options: &ExploreOptions) -> Result<Plans> {
    let options = options.clone().in_order();
    let empty = |name| {
        Err(Error::option(
            name,
            "empty",
            "must have at least one number",
        ))
    };
    let Some(first) = options.lambdas.first() else {
        return empty("lambdas");
    };
    if options.smallest.is_empty() {
        return empty("smallest");
    }
    let input = input.into();
    Ok(Plans {
        input: input.field().clone(),
        solver: Solver::new(input, &options.solver.lambda(*first))?,
        lambdas: options.lambdas.clone().into_iter(),
        smallest: Vec::new().into_iter(),
        surface: None,
        options,
    })
}

/// The first of some plans with at most as many sheets: of those that [`explore`] makes the one nearest to the
/// input. Makes none after it.
///
/// # Errors
/// The first error among the plans before.
pub fn finest(
    plans: impl IntoIterator<Item = Result<Plan>>,
    sheets: usize,
) -> Result<Option<Plan>> {
    let few = |plan: &Plan| plan.sheets().is_some_and(|count| count <= sheets);
    let mut plans = plans.into_iter();
    plans
        .find(|plan| plan.as_ref().map_or(true, few))
        .transpose()
}

impl Plans {
    fn advance(&mut self) -> Result<Option<Plan>> {
        let smallest = loop {
            match self.smallest.next() {
                Some(smallest) => break smallest,
                None => match self.lambdas.next() {
                    Some(lambda) => self.solve(lambda)?,
                    None => return Ok(None),
                },
            }
        };
        let Some(fitted) = &self.surface else {
            return Ok(None);
        };
        let begun = Instant::now();
        let outcome = match self.found(&fitted.surface, smallest) {
            Err(error) if !matches!(error, Error::NotFlat { .. }) => return Err(error),
            outcome => outcome,
        };
        Ok(Some(Plan {
            lambda: fitted.lambda,
            smallest,
            distance: fitted.distance,
            seconds: fitted.seconds + begun.elapsed().as_secs_f64(),
            outcome,
        }))
    }

    /// The surface of another λ, from the one before.
    fn solve(&mut self, lambda: f64) -> Result<()> {
        let begun = Instant::now();
        self.solver.restart(&self.options.solver.lambda(lambda))?;
        while self.solver.advance(usize::MAX)? == Status::Running {}
        let surface = self.solver.surface()?.into_heightfield();
        let distance = Deviation::between(&surface, &self.input)?.rms;
        self.surface = Some(Fitted {
            lambda,
            surface,
            distance,
            seconds: begun.elapsed().as_secs_f64(),
        });
        self.smallest = self.options.smallest.clone().into_iter();
        Ok(())
    }

    fn found(&self, surface: &Heightfield, smallest: f64) -> Result<Found> {
        let ExploreOptions {
            patches,
            pattern: sheets,
            drawing,
            ..
        } = &self.options;
        let patches = Patches::new(surface, &patches.smallest(smallest))?;
        let pattern = pattern(surface, &patches, sheets)?;
        let drawn = Drawing::new(&pattern.sheets, drawing)?;
        Ok(Found {
            drawing: drawn.missing(&pattern.missing, drawing.scale),
            pattern,
        })
    }
}

impl Iterator for Plans {
    type Item = Result<Plan>;

    fn next(&mut self) -> Option<Self::Item> {
        let next = self.advance().transpose();
        if matches!(next, Some(Err(_))) {
            self.smallest = Vec::new().into_iter();
            self.lambdas = Vec::new().into_iter();
        }
        next
    }
}

//! Patterns of one input at several λ and sizes of patches, to choose from.
//!
//! [`explore`] begins with the largest λ, whose surface is nearest to the input, and the smallest patches. So the
//! first plan with few enough sheets has the most detail ([`finest`]).
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

/// Default values of λ, the weight of the fidelity, to try: two per decade, from a surface near to the input to one
/// with little detail.
const DEFAULT_LAMBDAS: [f64; 6] = [1e7, 3e6, 1e6, 3e5, 1e5, 3e4];

/// Default minimum sizes of patches to try, as shares of all vertices.
const DEFAULT_MIN_PATCH_SHARES: [f64; 3] = [0.005, 0.02, 0.08];

/// Default values of λ to try for a mesh, as multiples of the λ that suits its noise.
const MESH_LAMBDA_SHARES: [f64; 4] = [1.0, 0.3, 0.1, 0.03];

/// Options of [`explore`]: what to try, and the options of solve, patches, pattern and drawing.
#[derive(Debug, Clone, PartialEq)]
pub struct ExploreOptions {
    /// Values of λ, the weight of the fidelity, to try, in any order. Default: 1e7, 3e6, 1e6, 3e5, 1e5 and 3e4.
    pub lambdas: Vec<f64>,
    /// [Minimum sizes of patches](PatchOptions::smallest) to try, as shares of all vertices, in any order. Default:
    /// 0.005, 0.02 and 0.08.
    pub smallest: Vec<f64>,
    /// Options of the solves that fit surfaces to the input; their λ is ignored. Default: [`Options::paper`], whose
    /// nuclear norm makes few large sheets.
    pub solver: Options,
    /// Options of the segmentation of a surface into patches; their minimum size is ignored.
    pub patches: PatchOptions,
    /// Options of the pattern, which cuts a surface into flat sheets.
    pub pattern: PatternOptions,
    /// Options of the drawing of the sheets.
    pub drawing: DrawingOptions,
}

impl Default for ExploreOptions {
    fn default() -> Self {
        ExploreOptions {
            lambdas: DEFAULT_LAMBDAS.into(),
            smallest: DEFAULT_MIN_PATCH_SHARES.into(),
            solver: Options::paper(),
            patches: PatchOptions::default(),
            pattern: PatternOptions::default(),
            drawing: DrawingOptions::default(),
        }
    }
}

impl ExploreOptions {
    /// Makes the default options for a mesh; `lambda` is the λ that suits its noise.
    pub fn for_mesh(lambda: f64) -> Self {
        ExploreOptions {
            lambdas: MESH_LAMBDA_SHARES.map(|share| share * lambda).into(),
            ..Default::default()
        }
    }

    /// Sorts the values of λ to try from the largest to the smallest, and the minimum patch sizes from the smallest to
    /// the largest.
    pub fn in_order(mut self) -> Self {
        self.lambdas.sort_by(|a, b| b.total_cmp(a));
        self.smallest.sort_by(f64::total_cmp);
        self
    }
}

/// Attempt to make a pattern (flat sheets) of an input, with one λ and one minimum size of patches.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Plan {
    /// λ, the weight of the fidelity, of the solve that made the plan's surface.
    pub lambda: f64,
    /// Minimum size of the plan's patches, as a share of all vertices.
    pub smallest: f64,
    /// Root mean square distance of the plan's surface from the input, in the input's unit of height.
    pub distance: f64,
    /// Time for the solve and the pattern, in seconds; each plan includes the whole solve of its λ.
    pub seconds: f64,
    /// The pattern, or [`Error::NotFlat`] with the place of a part that no cut lays flat within the strain limits.
    pub outcome: Result<Found>,
}

/// Pattern of a plan, with the drawing of its sheets.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Found {
    /// Pattern: the flat sheets that the surface is cut into.
    pub pattern: Pattern,
    /// Drawing of the sheets; its `summary` has the number of sheets and folds, the length of cuts and the strain.
    pub drawing: Drawing,
}

impl Plan {
    /// Number of sheets of the plan's pattern, or `None` if the plan has no pattern.
    pub fn sheets(&self) -> Option<usize> {
        let found = self.outcome.as_ref().ok()?;
        Some(found.pattern.sheets.len())
    }
}

/// Iterator over the patterns of an input at several λ and minimum patch sizes, those nearest to the input first. Each
/// plan is computed when it is asked for, so that a caller may stop at any of them. After an error there are no further
/// plans.
#[derive(Debug, Clone)]
pub struct Plans {
    input: Heightfield,
    solver: Solver,
    options: ExploreOptions,
    lambdas: IntoIter<f64>,
    smallest: IntoIter<f64>,
    /// Surface fitted with the current λ; `None` before the first solve.
    surface: Option<Fitted>,
}

#[derive(Debug, Clone)]
struct Fitted {
    lambda: f64,
    surface: Heightfield,
    distance: f64,
    seconds: f64,
}

/// Makes patterns of an input for each pair of λ and minimum patch size; larger λ, and smaller patches, come first.
///
/// Cost: one solve for each λ, with a warm start from the one before, and a [`pattern`] for each plan.
///
/// # Errors
/// [`Error::Option`] if an option is out of range or a list of what to try is empty, and the errors of
/// [`Solver::new`]. A plan's errors are those of [`Solver::advance`], [`Patches::new`], [`pattern`] and
/// [`Drawing::new`]; [`Error::NotFlat`] is its outcome instead.
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

/// Returns the first plan with at most `sheets` sheets: of the plans of [`explore`] the one nearest to the input. Later
/// plans are not computed; `None` if no plan has so few sheets.
///
/// # Errors
/// The first error among the plans up to that one.
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

    /// Fits the surface of another λ, with a warm start from the surface before, and starts again with the first patch
    /// size.
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

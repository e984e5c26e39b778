//! What to try for patterns of one input, to choose from: several λ and sizes of patches.
//!
//! Trials begin with the largest λ, whose surface is nearest to the input, and the smallest patches. So the first pattern with
//! few enough sheets has the most detail. A program makes one fit for each λ, with a warm start from the one before, and one
//! pattern for each size of patches:
//!
//! ```
//! use developable::explore::Trials;
//! use developable::patches::{PatchOptions, Patches};
//! use developable::pattern::{PatternOptions, pattern};
//! use developable::{Error, Heightfield, Lattice, Options, Solver, Status};
//! # fn main() -> developable::Result<()> {
//! // A folded card with a ripple: too fine for a sheet at a large λ, gone at a small one.
//! let card = Heightfield::from_fn(Lattice::new(24, 24, 1.0 / 24.0)?, |x, y| {
//!     -0.5 * (x - 0.52).abs() + 1e-3 * (40.0 * x).sin() * (40.0 * y).sin()
//! })?;
//! let trials = Trials { lambdas: vec![1e4, 1e6], smallest: vec![0.02] }.in_order();
//! let mut solver = Solver::new(card, &Options::paper())?;
//! let mut fewest = usize::MAX;
//! for lambda in trials.lambdas {
//!     solver.restart(&Options::paper().lambda(lambda))?;
//!     while solver.advance(usize::MAX)? == Status::Running {}
//!     let surface = solver.surface()?.into_heightfield();
//!     for smallest in &trials.smallest {
//!         let patches = Patches::new(&surface, &PatchOptions::default().smallest(*smallest))?;
//!         match pattern(&surface, &patches, &PatternOptions::default()) {
//!             Ok(found) => fewest = fewest.min(found.sheets.len()),
//!             Err(Error::NotFlat { .. }) => {} // nothing lays this surface flat
//!             Err(error) => return Err(error),
//!         }
//!     }
//! }
//! assert_eq!(fewest, 1);
//! # Ok(())
//! # }
//! ```

/// Default values of λ, the weight of the fidelity, to try: two per decade, from a surface near to the input to one
/// with little detail.
const DEFAULT_LAMBDAS: [f64; 6] = [1e7, 3e6, 1e6, 3e5, 1e5, 3e4];

/// Default minimum sizes of patches to try, as shares of all vertices.
const DEFAULT_MIN_PATCH_SHARES: [f64; 3] = [0.005, 0.02, 0.08];

/// Default values of λ to try for a mesh, as multiples of the λ that suits its noise.
const MESH_LAMBDA_SHARES: [f64; 4] = [1.0, 0.3, 0.1, 0.03];

/// Values of λ and minimum sizes of patches to try: a pattern for each pair of them.
#[derive(Debug, Clone, PartialEq)]
pub struct Trials {
    /// Values of λ, the weight of the fidelity, to try. Default: 1e7, 3e6, 1e6, 3e5, 1e5 and 3e4.
    pub lambdas: Vec<f64>,
    /// [Minimum sizes of patches](crate::patches::PatchOptions::smallest) to try, as shares of all vertices. Default: 0.005,
    /// 0.02 and 0.08.
    pub smallest: Vec<f64>,
}

impl Default for Trials {
    fn default() -> Self {
        Trials {
            lambdas: DEFAULT_LAMBDAS.into(),
            smallest: DEFAULT_MIN_PATCH_SHARES.into(),
        }
    }
}

impl Trials {
    /// Makes the default trials for a mesh; `lambda` is the λ that suits its noise.
    pub fn for_mesh(lambda: f64) -> Self {
        Trials {
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

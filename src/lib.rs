//! Heightfields to piecewise-developable surfaces, with certified optimality.
//!
//! A heightfield (a depth scan, a height image, a curled page) is turned into a
//! surface that bends like paper: smooth developable patches that meet in
//! creases. The surface minimises
//!
//! ```text
//! P(z) = λ Σ (z − z̃)² + Σ ‖H(z)‖_*
//! ```
//!
//! over the heights `z` at the vertices of a hexagonal lattice, where `z̃` is the
//! input and `‖H‖_*` the nuclear norm (the sum of the absolute eigenvalues) of
//! the best-fit Hessian at each interior vertex. The problem is convex. It is
//! solved by ADMM from coarse lattices to fine ones, and stops when a dual bound
//! proves the result close enough to the optimum.
//!
//! ```
//! use developable::{Heightfield, Lambda, Lattice, Options, fit};
//! # fn main() -> developable::Result<()> {
//! // A noisy cylinder on a lattice of 60 by 60 vertices.
//! let lattice = Lattice::new(60, 60, 1.0)?;
//! let field = Heightfield::from_fn(lattice, |x, _| {
//!     (60.0f64.powi(2) - (x - 30.0).powi(2)).sqrt() + 0.3 * (77.0 * x).sin()
//! })?;
//! let surface = fit(&field, &Options::default().lambda(Lambda::Small))?;
//! assert!(surface.report().is_certified(0.01)); // within 1 % of the optimum, certified
//! let heights = surface.heightfield().heights(); // row by row, in the input's units
//! # assert!(heights.iter().all(|z| z.is_finite()));
//! # Ok(())
//! # }
//! ```
//!
//! # From input to result
//!
//! A [`HeightImage`] (heights on square pixels) becomes a [`Heightfield`] on a hexagonal [`Lattice`] by
//! [`HeightImage::to_lattice`]. [`fit()`], or a [`Solver`] that runs in steps, fits a [`Surface`] to it, with a
//! [`Report`]. [`Heightfield::to_image`] makes a height image of the result, and [`files`] write it.
//!
//! [`analysis`], [`patches`] and [`rulings`] describe the surface's shape, [`picture`] draws it,
//! [`unroll`](mod@unroll) lays it flat and [`dewarp`] makes a photo of it flat ([`page`] does that by a page's edges,
//! without any heights). [`pattern`], [`drawing`] and [`assembly`] make sheets to cut out, fold and put together.
//!
//! A [`Mesh`], a point cloud or the depths of a camera ([`Intrinsics::back_project`]) are sampled along a [`View`] by
//! [`sample`], which gives a heightfield; [`Triangulation`] makes a mesh of a heightfield.
//!
//! An [`Input`] may say more than heights: how far each is to be trusted, which must be met
//! exactly, where the surface is torn ([`Occlusions`]). A [`Solver`] that has stopped can be
//! restarted with other options or another input, from the answer it has.
//!
//! Wherever a height is NaN there is no data: holes, islands and outlines of any
//! shape are welcome. Lengths and heights are in one unit of the user's choice.
//!
//! # Units of λ
//!
//! The energy is computed in coordinates scaled to the unit square
//! ([`Normalization`]), and both of its terms are plain sums over vertices; so a
//! [`Lambda`] means the same surface at every size and resolution.
//!
//! # Cost
//!
//! Each iteration is linear in the number of vertices; their number grows slowly with it (from 10
//! to 50 on the finest lattice from 20 thousand to 1 million vertices of a noisy page). About 180
//! bytes for each vertex. With the feature `threads` a solve runs on all cores ([`Options::threads`]).
//! The result is the same on every run, for any number of threads and, to rounding, on every machine.
//!
//! # References
//!
//! *Paper*: Silvia Sellán, Noam Aigerman, Alec Jacobson, Developability of
//! Heightfields via Rank Minimization, ACM Transactions on Graphics 39(4), 2020,
//! doi:10.1145/3386569.3392419. *Boyd et al.*: Distributed Optimization and
//! Statistical Learning via the Alternating Direction Method of Multipliers,
//! Foundations and Trends in Machine Learning 3(1), 2011.

#![forbid(unsafe_code)]
#![warn(missing_docs)]

// The tests of `tests/native/` know the library by its name.
#[cfg(test)]
extern crate self as developable;

pub mod assembly;
/// Meshes for the tests beside the code, on every platform, and for the native ones.
#[cfg(test)]
#[path = "../tests/native/common/closed_meshes.rs"]
mod closed_meshes;
pub mod dewarp;
pub mod drawing;
mod error;
mod examples;
pub mod explore;
pub mod files;
mod fit;
mod heights;
mod lattice;
mod math;
/// Tests of the library as its users see it. They are part of this crate so that one optimised build serves them and the tests
/// beside the code, and compiling takes most of the time of both.
#[cfg(all(test, not(target_arch = "wasm32")))]
#[path = "../tests/native/main.rs"]
mod native;
pub mod page;
pub mod pattern;
pub mod picture;
pub mod progress;
mod scene;
mod shape;
pub mod unroll;

pub use error::{Error, MAX_CELLS, Result};
pub use examples::{Example, ExampleOptions, Sample};
pub use fit::component_solver::Status;
pub use fit::cylinder::{Cylinder, CylinderReport, CylinderVerdict, fit_cylinder};
pub use fit::input::Input;
pub use fit::mesh::{
    EntangledTriangle, MeshKnown, MeshOptions, MeshPass, MeshReport, MeshSolver, MeshSurface,
    Repairs, fit_mesh,
};
pub use fit::options::{Border, Energy, Lambda, Options, Schedule, Tolerance};
pub use fit::report::{
    HuberReport, LambdaChoice, LambdaReason, LevelReport, Progress, Report, Seconds, StopReason,
};
pub use fit::solver::{Solver, fit, fit_with};
pub use fit::surface::Surface;
pub use fit::threads::ThreadLimit;
pub use heights::bridging::{BridgedImage, Bridging};
pub use heights::heightfield::{HeightImage, Heightfield};
pub use heights::normalization::Normalization;
pub use heights::occlusions::{OCCLUSION_THRESHOLD, Occlusions};
pub use lattice::domain::{Domain, Role};
pub use lattice::hessian::HessianOperator;
pub use lattice::hexagonal::Lattice;
pub use lattice::stencil::Quadratic;
#[cfg(all(feature = "thread-team", not(feature = "threads")))]
pub use math::fork::{ThreadTeam, set_thread_team};
pub use math::sym2::Sym2;
pub use scene::camera::{Camera, Depth, Distortion, Intrinsics, Pose};
pub use scene::exactness::Exactness;
pub use scene::mesh::{Mesh, TexturedTriangle};
pub use scene::quarter::Turn;
pub use scene::region::{Region, resampled};
pub use scene::sampling::{Hit, Resolution, Samples, sample};
pub use scene::triangulation::Triangulation;
pub use scene::view::{Frame, View};
pub use shape::{analysis, patches, rulings};

/// Checks of arguments, for the bindings in `wasm/`, which make the same checks as the library.
#[doc(hidden)]
pub mod checks {
    pub use crate::error::{Readable, check_count, check_photo, check_shape, positive, try_filled};
    pub use crate::fit::input::check_confidence;
}

/// The README, whose example is compiled and run as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

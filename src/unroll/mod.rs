//! Unrolling: surfaces laid flat without cuts and with as little strain as possible ([paper](crate#references), Fig. 10).
//!
//! A developable surface can be unrolled without strain: each of its triangles is moved
//! into the plane rigidly. The triangles of any other surface cannot all keep their
//! shape and fit together. The layout is the one that is *as rigid as possible* (Ligang Liu, Lei
//! Zhang, Yin Xu, Craig Gotsman, Steven J. Gortler, *A Local/Global Approach to Mesh
//! Parameterization*, Computer Graphics Forum 27(5), 2008): it minimises the sum of
//! `area · ‖J − R‖²` over the triangles, where `J` is the map of a triangle to the plane and `R`
//! the rotation nearest to it. [`Unrolling::report`] tells the strain.
//!
//! ```
//! use developable::unroll::{UnrollOptions, unroll};
//! use developable::{Heightfield, Lattice};
//! # fn main() -> developable::Result<()> {
//! // Half a tube of radius 0.35, its axis along y: seen from above 0.6 wide.
//! let tube = Heightfield::from_fn(Lattice::new(60, 61, 0.01)?, |x, _| {
//!     (0.35f64.powi(2) - (x - 0.295).powi(2)).sqrt()
//! })?;
//! let sheet = unroll(&tube, &UnrollOptions::default())?;
//! let places = sheet.places();
//! // The second row, which is not shifted, on the sheet: as long as the arc.
//! let width = places[2 * 61 + 60][0] - places[2 * 61][0];
//! let arc = 0.35 * ((0.305f64 / 0.35).asin() + (0.295f64 / 0.35).asin());
//! assert!((width / arc - 1.0).abs() < 0.001);
//! assert!(sheet.report().distortion.rms < 1e-4);
//! # Ok(())
//! # }
//! ```

pub(crate) mod arap_mesh;
mod cholesky;
mod components;
mod dense_front;
pub(crate) mod distortion;
pub(crate) mod flat_triangle;
mod layout;
mod local_global;
mod nested_dissection;
mod options;
pub(crate) mod overlap;
mod sparse_rows;
mod unflip;
mod unrolling;

pub use distortion::Distortion;
pub use layout::unroll;
pub use options::UnrollOptions;
pub(crate) use unflip::border;
pub use unrolling::{UnrollReport, Unrolling};

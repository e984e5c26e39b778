//! Measures of how developable a surface is ([paper](crate#references), Sec. 5.4,
//! Fig. 25 and Table 1).
//!
//! [`Curvatures`] are fields at the lattice's vertices; a [`Summary`] has their statistics,
//! comparable between surfaces of any size; [`Deviation`] is the distance of one surface from another.
//!
//! ```
//! use developable::analysis::{Curvatures, Summary};
//! use developable::{Heightfield, Lattice};
//! # fn main() -> developable::Result<()> {
//! // A cap of a sphere of radius 2: its Gaussian curvature is 1/4 everywhere.
//! let cap = Heightfield::from_fn(Lattice::new(50, 50, 0.02)?, |x, y| {
//!     (4.0 - (x - 0.5).powi(2) - (y + 0.4).powi(2)).sqrt()
//! })?;
//! let curvatures = Curvatures::new(&cap)?;
//! let inside = curvatures.gaussian.iter().filter(|k| !k.is_nan());
//! assert!(inside.clone().count() > 2000);
//! assert!(inside.clone().all(|k| (k - 0.25).abs() < 0.002));
//! let summary = Summary::new(&cap, &curvatures, 0.1)?;
//! assert_eq!(summary.gaussian_above, 1.0); // everywhere above 0.1
//! # Ok(())
//! # }
//! ```

mod curvature;
mod mesh;
mod summary;

pub use curvature::Curvatures;
pub use mesh::MeshCurvatures;
pub use summary::{DEFAULT_GAUSSIAN_THRESHOLD, Deviation, Histogram, Summary};

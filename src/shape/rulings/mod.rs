//! Rulings: the straight lines of a developable surface ([paper](crate#references), Sec. 6).
//!
//! Along a ruling the surface does not bend: seen from above it runs along the null direction of
//! the Hessian. An estimated Hessian has no such direction, so the direction in which the surface bends least
//! around a vertex is taken: the eigenvector of the smaller eigenvalue of `Σ H²` over its
//! neighbourhood, which does not depend on signs. Where the surface is nearly a plane, or bends
//! in both directions, the direction is uncertain, and the confidence is low. [`Rulings`] are those of heightfields,
//! [`MeshRulings`] those of meshes.
//!
//! ```
//! use developable::rulings::{Rulings, TraceOptions};
//! use developable::{Heightfield, Lattice};
//! # fn main() -> developable::Result<()> {
//! // A cylinder whose axis runs at 30° to the rows.
//! let (sin, cos) = 30f64.to_radians().sin_cos();
//! let tube = Heightfield::from_fn(Lattice::new(60, 60, 0.02)?, |x, y| {
//!     (1.0 - (cos * y - sin * x + 0.7).powi(2)).sqrt()
//! })?;
//! let rulings = Rulings::new(&tube)?;
//! let [x, y] = rulings.directions()[30 * 60 + 30];
//! assert!((x * sin - y * cos).abs() < 0.01);
//! let lines = rulings.trace(&TraceOptions::default().separation(0.1))?;
//! assert!(lines.len() > 5);
//! assert!(lines.iter().all(|line| line.deviation < 0.01));
//! # Ok(())
//! # }
//! ```

mod direction;
mod heightfield;
mod heightfield_trace;
mod mesh;
mod mesh_trace;
mod options;
mod point_hash;
mod ruling;

pub use heightfield::Rulings;
pub use mesh::MeshRulings;
pub use options::TraceOptions;
pub use ruling::Ruling;

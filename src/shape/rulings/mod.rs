//! Rulings: the straight lines of a developable surface ([paper](crate#references), Sec. 6).
//!
//! Along a ruling the surface does not bend: it runs along the null direction of the second fundamental form. An
//! estimated form has no such direction, so the direction in which the surface bends least around a vertex is taken: the
//! eigenvector of the smaller eigenvalue of the sum of its squares over the neighbourhood, which does not depend on
//! signs. Where the surface is nearly a plane, or bends in both directions, the direction is uncertain, and the confidence is
//! low.
//!
//! ```
//! use developable::rulings::{Rulings, TraceOptions};
//! use developable::{Frame, Heightfield, Lattice, Triangulation};
//! # fn main() -> developable::Result<()> {
//! // A cylinder whose axis runs at 30° to the rows.
//! let (sin, cos) = 30f64.to_radians().sin_cos();
//! let tube = Heightfield::from_fn(Lattice::new(60, 60, 0.02)?, |x, y| {
//!     (1.0 - (cos * y - sin * x + 0.7).powi(2)).sqrt()
//! })?;
//! let mesh = Triangulation::new(&tube, &Frame::default())?;
//! let rulings = Rulings::new(mesh.mesh())?;
//! let (directions, _) = rulings.on_lattice(&mesh)?;
//! let [x, y] = directions[30 * 60 + 30];
//! assert!((x * sin - y * cos).abs() < 0.01);
//! let lines = rulings.trace(&TraceOptions::default().separation(0.1))?;
//! assert!(lines.len() > 5);
//! assert!(lines.iter().all(|line| line.deviation < 0.01));
//! # Ok(())
//! # }
//! ```

mod direction;
mod field;
mod options;
mod point_hash;
mod ruling;
mod trace;

pub use field::Rulings;
pub use options::TraceOptions;
pub use ruling::Ruling;

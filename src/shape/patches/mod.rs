//! Where a surface creases, and the smooth patches between the creases
//! ([paper](crate#references), Sec. 6).
//!
//! The paper floods the surface where the nuclear norm of the Hessian is low. Here what counts is
//! the angle by which the surface bends from one vertex to the next, so that a threshold means the
//! same on steep and on level ground, and two thresholds instead of one: a crease is a band of
//! vertices that bend by more than the lower one, with one among them that bends by more than the
//! higher one. What is left falls apart into patches. Then the patches grow into the bands, the
//! vertices that bend least first, until they meet on the bands' ridges; patches with hardly an
//! angle between them become one. Where creases end at the border of the surface, vertices go to the
//! patch that they lie on.
//!
//! ```
//! use developable::patches::{PatchOptions, Patches};
//! use developable::{Heightfield, Lattice};
//! # fn main() -> developable::Result<()> {
//! // Two planes that meet at an angle.
//! let roof = Heightfield::from_fn(Lattice::new(40, 40, 0.025)?, |x, _| -0.5 * (x - 0.52).abs())?;
//! let found = Patches::new(&roof, &PatchOptions::default())?;
//! assert_eq!(found.patches().len(), 2);
//! let ridge = &found.creases()[0];
//! assert!((ridge.fold - 2.0 * 0.5f64.atan()).abs() < 0.02);
//! assert!((ridge.length / (39.0 * roof.lattice().row_spacing()) - 1.0).abs() < 0.05);
//! # Ok(())
//! # }
//! ```

mod bend;
pub(crate) mod chains;
pub(crate) mod crease;
pub(crate) mod extend;
mod flood;
mod merge;
mod mesh;

use crate::error::{Error, Result, check_shape, positive, try_filled};
use crate::heights::heightfield::Heightfield;
use crate::lattice::hexagonal::Lattice;
use crate::scene::triangulation::Triangulation;
use crate::scene::view::Frame;
use bend::Bend;
pub use crease::Crease;
pub use mesh::MeshPatches;

/// Label of vertices without a height, and of those that belong to no patch.
pub const NO_PATCH: u32 = u32::MAX;

/// What counts as a crease and as a patch.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct PatchOptions {
    /// Angle, in radians, by which the surface bends from one vertex to the next on a crease.
    /// `None`: six times its median, and at least 0.035 (two degrees).
    pub bend: Option<f64>,
    /// Angle, in radians, between the surface on either side of a crease, on average along it:
    /// patches that fold by less are one. Default 0.15, about nine degrees.
    pub fold: f64,
    /// Share of all vertices that a patch has at least; smaller ones become part of those around
    /// them. Default 0.005.
    pub smallest: f64,
}

impl Default for PatchOptions {
    fn default() -> Self {
        PatchOptions {
            bend: None,
            fold: 0.15,
            smallest: 0.005,
        }
    }
}

impl PatchOptions {
    /// These options with another angle from vertex to vertex.
    pub fn bend(self, bend: f64) -> Self {
        PatchOptions {
            bend: Some(bend),
            ..self
        }
    }

    /// These options with another angle between patches.
    pub fn fold(self, fold: f64) -> Self {
        PatchOptions { fold, ..self }
    }

    /// These options with another share.
    pub fn smallest(self, smallest: f64) -> Self {
        PatchOptions { smallest, ..self }
    }
}

/// A smooth part of a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct Patch {
    /// Number of its vertices.
    pub vertices: usize,
    /// Its area on the surface, in the surface's units: each triangle's in equal parts its
    /// corners'.
    pub area: f64,
}

/// A surface cut along its creases.
#[derive(Debug, Clone, PartialEq)]
pub struct Patches {
    lattice: Lattice,
    labels: Vec<u32>,
    patches: Vec<Patch>,
    creases: Vec<Crease>,
    bend: f64,
}

impl Patches {
    /// Looks for the patches of a surface; costs `O(n log n)` for `n` vertices.
    ///
    /// # Errors
    /// [`Error::Option`](crate::Error::Option) for an angle that is not positive and finite or a
    /// share that is not from 0 to 1, [`Error::NoInterior`](crate::Error::NoInterior) if no vertex
    /// has all six neighbours, [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn new(surface: &Heightfield, options: &PatchOptions) -> Result<Self> {
        if !(0.0..=1.0).contains(&options.smallest) {
            return Err(crate::Error::option(
                "smallest",
                options.smallest,
                "must be from 0 to 1",
            ));
        }
        let bend = Bend::new(surface)?;
        let high = match options.bend {
            Some(bend) => positive("bend", bend)?,
            None => bend.usual_threshold(),
        };
        let fold = positive("fold", options.fold)?;
        let mut labels = flood::regions(surface, &bend, high)?;
        let valid = labels.iter().filter(|label| **label != NO_PATCH).count();
        let least = options.smallest * valid as f64;
        merge::merge(surface.lattice(), &bend, fold, least, &mut labels);
        extend::settle(surface, &bend, &mut labels);
        let mesh = Triangulation::new(surface, &Frame::default())?;
        let (patches, _) = sorted(&mesh, &mut labels)?;
        let creases = crease::creases(surface, &mesh, &bend, &labels);
        Ok(Patches {
            lattice: *surface.lattice(),
            labels,
            patches,
            creases,
            bend: high,
        })
    }

    /// The same for a surface with other patches, by the labels of its vertices; these are numbered anew
    /// by their areas, and the second is what number each had.
    pub(crate) fn divided(
        &self,
        surface: &Heightfield,
        mut labels: Vec<u32>,
    ) -> Result<(Self, Vec<usize>)> {
        let bend = Bend::new(surface)?;
        let mesh = Triangulation::new(surface, &Frame::default())?;
        let (patches, order) = sorted(&mesh, &mut labels)?;
        let creases = crease::creases(surface, &mesh, &bend, &labels);
        let divided = Patches {
            lattice: *surface.lattice(),
            labels,
            patches,
            creases,
            bend: self.bend,
        };
        Ok((divided, order))
    }

    /// The area of a surface.
    pub(crate) fn area(surface: &Heightfield) -> Result<f64> {
        let mesh = Triangulation::new(surface, &Frame::default())?;
        let mut labels = vec![0; surface.heights().len()];
        let (patches, _) = sorted(&mesh, &mut labels)?;
        Ok(patches.iter().map(|patch| patch.area).sum())
    }

    /// The patch of each vertex, row by row; [`NO_PATCH`] where there is none.
    pub fn labels(&self) -> &[u32] {
        &self.labels
    }

    /// Whether they may be those of a surface: its lattice, and patches where it has heights and
    /// nowhere else.
    ///
    /// # Errors
    /// [`Error::Shape`](crate::Error::Shape) or [`Error::Mismatch`](crate::Error::Mismatch).
    pub(crate) fn check_of(&self, surface: &Heightfield) -> Result<()> {
        let lattice = surface.lattice();
        check_shape("patches", lattice.rows(), lattice.cols(), self.labels.len())?;
        let differs = |i: usize| {
            *lattice != self.lattice
                || (self.labels[i] == NO_PATCH) != surface.heights()[i].is_nan()
        };
        match (0..lattice.len()).find(|i| differs(*i)) {
            None => Ok(()),
            Some(i) => Err(Error::Mismatch {
                what: "patches",
                row: i / lattice.cols(),
                col: i % lattice.cols(),
            }),
        }
    }

    /// The patches, that with the largest area first.
    pub fn patches(&self) -> &[Patch] {
        &self.patches
    }

    /// The creases between them.
    pub fn creases(&self) -> &[Crease] {
        &self.creases
    }

    /// The angle that counted as a crease, in radians from one vertex to the next.
    pub fn bend(&self) -> f64 {
        self.bend
    }
}

/// Measures the patches, and numbers them anew by their areas; the second is what number each had.
fn sorted(mesh: &Triangulation, labels: &mut [u32]) -> Result<(Vec<Patch>, Vec<usize>)> {
    let count = labels.iter().filter(|label| **label != NO_PATCH).max();
    let count = count.map_or(0, |label| *label as usize + 1);
    let blank = Patch {
        vertices: 0,
        area: 0.0,
    };
    let mut patches = try_filled("patches", count, blank)?;
    for label in labels.iter().filter(|label| **label != NO_PATCH) {
        patches[*label as usize].vertices += 1;
    }
    let unit = mesh.lattice().spacing().powi(2);
    for triangle in mesh.triangles() {
        let [x, y, z] = mesh.normal(*triangle);
        let share = 0.5 * x.hypot(y).hypot(z) * unit / 3.0;
        for vertex in triangle {
            let label = labels[mesh.vertices()[*vertex as usize] as usize];
            if label != NO_PATCH {
                patches[label as usize].area += share;
            }
        }
    }
    let mut order: Vec<usize> = (0..count).collect();
    order.sort_by(|a, b| patches[*b].area.total_cmp(&patches[*a].area));
    let mut numbers = try_filled("patches", count, 0)?;
    for (number, old) in order.iter().enumerate() {
        numbers[*old] = number as u32;
    }
    for label in labels.iter_mut().filter(|label| **label != NO_PATCH) {
        *label = numbers[*label as usize];
    }
    Ok((order.iter().map(|old| patches[*old]).collect(), order))
}

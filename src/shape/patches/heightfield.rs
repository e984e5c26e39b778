//! Divides a heightfield into patches along its creases.

use super::bend_angles::BendAngles;
use super::crease::{Crease, creases};
use super::extrapolate::reassign_border_vertices;
use super::flood_fill::segment;
use super::merge::merge_patches;
use super::options::PatchOptions;
use super::patch::{NO_PATCH, Patch};
use crate::error::{Error, Result, check_shape, positive, try_filled};
use crate::heights::heightfield::Heightfield;
use crate::lattice::hexagonal::Lattice;
use crate::scene::triangulation::Triangulation;
use crate::scene::view::Frame;

/// The patches of a heightfield and the creases between them.
#[derive(Debug, Clone, PartialEq)]
pub struct Patches {
    lattice: Lattice,
    labels: Vec<u32>,
    patches: Vec<Patch>,
    creases: Vec<Crease>,
    bend: f64,
}

impl Patches {
    /// Divides a heightfield into patches at its creases; costs `O(n log n)` for `n` vertices.
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
        let bend = BendAngles::new(surface)?;
        let high = match options.bend {
            Some(bend) => positive("bend", bend)?,
            None => bend.default_crease_bend(),
        };
        let fold = positive("fold", options.fold)?;
        let mut labels = segment(surface, &bend, high)?;
        let valid = labels.iter().filter(|label| **label != NO_PATCH).count();
        let min_vertices = options.smallest * valid as f64;
        merge_patches(surface, &bend, fold, min_vertices, &mut labels);
        reassign_border_vertices(surface, &bend, &mut labels);
        let mesh = Triangulation::new(surface, &Frame::default())?;
        let (patches, _) = number_by_area(&mesh, &mut labels)?;
        let creases = creases(surface, &mesh, &bend, &labels);
        Ok(Patches {
            lattice: *surface.lattice(),
            labels,
            patches,
            creases,
            bend: high,
        })
    }

    /// Returns the number of the patch of each vertex, row by row; [`NO_PATCH`] where there is no patch.
    pub fn labels(&self) -> &[u32] {
        &self.labels
    }

    /// Checks that patches belong to a surface: the patches are on the surface's lattice, and a vertex has a patch
    /// where it has a height.
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

    /// Returns the patches by area, the largest first.
    pub fn patches(&self) -> &[Patch] {
        &self.patches
    }

    /// Returns the creases between the patches.
    pub fn creases(&self) -> &[Crease] {
        &self.creases
    }

    /// Returns the bend angle above which a vertex counted as part of a crease, in radians from one vertex to the
    /// next.
    pub fn bend(&self) -> f64 {
        self.bend
    }
}

/// Measures the patches and numbers them by area, the largest first. Returns the patches and the former number of each.
fn number_by_area(mesh: &Triangulation, labels: &mut [u32]) -> Result<(Vec<Patch>, Vec<usize>)> {
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

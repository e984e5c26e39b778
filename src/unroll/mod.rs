//! Surfaces laid flat, with as little distortion as it goes ([paper](crate#references), Fig. 10).
//!
//! A surface that bends like paper can be unrolled without any: each of its triangles is turned
//! into the plane as it is. Of what is not quite developable, the triangles cannot all keep their
//! shape and fit together. The layout is the one that is *as rigid as possible* (Ligang Liu, Lei
//! Zhang, Yin Xu, Craig Gotsman, Steven J. Gortler, *A Local/Global Approach to Mesh
//! Parameterization*, Computer Graphics Forum 27(5), 2008): it minimises the sum of
//! `area · ‖J − R‖²` over the triangles, where `J` is the map of a triangle to the plane and `R`
//! the rotation next to it. [`Unrolling::report`] says what is left.
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

mod arap;
mod distortion;
mod grid;
pub(crate) mod joint;
mod laplacian;
mod multigrid;
pub(crate) mod overlap;
pub(crate) mod pieces;
mod repair;
mod sheets;

use crate::error::{Error, Result, positive, try_filled};
use crate::heights::heightfield::Heightfield;
use crate::lattice::hexagonal::{ROW, shift};
use crate::scene::triangulation::Triangulation;
use crate::scene::view::Frame;
use arap::Limits;
pub use distortion::Distortion;
use distortion::{distortion, stretches};
use grid::Grid;
use pieces::{Pieces, Point};

/// When to stop.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct UnrollOptions {
    /// Stop when iterations change the energy over the area, which is the mean of the squared
    /// strains, by less than this. Default 10⁻¹⁰.
    pub tolerance: f64,
    /// Most iterations. Default 500.
    pub max_iterations: usize,
}

impl Default for UnrollOptions {
    fn default() -> Self {
        UnrollOptions {
            tolerance: 1e-10,
            max_iterations: 500,
        }
    }
}

impl UnrollOptions {
    /// These options with another tolerance.
    pub fn tolerance(self, tolerance: f64) -> Self {
        UnrollOptions { tolerance, ..self }
    }

    /// These options with another limit.
    pub fn max_iterations(self, max_iterations: usize) -> Self {
        UnrollOptions {
            max_iterations,
            ..self
        }
    }
}

/// What came of it.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(rename_all = "camelCase")
)]
#[non_exhaustive]
pub struct UnrollReport {
    /// Connected parts of the surface, each laid flat for itself.
    pub parts: usize,
    /// Local and global steps.
    pub iterations: usize,
    /// Energy over area: the mean of the squared strains.
    pub energy: f64,
    /// How much the last iteration changed that.
    pub change: f64,
    /// Area of the surface, in its own units.
    pub area: f64,
    /// Of the layout: 0 for what can be unrolled.
    pub distortion: Distortion,
    /// The same for the view from above: how far from flat the surface was to begin with.
    pub plan: Distortion,
    /// Pairs of edges on the border of the layout that cross: 0 where it does not overlap.
    pub crossings: usize,
}

/// A surface laid flat.
///
/// Each connected part lies upright where it is seen from above, as nearly as it goes. Parts may
/// come to lie on each other.
#[derive(Debug, Clone, PartialEq)]
pub struct Unrolling {
    mesh: Triangulation,
    places: Vec<[f64; 2]>,
    parts: Vec<u32>,
    stretches: Vec<[f64; 2]>,
    overlaps: Vec<[[u32; 2]; 2]>,
    report: UnrollReport,
}

impl Unrolling {
    /// The surface, as triangles.
    pub fn mesh(&self) -> &Triangulation {
        &self.mesh
    }

    pub(crate) fn into_mesh(self) -> Triangulation {
        self.mesh
    }

    /// Where each vertex of the mesh lies on the plane, in the surface's units.
    pub fn places(&self) -> &[[f64; 2]] {
        &self.places
    }

    /// The connected part of each vertex of the mesh; 0 is that with the most vertices.
    pub fn parts(&self) -> &[u32] {
        &self.parts
    }

    /// For each triangle the singular values `σ₁ ≥ σ₂` of its map to the plane, both 1 where it is
    /// rigid: `σ₁σ₂` is the change of area, `σ₁/σ₂` that of angles. `σ₂` is negative where the
    /// triangle lies upside down.
    pub fn stretches(&self) -> &[[f64; 2]] {
        &self.stretches
    }

    /// Pairs of edges on the border, by the mesh's vertices, that cross.
    pub fn overlaps(&self) -> &[[[u32; 2]; 2]] {
        &self.overlaps
    }

    /// How well it went.
    pub fn report(&self) -> &UnrollReport {
        &self.report
    }
}

/// Lays a surface flat.
///
/// Costs `O(vertices)`, some tens of iterations, each linear; 300 bytes for each vertex. The same
/// on every run.
///
/// # Errors
/// [`Error::Option`] unless the tolerance is positive and finite, [`Error::Unsupported`] without
/// any whole triangle, [`Error::Overflow`] for heights out of all proportion to the spacing,
/// [`Error::OutOfMemory`].
pub fn unroll(surface: &Heightfield, options: &UnrollOptions) -> Result<Unrolling> {
    let mesh = Triangulation::new(surface, &Frame::default())?;
    unroll_mesh(mesh, options, None)
}

/// The same for some of a surface's triangles; one whose strain (root of the mean square) will stay
/// well above a limit is given up early.
pub(crate) fn unroll_mesh(
    mesh: Triangulation,
    options: &UnrollOptions,
    limit: Option<f64>,
) -> Result<Unrolling> {
    let limits = Limits {
        tolerance: positive("tolerance", options.tolerance)?,
        iterations: options.max_iterations,
        // Of the two principal strains the energy has the sum of the squares.
        hopeless: limit.map_or(f64::INFINITY, |limit| 2.0 * limit * limit),
    };
    let lattice = *mesh.lattice();
    let spacing = lattice.spacing();
    let grid = Grid::new(lattice.rows(), lattice.cols());
    let cell = |index: u32| {
        let index = index as usize;
        grid.cell(index / lattice.cols(), index % lattice.cols())
    };
    let mut heights = try_filled("unrolling", grid.cells(), f64::NAN)?;
    for (v, [_, _, z]) in mesh.vertices().iter().zip(mesh.positions()) {
        heights[cell(*v)] = z / spacing;
    }
    // A triangle by its upper left corner, and whether it lies below that or beside it.
    let mut wanted = try_filled("unrolling", grid.cells(), [false; 2])?;
    for [a, b, _] in mesh.triangles() {
        let [first, second] = [a, b].map(|v| cell(mesh.vertices()[*v as usize]));
        let offsets = grid.offsets(grid.vertex(first).0);
        let below = first.wrapping_add_signed(offsets.south_west) == second;
        wanted[first][usize::from(!below)] = true;
    }
    let pieces = Pieces::new(grid, &heights, |(cell, side)| wanted[cell][side]).map_err(
        |error| match error {
            Error::Overflow { .. } => Error::Overflow { spacing },
            other => other,
        },
    )?;
    let mut places = plan(grid)?;
    let from_above = distortion(&pieces, pieces.names(), &places);
    let mut course = arap::relax(&pieces, &mut places, limits)?;
    if repair::unflip(&pieces, &mut places)? {
        let mut pull = try_filled("unrolling", places.len(), Point::default())?;
        course.energy = pieces.pull(&places, &mut pull) / pieces.area;
    }
    let mut values = try_filled("unrolling", mesh.triangles().len(), [0.0; 2])?;
    for (value, name) in values.iter_mut().zip(pieces.names()) {
        *value = stretches(&pieces, name, &places);
    }
    let layout = distortion(&pieces, pieces.names(), &places);

    let (parts, count) = sheets::parts(&mesh)?;
    let mut flat: Vec<Point> = try_filled("unrolling", parts.len(), Point::default())?;
    for (place, v) in flat.iter_mut().zip(mesh.vertices()) {
        *place = places[cell(*v)] * spacing;
    }
    sheets::lay_upright(&mesh, &parts, count, &mut flat);

    let mut numbers = try_filled("unrolling", grid.cells(), 0u32)?;
    for (number, v) in mesh.vertices().iter().enumerate() {
        numbers[cell(*v)] = number as u32;
    }
    let border: Vec<[u32; 2]> = (pieces.border())
        .map(|edge| edge.map(|cell| numbers[cell]))
        .collect();
    let overlaps: Vec<[[u32; 2]; 2]> = (overlap::crossings(&flat, &border).into_iter())
        .map(|pair| pair.map(|edge| border[edge]))
        .collect();
    let report = UnrollReport {
        parts: count,
        iterations: course.iterations,
        energy: course.energy,
        change: course.change,
        area: pieces.area * spacing * spacing,
        distortion: layout,
        plan: from_above,
        crossings: overlaps.len(),
    };
    Ok(Unrolling {
        mesh,
        places: flat.iter().map(|place| [place.re, place.im]).collect(),
        parts,
        stretches: values,
        overlaps,
        report,
    })
}

/// Where the vertices are seen from above, in units of the spacing.
fn plan(grid: Grid) -> Result<Vec<Point>> {
    let mut places = try_filled("unrolling", grid.cells(), Point::default())?;
    for row in 0..grid.rows() {
        let shift = shift(row);
        for (col, cell) in grid.row(row).enumerate() {
            places[cell] = Point::new(col as f64 - shift, -(row as f64) * ROW);
        }
    }
    Ok(places)
}

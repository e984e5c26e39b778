//! Heightfields laid flat.

use super::arap::{self, Limits};
use super::distortion::{distortion, stretches};
use super::grid::Grid;
use super::options::UnrollOptions;
use super::pieces::{Pieces, Point};
use super::unrolling::{UnrollReport, Unrolling};
use super::{overlap, repair, sheets};
use crate::error::{Error, Result, positive, try_filled};
use crate::heights::heightfield::Heightfield;
use crate::lattice::hexagonal::{ROW, shift};
use crate::scene::triangulation::Triangulation;
use crate::scene::view::Frame;

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
pub(super) fn plan(grid: Grid) -> Result<Vec<Point>> {
    let mut places = try_filled("unrolling", grid.cells(), Point::default())?;
    for row in 0..grid.rows() {
        let shift = shift(row);
        for (col, cell) in grid.row(row).enumerate() {
            places[cell] = Point::new(col as f64 - shift, -(row as f64) * ROW);
        }
    }
    Ok(places)
}

//! Heightfields laid flat.

use super::arap_lattice::{Limits, minimise_energy};
use super::components::{align_to_plan, components};
use super::distortion::{distortion, singular_values};
use super::flat_triangle::Point;
use super::lattice_triangles::LatticeTriangles;
use super::options::UnrollOptions;
use super::overlap::crossings;
use super::padded_lattice::PaddedLattice;
use super::unflip::unflip_triangles;
use super::unrolling::{UnrollReport, Unrolling};
use crate::error::{Error, Result, positive, try_filled};
use crate::heights::heightfield::Heightfield;
use crate::lattice::hexagonal::{ROW_SPACING, shift};
use crate::scene::triangulation::Triangulation;
use crate::scene::view::Frame;

/// Maximum change of the energy in one iteration, as a share of it, at which a layout has converged whose strain is below
/// the limit that it is compared with: further iterations would only lower a strain that is small enough.
const RELATIVE_ENERGY_TOLERANCE: f64 = 1e-4;

/// Lays a surface flat with as little strain as possible.
///
/// Costs tens of iterations of `O(vertices)`, and 300 bytes for each vertex. Deterministic.
///
/// # Errors
/// [`Error::Option`] unless the tolerance is positive and finite, [`Error::Unsupported`] if no triangle has
/// heights at all corners, [`Error::Overflow`] if heights are too large for the spacing,
/// [`Error::OutOfMemory`].
pub fn unroll(surface: &Heightfield, options: &UnrollOptions) -> Result<Unrolling> {
    let mesh = Triangulation::new(surface, &Frame::default())?;
    unroll_mesh(mesh, options, None)
}

/// Lays some triangles of a surface flat. If there is a limit, a layout whose root mean square strain will stay well
/// above it is given up early.
///
/// # Errors
/// Those of [`unroll`].
pub(crate) fn unroll_mesh(
    mesh: Triangulation,
    options: &UnrollOptions,
    limit: Option<f64>,
) -> Result<Unrolling> {
    let limits = Limits {
        tolerance: positive("tolerance", options.tolerance)?,
        max_iterations: options.max_iterations,
        // The energy is the sum of both squared principal strains.
        wanted_energy: limit.map_or(f64::INFINITY, |limit| 2.0 * limit * limit),
        relative_tolerance: limit.map_or(0.0, |_| RELATIVE_ENERGY_TOLERANCE),
    };
    let lattice = *mesh.lattice();
    let spacing = lattice.spacing();
    let grid = PaddedLattice::new(lattice.rows(), lattice.cols());
    let cell = |index: u32| {
        let index = index as usize;
        grid.cell(index / lattice.cols(), index % lattice.cols())
    };
    let mut heights = try_filled("unrolling", grid.cells(), f64::NAN)?;
    for (v, [_, _, z]) in mesh.vertices().iter().zip(mesh.positions()) {
        heights[cell(*v)] = z / spacing;
    }
    // Each triangle is marked at its upper left corner, by whether it lies below that corner or beside it.
    let mut wanted = try_filled("unrolling", grid.cells(), [false; 2])?;
    for [a, b, _] in mesh.triangles() {
        let [first, second] = [a, b].map(|v| cell(mesh.vertices()[*v as usize]));
        let offsets = grid.offsets(grid.vertex(first).0);
        let below = first.wrapping_add_signed(offsets.south_west) == second;
        wanted[first][usize::from(!below)] = true;
    }
    let triangles = LatticeTriangles::new(grid, &heights, |(cell, side)| wanted[cell][side])
        .map_err(|error| match error {
            Error::Overflow { .. } => Error::Overflow { spacing },
            other => other,
        })?;
    let mut places = plan_positions(grid)?;
    let from_above = distortion(&triangles, triangles.ids(), &places);
    let mut iteration = minimise_energy(&triangles, &mut places, limits)?;
    if unflip_triangles(&triangles, &mut places)? {
        let mut descent = try_filled("unrolling", places.len(), Point::default())?;
        iteration.energy = triangles.energy(&places, &mut descent) / triangles.area;
    }
    let mut values = try_filled("unrolling", mesh.triangles().len(), [0.0; 2])?;
    for (value, id) in values.iter_mut().zip(triangles.ids()) {
        *value = singular_values(&triangles, id, &places);
    }
    let layout = distortion(&triangles, triangles.ids(), &places);

    let (parts, count) = components(&mesh)?;
    let mut flat: Vec<Point> = try_filled("unrolling", parts.len(), Point::default())?;
    for (place, v) in flat.iter_mut().zip(mesh.vertices()) {
        *place = places[cell(*v)] * spacing;
    }
    align_to_plan(&mesh, &parts, count, &mut flat);

    let mut numbers = try_filled("unrolling", grid.cells(), 0u32)?;
    for (number, v) in mesh.vertices().iter().enumerate() {
        numbers[cell(*v)] = number as u32;
    }
    let border: Vec<[u32; 2]> = (triangles.border())
        .map(|edge| edge.map(|cell| numbers[cell]))
        .collect();
    let overlaps: Vec<[[u32; 2]; 2]> = (crossings(&flat, &border).into_iter())
        .map(|pair| pair.map(|edge| border[edge]))
        .collect();
    let report = UnrollReport {
        parts: count,
        iterations: iteration.steps,
        energy: iteration.energy,
        change: iteration.decrease,
        area: triangles.area * spacing * spacing,
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

/// Computes the positions of the vertices in the view from above, in units of the spacing, by the cells of the
/// padded lattice.
pub(super) fn plan_positions(grid: PaddedLattice) -> Result<Vec<Point>> {
    let mut places = try_filled("unrolling", grid.cells(), Point::default())?;
    for row in 0..grid.rows() {
        let shift = shift(row);
        for (col, cell) in grid.row(row).enumerate() {
            places[cell] = Point::new(col as f64 - shift, -(row as f64) * ROW_SPACING);
        }
    }
    Ok(places)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lattice::hexagonal::Lattice;

    #[test]
    fn a_strain_below_the_limit_is_found_in_fewer_steps_to_a_hundredth() {
        // A cap of a sphere, whose strain no layout removes.
        let lattice = Lattice::new(40, 46, 1.0).unwrap();
        let cap = Heightfield::from_fn(lattice, |x, y| {
            let square = (x - 22.0).powi(2) + (y + 17.0).powi(2);
            if square > 400.0 {
                f64::NAN
            } else {
                (1600.0 - square).sqrt()
            }
        });
        let mesh = Triangulation::new(&cap.unwrap(), &Frame::default()).unwrap();
        let lay = |limit| {
            let flat = unroll_mesh(mesh.clone(), &UnrollOptions::default(), limit);
            *flat.unwrap().report()
        };
        let [exact, enough, strict] = [None, Some(0.5), Some(1e-3)].map(lay);
        assert!(enough.iterations < exact.iterations);
        assert!((enough.energy / exact.energy - 1.0).abs() < 0.01);
        // Far above the limit it is given up.
        assert!(strict.iterations < exact.iterations && strict.energy > 2e-6);
    }
}

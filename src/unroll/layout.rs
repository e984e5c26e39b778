//! Heightfields laid flat.

use super::arap_mesh::{ArapMesh, StoppingCriteria};
use super::components::{align_to_plan, components};
use super::distortion::distortion;
use super::flat_triangle::{FlatTriangle, Point};
use super::options::UnrollOptions;
use super::overlap::crossings;
use super::unflip::border;
use super::unrolling::{UnrollReport, Unrolling};
use crate::error::{Error, Result, positive};
use crate::heights::heightfield::Heightfield;
use crate::scene::triangulation::Triangulation;
use crate::scene::view::Frame;

/// Lays a surface flat with as little strain as possible.
///
/// Costs a factorisation of `O(vertices^1.5)` and tens of iterations of `O(vertices log vertices)`. Deterministic.
///
/// # Errors
/// [`Error::Option`] unless the tolerance is positive and finite, [`Error::Unsupported`] if no triangle has
/// heights at all corners, [`Error::Overflow`] if heights are too large for the spacing,
/// [`Error::OutOfMemory`].
pub fn unroll(surface: &Heightfield, options: &UnrollOptions) -> Result<Unrolling> {
    let criteria = StoppingCriteria {
        tolerance: positive("tolerance", options.tolerance)?,
        relative_tolerance: 0.0,
        target_energy: 0.0,
        hopeless_energy: f64::INFINITY,
        max_steps: options.max_iterations,
    };
    let mesh = Triangulation::new(surface, &Frame::default())?;
    let spacing = mesh.lattice().spacing();
    let triangles = (mesh.triangles().iter())
        .map(|corners| {
            let places = corners.map(|v| mesh.positions()[v as usize].map(|x| x / spacing));
            (FlatTriangle::from_points(places), *corners)
        })
        .collect::<Vec<_>>();
    // Seen from above each has an area.
    if !triangles.iter().all(|(triangle, _)| triangle.exists()) {
        return Err(Error::Overflow { spacing });
    }
    let mut places = plan(&mesh, spacing);
    let from_above = distortion(&triangles, &places);
    let mut problem = ArapMesh::new(&places, triangles)?;
    let progress = problem.lay_flat(&mut places, criteria)?;
    let (triangles, area) = (problem.triangles(), problem.area());
    let stretches = triangles
        .iter()
        .map(|(triangle, corners)| triangle.singular_values(corners.map(|v| places[v as usize])));
    let stretches = stretches.collect();
    let layout = distortion(triangles, &places);

    let (parts, count) = components(&mesh)?;
    places.iter_mut().for_each(|place| *place *= spacing);
    align_to_plan(&mesh, &parts, count, &mut places);
    let border: Vec<[u32; 2]> = border(mesh.triangles()).collect();
    let mut crossing: Vec<[usize; 2]> = crossings(&places, &border).collect();
    crossing.sort_unstable();
    let overlaps: Vec<[[u32; 2]; 2]> = (crossing.into_iter())
        .map(|pair| pair.map(|edge| border[edge]))
        .collect();
    let report = UnrollReport {
        parts: count,
        iterations: progress.steps,
        energy: progress.energy,
        change: progress.decrease,
        area: area * spacing * spacing,
        distortion: layout,
        plan: from_above,
        crossings: overlaps.len(),
    };
    Ok(Unrolling {
        mesh,
        places: places.iter().map(|place| [place.re, place.im]).collect(),
        parts,
        stretches,
        overlaps,
        report,
    })
}

/// Returns the positions of a mesh's vertices in the view from above, in units of a given length.
fn plan(mesh: &Triangulation, unit: f64) -> Vec<Point> {
    let all = mesh.positions().iter();
    all.map(|[x, y, _]| Point::new(*x, *y) / unit).collect()
}

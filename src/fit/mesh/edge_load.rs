//! Loads of bending moments on the border and the creases of a mesh, neither of which bears any by itself: see
//! [`energy::moment_load`](crate::fit::energy::moment_load).

use nalgebra::Matrix3;

use super::geometry::Frame;
use super::linearisation::Linearisation;
use super::options::MeshOptions;
use crate::error::{Result, try_filled};
use crate::fit::energy::moment_load::Rings;
use crate::math::index::NO_INDEX;
use crate::math::sym2::Sym2;

/// Loads the border, and the creases whose stencils are `known`, with the bending `moments` of the stencils inside;
/// returns whether there are any. Moments smaller than the options' flatness are ignored: they are noise on flat faces.
///
/// # Errors
/// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
pub(super) fn load_border(
    linear: &mut Linearisation,
    moments: &[Sym2],
    options: &MeshOptions,
    known: &[bool],
) -> Result<bool> {
    let vertices = &linear.vertices;
    if vertices.closed && !known.contains(&true) {
        return Ok(false);
    }
    let around = |vertex: usize| {
        vertices
            .adjacency
            .around(vertex)
            .iter()
            .map(|v| *v as usize)
    };
    let outermost = (0..vertices.len() as u32).filter(|v| match linear.about[*v as usize] {
        NO_INDEX => true,
        stencil => known[stencil as usize],
    });
    let reach = linear.problem.reach(options.bend_radius);
    let rings = Rings::new(outermost.collect(), vertices.len(), around, reach)?;
    // Moments are averaged in space, because neighbours have different frames.
    let mut spatial = try_filled("moments", vertices.len(), Matrix3::zeros())?;
    for (vertex, moment) in linear.centres.iter().zip(moments) {
        let vertex = *vertex as usize;
        spatial[vertex] = in_space(&vertices.frames[vertex], *moment);
    }
    if !rings.continue_outwards(&mut spatial, around)? {
        return Ok(false);
    }
    let centres = linear.centres.iter().map(|vertex| *vertex as usize);
    let planar: Vec<Sym2> = centres
        .map(|vertex| in_plane(&vertices.frames[vertex], &spatial[vertex]))
        .map(|moment| match moment.spectral_norm() < options.flatness {
            true => Sym2::default(),
            false => moment,
        })
        .collect();
    let (across, directions) = (vertices.len() + 1, &vertices.directions.all);
    linear.problem.load(&planar, |unknown| {
        let vertex = match unknown.checked_sub(across) {
            Some(way) => directions[way].0 as usize,
            None => unknown,
        };
        rings.contain(vertex)
    })?;
    Ok(true)
}

/// Converts a bending moment in the tangent plane of a frame to a matrix in space.
pub(super) fn in_space(frame: &Frame, moment: Sym2) -> Matrix3<f64> {
    let [xx, xy, yy] = moment.entries();
    let [a, b] = &frame.tangents;
    let mixed = a * b.transpose();
    xx * a * a.transpose() + xy * (mixed + mixed.transpose()) + yy * b * b.transpose()
}

/// Returns the part of a bending moment, a matrix in space, that is in the tangent plane of a frame.
pub(super) fn in_plane(frame: &Frame, moment: &Matrix3<f64>) -> Sym2 {
    let [a, b] = &frame.tangents;
    let on = |u: &super::geometry::Point, v: &super::geometry::Point| u.dot(&(moment * v));
    Sym2::new(on(a, a), on(a, b), on(b, b))
}

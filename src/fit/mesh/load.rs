//! Which moments load the border of a mesh: see [`energy::load`](crate::fit::energy::load).

use nalgebra::Matrix3;

use super::geometry::Frame;
use super::linear::{Linearised, NONE};
use super::topology::Topology;
use crate::error::{Result, try_filled};
use crate::fit::energy::load::Rings;
use crate::math::sym2::Sym2;

/// Loads the border with the `moments` of the stencils inside. Says whether there are any.
///
/// # Errors
/// Out of memory.
pub(super) fn load_border(
    topology: &Topology,
    linear: &mut Linearised,
    moments: &[Sym2],
    bend_radius: f64,
) -> Result<bool> {
    if topology.closed {
        return Ok(false);
    }
    let around = |vertex: usize| topology.around(vertex).iter().map(|v| *v as usize);
    let vertices = 0..topology.len() as u32;
    let outermost = vertices.filter(|v| linear.about[*v as usize] == NONE);
    let reach = linear.problem.reach(bend_radius);
    let rings = Rings::new(outermost.collect(), topology.len(), around, reach)?;
    // In space, where the frames of neighbours have something in common.
    let mut spatial = try_filled("moments", topology.len(), Matrix3::zeros())?;
    for (vertex, moment) in linear.centres.iter().zip(moments) {
        let vertex = *vertex as usize;
        spatial[vertex] = in_space(&linear.frames[vertex], *moment);
    }
    if !rings.continue_outwards(&mut spatial, around)? {
        return Ok(false);
    }
    let centres = linear.centres.iter().map(|vertex| *vertex as usize);
    let planar: Vec<Sym2> = centres
        .map(|vertex| in_plane(&linear.frames[vertex], &spatial[vertex]))
        .collect();
    linear
        .problem
        .load(&planar, |vertex| rings.are_next_to(vertex))?;
    Ok(true)
}

fn in_space(frame: &Frame, moment: Sym2) -> Matrix3<f64> {
    let [xx, xy, yy] = moment.entries();
    let [a, b] = &frame.tangents;
    let mixed = a * b.transpose();
    xx * a * a.transpose() + xy * (mixed + mixed.transpose()) + yy * b * b.transpose()
}

fn in_plane(frame: &Frame, moment: &Matrix3<f64>) -> Sym2 {
    let [a, b] = &frame.tangents;
    let on = |u: &super::geometry::Point, v: &super::geometry::Point| u.dot(&(moment * v));
    Sym2::new(on(a, a), on(a, b), on(b, b))
}

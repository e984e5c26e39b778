//! Which moments load the border of a mesh: see [`energy::load`](crate::fit::energy::load).

use nalgebra::Matrix3;

use super::geometry::Frame;
use super::linear::{Linearised, NONE};
use super::topology::Topology;
use crate::error::{Result, try_filled};
use crate::math::sym2::Sym2;

/// Loads the border with the `moments` of the stencils inside, which are averaged there and continued
/// along the shortest ways. Says whether there is a border.
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
    let reach = linear.problem.reach(bend_radius);
    let rings = rings(topology, linear, reach)?;
    let mut depth = try_filled("border", topology.len(), reach)?;
    for (ring, vertices) in rings.iter().enumerate() {
        for vertex in vertices {
            depth[*vertex as usize] = ring as u32;
        }
    }
    // In space, where the frames of neighbours have something in common.
    let mut spatial = try_filled("moments", topology.len(), Matrix3::zeros())?;
    let mut known = try_filled("moments", topology.len(), false)?;
    for (vertex, moment) in linear.centres.iter().zip(moments) {
        let vertex = *vertex as usize;
        if depth[vertex] == reach {
            spatial[vertex] = in_space(&linear.frames[vertex], *moment);
            known[vertex] = true;
        }
    }
    // Those of noise have no mean.
    for _ in 0..reach {
        let old = spatial.clone();
        for vertex in linear.centres.iter().map(|vertex| *vertex as usize) {
            if known[vertex] {
                let start = (2.0 * old[vertex], 2.0);
                let (sum, count) = sum_around(topology, vertex, &old, |other| known[other], start);
                spatial[vertex] = sum / count;
            }
        }
    }
    for ring in rings.iter().skip(1).rev() {
        for vertex in ring.iter().map(|vertex| *vertex as usize) {
            let inwards = |other: usize| known[other] && depth[other] > depth[vertex];
            let (sum, count) =
                sum_around(topology, vertex, &spatial, inwards, (Matrix3::zeros(), 0.0));
            if count > 0.0 {
                spatial[vertex] = sum / count;
                known[vertex] = true;
            }
        }
    }
    let centres = linear.centres.iter().map(|vertex| *vertex as usize);
    let planar: Vec<Sym2> = centres
        .map(|vertex| in_plane(&linear.frames[vertex], &spatial[vertex]))
        .collect();
    linear
        .problem
        .load(&planar, |vertex| depth.get(vertex).is_some_and(|d| *d <= 1))?;
    Ok(true)
}

/// The sum over those neighbours that count, and how many these are, on top of a start.
fn sum_around(
    topology: &Topology,
    vertex: usize,
    values: &[Matrix3<f64>],
    counts: impl Fn(usize) -> bool,
    start: (Matrix3<f64>, f64),
) -> (Matrix3<f64>, f64) {
    let around = topology.around(vertex).iter().map(|other| *other as usize);
    around
        .filter(|other| counts(*other))
        .fold(start, |(sum, count), other| {
            (sum + values[other], count + 1.0)
        })
}

/// The vertices without a stencil, their neighbours, and so on, up to a number of rings.
fn rings(topology: &Topology, linear: &Linearised, reach: u32) -> Result<Vec<Vec<u32>>> {
    let mut seen = try_filled("border", topology.len(), false)?;
    let mut front: Vec<u32> = (0..topology.len() as u32)
        .filter(|vertex| linear.about[*vertex as usize] == NONE)
        .collect();
    let mut rings = Vec::new();
    while !front.is_empty() && (rings.len() as u32) < reach {
        front
            .iter()
            .for_each(|vertex| seen[*vertex as usize] = true);
        let around = front
            .iter()
            .flat_map(|vertex| topology.around(*vertex as usize));
        let mut next: Vec<u32> = around
            .copied()
            .filter(|other| !seen[*other as usize])
            .collect();
        next.sort_unstable();
        next.dedup();
        rings.push(std::mem::replace(&mut front, next));
    }
    Ok(rings)
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

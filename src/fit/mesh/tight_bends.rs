//! Tight bends, told from creases by the residuals that either leaves.
//!
//! A crease pass makes a fold of every tight bend. Where the bend spans several edges the vertices are then on one side
//! of the surface together, and the means of neighbouring residuals are larger than without the pass.

use super::geometry::{Frame, Point};
use super::input::MeshInput;
use super::smooth_regions::SmoothRegions;
use super::topology::Topology;

/// Number of rings around a crease within which residuals are compared and the surface is replaced: a fold differs from
/// a bend on both sides of its line (`benches/whole.md`).
const COMPARISON_RINGS: usize = 2;

/// Minimum ratio of the squared residuals without a crease to those with it at which the crease is kept: with noise it is
/// above 0.9 at folds, however fine the mesh is, and below 0.65 at bends over four edges or more (`benches/whole.md`).
const MIN_CREASE_RESIDUAL_RATIO: f64 = 0.75;

/// Restores the surface `before` crease passes around each connected crease that explains the given positions
/// worse. Costs `O(vertices)`.
pub(super) fn restore_bends(
    given: &MeshInput,
    sides: &SmoothRegions,
    x: &mut [Point],
    before: &[Point],
    frames: &[Frame],
) {
    let topology = &given.topology;
    let [after, first] = [&*x, before].map(|x| ring_residuals(given, x, frames));
    let mut seen = vec![false; topology.len()];
    for start in 0..topology.len() {
        let crease = connected_crease(topology, sides, start, &mut seen);
        if crease.is_empty() {
            continue;
        }
        let near = topology.within_rings(crease, COMPARISON_RINGS);
        let squares = |of: &[f64]| near.iter().map(|v| of[*v as usize].powi(2)).sum::<f64>();
        if squares(&first) < MIN_CREASE_RESIDUAL_RATIO * squares(&after) {
            for vertex in near {
                x[vertex as usize] = before[vertex as usize];
            }
        }
    }
}

/// The vertices on creases that are connected with a start, if it is one and none of them was seen before.
fn connected_crease(
    topology: &Topology,
    sides: &SmoothRegions,
    start: usize,
    seen: &mut [bool],
) -> Vec<u32> {
    if seen[start] || !sides.is_on_crease(start) || !topology.inside[start] {
        return Vec::new();
    }
    seen[start] = true;
    let mut crease = vec![start as u32];
    let mut next = 0;
    while let Some(vertex) = crease.get(next) {
        next += 1;
        for other in topology.around(*vertex as usize) {
            let own = *other as usize;
            if !seen[own] && sides.is_on_crease(own) {
                seen[own] = true;
                crease.push(*other);
            }
        }
    }
    crease
}

/// Mean residual of each vertex and its neighbours: their distances from where they were given, along their normals.
fn ring_residuals(given: &MeshInput, x: &[Point], frames: &[Frame]) -> Vec<f64> {
    let residuals: Vec<f64> = (x.iter().zip(&given.noisy).zip(frames))
        .map(|((x, noisy), frame)| (noisy - x).dot(&frame.normal))
        .collect();
    let mean = |vertex: usize| {
        let ring = given.topology.around(vertex);
        let sum: f64 = ring.iter().map(|other| residuals[*other as usize]).sum();
        (residuals[vertex] + sum) / (1 + ring.len()) as f64
    };
    (0..x.len()).map(mean).collect()
}

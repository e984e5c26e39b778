//! Moves a mesh's vertices on creases to the intersection of the surfaces on either side.
//!
//! A quadratic fitted about a vertex next to a crease uses vertices on both sides, and blunts the crease by a part of
//! an edge's length. So each vertex on a crease is moved, by the smallest step, to the intersection of the
//! continuations of both sides (of all three in a corner), each found from vertices on its side alone.

use super::border_extrapolation::continue_surface;
use super::geometry::{Frame, Point, faces_away, normals};
use super::input::MeshInput;
use super::smooth_regions::{MIN_FOLD_ANGLE_RADIANS, SmoothRegions};
use super::topology::Topology;
use crate::math::symmetric_eigen::symmetric_eigen3;
use nalgebra::Matrix3;

/// Maximum step by which a vertex on a crease is moved, as a share of the mean length of the edges around it.
const MAX_SHARPENING_SHARE: f64 = 0.7;

/// Moves the vertices on creases, where smooth regions of `sides` meet, to the intersection of these regions' surfaces;
/// `rays` are the vertices' frames before, for normals that are not determined.
pub(super) fn move_crease_vertices(
    given: &MeshInput,
    sides: &SmoothRegions,
    x: &mut [Point],
    rays: &[Frame],
) {
    let topology = &given.topology;
    let old: Vec<Point> = rays.iter().map(|frame| frame.normal).collect();
    let up = normals(topology, x, Some(&old));
    let frames: Vec<Frame> = (up.iter().zip(rays))
        .map(|(normal, hint)| Frame::from_normal(*normal, hint.tangents[0]))
        .collect();
    let before = x.to_vec();
    for vertex in 0..topology.len() {
        let around = sides.around(vertex);
        if given.held[vertex] || !(2..=3).contains(&around.len()) {
            continue;
        }
        let planes: Vec<(f64, Point)> = around
            .iter()
            .filter_map(|label| plane(topology, &before, &frames, &sides.region, vertex, *label))
            .collect();
        if planes.len() < around.len() {
            continue;
        }
        let Some(step) = intersect_planes(&planes) else {
            continue;
        };
        let ring = topology.around(vertex);
        let edges = ring
            .iter()
            .map(|other| (before[*other as usize] - before[vertex]).norm());
        if step.norm() > MAX_SHARPENING_SHARE * edges.sum::<f64>() / ring.len() as f64 {
            continue;
        }
        x[vertex] = given.within_reach(vertex, before[vertex] + step);
        // A step that folds a triangle over is not made.
        let folds = |x: &[Point], t: &u32| faces_away(x, &up, &topology.triangles[*t as usize]);
        let own = sides.vertex_fans.around(vertex);
        if own.iter().any(|t| folds(x, t) && !folds(&before, t)) {
            x[vertex] = before[vertex];
        }
    }
}

/// Continues the tangent planes of one smooth region to a vertex: returns their mean height above the vertex, and their
/// mean normal. `of` has the region of each vertex, `label` is the region.
fn plane(
    topology: &Topology,
    x: &[Point],
    frames: &[Frame],
    of: &[u32],
    vertex: usize,
    label: u32,
) -> Option<(f64, Point)> {
    let mut second = Vec::new();
    let own = |other: &&u32| of[**other as usize] == label && topology.inside[**other as usize];
    topology.second_ring(vertex, &mut second);
    // Noise decreases with the number of neighbours.
    let near = topology.around(vertex).iter().chain(&second).filter(own);
    let usable = |other: usize| of[other] == label;
    let (mut rise, mut normal, mut count) = (0.0, Point::zeros(), 0.0);
    for inner in near {
        let inner = *inner as usize;
        if let Some((own, up)) =
            continue_surface(topology, x, &frames[inner], inner, usable, x[vertex])
        {
            rise += own;
            normal += up;
            count += 1.0;
        }
    }
    (count > 0.0 && normal.norm() > 0.0).then(|| (rise / count, normal.normalize()))
}

/// Returns the shortest step to the intersection of planes, each given by its height above the start and its unit
/// normal; `None` if the planes are nearly parallel.
fn intersect_planes(planes: &[(f64, Point)]) -> Option<Point> {
    let (mut matrix, mut right) = (Matrix3::zeros(), Point::zeros());
    for (rise, normal) in planes {
        matrix += normal * normal.transpose();
        right += normal * *rise;
    }
    let values = symmetric_eigen3(matrix);
    // Two planes at an angle have the eigenvalues 1 ± cos, and 0 along their line.
    let least = 1.0 - MIN_FOLD_ANGLE_RADIANS.cos();
    let known = values
        .iter()
        .take(planes.len())
        .filter(|(value, _)| *value > least);
    let mut step = Point::zeros();
    let mut count = 0;
    for (value, vector) in known {
        step += vector * (vector.dot(&right) / value);
        count += 1;
    }
    (count >= 2 && step.iter().all(|v| v.is_finite())).then_some(step)
}

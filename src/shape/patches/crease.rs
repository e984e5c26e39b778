//! Finds the creases of a heightfield: their courses, lengths and fold angles.

use std::collections::BTreeMap;

use super::bend_angles::BendAngles;
use super::patch::NO_PATCH;
use crate::heights::heightfield::Heightfield;
use crate::math::index::NO_INDEX;
use crate::scene::triangulation::Triangulation;

/// A crease: a curve along which two patches meet.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct Crease {
    /// Numbers of the patches on either side of the crease, from 0 as in the labels, the lower one first.
    pub patches: [u32; 2],
    /// Points along the crease, in the surface's units, smoothed. The crease is closed if the last point is the first.
    pub points: Vec<[f64; 3]>,
    /// Length of the crease, in the surface's units.
    pub length: f64,
    /// Fold angle, in radians: between the normals of the patches on either side, on average along the crease; 0 where
    /// the surface is smooth.
    pub fold: f64,
}

/// Number of smoothing passes of a crease's polyline: enough to remove the zigzag of the lattice's edges.
const SMOOTHING_PASSES: usize = 8;

/// A node of a crease: the midpoint of an edge between two patches, by its two vertices, the lower number first; or the
/// centre of a triangle between three patches, by its number and [`NO_INDEX`].
pub(crate) type CreaseNode = (u32, u32);

/// Finds the creases: returns the patches on either side of each crease and the nodes along it, in the order of
/// [`creases`].
pub(crate) fn crease_lines(
    mesh: &Triangulation,
    labels: &[u32],
) -> Vec<([u32; 2], Vec<CreaseNode>)> {
    let label = |vertex: u32| labels[mesh.vertices()[vertex as usize] as usize];
    // For each pair of patches the neighbours of each node.
    let mut lines: BTreeMap<[u32; 2], BTreeMap<CreaseNode, Vec<CreaseNode>>> = BTreeMap::new();
    for (number, [a, b, c]) in mesh.triangles().iter().enumerate() {
        let crossed: Vec<(u32, u32)> = [(*a, *b), (*b, *c), (*c, *a)]
            .into_iter()
            .filter(|(p, q)| label(*p) != label(*q))
            .map(|(p, q)| (p.min(q), p.max(q)))
            .collect();
        let pair = |(p, q): CreaseNode| {
            let (p, q) = (label(p), label(q));
            [p.min(q), p.max(q)]
        };
        let mut join = |patches: [u32; 2], from: CreaseNode, to: CreaseNode| {
            let line = lines.entry(patches).or_default();
            line.entry(from).or_default().push(to);
            line.entry(to).or_default().push(from);
        };
        match crossed[..] {
            [one, other] => join(pair(one), one, other),
            [_, _, _] => {
                for edge in crossed {
                    join(pair(edge), edge, (number as u32, NO_INDEX));
                }
            }
            _ => {}
        }
    }
    let mut out = Vec::new();
    for (patches, mut line) in lines {
        if patches[1] == NO_PATCH {
            continue;
        }
        while let Some(nodes) = take_polyline(&mut line) {
            out.push((patches, nodes));
        }
    }
    out
}

/// Finds the creases between the patches of a heightfield that is divided into patches.
pub(super) fn creases(
    surface: &Heightfield,
    mesh: &Triangulation,
    bend: &BendAngles,
    labels: &[u32],
) -> Vec<Crease> {
    let crease = |(patches, nodes): ([u32; 2], Vec<CreaseNode>)| {
        let points = smooth_polyline(
            nodes
                .iter()
                .map(|node| node_position(mesh, *node))
                .collect(),
        );
        let length = points.windows(2).map(|p| distance(p[0], p[1])).sum();
        let folds = nodes
            .iter()
            .filter(|(_, q)| *q != NO_INDEX)
            .filter_map(|(p, q)| {
                let ends = [p, q].map(|v| mesh.vertices()[*v as usize] as usize);
                bend.fold_angle(surface.lattice(), labels, ends)
            });
        let (sum, count) = folds.fold((0.0, 0.0), |(sum, n), fold| (sum + fold, n + 1.0));
        Crease {
            patches,
            points,
            length,
            fold: if count > 0.0 { sum / count } else { 0.0 },
        }
    };
    crease_lines(mesh, labels).into_iter().map(crease).collect()
}

/// Removes one polyline, from one end to the other or closed, from a graph of nodes.
fn take_polyline(line: &mut BTreeMap<CreaseNode, Vec<CreaseNode>>) -> Option<Vec<CreaseNode>> {
    let end = line.iter().find(|(_, joined)| joined.len() == 1);
    let mut here = *end.or_else(|| line.iter().next())?.0;
    let mut nodes = vec![here];
    while let Some(next) = line.get_mut(&here).and_then(Vec::pop) {
        if line.get(&here).is_some_and(Vec::is_empty) {
            line.remove(&here);
        }
        if let Some(back) = line.get_mut(&next) {
            if let Some(i) = back.iter().position(|node| *node == here) {
                back.swap_remove(i);
            }
            if back.is_empty() {
                line.remove(&next);
            }
        }
        nodes.push(next);
        here = next;
    }
    Some(nodes)
}

/// Computes the position of a crease's node: the midpoint of an edge, or the centre of a triangle.
fn node_position(mesh: &Triangulation, (p, q): CreaseNode) -> [f64; 3] {
    let at = |v: u32| mesh.positions()[v as usize];
    if q == NO_INDEX {
        let corners = mesh.triangles()[p as usize].map(at);
        return [0, 1, 2].map(|k| corners.iter().map(|c| c[k]).sum::<f64>() / 3.0);
    }
    let (a, b) = (at(p), at(q));
    [0, 1, 2].map(|k| 0.5 * (a[k] + b[k]))
}

/// Smooths a polyline and keeps its ends; a polyline whose last point is the first is closed.
pub(crate) fn smooth_polyline<const N: usize>(mut points: Vec<[f64; N]>) -> Vec<[f64; N]> {
    let n = points.len();
    let closed = n > 3 && points[0] == points[n - 1];
    for _ in 0..SMOOTHING_PASSES {
        let last = points.clone();
        let mean = |a: [f64; N], b: [f64; N], c: [f64; N]| {
            std::array::from_fn(|k| 0.25 * a[k] + 0.5 * b[k] + 0.25 * c[k])
        };
        for i in 1..n.saturating_sub(1) {
            points[i] = mean(last[i - 1], last[i], last[i + 1]);
        }
        if closed {
            points[0] = mean(last[n - 2], last[0], last[1]);
            points[n - 1] = points[0];
        }
    }
    points
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1]).hypot(a[2] - b[2])
}

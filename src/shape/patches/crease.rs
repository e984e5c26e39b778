//! Finds the creases of a heightfield: their courses, lengths and fold angles.

use std::collections::BTreeMap;

use super::bend_angles::BendAngles;
use super::chains::{Chain, chains};
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

/// Maximum number of smoothing passes of a crease's polyline: they halve waves of eleven edges. `benches/patterns.md` has what others
/// give.
const MAX_SMOOTHING_PASSES: usize = 128;

/// Maximum share of the longest wave along a crease's polyline that smoothing takes away.
/// `benches/patterns.md` has what others give.
const MAX_SHRINKAGE: f64 = 0.01;

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
    // For each pair of patches the pieces of the lines between them, from node to node.
    let mut pieces: BTreeMap<[u32; 2], Vec<[CreaseNode; 2]>> = BTreeMap::new();
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
        match crossed[..] {
            [one, other] => pieces.entry(pair(one)).or_default().push([one, other]),
            [_, _, _] => {
                for edge in crossed {
                    let piece = [edge, (number as u32, NO_INDEX)];
                    pieces.entry(pair(edge)).or_default().push(piece);
                }
            }
            _ => {}
        }
    }
    let mut out = Vec::new();
    for (patches, own) in pieces.iter().filter(|(patches, _)| patches[1] != NO_PATCH) {
        let mut nodes = own.as_flattened().to_vec();
        nodes.sort_unstable();
        nodes.dedup();
        let number = |node: &CreaseNode| nodes.partition_point(|other| other < node) as u32;
        let edges: Vec<[u32; 2]> = own.iter().map(|ends| ends.each_ref().map(number)).collect();
        let line = |chain: &Chain| chain.vertices.iter().map(|v| nodes[*v as usize]).collect();
        out.extend((chains(&edges, |_| false).iter()).map(|chain| (*patches, line(chain))));
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

/// Smooths a polyline and keeps its ends; a polyline whose last point is the first is closed. Zigzags of two to ten edges go, and
/// the line shrinks by a hundredth at most.
pub(crate) fn smooth_polyline<const N: usize>(points: Vec<[f64; N]>) -> Vec<[f64; N]> {
    smoothed(&points, 1, points.clone(), f64::INFINITY)
}

/// Smooths a polyline as [`smooth_polyline`] does, and waves of up to a hundred edges, too, but moves no point by more than a given
/// distance.
pub(crate) fn smooth_polyline_within<const N: usize>(
    points: &[[f64; N]],
    reach: f64,
) -> Vec<[f64; N]> {
    let steps = [8, 4, 2, 1].into_iter();
    steps.fold(points.to_vec(), |moved, step| {
        smoothed(points, step, moved, reach)
    })
}

/// Makes smoothing passes, each of which replaces a point by `(−1, 4, 10, 4, −1) / 16` of every `step`-th point around it: cubics stay as
/// they are. A point stays within a distance from where it was given.
fn smoothed<const N: usize>(
    given: &[[f64; N]],
    step: usize,
    mut points: Vec<[f64; N]>,
    reach: f64,
) -> Vec<[f64; N]> {
    let last = points.len() - 1;
    let is_closed = last > 2 && given[0] == given[last];
    // Steps of the longest wave along the line, of which a pass takes the fourth power of a sine away.
    let period = if is_closed { last } else { 2 * last } / step;
    if period < 4 {
        return points;
    }
    let loss = (std::f64::consts::PI / period as f64).sin().powi(4);
    let passes = MAX_SMOOTHING_PASSES.min((MAX_SHRINKAGE / loss) as usize);
    for _ in 0..passes {
        let before = points.clone();
        let at = |i: isize| match is_closed {
            true => before[i.rem_euclid(last as isize) as usize],
            // Beyond an end the line goes on as its reflection in that.
            false => {
                let within = i.clamp(0, last as isize);
                let mirror = before[(2 * within - i) as usize];
                std::array::from_fn(|k| match within == i {
                    true => mirror[k],
                    false => 2.0 * before[within as usize][k] - mirror[k],
                })
            }
        };
        let inner = if is_closed { 0..last } else { 1..last };
        for i in inner {
            let [a, b, c, d] = [-2, -1, 1, 2].map(|k| at(i as isize + k * step as isize));
            let way: [f64; N] = std::array::from_fn(|k| {
                (10.0 * before[i][k] + 4.0 * (b[k] + c[k]) - a[k] - d[k]) / 16.0 - given[i][k]
            });
            let length = way.iter().map(|x| x * x).sum::<f64>().sqrt();
            let share = if length > reach { reach / length } else { 1.0 };
            points[i] = std::array::from_fn(|k| given[i][k] + share * way[k]);
        }
        if is_closed {
            points[last] = points[0];
        }
    }
    points
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1]).hypot(a[2] - b[2])
}

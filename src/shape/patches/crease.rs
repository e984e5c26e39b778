//! The lines between patches: where they run, how long they are and by which angle they fold.

use std::collections::BTreeMap;

use super::bend::Bend;
use super::patch::NO_PATCH;
use crate::heights::heightfield::Heightfield;
use crate::scene::triangulation::Triangulation;

/// A line between two patches.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct Crease {
    /// The patches on either side, the lower number first.
    pub patches: [u32; 2],
    /// Its course on the surface, in the surface's units, smoothed along itself. Closed if the
    /// last point is the first.
    pub points: Vec<[f64; 3]>,
    /// Its length.
    pub length: f64,
    /// The angle between the normals of the two patches beside it, in radians, on average along
    /// it: 0 where the surface is smooth.
    pub fold: f64,
}

/// How often a line is smoothed: the lattice's zigzag goes, its course stays.
const SMOOTHING: usize = 8;

/// An edge of the lattice between two patches, by the mesh's vertices, the lower one first; or a
/// triangle between three, by its number and that of no vertex.
pub(crate) type Node = (u32, u32);

/// The nodes along each crease and the patches beside it, in the order of [`creases`].
pub(crate) fn lines(mesh: &Triangulation, labels: &[u32]) -> Vec<([u32; 2], Vec<Node>)> {
    let label = |vertex: u32| labels[mesh.vertices()[vertex as usize] as usize];
    // For each pair of patches what its nodes are joined to.
    let mut lines: BTreeMap<[u32; 2], BTreeMap<Node, Vec<Node>>> = BTreeMap::new();
    for (number, [a, b, c]) in mesh.triangles().iter().enumerate() {
        let crossed: Vec<(u32, u32)> = [(*a, *b), (*b, *c), (*c, *a)]
            .into_iter()
            .filter(|(p, q)| label(*p) != label(*q))
            .map(|(p, q)| (p.min(q), p.max(q)))
            .collect();
        let pair = |(p, q): Node| {
            let (p, q) = (label(p), label(q));
            [p.min(q), p.max(q)]
        };
        let mut join = |patches: [u32; 2], from: Node, to: Node| {
            let line = lines.entry(patches).or_default();
            line.entry(from).or_default().push(to);
            line.entry(to).or_default().push(from);
        };
        match crossed[..] {
            [one, other] => join(pair(one), one, other),
            [_, _, _] => {
                for edge in crossed {
                    join(pair(edge), edge, (number as u32, u32::MAX));
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
        while let Some(nodes) = chain(&mut line) {
            out.push((patches, nodes));
        }
    }
    out
}

pub(super) fn creases(
    surface: &Heightfield,
    mesh: &Triangulation,
    bend: &Bend,
    labels: &[u32],
) -> Vec<Crease> {
    let crease = |(patches, nodes): ([u32; 2], Vec<Node>)| {
        let points = smoothed(nodes.iter().map(|node| point(mesh, *node)).collect());
        let length = points.windows(2).map(|p| distance(p[0], p[1])).sum();
        let folds = nodes
            .iter()
            .filter(|(_, q)| *q != u32::MAX)
            .filter_map(|(p, q)| {
                let ends = [p, q].map(|v| mesh.vertices()[*v as usize] as usize);
                bend.fold(surface.lattice(), labels, ends)
            });
        let (sum, count) = folds.fold((0.0, 0.0), |(sum, n), fold| (sum + fold, n + 1.0));
        Crease {
            patches,
            points,
            length,
            fold: if count > 0.0 { sum / count } else { 0.0 },
        }
    };
    lines(mesh, labels).into_iter().map(crease).collect()
}

/// Takes one line off: from one end to the other, or around.
fn chain(line: &mut BTreeMap<Node, Vec<Node>>) -> Option<Vec<Node>> {
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

/// The middle of an edge or of a triangle.
fn point(mesh: &Triangulation, (p, q): Node) -> [f64; 3] {
    let at = |v: u32| mesh.positions()[v as usize];
    if q == u32::MAX {
        let corners = mesh.triangles()[p as usize].map(at);
        return [0, 1, 2].map(|k| corners.iter().map(|c| c[k]).sum::<f64>() / 3.0);
    }
    let (a, b) = (at(p), at(q));
    [0, 1, 2].map(|k| 0.5 * (a[k] + b[k]))
}

/// Points along a line, smoothed but for its ends; closed if the last one is the first.
pub(crate) fn smoothed<const N: usize>(mut points: Vec<[f64; N]>) -> Vec<[f64; N]> {
    let n = points.len();
    let closed = n > 3 && points[0] == points[n - 1];
    for _ in 0..SMOOTHING {
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

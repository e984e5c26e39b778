//! The triangulation of a surface seen from above, and the patches of its triangles.

use std::cell::RefCell;

use rustc_hash::{FxHashMap, FxHashSet};
use spade::{
    ConstrainedDelaunayTriangulation, HasPosition, InsertionError, Point2, Triangulation as _,
};

use super::lines::Lines;
use super::nodes::Nodes;
use crate::error::{Error, Result};
use crate::math::planar::orientation;
use crate::math::union_find::UnionFind;
use crate::shape::patches::NO_PATCH;

/// A point of the triangulation, with its number.
struct Site {
    at: [f64; 2],
    number: u32,
}

impl HasPosition for Site {
    type Scalar = f64;

    fn position(&self) -> Point2<f64> {
        Point2::new(self.at[0], self.at[1])
    }
}

/// A triangle, with the triangles on the other sides of its edges that are on no line.
pub(super) struct Triangle {
    pub corners: [u32; 3],
    neighbours: Vec<u32>,
}

/// Triangulates points seen from above, with given lines as edges. Returns all points, those of lines first, and the triangles.
pub(super) fn triangulate(
    lines: &Lines,
    inner: &[[f64; 2]],
) -> Result<(Vec<[f64; 2]>, Vec<Triangle>)> {
    let mut sites: Vec<[f64; 2]> = lines.points.iter().chain(inner).copied().collect();
    let all = (0..).zip(&sites);
    let all = all.map(|(number, at)| Site { at: *at, number });
    let edges = lines.edges.iter().map(|ends| ends.map(|v| v as usize));
    let mut crossing = Vec::new();
    let failed = |error: InsertionError| Error::Unsupported {
        format: "surface",
        reason: format!("its creases cannot be triangulated ({error})"),
    };
    let mut all = ConstrainedDelaunayTriangulation::<Site>::try_bulk_load_cdt(
        all.collect(),
        edges.collect(),
        |edge| crossing.push(edge),
    )
    .map_err(failed)?;
    if !crossing.is_empty() {
        let handles: FxHashMap<u32, _> =
            all.vertices().map(|v| (v.data().number, v.fix())).collect();
        for ends in crossing {
            let [from, to] = ends.map(|v| handles[&(v as u32)]);
            // Lines that cross, as in a narrow place, get a point in common.
            let more = RefCell::new(Vec::new());
            let first = sites.len();
            all.add_constraint_and_split(from, to, |at| {
                more.borrow_mut().push([at.x, at.y]);
                let number = (first + more.borrow().len() - 1) as u32;
                Site {
                    at: [at.x, at.y],
                    number,
                }
            });
            sites.extend(more.into_inner());
        }
    }
    let order = all.inner_faces().map(|face| face.fix()).zip(0..);
    let order: FxHashMap<_, u32> = order.collect();
    let triangles = all.inner_faces().map(|face| {
        let edges = face.adjacent_edges().into_iter();
        let open = edges.filter(|edge| !edge.is_constraint_edge());
        let others = open.filter_map(|edge| order.get(&edge.rev().face().as_inner()?.fix()));
        Triangle {
            corners: face.vertices().map(|v| v.data().number),
            neighbours: others.copied().collect(),
        }
    });
    let triangles = triangles.collect();
    Ok((sites, triangles))
}

/// Finds the patch of each triangle: that which most of the area between the same lines has; [`NO_PATCH`] to the right of the border.
pub(super) fn regions(
    nodes: &Nodes,
    lines: &Lines,
    sites: &[[f64; 2]],
    triangles: &[Triangle],
) -> Result<Vec<u32>> {
    let mut sets = UnionFind::new("pattern", triangles.len())?;
    for (number, triangle) in (0..).zip(triangles) {
        let inner = triangle.neighbours.iter();
        inner.for_each(|other| sets.union(number, *other));
    }
    let mut areas: FxHashMap<(u32, u32), f64> = FxHashMap::default();
    let mut outside: FxHashSet<u32> = FxHashSet::default();
    let roots: Vec<u32> = (0..triangles.len() as u32).map(|t| sets.find(t)).collect();
    for (root, triangle) in roots.iter().zip(triangles) {
        let corners = triangle.corners.map(|v| sites[v as usize]);
        let middle = [0, 1].map(|k| corners.iter().map(|p| p[k]).sum::<f64>() / 3.0);
        let [a, b, c] = corners;
        *areas.entry((*root, nodes.label_at(middle))).or_default() += orientation(a, b, c);
        let [a, b, c] = triangle.corners;
        let is_outer = |[from, to]: [u32; 2]| {
            lines.border.contains(&[to, from]) && !lines.border.contains(&[from, to])
        };
        if [[a, b], [b, c], [c, a]].into_iter().any(is_outer) {
            outside.insert(*root);
        }
    }
    let mut most: FxHashMap<u32, (f64, u32)> = FxHashMap::default();
    let mut areas: Vec<((u32, u32), f64)> = areas.into_iter().collect();
    areas.sort_unstable_by_key(|(key, _)| *key);
    for ((root, patch), area) in areas {
        let best = most.entry(root).or_insert((area, patch));
        if area > best.0 {
            *best = (area, patch);
        }
    }
    let patch = |root: u32| match outside.contains(&root) {
        true => NO_PATCH,
        false => most[&root].1,
    };
    Ok(roots.into_iter().map(patch).collect())
}

//! The lines around patches.

use super::{Node, SeamGraph, Segment, is_triangle};
use crate::pattern::line::meeting;
use crate::shape::patches::NO_PATCH;
use crate::unroll::border;
use crate::unroll::flat_triangle::Point;
use rustc_hash::{FxHashMap, FxHashSet};

/// Number of nodes at a seam's end over which the direction of the seam there is measured.
pub(in crate::pattern) const HEADING_NODES: usize = 6;

fn is_vertex((p, q): &Node) -> bool {
    p == q
}

impl SeamGraph {
    /// Returns the seam that a segment of the line around a patch belongs to, given by the two nodes at its ends;
    /// `None` on the surface's border.
    pub(super) fn seam_along(&self, from: Node, to: Node) -> Option<usize> {
        if is_vertex(&from) || is_vertex(&to) {
            return None;
        }
        match (is_triangle(from), is_triangle(to)) {
            (true, true) => None,
            (true, false) => self.seam_of.get(&to).copied(),
            (false, true) => self.seam_of.get(&from).copied(),
            (false, false) => self.seam_between(from, to),
        }
    }

    /// Lists the segments of the line around a patch, each with the seam that it belongs to; `None` for the surface's
    /// border.
    pub(in crate::pattern) fn border(
        &self,
        patch: u32,
    ) -> impl Iterator<Item = (Segment, Option<usize>)> {
        let pieces = self.borders[patch as usize].iter();
        pieces.map(|[from, to]| ([*from, *to], self.seam_along(*from, *to)))
    }

    /// Finds the seam of a segment between two nodes of one triangle; `None` if the nodes have no seam in common.
    pub(super) fn seam_between(&self, one: Node, other: Node) -> Option<usize> {
        let (one, other) = (self.seams_of(one), self.seams_of(other));
        let both = one
            .into_iter()
            .flatten()
            .find(|seam| other.contains(&Some(*seam)));
        both.or(one[0])
    }

    pub(super) fn add_borders(&mut self) {
        let open: FxHashSet<[u32; 2]> = border(self.mesh.triangles()).collect();
        for (number, corners) in self.mesh.triangles().iter().copied().enumerate() {
            let labels = corners.map(|v| self.labels[v as usize]);
            let junction = (number as u32, u32::MAX);
            let [a, b, c] = labels;
            let apart = a != b && b != c && c != a;
            for (k, patch) in labels.into_iter().enumerate() {
                if patch == NO_PATCH || labels[..k].contains(&patch) {
                    continue;
                }
                let mut border = Vec::new();
                let (mut exit, mut entry) = (None, None);
                for (i, from) in corners.into_iter().enumerate() {
                    let to = corners[(i + 1) % 3];
                    let [ours, theirs] = [i, (i + 1) % 3].map(|k| labels[k] == patch);
                    let edge = (from.min(to), from.max(to));
                    let ends: Segment = match (ours, theirs) {
                        (true, true) => [(from, from), (to, to)],
                        (true, false) => [(from, from), *exit.insert(edge)],
                        (false, true) => [*entry.insert(edge), (to, to)],
                        (false, false) => continue,
                    };
                    if open.contains(&[from, to]) {
                        border.push(ends);
                    }
                }
                if let (Some(exit), Some(entry)) = (exit, entry) {
                    match apart {
                        true => border.extend([[exit, junction], [junction, entry]]),
                        false => border.push([exit, entry]),
                    }
                }
                self.borders[patch as usize].extend(border);
            }
        }
    }

    /// Computes for each seam that ends at the border the distance from its last node to the border's line, which
    /// connects the midpoints of the border's edges. The distance is computed in plan (as seen from above), so that
    /// both sides of a seam get the same distance.
    pub(super) fn add_ends(&mut self) {
        let (mut after, mut before) = (FxHashMap::default(), FxHashMap::default());
        for (patch, border) in self.borders.iter().enumerate() {
            let pieces = border.iter().filter(|piece| piece.iter().any(is_vertex));
            for [from, to] in pieces {
                after.insert((*from, patch as u32), *to);
                before.insert((*to, patch as u32), *from);
            }
        }
        // Midpoint of the first border edge of a patch next to a node.
        let middle = |node: Node, patch: u32| {
            [&after, &before].into_iter().find_map(|way| {
                let first = way.get(&(node, patch))?;
                let next = way.get(&(*first, patch)).filter(|node| is_vertex(node))?;
                let [p, q] = [first, next].map(|node| self.plan(*node));
                Some(Point::new(0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1])))
            })
        };
        let mut ends = FxHashMap::default();
        for seam in self.seams.iter().filter(|seam| seam.nodes.len() > 1) {
            let last = seam.nodes.len() - 1;
            for (end, back) in [
                (0, HEADING_NODES.min(last)),
                (last, last.saturating_sub(HEADING_NODES)),
            ] {
                let node = seam.nodes[end];
                let [one, other] = seam.patches.map(|patch| middle(node, patch));
                let (Some(one), Some(other)) = (one, other) else {
                    continue;
                };
                let [end, back] = [end, back].map(|k| {
                    let [x, y] = self.plan(seam.nodes[k]);
                    Point::new(x, y)
                });
                let along = (end - back) / (end - back).norm();
                let reach =
                    meeting([back, end], [one, other]).map(|p| (along.conj() * (p - end)).re);
                if let Some(reach) = reach.filter(|reach| reach.abs() < self.spacing) {
                    ends.insert(node, reach);
                }
            }
        }
        self.ends = ends;
    }

    /// Computes the intersection of a seam with the border's line, on one of its flat patches: the seam is extended
    /// from an inner node through its last node by the distance that [`SeamGraph::add_ends`] found in plan. `nodes` and
    /// `places` hold the inner node and the last one.
    pub(in crate::pattern) fn end(&self, nodes: [Node; 2], places: [Point; 2]) -> Point {
        let [[a, b], [c, d]] = nodes.map(|node| self.plan(node));
        let long = (c - a).hypot(d - b);
        let reach = self.ends.get(&nodes[1]).copied().unwrap_or(0.0);
        match long > 0.0 {
            true => places[1] + (places[1] - places[0]) * (reach / long),
            false => places[1],
        }
    }
}

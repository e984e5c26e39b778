//! Places of the patches on a sheet, and the closed lines around them.

use super::motion::Motion;
use super::seam_graph::{Node, SeamGraph, is_triangle};
use crate::math::planar::{distance_to_segment, polygon_contains};
use crate::unroll::flat_triangle::Point;
use crate::unroll::overlap::crossings;
use rustc_hash::FxHashMap;

/// Layout of all patches in the plane: the rigid motion of each patch, and for each seam whether it is a fold.
#[derive(Debug, Clone)]
pub(super) struct Layout {
    pub motions: Vec<Motion>,
    pub folded: Vec<bool>,
}

/// A corner of an outline: a closed line around patches, which lie to its left.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Corner {
    pub node: Node,
    pub place: Point,
    /// Number of the seam that the outline follows after this corner; `None` along the border.
    pub seam: Option<usize>,
    /// Number of the patch to the left of the outline after this corner.
    pub patch: u32,
}

impl Layout {
    /// Creates the layout in which no seam is a fold and no patch is moved.
    pub(super) fn loose(net: &SeamGraph) -> Layout {
        Layout {
            motions: vec![Motion::IDENTITY; net.flat_patches.len()],
            folded: vec![false; net.seams.len()],
        }
    }

    /// Applies a rigid motion to some patches of the layout.
    pub(super) fn carry(&mut self, patches: &[u32], motion: &Motion) {
        for patch in patches {
            let own = &mut self.motions[*patch as usize];
            *own = own.then(motion);
        }
    }

    /// Computes the positions, on the flat sheet, of a seam's nodes on one of its two patches, 0 or 1.
    pub(super) fn side(&self, net: &SeamGraph, seam: usize, side: usize) -> Vec<Point> {
        let motion = &self.motions[net.seams[seam].patches[side] as usize];
        let places = net.seams[seam].sides[side].iter();
        places.map(|place| motion.apply(*place)).collect()
    }

    /// Finds the patches at a node that are connected to a given patch by folds at that node, including that patch;
    /// ascending.
    fn family(&self, net: &SeamGraph, node: Node, patch: u32) -> Vec<u32> {
        let mut family = vec![patch];
        let seams = match node {
            (p, q) if p == q => return family,
            _ if is_triangle(node) => net.seams_at(node.0),
            _ => {
                let [one, other] = net.seams_of(node);
                [one, other, None]
            }
        };
        // Each pass adds the neighbours of the patches found so far; at most three patches meet at a node.
        for _ in 0..2 {
            for seam in seams.into_iter().flatten().filter(|s| self.folded[*s]) {
                let [a, b] = net.seams[seam].patches;
                for (one, other) in [(a, b), (b, a)] {
                    if family.contains(&one) && !family.contains(&other) {
                        family.push(other);
                    }
                }
            }
        }
        family.sort_unstable();
        family
    }

    /// Finds the outlines of some patches on a sheet: the closed lines around them, which also follow both sides of
    /// each seam between them that is not joined.
    pub(super) fn outlines(&self, net: &SeamGraph, patches: &[u32]) -> Vec<Vec<Corner>> {
        let mut segments = Vec::new();
        let mut starts: FxHashMap<(Node, u32), Vec<usize>> = FxHashMap::default();
        for patch in patches {
            for ([start, end], seam) in net.border(*patch) {
                if seam.is_some_and(|seam| self.folded[seam]) {
                    continue;
                }
                let [from, to] = [start, end].map(|node| self.family(net, node, *patch));
                let place = from
                    .iter()
                    .map(|p| self.motions[*p as usize].apply(net.place(start, *p)));
                let corner = Corner {
                    node: start,
                    place: place.sum::<Point>() / from.len() as f64,
                    seam,
                    patch: *patch,
                };
                starts
                    .entry((start, from[0]))
                    .or_default()
                    .push(segments.len());
                segments.push((corner, (end, to[0])));
            }
        }
        let mut used = vec![false; segments.len()];
        let mut outlines = Vec::new();
        for first in 0..segments.len() {
            let (mut line, mut next) = (Vec::new(), Some(first));
            while let Some(i) = next.filter(|i| !used[*i]) {
                used[i] = true;
                let (corner, end) = &segments[i];
                line.push(*corner);
                let onwards = starts.get(end).into_iter().flatten();
                next = onwards.copied().find(|i| !used[*i]);
            }
            if line.len() > 2 {
                outlines.push(line);
            }
        }
        outlines
    }

    /// Returns whether two sheets reach into each other by more than a distance: whether a corner of one outline is inside
    /// of the other one and farther from it than that.
    pub(super) fn reach_into_each_other(
        &self,
        net: &SeamGraph,
        [one, other]: [&[u32]; 2],
        distance: f64,
    ) -> bool {
        let [one, other] = [one, other].map(|patches| {
            let outlines = self.outlines(net, patches).into_iter();
            let closed = outlines.map(|line| line.iter().map(|corner| corner.place).collect());
            closed.collect::<Vec<Vec<Point>>>()
        });
        reach_into_each_other([&one, &other], distance)
    }

    /// Returns whether some of the given patches overlap where the layout puts them in the plane.
    pub(super) fn overlaps(&self, net: &SeamGraph, patches: &[u32]) -> bool {
        let (mut places, mut edges) = (Vec::new(), Vec::new());
        for line in self.outlines(net, patches) {
            let (first, count) = (places.len() as u32, line.len() as u32);
            places.extend(line.iter().map(|corner| corner.place));
            edges.extend((0..count).map(|k| [first + k, first + (k + 1) % count]));
        }
        !crossings(&places, &edges).is_empty()
    }
}

/// Returns whether two outlines, closed lines each, reach into each other by more than a distance.
pub(super) fn reach_into_each_other([one, other]: [&[Vec<Point>]; 2], distance: f64) -> bool {
    let is_inside = |points: &[Vec<Point>], around: &[Vec<Point>]| {
        let mut probes = points.iter().flatten();
        probes.any(|place| is_deep_inside(*place, around, distance))
    };
    is_inside(one, other) || is_inside(other, one)
}

/// Returns whether a point is inside of closed lines and farther from them than a distance.
fn is_deep_inside(place: Point, lines: &[Vec<Point>], distance: f64) -> bool {
    let around = lines.iter().filter(|line| polygon_contains(line, place));
    let mut segments = lines.iter().flat_map(|line| {
        let ends = line.iter().cycle().skip(1);
        line.iter().zip(ends).map(|(p, q)| [*p, *q])
    });
    around.count() % 2 == 1 && segments.all(|ends| distance_to_segment(place, ends) > distance)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_point_in_a_ring_is_as_deep_as_it_is_far_from_both_circles() {
        let circle = |radius: f64| -> Vec<Point> {
            (0..360)
                .map(|k| Point::from_polar(radius, f64::from(k).to_radians()))
                .collect()
        };
        let ring = [circle(10.0), circle(4.0)];
        let is_deep =
            |radius: f64, distance| is_deep_inside(Point::from_polar(radius, 1.0), &ring, distance);
        assert!(is_deep(7.0, 2.9) && !is_deep(7.0, 3.1));
        assert!(is_deep(9.0, 0.9) && !is_deep(9.0, 1.1));
        assert!(!is_deep(3.0, 0.5), "in the hole");
        assert!(!is_deep(12.0, 0.5), "outside");
    }
}

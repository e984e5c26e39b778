//! Where nodes are: in space, in plan, and on the plane of a patch that was laid flat.

use super::{Node, SeamGraph, is_triangle};
use crate::pattern::flat_patch::FlatPatch;
use crate::shape::patches::crease::smooth_polyline;
use crate::unroll::arap_mesh::BarycentricPoint;
use crate::unroll::flat_triangle::Point;

/// Minimum barycentric coordinate of a node on its edge or in its triangle, so that no two nodes coincide.
const MIN_NODE_SHARE: f64 = 0.01;

/// Number of smoothing passes over a cut inside of a patch, which zigzags between the vertices on either side. A cut
/// that was decided on a lattice of twice the spacing takes four times as many passes.
/// `benches/patterns.md` has what others give.
const CUT_SMOOTHING_PASSES: f64 = 4.0;

impl SeamGraph {
    /// Computes the position of a node seen from above.
    pub(in crate::pattern) fn plan(&self, (p, q): Node) -> [f64; 2] {
        let corners = match is_triangle((p, q)) {
            true => self.mesh.triangles()[p as usize],
            false => [p, q, q],
        };
        let shares = self.shares.get(&(p, q)).copied();
        let shares = shares.unwrap_or([0.5, 0.5, 0.0]);
        [0, 1].map(|k| {
            let terms = corners.iter().zip(shares);
            terms
                .map(|(v, share)| share * self.mesh.positions()[*v as usize][k])
                .sum()
        })
    }

    /// Computes the position of a node on the surface; its height is the mean of its patches' heights there.
    pub(in crate::pattern) fn built(&self, node: Node) -> [f64; 3] {
        let [x, y] = self.plan(node);
        let seams = match is_triangle(node) {
            true => self.seams_at(node.0),
            false => [self.seams_of(node)[0], None, None],
        };
        let (mut sum, mut count) = (0.0, 0.0);
        for patch in seams
            .into_iter()
            .flatten()
            .flat_map(|seam| self.seams[seam].patches)
        {
            let flat_patch = self.flat_patches[patch as usize].as_ref();
            if let (Some(flat_patch), Some(mean)) = (flat_patch, self.mean(node, patch)) {
                let terms = mean.iter().filter(|(_, share)| *share != 0.0);
                sum += terms
                    .map(|(vertex, share)| share * flat_patch.positions()[*vertex as usize][2])
                    .sum::<f64>();
                count += 1.0;
            }
        }
        [x, y, sum / count]
    }

    /// Computes the positions of consecutive nodes in a patch's plane, smoothed along the line; a `smooth` line, a cut
    /// inside of a patch, is smoothed more.
    pub(super) fn line(&self, patch: u32, nodes: &[Node], smooth: bool) -> Vec<Point> {
        let places = nodes.iter().map(|node| self.raw_place(*node, patch));
        let mut line: Vec<[f64; 2]> = places.map(|place| [place.re, place.im]).collect();
        let coarse = (self.decided / self.spacing).max(1.0);
        let times = if smooth {
            CUT_SMOOTHING_PASSES * coarse.powi(2)
        } else {
            1.0
        };
        for _ in 0..times as usize {
            line = smooth_polyline(line);
        }
        line.into_iter().map(|[x, y]| Point::new(x, y)).collect()
    }

    /// Replaces the flat positions of a patch's vertices.
    pub(in crate::pattern) fn set_places(&mut self, patch: u32, places: Vec<Point>) {
        if let Some(flat_patch) = self.flat_patches[patch as usize].as_mut() {
            flat_patch.set_places(places);
        }
        for crease in 0..self.parts.len() {
            let seam = self.parts[crease].first().map(|seam| &self.seams[*seam]);
            if seam.is_some_and(|seam| seam.patches.contains(&patch)) {
                self.draw_side(crease, patch);
            }
        }
    }

    /// Resets the vertices of a patch to their positions when it was laid flat by itself.
    pub(in crate::pattern) fn lay_alone(&mut self, patch: u32) {
        let flat_patch = self.flat_patches[patch as usize].as_ref();
        if let Some(places) = flat_patch.and_then(FlatPatch::moved_from) {
            self.set_places(patch, places);
        }
    }

    /// Computes the line of a crease on one of its flat patches; all seams of the crease are smoothed as one line.
    pub(super) fn draw_side(&mut self, crease: usize, patch: u32) {
        let parts = self.parts(crease);
        let Some(first) = parts.first().map(|seam| &self.seams[*seam]) else {
            return;
        };
        let Some(side) = first.patches.iter().position(|p| *p == patch) else {
            return;
        };
        let (smooth, mut nodes) = (first.smooth, first.nodes.clone());
        for seam in &parts[1..] {
            nodes.extend(&self.seams[*seam].nodes[1..]);
        }
        let line = self.line(patch, &nodes, smooth);
        for (node, place) in nodes.iter().zip(&line) {
            self.on_seams.insert((*node, patch), *place);
        }
        for seam in parts {
            let seam = &mut self.seams[seam];
            seam.sides[side] = line[seam.from..seam.from + seam.nodes.len()].to_vec();
        }
    }

    /// Expresses a node of a seam as a weighted mean of vertices of one of its two patches.
    pub(in crate::pattern) fn mean(&self, node: Node, patch: u32) -> Option<BarycentricPoint> {
        let flat_patch = self.flat_patches[patch as usize].as_ref()?;
        let shares = self.shares.get(&node)?;
        let vertices = match is_triangle(node) {
            true => self.mesh.triangles()[node.0 as usize],
            false => [node.0, node.1, node.0],
        };
        let mut mean = [(0, 0.0); 3];
        for ((term, vertex), share) in mean.iter_mut().zip(vertices).zip(shares) {
            if *share != 0.0 {
                *term = (flat_patch.number(self.row_and_col(vertex))? as u32, *share);
            }
        }
        Some(mean)
    }

    /// Computes where the extended surfaces of two patches intersect above an edge of the lattice: the position as a
    /// share of the way from the first vertex to the second, clamped to the edge, and the height that the second patch
    /// falls relative to the first along the edge.
    pub(super) fn crossing(&self, (p, q): Node) -> (f64, f64) {
        let [first, second] = [p, q].map(|v| self.labels[v as usize]);
        // Height of the first vertex's patch above the second one's, at both vertices.
        let here = self.mesh.positions()[p as usize][2] - self.vertex_height(p, second);
        let there = self.vertex_height(q, first) - self.mesh.positions()[q as usize][2];
        let share = here / (here - there);
        let share = if share.is_finite() { share } else { 0.5 };
        (
            share.clamp(MIN_NODE_SHARE, 1.0 - MIN_NODE_SHARE),
            there - here,
        )
    }

    /// Computes the barycentric coordinates of the point in a triangle where its three patches meet; those of the
    /// centroid if they do not meet inside.
    pub(super) fn meeting(&self, triangle: u32) -> [f64; 3] {
        let corners = self.mesh.triangles()[triangle as usize];
        let heights = corners.map(|own| {
            let patch = self.labels[own as usize];
            corners.map(|corner| self.vertex_height(corner, patch))
        });
        let difference = |a: usize, b: usize| [0, 1, 2].map(|k| heights[a][k] - heights[b][k]);
        let ([a, b, c], [d, e, f]) = (difference(0, 1), difference(1, 2));
        let shares = [b * f - c * e, c * d - a * f, a * e - b * d];
        let shares = shares.map(|share| share / shares.iter().sum::<f64>());
        match shares.iter().all(|share| *share >= MIN_NODE_SHARE) {
            true => shares,
            false => [1.0 / 3.0; 3],
        }
    }

    pub(super) fn row_and_col(&self, vertex: u32) -> [usize; 2] {
        let cols = self.mesh.lattice().cols();
        let index = self.mesh.vertices()[vertex as usize] as usize;
        [index / cols, index % cols]
    }

    pub(super) fn vertex_height(&self, vertex: u32, patch: u32) -> f64 {
        let flat_patch = self.flat_patches[patch as usize].as_ref();
        flat_patch.map_or(f64::NAN, |flat_patch| {
            flat_patch.height(self.row_and_col(vertex))
        })
    }

    pub(super) fn vertex_place(&self, vertex: u32, patch: u32) -> Point {
        let flat_patch = self.flat_patches[patch as usize].as_ref();
        flat_patch.map_or(Point::new(f64::NAN, f64::NAN), |flat_patch| {
            flat_patch.place(self.row_and_col(vertex))
        })
    }

    /// Computes the height of one patch's extended surface at a node on an edge.
    pub(super) fn height(&self, node: Node, patch: u32) -> f64 {
        let [first, second, _] = self.shares[&node];
        first * self.vertex_height(node.0, patch) + second * self.vertex_height(node.1, patch)
    }

    /// Computes the position of a node in the plane of a flat patch, before the line of nodes is smoothed.
    pub(super) fn raw_place(&self, node: Node, patch: u32) -> Point {
        let (p, q) = node;
        if p == q {
            return self.vertex_place(p, patch);
        }
        let shares = self.shares[&node];
        if is_triangle(node) {
            let corners = self.mesh.triangles()[p as usize].into_iter().zip(shares);
            return corners.map(|(v, w)| self.vertex_place(v, patch) * w).sum();
        }
        self.vertex_place(p, patch) * shares[0] + self.vertex_place(q, patch) * shares[1]
    }

    /// Returns the position of a node in the plane of a flat patch, smoothed if the node lies on a seam.
    pub(in crate::pattern) fn place(&self, node: Node, patch: u32) -> Point {
        match self.on_seams.get(&(node, patch)) {
            Some(place) => *place,
            None => self.raw_place(node, patch),
        }
    }
}

//! What a surface falls into along its creases: patches laid flat, the seams between them, and the
//! lines around each patch.
//!
//! A *node* is a place where such a line may turn: a vertex of the lattice, the point of an edge
//! between two patches where they meet, or that of a triangle where three do.

use std::collections::HashMap;

use super::leaf::{Leaf, Window};
use crate::error::Result;
use crate::flat::unroll::UnrollOptions;
use crate::flat::unroll::pieces::Point;
use crate::heights::heightfield::Heightfield;
use crate::lattice::hexagonal::NEIGHBOURS;
use crate::scene::triangulation::Triangulation;
use crate::scene::view::Frame;
use crate::shape::patches::crease::{lines, smoothed};
use crate::shape::patches::{NO_PATCH, Patches};

/// An edge by its vertices, the lower one first; a vertex by itself, twice; a triangle by its
/// number and that of no vertex. All in the numbers of the whole surface's mesh.
pub(super) type Node = crate::shape::patches::crease::Node;

/// Share of an edge or a triangle that is left to each side at least, so that no two nodes are at
/// one place.
const LEAST: f64 = 0.01;

/// A crease, as either patch has it.
pub(super) struct Seam {
    pub patches: [u32; 2],
    pub nodes: Vec<Node>,
    /// Where the nodes are on either patch's plane, smoothed along the crease.
    pub sides: [Vec<Point>; 2],
    /// Above 0 for a ridge, below for a groove, seen from above.
    pub rise: f64,
    /// How far the patches are from each other along it, in height: root of the mean square.
    pub apart: f64,
}

/// A piece of the line around a patch, which lies to the left of it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Segment {
    pub from: Node,
    pub to: Node,
    /// The seam that it is a piece of.
    pub seam: Option<usize>,
}

pub(super) struct Net {
    pub spacing: f64,
    pub leaves: Vec<Option<Leaf>>,
    pub seams: Vec<Seam>,
    /// The seam of each edge between two patches.
    pub seam_of: HashMap<Node, usize>,
    /// The line around each patch, in no order.
    pub borders: Vec<Vec<Segment>>,
    mesh: Triangulation,
    labels: Vec<u32>,
    /// Shares of the first corner on edges, or of all three, on triangles.
    shares: HashMap<Node, [f64; 3]>,
    /// By node and patch.
    on_seams: HashMap<(Node, u32), Point>,
}

impl Net {
    pub(super) fn new(
        surface: &Heightfield,
        patches: &Patches,
        options: &UnrollOptions,
    ) -> Result<Net> {
        let labels = patches.labels();
        let mesh = Triangulation::new(surface, &Frame::default())?;
        let windows = Window::around(surface.lattice(), labels, patches.patches().len());
        let mut leaves = Vec::new();
        for (patch, window) in windows.into_iter().enumerate() {
            leaves.push(Leaf::new(surface, labels, patch as u32, window, options)?);
        }
        let mut net = Net {
            spacing: surface.lattice().spacing(),
            leaves,
            seams: Vec::new(),
            seam_of: HashMap::new(),
            borders: vec![Vec::new(); patches.patches().len()],
            labels: (mesh.vertices().iter())
                .map(|v| labels[*v as usize])
                .collect(),
            mesh,
            shares: HashMap::new(),
            on_seams: HashMap::new(),
        };
        for (patches, nodes) in lines(&net.mesh, labels) {
            net.add_seam(patches, nodes);
        }
        net.add_borders(surface);
        Ok(net)
    }

    fn add_seam(&mut self, patches: [u32; 2], nodes: Vec<Node>) {
        let number = self.seams.len();
        let (mut rise, mut squares, mut count) = (0.0, 0.0, 0.0);
        for node in &nodes {
            if is_triangle(*node) {
                let share = self.meeting(node.0);
                self.shares.entry(*node).or_insert(share);
                continue;
            }
            self.seam_of.insert(*node, number);
            let (share, steepness) = self.crossing(*node);
            self.shares.insert(*node, [1.0 - share, share, 0.0]);
            rise += steepness;
            let [a, b] = patches.map(|patch| self.height(*node, patch));
            squares += (a - b) * (a - b);
            count += 1.0;
        }
        let sides: [Vec<Point>; 2] = patches.map(|patch| {
            let places = nodes.iter().map(|node| self.raw_place(*node, patch));
            let line = smoothed(places.map(|place| [place.re, place.im]).collect());
            line.into_iter().map(|[x, y]| Point::new(x, y)).collect()
        });
        for (patch, side) in patches.iter().zip(&sides) {
            for (node, place) in nodes.iter().zip(side) {
                self.on_seams.insert((*node, *patch), *place);
            }
        }
        self.seams.push(Seam {
            patches,
            nodes,
            sides,
            rise,
            apart: (squares / f64::max(count, 1.0)).sqrt(),
        });
    }

    /// Where on an edge its patches meet, from the first vertex to the second, and how much faster
    /// that of the second one falls than the other: where there is no such place, the nearest end.
    fn crossing(&self, (p, q): Node) -> (f64, f64) {
        let [first, second] = [p, q].map(|v| self.labels[v as usize]);
        // The first vertex's patch above the other one's.
        let here = self.mesh.positions()[p as usize][2] - self.vertex_height(p, second);
        let there = self.vertex_height(q, first) - self.mesh.positions()[q as usize][2];
        let share = here / (here - there);
        let share = if share.is_finite() { share } else { 0.5 };
        (share.clamp(LEAST, 1.0 - LEAST), there - here)
    }

    /// Shares of a triangle's corners in the point where its three patches meet; its middle where
    /// they do not.
    fn meeting(&self, triangle: u32) -> [f64; 3] {
        let corners = self.mesh.triangles()[triangle as usize];
        let heights = corners.map(|own| {
            let patch = self.labels[own as usize];
            corners.map(|corner| self.vertex_height(corner, patch))
        });
        let difference = |a: usize, b: usize| [0, 1, 2].map(|k| heights[a][k] - heights[b][k]);
        let ([a, b, c], [d, e, f]) = (difference(0, 1), difference(1, 2));
        let shares = [b * f - c * e, c * d - a * f, a * e - b * d];
        let shares = shares.map(|share| share / shares.iter().sum::<f64>());
        match shares.iter().all(|share| *share >= LEAST) {
            true => shares,
            false => [1.0 / 3.0; 3],
        }
    }

    fn row_and_col(&self, vertex: u32) -> [usize; 2] {
        let cols = self.mesh.lattice().cols();
        let index = self.mesh.vertices()[vertex as usize] as usize;
        [index / cols, index % cols]
    }

    fn vertex_height(&self, vertex: u32, patch: u32) -> f64 {
        let leaf = self.leaves[patch as usize].as_ref();
        leaf.map_or(f64::NAN, |leaf| leaf.height(self.row_and_col(vertex)))
    }

    fn vertex_place(&self, vertex: u32, patch: u32) -> Point {
        let leaf = self.leaves[patch as usize].as_ref();
        leaf.map_or(Point::new(f64::NAN, f64::NAN), |leaf| {
            leaf.place(self.row_and_col(vertex))
        })
    }

    /// Height of an edge's node on one of its patches.
    fn height(&self, node: Node, patch: u32) -> f64 {
        let [first, second, _] = self.shares[&node];
        first * self.vertex_height(node.0, patch) + second * self.vertex_height(node.1, patch)
    }

    /// Where a node is on a patch's plane, before smoothing.
    fn raw_place(&self, node: Node, patch: u32) -> Point {
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

    /// Where a node is on a patch's plane.
    pub(super) fn place(&self, node: Node, patch: u32) -> Point {
        match self.on_seams.get(&(node, patch)) {
            Some(place) => *place,
            None => self.raw_place(node, patch),
        }
    }

    /// The seams that meet in a triangle.
    pub(super) fn seams_at(&self, triangle: u32) -> [Option<usize>; 3] {
        let [a, b, c] = self.mesh.triangles()[triangle as usize];
        [(a, b), (b, c), (c, a)].map(|(p, q)| self.seam_of.get(&(p.min(q), p.max(q))).copied())
    }

    fn add_borders(&mut self, surface: &Heightfield) {
        for (number, corners) in self.mesh.triangles().iter().copied().enumerate() {
            let labels = corners.map(|v| self.labels[v as usize]);
            let junction = (number as u32, u32::MAX);
            let [a, b, c] = labels;
            let apart = a != b && b != c && c != a;
            for (k, patch) in labels.into_iter().enumerate() {
                if patch == NO_PATCH || labels[..k].contains(&patch) {
                    continue;
                }
                let border = &mut self.borders[patch as usize];
                let (mut exit, mut entry) = (None, None);
                for (i, from) in corners.into_iter().enumerate() {
                    let to = corners[(i + 1) % 3];
                    let [ours, theirs] = [i, (i + 1) % 3].map(|k| labels[k] == patch);
                    let edge = (from.min(to), from.max(to));
                    let ends = match (ours, theirs) {
                        (true, true) => [(from, from), (to, to)],
                        (true, false) => [(from, from), *exit.insert(edge)],
                        (false, true) => [*entry.insert(edge), (to, to)],
                        (false, false) => continue,
                    };
                    if is_open(surface, &self.mesh, from, to) {
                        let [from, to] = ends;
                        let seam = None;
                        border.push(Segment { from, to, seam });
                    }
                }
                if let (Some(exit), Some(entry)) = (exit, entry) {
                    let [out, back] = [exit, entry].map(|edge| self.seam_of.get(&edge).copied());
                    let mut add = |from, to, seam| border.push(Segment { from, to, seam });
                    if apart {
                        add(exit, junction, out);
                        add(junction, entry, back);
                    } else {
                        add(exit, entry, out);
                    }
                }
            }
        }
    }
}

pub(super) fn is_triangle((_, q): Node) -> bool {
    q == u32::MAX
}

/// Whether there is no triangle to the right of an edge of one to the left.
fn is_open(surface: &Heightfield, mesh: &Triangulation, from: u32, to: u32) -> bool {
    let lattice = surface.lattice();
    let [from, to] = [from, to].map(|v| {
        let index = mesh.vertices()[v as usize] as usize;
        (index / lattice.cols(), index % lattice.cols())
    });
    let place = (from.0 as isize, from.1 as isize);
    let target = (to.0 as isize, to.1 as isize);
    // The next direction clockwise of W, E, NW, NE, SW, SE.
    const CLOCKWISE: [usize; 6] = [2, 5, 3, 1, 0, 4];
    let towards = (0..6).find(|k| NEIGHBOURS[*k].step(place.0, place.1) == target);
    let Some(towards) = towards else { return true };
    let (row, col) = NEIGHBOURS[CLOCKWISE[towards]].step(place.0, place.1);
    !lattice.contains(row, col) || surface.height(row as usize, col as usize).is_nan()
}

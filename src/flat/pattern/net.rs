//! What a surface falls into along its creases: patches laid flat, the seams between them, and the
//! lines around each patch.
//!
//! A *node* is a place where such a line may turn: a vertex of the lattice, the point of an edge
//! between two patches where they meet, or that of a triangle where three do.

use std::collections::HashMap;

use super::labels::Labels;
use super::leaf::Leaf;
use crate::error::Result;
use crate::flat::unroll::joint::Mean;
use crate::flat::unroll::pieces::Point;
use crate::heights::heightfield::Heightfield;
use crate::lattice::hexagonal::NEIGHBOURS;
use crate::scene::triangulation::Triangulation;
use crate::scene::view::Frame;
use crate::shape::patches::NO_PATCH;
use crate::shape::patches::crease::{lines, smoothed};

/// An edge by its vertices, the lower one first; a vertex by itself, twice; a triangle by its
/// number and that of no vertex. All in the numbers of the whole surface's mesh.
pub(super) type Node = crate::shape::patches::crease::Node;

/// Share of an edge or a triangle that is left to each side at least, so that no two nodes are at
/// one place.
const LEAST: f64 = 0.01;

/// How often a cut through a patch is smoothed; it is the zigzag between the vertices on either side.
const CUT_SMOOTHING: usize = 4;

/// Least share of a seam's length that is joined where the whole of it cannot be: of a crease, and of
/// a cut through what was one patch.
const PART_OF_CREASE: f64 = 0.5;
const PART_OF_CUT: f64 = 0.2;

/// A crease or a part of it, as either patch has it.
pub(super) struct Seam {
    pub patches: [u32; 2],
    /// The crease by its number.
    pub crease: usize,
    /// Whether it is a cut through what was one patch.
    pub smooth: bool,
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
    /// The seam of each edge between two patches, and a second one where a crease is divided.
    seam_of: HashMap<Node, usize>,
    also: HashMap<Node, usize>,
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
    /// Seams that cannot be joined as a whole are divided, if by `gap` (see
    /// [`PatternOptions`](super::PatternOptions)) a good part of them can.
    pub(super) fn new(
        surface: &Heightfield,
        labels: &Labels,
        leaves: Vec<Option<Leaf>>,
        gap: f64,
    ) -> Result<Net> {
        let mesh = Triangulation::new(surface, &Frame::default())?;
        let mut net = Net {
            spacing: surface.lattice().spacing(),
            borders: vec![Vec::new(); leaves.len()],
            leaves,
            seams: Vec::new(),
            seam_of: HashMap::new(),
            also: HashMap::new(),
            labels: (mesh.vertices().iter())
                .map(|v| labels.of[*v as usize])
                .collect(),
            mesh,
            shares: HashMap::new(),
            on_seams: HashMap::new(),
        };
        for (crease, (patches, nodes)) in lines(&net.mesh, &labels.of).into_iter().enumerate() {
            let smooth = labels.are_one(patches[0], patches[1]);
            net.add_seam(crease, patches, smooth, nodes, gap);
        }
        net.add_borders(surface);
        Ok(net)
    }

    fn add_seam(
        &mut self,
        crease: usize,
        patches: [u32; 2],
        smooth: bool,
        nodes: Vec<Node>,
        gap: f64,
    ) {
        let (mut rise, mut squares, mut count) = (0.0, 0.0, 0.0);
        for node in &nodes {
            if is_triangle(*node) {
                let share = self.meeting(node.0);
                self.shares.entry(*node).or_insert(share);
                continue;
            }
            let (share, steepness) = match smooth {
                true => (0.5, 0.0),
                false => self.crossing(*node),
            };
            self.shares.insert(*node, [1.0 - share, share, 0.0]);
            rise += steepness;
            let [a, b] = patches.map(|patch| self.height(*node, patch));
            squares += (a - b) * (a - b);
            count += 1.0;
        }
        let sides = patches.map(|patch| self.line(patch, &nodes, smooth));
        for (patch, side) in patches.iter().zip(&sides) {
            for (node, place) in nodes.iter().zip(side) {
                self.on_seams.insert((*node, *patch), *place);
            }
        }
        let apart = f64::sqrt(squares / f64::max(count, 1.0));
        let least = if smooth { PART_OF_CUT } else { PART_OF_CREASE };
        let ends = match apart <= super::layout::TORN * self.spacing {
            true => divided(&sides, gap, super::layout::FINE * self.spacing, least),
            false => vec![0, nodes.len() - 1],
        };
        for pair in ends.windows(2) {
            let (from, to) = (pair[0], pair[1]);
            let number = self.seams.len();
            for node in nodes[from..=to].iter().filter(|node| !is_triangle(**node)) {
                match self.seam_of.get(node) {
                    Some(first) if *first != number => {
                        self.also.insert(*node, number);
                    }
                    _ => {
                        self.seam_of.insert(*node, number);
                    }
                }
            }
            self.seams.push(Seam {
                patches,
                crease,
                smooth,
                nodes: nodes[from..=to].to_vec(),
                sides: [0, 1].map(|k| sides[k][from..=to].to_vec()),
                rise,
                apart,
            });
        }
    }

    /// Where nodes are on a patch's plane, smoothed along their line.
    fn line(&self, patch: u32, nodes: &[Node], smooth: bool) -> Vec<Point> {
        let places = nodes.iter().map(|node| self.raw_place(*node, patch));
        let mut line: Vec<[f64; 2]> = places.map(|place| [place.re, place.im]).collect();
        for _ in 0..if smooth { CUT_SMOOTHING } else { 1 } {
            line = smoothed(line);
        }
        line.into_iter().map(|[x, y]| Point::new(x, y)).collect()
    }

    /// Lays a patch elsewhere.
    pub(super) fn set_places(&mut self, patch: u32, places: Vec<Point>) {
        if let Some(leaf) = self.leaves[patch as usize].as_mut() {
            leaf.set_places(places);
        }
        // Parts of one line are smoothed as one.
        let mut first = 0;
        while first < self.seams.len() {
            let crease = self.seams[first].crease;
            let parts = self.seams[first..]
                .iter()
                .take_while(|s| s.crease == crease)
                .count();
            let parts = first..first + parts;
            first = parts.end;
            let Some(side) = self.seams[parts.start]
                .patches
                .iter()
                .position(|p| *p == patch)
            else {
                continue;
            };
            let smooth = self.seams[parts.start].smooth;
            let mut nodes = self.seams[parts.start].nodes.clone();
            for seam in &self.seams[parts.start + 1..parts.end] {
                nodes.extend(&seam.nodes[1..]);
            }
            let line = self.line(patch, &nodes, smooth);
            for (node, place) in nodes.iter().zip(&line) {
                self.on_seams.insert((*node, patch), *place);
            }
            let mut from = 0;
            for seam in &mut self.seams[parts] {
                let to = from + seam.nodes.len();
                seam.sides[side] = line[from..to].to_vec();
                from = to - 1;
            }
        }
    }

    /// A node of a seam as a mean of vertices of one of its leaves.
    pub(super) fn mean(&self, node: Node, patch: u32) -> Option<Mean> {
        let leaf = self.leaves[patch as usize].as_ref()?;
        let shares = self.shares.get(&node)?;
        let vertices = match is_triangle(node) {
            true => self.mesh.triangles()[node.0 as usize],
            false => [node.0, node.1, node.0],
        };
        let mut mean = [(0, 0.0); 3];
        for ((term, vertex), share) in mean.iter_mut().zip(vertices).zip(shares) {
            if *share != 0.0 {
                *term = (leaf.number(self.row_and_col(vertex))? as u32, *share);
            }
        }
        Some(mean)
    }

    /// The seams that an edge's node is on.
    pub(super) fn seams_of(&self, node: Node) -> [Option<usize>; 2] {
        [
            self.seam_of.get(&node).copied(),
            self.also.get(&node).copied(),
        ]
    }

    /// The seam that a piece between two nodes in a triangle is of.
    fn seam_between(&self, one: Node, other: Node) -> Option<usize> {
        let (one, other) = (self.seams_of(one), self.seams_of(other));
        let both = one
            .into_iter()
            .flatten()
            .find(|seam| other.contains(&Some(*seam)));
        both.or(one[0])
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
                let mut border = Vec::new();
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
                    let through = self.seam_between(exit, entry);
                    let mut add = |from, to, seam| border.push(Segment { from, to, seam });
                    if apart {
                        add(exit, junction, out);
                        add(junction, entry, back);
                    } else {
                        add(exit, entry, through);
                    }
                }
                self.borders[patch as usize].extend(border);
            }
        }
    }
}

pub(super) fn is_triangle((_, q): Node) -> bool {
    q == u32::MAX
}

/// The places along a seam, from its first to its last, at which it is divided into parts that are
/// joined and parts that are not: if its sides do not fit on each other, the longest part of them that
/// does is one, where it has the `least` share of the length.
fn divided(sides: &[Vec<Point>; 2], gap: f64, fine: f64, least: f64) -> Vec<usize> {
    let last = sides[0].len() - 1;
    let whole = vec![0, last];
    // Lengths and moments of all beginnings, so that any part is compared at once.
    let mut lengths = vec![0.0; last + 1];
    for i in 0..last {
        lengths[i + 1] = lengths[i] + (sides[0][i + 1] - sides[0][i]).norm();
    }
    let zero = (Point::default(), Point::default(), Point::default(), 0.0);
    let mut moments = vec![zero];
    for (p, q) in sides[0].iter().zip(&sides[1]) {
        let (a, b, c, d) = moments[moments.len() - 1];
        moments.push((
            a + p,
            b + q,
            c + p.conj() * q,
            d + p.norm_sqr() + q.norm_sqr(),
        ));
    }
    let fits = |from: usize, to: usize| {
        let ((a, b, c, d), (e, f, g, h)) = (moments[to + 1], moments[from]);
        let count = (to + 1 - from) as f64;
        let (p, q) = (a - e, b - f);
        let correlation = c - g - p.conj() * q / count;
        let squares = d - h - (p.norm_sqr() + q.norm_sqr()) / count;
        let apart = ((squares - 2.0 * correlation.norm()) / count)
            .max(0.0)
            .sqrt();
        apart <= (gap * (lengths[to] - lengths[from])).max(fine)
    };
    if last < 8 || fits(0, last) {
        return whole;
    }
    let mut best = (0.0, 0, 0);
    for from in (0..last).step_by(1 + last / 128) {
        // As far as it goes: in growing steps, then in shrinking ones.
        let (mut to, mut step) = (from + 2, 1);
        while to + step <= last && fits(from, to + step) {
            to += step;
            step *= 2;
        }
        while step > 0 {
            if to + step <= last && fits(from, to + step) {
                to += step;
            }
            step /= 2;
        }
        if to <= last && lengths[to] - lengths[from] > best.0 {
            best = (lengths[to] - lengths[from], from, to);
        }
    }
    let (length, mut from, mut to) = best;
    if length < least * lengths[last] {
        return whole;
    }
    // No part is too short to be one.
    const SHORT: usize = 4;
    if from < SHORT {
        from = 0;
    }
    if last - to < SHORT {
        to = last;
    }
    let mut ends = vec![0, from, to, last];
    ends.dedup();
    ends
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

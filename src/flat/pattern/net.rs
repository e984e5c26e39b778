//! What a surface falls into along its creases: patches laid flat, the seams between them, and the
//! lines around each patch.
//!
//! A *node* is a place where such a line may turn: a vertex of the lattice, the point of an edge
//! between two patches where they meet, or that of a triangle where three do.

use super::labels::Labels;
use super::leaf::Leaf;
use crate::error::Result;
use crate::flat::unroll::joint::Mean;
use crate::flat::unroll::pieces::Point;
use crate::heights::heightfield::Heightfield;
use crate::lattice::hexagonal::NEIGHBOURS;
use crate::math::hash::NumberMap;
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

/// So many nodes on either side make a place where a seam is held.
const BESIDE: usize = 2;

/// No part of a seam has fewer nodes.
const SHORT: usize = 4;

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
    /// Which of the crease's nodes is its first.
    from: usize,
    pub nodes: Vec<Node>,
    /// Where the nodes are on either patch's plane, smoothed along the crease.
    pub sides: [Vec<Point>; 2],
    /// Above 0 for a ridge, below for a groove, seen from above.
    pub rise: f64,
    /// How far the patches are from each other along it, in height: root of the mean square.
    pub apart: f64,
}

/// A piece of the line around a patch, which lies to the left of it: from one node to another.
type Segment = [Node; 2];

pub(super) struct Net {
    pub spacing: f64,
    pub leaves: Vec<Option<Leaf>>,
    pub seams: Vec<Seam>,
    /// The seams that each crease is divided into.
    parts: Vec<Vec<usize>>,
    /// The seam of each edge between two patches, and a second one where a crease is divided.
    seam_of: NumberMap<Node, usize>,
    also: NumberMap<Node, usize>,
    /// The line around each patch, in no order.
    borders: Vec<Vec<Segment>>,
    mesh: Triangulation,
    labels: Vec<u32>,
    /// Shares of the first corner on edges, or of all three, on triangles.
    shares: NumberMap<Node, [f64; 3]>,
    /// By node and patch.
    on_seams: NumberMap<(Node, u32), Point>,
}

impl Net {
    /// Each crease is one seam.
    pub(super) fn new(
        surface: &Heightfield,
        labels: &Labels,
        leaves: Vec<Option<Leaf>>,
    ) -> Result<Net> {
        let mesh = Triangulation::new(surface, &Frame::default())?;
        let mut net = Net {
            spacing: surface.lattice().spacing(),
            borders: vec![Vec::new(); leaves.len()],
            leaves,
            seams: Vec::new(),
            parts: Vec::new(),
            seam_of: NumberMap::default(),
            also: NumberMap::default(),
            labels: (mesh.vertices().iter())
                .map(|v| labels.of[*v as usize])
                .collect(),
            mesh,
            shares: NumberMap::default(),
            on_seams: NumberMap::default(),
        };
        for (crease, (patches, nodes)) in lines(&net.mesh, &labels.of).into_iter().enumerate() {
            let smooth = labels.are_one(patches[0], patches[1]);
            net.add_seam(crease, patches, smooth, nodes);
        }
        net.index();
        net.add_borders(surface);
        Ok(net)
    }

    fn add_seam(&mut self, crease: usize, patches: [u32; 2], smooth: bool, nodes: Vec<Node>) {
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
        self.parts.push(vec![self.seams.len()]);
        self.seams.push(Seam {
            patches,
            crease,
            smooth,
            from: 0,
            nodes,
            sides,
            rise,
            apart: f64::sqrt(squares / f64::max(count, 1.0)),
        });
    }

    /// Finds the seams of all nodes again.
    fn index(&mut self) {
        self.seam_of.clear();
        self.also.clear();
        for (number, seam) in self.seams.iter().enumerate() {
            for node in seam.nodes.iter().filter(|node| !is_triangle(**node)) {
                match self.seam_of.get(node) {
                    Some(first) if *first != number => {
                        self.also.insert(*node, number);
                    }
                    _ => {
                        self.seam_of.insert(*node, number);
                    }
                }
            }
        }
    }

    /// The seam that a piece of a patch's line is of, by its ends; `None` on the border.
    fn seam_along(&self, from: Node, to: Node) -> Option<usize> {
        let on_vertex = |(p, q): Node| p == q;
        if on_vertex(from) || on_vertex(to) {
            return None;
        }
        match (is_triangle(from), is_triangle(to)) {
            (true, true) => None,
            (true, false) => self.seam_of.get(&to).copied(),
            (false, true) => self.seam_of.get(&from).copied(),
            (false, false) => self.seam_between(from, to),
        }
    }

    /// Divides seams that cannot be joined as a whole, if by `gap` (see
    /// [`PatternOptions`](super::PatternOptions)) a good part of them can.
    pub(super) fn divide_by_fit(&mut self, gap: f64) {
        for number in 0..self.seams.len() {
            if self.is_torn(number) {
                continue;
            }
            let seam = &self.seams[number];
            let least = if seam.smooth {
                PART_OF_CUT
            } else {
                PART_OF_CREASE
            };
            let ends = divided(&seam.sides, gap, super::layout::FINE * self.spacing, least);
            for at in ends[1..ends.len() - 1].iter().rev() {
                self.cut_off(number, *at);
            }
        }
        self.index();
    }

    /// The line around a patch, piece by piece, with the seams that these are of.
    pub(super) fn border(&self, patch: u32) -> impl Iterator<Item = (Segment, Option<usize>)> {
        let pieces = self.borders[patch as usize].iter();
        pieces.map(|[from, to]| ([*from, *to], self.seam_along(*from, *to)))
    }

    /// Divides a seam before one of its inner nodes; the number of the second part.
    pub(super) fn divide(&mut self, seam: usize, at: usize) -> usize {
        let number = self.cut_off(seam, at);
        self.index();
        number
    }

    /// Divides a seam where its nodes are of two kinds; its parts, and which kind each is. No part
    /// is short, unless all of the seam is.
    pub(super) fn divide_where(&mut self, seam: usize, kinds: &[bool]) -> Vec<(usize, bool)> {
        let mut runs: Vec<(usize, bool)> = Vec::new();
        for kind in kinds {
            match runs.last_mut() {
                Some((count, last)) if last == kind => *count += 1,
                _ => runs.push((1, *kind)),
            }
        }
        // What is short is of the kind before it, or after it.
        while let Some(k) = runs.iter().position(|(count, _)| *count < SHORT) {
            if runs.len() == 1 {
                break;
            }
            let (count, _) = runs.remove(k);
            runs[k.saturating_sub(1)].0 += count;
            let mut merged: Vec<(usize, bool)> = Vec::new();
            for (count, kind) in runs {
                match merged.last_mut() {
                    Some((all, last)) if *last == kind => *all += count,
                    _ => merged.push((count, kind)),
                }
            }
            runs = merged;
        }
        let mut parts = Vec::new();
        let mut from = kinds.len();
        for (count, kind) in runs.iter().rev() {
            from -= count;
            let part = if from == 0 {
                seam
            } else {
                self.cut_off(seam, from)
            };
            parts.push((part, *kind));
        }
        self.index();
        parts
    }

    /// Where a node is in plan.
    pub(super) fn plan(&self, (p, q): Node) -> [f64; 2] {
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

    fn cut_off(&mut self, seam: usize, at: usize) -> usize {
        let number = self.seams.len();
        let first = &mut self.seams[seam];
        let rest = Seam {
            from: first.from + at,
            nodes: first.nodes[at..].to_vec(),
            sides: [0, 1].map(|side| first.sides[side][at..].to_vec()),
            ..*first
        };
        first.nodes.truncate(at + 1);
        first
            .sides
            .iter_mut()
            .for_each(|side| side.truncate(at + 1));
        self.parts[rest.crease].push(number);
        self.seams.push(rest);
        number
    }

    /// The seams of each crease from its beginning to its end.
    pub(super) fn parts(&self, crease: usize) -> Vec<usize> {
        let mut parts = self.parts[crease].clone();
        parts.sort_by_key(|seam| self.seams[*seam].from);
        parts
    }

    /// Whether its sides are apart in space: at a step of the surface.
    pub(super) fn is_torn(&self, seam: usize) -> bool {
        self.seams[seam].apart > super::layout::TORN * self.spacing
    }

    /// Makes one of neighbouring seams of a crease that are both folds or both none.
    pub(super) fn join_parts(&mut self, folded: &mut Vec<bool>) {
        let (mut seams, mut flags): (Vec<Seam>, Vec<bool>) = (Vec::new(), Vec::new());
        let mut old: Vec<Option<Seam>> = std::mem::take(&mut self.seams)
            .into_iter()
            .map(Some)
            .collect();
        for crease in 0..self.parts.len() {
            let mut parts = std::mem::take(&mut self.parts[crease]);
            parts.sort_by_key(|seam| old[*seam].as_ref().map_or(0, |seam| seam.from));
            for number in parts {
                let Some(seam) = old[number].take() else {
                    continue;
                };
                match seams.last_mut() {
                    Some(last)
                        if last.crease == crease && flags.last() == Some(&folded[number]) =>
                    {
                        last.nodes.extend(&seam.nodes[1..]);
                        for (side, more) in last.sides.iter_mut().zip(&seam.sides) {
                            side.extend(&more[1..]);
                        }
                    }
                    _ => {
                        self.parts[crease].push(seams.len());
                        seams.push(seam);
                        flags.push(folded[number]);
                    }
                }
            }
        }
        self.seams = seams;
        *folded = flags;
        self.index();
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
        for crease in 0..self.parts.len() {
            let seam = self.parts[crease].first().map(|seam| &self.seams[*seam]);
            if seam.is_some_and(|seam| seam.patches.contains(&patch)) {
                self.draw_side(crease, patch);
            }
        }
    }

    /// Lays a patch as it lies by itself.
    pub(super) fn lay_alone(&mut self, patch: u32) {
        let leaf = self.leaves[patch as usize].as_ref();
        if let Some(places) = leaf.and_then(Leaf::moved_from) {
            self.set_places(patch, places);
        }
    }

    /// Finds where a crease lies on one of its patches; its parts are smoothed as one.
    fn draw_side(&mut self, crease: usize, patch: u32) {
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

    /// The middle of a seam's nodes next to one of them, as a mean of vertices of one of its leaves.
    pub(super) fn around(&self, seam: usize, node: usize, patch: u32) -> Vec<(u32, f64)> {
        let nodes = &self.seams[seam].nodes;
        let reach = BESIDE.min(node).min(nodes.len() - 1 - node);
        let means: Vec<Mean> = (nodes[node - reach..=node + reach].iter())
            .filter_map(|node| self.mean(*node, patch))
            .collect();
        let share = 1.0 / means.len().max(1) as f64;
        let terms = means.into_iter().flatten().filter(|(_, w)| *w != 0.0);
        terms.map(|(v, w)| (v, share * w)).collect()
    }

    /// Where that is on the patch's plane.
    pub(super) fn held(&self, seam: usize, node: usize, patch: u32) -> Point {
        let places = self.leaves[patch as usize].as_ref().map(Leaf::places);
        let terms = self.around(seam, node, patch).into_iter();
        terms
            .map(|(v, w)| places.map_or(Point::default(), |places| places[v as usize] * w))
            .sum()
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
                    let ends: Segment = match (ours, theirs) {
                        (true, true) => [(from, from), (to, to)],
                        (true, false) => [(from, from), *exit.insert(edge)],
                        (false, true) => [*entry.insert(edge), (to, to)],
                        (false, false) => continue,
                    };
                    if is_open(surface, &self.mesh, from, to) {
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

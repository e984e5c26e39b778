//! The line along a lattice's border, which zigzags between the vertices of its rows.

use rustc_hash::{FxHashMap, FxHashSet};

use crate::math::index::NO_INDEX;
use crate::math::planar::Point2;
use crate::scene::half_edges::{half_edge_ends, outlines, twin_half_edges};
use crate::scene::triangulation::Triangulation;

/// Number of edges on either side of a vertex over which the direction of the border is measured.
/// `benches/patterns.md` has what others give.
const HEADING_EDGES: usize = 4;

/// Minimum angle by which the border turns at a corner, in radians. `benches/patterns.md` has what others give.
const MIN_CORNER_TURN: f64 = 0.9;

/// Difference of angles, in radians, that is rounding.
const TURN_ROUNDING: f64 = 1e-6;

/// The closed lines along the border of a lattice's mesh.
pub(super) struct BorderLines {
    /// The vertices of each line, in order; the surface is to its left.
    pub lines: Vec<Vec<u32>>,
    /// The vertices at the border, each as a mean of itself and its neighbours along the border: the line through the middles
    /// of the border's edges, which is straight where the lattice's border zigzags.
    shares: FxHashMap<u32, Vec<(u32, f64)>>,
    /// Whether a vertex has to stay on the line, as a corner or where two lines meet.
    fixed: FxHashMap<u32, bool>,
    /// Vertices next to a corner, which may lie beyond it.
    beside_corners: FxHashSet<u32>,
}

impl BorderLines {
    pub(super) fn new(lattice: &Triangulation) -> Self {
        let triangles = lattice.triangles();
        let twins = twin_half_edges(triangles);
        let is_border = |side: u32| twins[side as usize] == NO_INDEX;
        let lines = outlines(&twins, 0..twins.len() as u32, is_border).into_iter();
        let start = |side: u32| half_edge_ends(triangles, side)[0];
        let mut all = BorderLines {
            lines: lines
                .map(|line| line.into_iter().map(start).collect())
                .collect(),
            shares: FxHashMap::default(),
            fixed: FxHashMap::default(),
            beside_corners: FxHashSet::default(),
        };
        for number in 0..all.lines.len() {
            all.straighten(lattice, number);
        }
        all
    }

    fn straighten(&mut self, lattice: &Triangulation, number: usize) {
        let line = &self.lines[number];
        let n = line.len();
        let at = |k: usize| {
            let [x, y, _] = lattice.positions()[line[k % n] as usize];
            Point2::new(x, y)
        };
        let turn = |k: usize| {
            let ahead = at(k + HEADING_EDGES) - at(k);
            let behind = at(k) - at(k + n - HEADING_EDGES % n);
            (ahead * behind.conj()).arg().abs()
        };
        let turns: Vec<f64> = (0..n).map(turn).collect();
        let is_corner = |k: usize| {
            let own = turns[k];
            let reach = HEADING_EDGES / 2;
            // The first of several alike, whatever the rounding.
            let before = (1..=reach).all(|i| own > turns[(k + n - i % n) % n] + TURN_ROUNDING);
            let after = (1..=reach).all(|i| own > turns[(k + i) % n] - TURN_ROUNDING);
            n > 4 * HEADING_EDGES && own > MIN_CORNER_TURN && before && after
        };
        let mean = |k: usize| {
            let [a, b, c] = [k + n - 1, k, k + 1].map(|k| line[k % n]);
            vec![(a, 0.25), (b, 0.5), (c, 0.25)]
        };
        let middle = |k: usize| at(k + n - 1) * 0.25 + at(k) * 0.5 + at(k + 1) * 0.25;
        // A corner is where the lines on both sides meet.
        let corner = |k: usize| {
            let (from, along) = (middle(k + n - 1), middle(k + n - 3) - middle(k + n - 1));
            let (other, across) = (middle(k + 1), middle(k + 3) - middle(k + 1));
            let share = (across.conj() * (other - from)).im / (across.conj() * along).im;
            let is_near = (from + along * share - at(k)).norm() <= lattice.lattice().spacing();
            let one = mean(k + n - 1)
                .into_iter()
                .map(|(v, w)| (v, w * (1.0 - share)));
            let far = mean(k + n - 3).into_iter().map(|(v, w)| (v, w * share));
            match is_near {
                true => one.chain(far).collect(),
                false => vec![(line[k], 1.0)],
            }
        };
        for k in (0..n).filter(|k| is_corner(*k)) {
            self.beside_corners
                .extend([line[(k + n - 1) % n], line[(k + 1) % n]]);
        }
        let placed = (0..n).map(|k| match is_corner(k) {
            true => (line[k], true, corner(k)),
            false => (line[k], false, mean(k)),
        });
        for (vertex, is_corner, shares) in placed.collect::<Vec<_>>() {
            let known = self.fixed.insert(vertex, is_corner);
            // Where two lines meet, a vertex stays where it is.
            let (is_fixed, shares) = match known {
                None => (is_corner, shares),
                Some(_) => (true, vec![(vertex, 1.0)]),
            };
            self.fixed.insert(vertex, is_fixed);
            self.shares.insert(vertex, shares);
        }
    }

    /// Returns whether the border's line has to pass through a vertex.
    pub(super) fn is_fixed(&self, vertex: u32) -> bool {
        self.fixed.get(&vertex) == Some(&true)
    }

    /// Returns whether a vertex may be beyond the border's line, as it is beside a corner.
    pub(super) fn is_beside_corner(&self, vertex: u32) -> bool {
        self.beside_corners.contains(&vertex) && !self.is_fixed(vertex)
    }

    /// Vertices of which the place of a vertex is the weighted mean; `None` inside of the surface.
    pub(super) fn shares(&self, vertex: u32) -> Option<&[(u32, f64)]> {
        self.shares.get(&vertex).map(Vec::as_slice)
    }
}

//! Nets: facets placed in the plane by rigid motions along a forest of hinges, without overlaps.

use nalgebra::Complex;
use oorandom::Rand64;
use rustc_hash::FxHashMap;

use super::polyhedron::Polyhedron;
use crate::math::index::NO_INDEX;
use crate::math::planar::{LeastBox, Point2, cross};

/// Work of the search for fewer pieces and shorter cuts, in triangles that are placed or compared.
const SEARCH_WORK: usize = 12_000_000;

/// Largest distance, in facets, from the hinge about which the search takes a net apart.
const MAX_RUIN_RADIUS: u64 = 3;

/// Minimum size of the cells of a piece's grid, in multiples of the rounding: a thousandth of the mesh's diagonal.
const MIN_CELL_ROUNDINGS: f64 = 1000.0;

/// A rigid motion of the plane: a rotation, then a translation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Motion {
    turn: Point2,
    shift: Point2,
}

impl Motion {
    const IDENTITY: Motion = Motion {
        turn: Complex::new(1.0, 0.0),
        shift: Complex::new(0.0, 0.0),
    };

    pub(super) fn of(&self, p: Point2) -> Point2 {
        self.turn * p + self.shift
    }

    /// The motion that takes a segment to another one of the same length.
    fn between([a, b]: [Point2; 2], [c, d]: [Point2; 2]) -> Motion {
        let turn = (d - c) * (b - a).conj();
        let turn = turn / turn.norm();
        // Midpoints meet, so that rounding is shared by both ends.
        Motion {
            turn,
            shift: 0.5 * (c + d) - turn * (0.5 * (a + b)),
        }
    }

    fn after(&self, first: &Motion) -> Motion {
        let turn = self.turn * first.turn;
        Motion {
            turn: turn / turn.norm(),
            shift: self.of(first.shift),
        }
    }
}

/// A line along which two facets meet.
pub(super) struct Hinge {
    pub facets: [u32; 2],
    /// A half-edge along the line, of the first facet.
    side: u32,
    length: f64,
}

/// The hinges of a polyhedron, the longest first. Two facets that meet along several lines have several.
fn hinges(solid: &Polyhedron) -> Vec<Hinge> {
    let mut between: FxHashMap<[u32; 2], (u32, f64, f64)> = FxHashMap::default();
    for (side, twin) in (0u32..).zip(&solid.twins) {
        if *twin == NO_INDEX || solid.facet(side) >= solid.facet(*twin) {
            continue;
        }
        let [a, b] = solid.ends(side);
        let long = (b - a).norm();
        let key = [solid.facet(side), solid.facet(*twin)];
        let found = between.entry(key).or_insert((side, long, 0.0));
        found.2 += long;
        // The longest edge gives the direction best.
        if long > found.1 {
            (found.0, found.1) = (side, long);
        }
    }
    let all = between.into_iter();
    let mut hinges: Vec<Hinge> = all
        .map(|(facets, (side, _, length))| Hinge {
            facets,
            side,
            length,
        })
        .collect();
    hinges.sort_by(|a, b| b.length.total_cmp(&a.length).then(a.facets.cmp(&b.facets)));
    hinges
}

/// A piece of a net: its facets, and which of its triangles touch each cell of a grid.
#[derive(Clone, Default)]
struct Piece {
    facets: Vec<u32>,
    grid: FxHashMap<[i32; 2], Vec<u32>>,
}

/// A forest of hinges that places all facets, with the pieces that it makes of them.
pub(super) struct Net<'a> {
    solid: &'a Polyhedron,
    hinges: Vec<Hinge>,
    triangles: Vec<Vec<u32>>,
    /// Numbers of each facet's hinges.
    around: Vec<Vec<u32>>,
    is_joined: Vec<bool>,
    motions: Vec<Motion>,
    piece_of: Vec<u32>,
    pieces: Vec<Piece>,
    cell: f64,
    /// Width and height within which each piece has to lie, if it has to.
    room: Option<[f64; 2]>,
    work: usize,
}

impl<'a> Net<'a> {
    /// Places the facets of a polyhedron so that few pieces arise and short cuts between them; each piece lies within
    /// `room`, width and height in either order, if that is given and no single facet is larger.
    pub(super) fn new(solid: &'a Polyhedron, room: Option<[f64; 2]>) -> Net<'a> {
        let hinges = hinges(solid);
        let count = solid.normals.len();
        let mut triangles = vec![Vec::new(); count];
        for (t, facet) in (0u32..).zip(&solid.facets) {
            triangles[*facet as usize].push(t);
        }
        let mut around = vec![Vec::new(); count];
        for (number, hinge) in (0u32..).zip(&hinges) {
            hinge
                .facets
                .iter()
                .for_each(|facet| around[*facet as usize].push(number));
        }
        let area: f64 = solid.areas.iter().sum();
        let mut net = Net {
            solid,
            is_joined: vec![false; hinges.len()],
            hinges,
            triangles,
            around,
            motions: vec![Motion::IDENTITY; count],
            piece_of: (0..count as u32).collect(),
            pieces: vec![Piece::default(); count],
            cell: (area / solid.triangles.len() as f64)
                .sqrt()
                .max(MIN_CELL_ROUNDINGS * solid.rounding),
            room,
            work: 0,
        };
        for facet in 0..count as u32 {
            net.insert(facet, facet);
        }
        for hinge in 0..net.hinges.len() {
            net.join(hinge);
        }
        net.improve();
        net
    }

    /// The facets of each piece, the largest piece first.
    pub(super) fn pieces(&self) -> Vec<Vec<u32>> {
        let mut pieces: Vec<Vec<u32>> = (self.pieces.iter())
            .filter(|piece| !piece.facets.is_empty())
            .map(|piece| piece.facets.clone())
            .collect();
        let area = |facets: &[u32]| -> f64 {
            facets
                .iter()
                .map(|facet| self.solid.areas[*facet as usize])
                .sum()
        };
        pieces.sort_by(|a, b| area(b).total_cmp(&area(a)).then(a.cmp(b)));
        pieces
    }

    /// Positions of a triangle's corners in its piece.
    pub(super) fn placed(&self, triangle: u32) -> [Point2; 3] {
        let motion = self.motions[self.solid.facets[triangle as usize] as usize];
        self.solid.flat[triangle as usize].map(|p| motion.of(p))
    }

    pub(super) fn placed_ends(&self, half_edge: u32) -> [Point2; 2] {
        let motion = self.motions[self.solid.facet(half_edge) as usize];
        self.solid.flat_ends(half_edge).map(|p| motion.of(p))
    }

    /// Whether both sides of an edge lie on each other, so that it is no cut.
    pub(super) fn is_closed(&self, half_edge: u32) -> bool {
        let twin = self.solid.twins[half_edge as usize];
        if twin == NO_INDEX {
            return false;
        }
        let [one, other] =
            [half_edge, twin].map(|side| self.piece_of[self.solid.facet(side) as usize]);
        let ([a, b], [d, c]) = (self.placed_ends(half_edge), self.placed_ends(twin));
        let near = self.solid.rounding;
        one == other && (a - c).norm() <= near && (b - d).norm() <= near
    }

    /// Cells that the bounding box of a triangle touches.
    fn cells(&self, corners: &[Point2; 3]) -> impl Iterator<Item = [i32; 2]> + use<> {
        let range = |of: fn(&Point2) -> f64| {
            let all = corners.iter().map(of);
            let low = all.clone().fold(f64::INFINITY, f64::min);
            let high = all.fold(f64::NEG_INFINITY, f64::max);
            (low / self.cell).floor() as i32..=(high / self.cell).floor() as i32
        };
        let (xs, ys) = (range(|p| p.re), range(|p| p.im));
        xs.flat_map(move |x| ys.clone().map(move |y| [x, y]))
    }

    fn insert(&mut self, piece: u32, facet: u32) {
        self.piece_of[facet as usize] = piece;
        let mut own = std::mem::take(&mut self.pieces[piece as usize]);
        own.facets.push(facet);
        for triangle in &self.triangles[facet as usize] {
            for cell in self.cells(&self.placed(*triangle)) {
                own.grid.entry(cell).or_default().push(*triangle);
                self.work += 1;
            }
        }
        self.pieces[piece as usize] = own;
    }

    /// Joins the pieces on both sides of a hinge if nothing comes to lie on anything else.
    fn join(&mut self, number: usize) {
        let hinge = &self.hinges[number];
        let twin = self.solid.twins[hinge.side as usize];
        let [mut from, mut to] = [twin, hinge.side];
        let piece = |side: u32| self.piece_of[self.solid.facet(side) as usize];
        if piece(from) == piece(to) {
            return;
        }
        let size = |side: u32| self.pieces[piece(side) as usize].facets.len();
        if size(from) > size(to) {
            std::mem::swap(&mut from, &mut to);
        }
        let ([a, b], [d, c]) = (self.placed_ends(from), self.placed_ends(to));
        let motion = Motion::between([a, b], [c, d]);
        let (small, large) = (piece(from), piece(to));
        if self.overlaps(small, large, &motion) || !self.fits(small, large, &motion) {
            return;
        }
        for facet in std::mem::take(&mut self.pieces[small as usize]).facets {
            let own = &mut self.motions[facet as usize];
            *own = motion.after(own);
            self.insert(large, facet);
        }
        self.is_joined[number] = true;
    }

    fn overlaps(&mut self, small: u32, large: u32, motion: &Motion) -> bool {
        let grid = &self.pieces[large as usize].grid;
        let mut work = 0;
        let facets = self.pieces[small as usize].facets.iter();
        let mut triangles = facets.flat_map(|facet| &self.triangles[*facet as usize]);
        let found = triangles.any(|triangle| {
            let corners = self.placed(*triangle).map(|p| motion.of(p));
            let near = self.cells(&corners).filter_map(|cell| grid.get(&cell));
            near.flatten().any(|other| {
                work += 1;
                overlap(&corners, &self.placed(*other), 2.0 * self.solid.rounding)
            })
        });
        self.work += work;
        found
    }

    fn fits(&mut self, small: u32, large: u32, motion: &Motion) -> bool {
        let Some(room) = self.room else {
            return true;
        };
        let mut all: Vec<[f64; 2]> = Vec::new();
        for (piece, motion) in [(small, motion), (large, &Motion::IDENTITY)] {
            let facets = self.pieces[piece as usize].facets.iter();
            for triangle in facets.flat_map(|facet| &self.triangles[*facet as usize]) {
                let corners = self.placed(*triangle).map(|p| motion.of(p));
                all.extend(corners.map(|p| [p.re, p.im]));
            }
        }
        let work = all.len();
        let sorted = |[a, b]: [f64; 2]| [f64::min(a, b), f64::max(a, b)];
        let ([a, b], [c, d]) = (sorted(LeastBox::around(all).size), sorted(room));
        self.work += work;
        a <= c && b <= d
    }

    /// Number of pieces, and length of all cuts.
    fn cost(&self, pieces: usize) -> (usize, f64) {
        let cut = self
            .hinges
            .iter()
            .zip(&self.is_joined)
            .filter(|(_, joined)| !**joined);
        let open = cut.filter(|(hinge, _)| !self.is_closed(hinge.side));
        (pieces, open.map(|(hinge, _)| hinge.length).sum())
    }

    /// Takes the net apart around one cut after another and joins it again in another order; keeps what is better
    /// (ruin and recreate).
    fn improve(&mut self) {
        let mut random = Rand64::new(0);
        let count = |net: &Net| {
            net.pieces
                .iter()
                .filter(|piece| !piece.facets.is_empty())
                .count()
        };
        let mut best = self.cost(count(self));
        let limit = self.work + SEARCH_WORK;
        loop {
            let cuts: Vec<u32> = (0..self.hinges.len() as u32)
                .filter(|hinge| {
                    let hinge = *hinge as usize;
                    !self.is_joined[hinge] && !self.is_closed(self.hinges[hinge].side)
                })
                .collect();
            // A longest forest of one piece has no better one.
            let longest = (self.hinges.iter().zip(&self.is_joined))
                .take_while(|(_, joined)| **joined)
                .count();
            if cuts.is_empty() || self.work >= limit || longest + cuts.len() == self.hinges.len() {
                return;
            }
            let between: Vec<u32> = (cuts.iter().copied())
                .filter(|hinge| {
                    let [a, b] = self.hinges[*hinge as usize]
                        .facets
                        .map(|f| self.piece_of[f as usize]);
                    a != b
                })
                .collect();
            let from = match !between.is_empty() && random.rand_range(0..4) > 0 {
                true => &between,
                false => &cuts,
            };
            let start = from[random.rand_range(0..from.len() as u64) as usize];
            let radius = random.rand_range(0..MAX_RUIN_RADIUS + 1);
            self.work += self.hinges.len() / 8;
            let saved = self.ruin(start, radius);
            let mut order: Vec<(f64, u32)> = (saved.hinges.iter())
                .map(|hinge| {
                    (
                        self.hinges[*hinge as usize].length * (0.3 + random.rand_float()),
                        *hinge,
                    )
                })
                .collect();
            // The cut about which all was taken apart comes first.
            order
                .iter_mut()
                .filter(|(_, hinge)| *hinge == start)
                .for_each(|(w, _)| *w = f64::INFINITY);
            order.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
            for (_, hinge) in order {
                self.join(hinge as usize);
            }
            let found = self.cost(count(self));
            let is_better = found.0 < best.0 || (found.0 == best.0 && found.1 <= best.1);
            match is_better {
                true => best = found,
                false => self.restore(saved),
            }
        }
    }

    /// Removes the joined hinges near a cut, and makes the pieces that it touches anew without them.
    fn ruin(&mut self, start: u32, radius: u64) -> Saved {
        let mut near: Vec<u32> = self.hinges[start as usize].facets.to_vec();
        let mut first = 0;
        for _ in 0..radius {
            let last = near.len();
            for k in first..last {
                for hinge in &self.around[near[k] as usize] {
                    for facet in self.hinges[*hinge as usize].facets {
                        if !near.contains(&facet) {
                            near.push(facet);
                        }
                    }
                }
            }
            first = last;
        }
        let mut touched: Vec<u32> = near
            .iter()
            .map(|facet| self.piece_of[*facet as usize])
            .collect();
        touched.sort_unstable();
        touched.dedup();
        let mut saved = Saved::default();
        for piece in &touched {
            let own = std::mem::take(&mut self.pieces[*piece as usize]);
            for facet in &own.facets {
                saved
                    .facets
                    .push((*facet, *piece, self.motions[*facet as usize]));
                self.piece_of[*facet as usize] = NO_INDEX;
            }
            saved.pieces.push((*piece, own));
        }
        for (facet, ..) in &saved.facets {
            saved.hinges.extend(&self.around[*facet as usize]);
        }
        saved.hinges.sort_unstable();
        saved.hinges.dedup();
        let is_touched = |facet: u32| self.piece_of[facet as usize] == NO_INDEX;
        saved.hinges.retain(|hinge| {
            self.hinges[*hinge as usize]
                .facets
                .iter()
                .all(|f| is_touched(*f))
        });
        saved.joined = saved
            .hinges
            .iter()
            .map(|hinge| self.is_joined[*hinge as usize])
            .collect();
        for facet in near {
            for hinge in &self.around[facet as usize] {
                self.is_joined[*hinge as usize] = false;
            }
        }
        // Connected parts of what is left, each a piece with the number of its first facet.
        for k in 0..saved.facets.len() {
            let facet = saved.facets[k].0;
            if self.piece_of[facet as usize] != NO_INDEX {
                continue;
            }
            let mut open = vec![facet];
            self.piece_of[facet as usize] = facet;
            while let Some(next) = open.pop() {
                self.insert(facet, next);
                for hinge in &self.around[next as usize] {
                    if !self.is_joined[*hinge as usize] {
                        continue;
                    }
                    for other in self.hinges[*hinge as usize].facets {
                        if self.piece_of[other as usize] == NO_INDEX {
                            self.piece_of[other as usize] = facet;
                            open.push(other);
                        }
                    }
                }
            }
        }
        saved
    }

    fn restore(&mut self, saved: Saved) {
        for (facet, ..) in &saved.facets {
            let piece = self.piece_of[*facet as usize];
            self.pieces[piece as usize] = Piece::default();
        }
        for (facet, piece, motion) in saved.facets {
            self.piece_of[facet as usize] = piece;
            self.motions[facet as usize] = motion;
        }
        for (piece, own) in saved.pieces {
            self.pieces[piece as usize] = own;
        }
        for (hinge, joined) in saved.hinges.iter().zip(saved.joined) {
            self.is_joined[*hinge as usize] = joined;
        }
    }
}

/// The part of a net that was taken apart, as it was before.
#[derive(Default)]
struct Saved {
    facets: Vec<(u32, u32, Motion)>,
    pieces: Vec<(u32, Piece)>,
    hinges: Vec<u32>,
    joined: Vec<bool>,
}

/// Whether two triangles overlap by more than a depth (separating axes: some line along a side has one on either side).
fn overlap(one: &[Point2; 3], other: &[Point2; 3], depth: f64) -> bool {
    let is_apart = |p: &[Point2; 3], q: &[Point2; 3]| {
        (0..3).any(|k| {
            let (a, b, c) = (p[k], p[(k + 1) % 3], p[(k + 2) % 3]);
            let along = b - a;
            let long = along.norm();
            // Which side of the line the own triangle is on: left, as all are anticlockwise, or nowhere.
            let farthest = q
                .iter()
                .map(|v| cross(along, v - a))
                .fold(f64::NEG_INFINITY, f64::max);
            farthest <= depth * long || cross(along, c - a) <= depth * long
        })
    };
    !is_apart(one, other) && !is_apart(other, one)
}

//! Nets: facets placed in the plane by rigid motions along a forest of hinges, without overlaps.

use std::f64::consts::PI;

use rustc_hash::{FxHashMap, FxHashSet};

use crate::error::{Error, Result};
use crate::math::index::NO_INDEX;
use crate::math::motion::Motion;
use crate::math::planar::{LeastBox, Point2, cross};
use crate::scene::polyhedron::Polyhedron;

/// Maximum number of cells of all grids for each triangle. Slender triangles get larger cells.
const MAX_CELLS_PER_TRIANGLE: f64 = 64.0;

/// Surcharge for a cut between facets that meet flat over one of the same length between facets that fold onto each other, as a
/// share: of edges that are equally long a sharp one is cut, and no smooth bend.
/// `benches/patterns.md` has what others give.
const MAX_FLAT_SURCHARGE: f64 = 1e-3;

/// A line along which two facets meet.
pub(super) struct Hinge {
    pub facets: [u32; 2],
    /// A half-edge along the line, of the first facet.
    pub side: u32,
    /// Cost of a cut along the line: its length, and up to [`MAX_FLAT_SURCHARGE`] more the flatter the facets meet.
    pub cost: f64,
}

/// The hinges of a polyhedron, the costliest to cut first. Two facets that meet along several lines have one hinge, as long as
/// all of them.
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
    let surcharge = |side| MAX_FLAT_SURCHARGE * (1.0 - solid.angle(side).abs() / PI);
    let mut hinges: Vec<Hinge> = (between.into_iter())
        .map(|(facets, (side, _, length))| Hinge {
            facets,
            side,
            cost: length * (1.0 + surcharge(side)),
        })
        .collect();
    hinges.sort_by(|a, b| b.cost.total_cmp(&a.cost).then(a.facets.cmp(&b.facets)));
    hinges
}

/// Pairs of facets, the lower number first, whose common edges are to be cut or not to be.
#[derive(Default)]
pub(super) struct EdgeChoices {
    pub cut: FxHashSet<[u32; 2]>,
    pub join: FxHashSet<[u32; 2]>,
}

/// A piece of a net: its facets, and which of its triangles touch each cell of a grid.
#[derive(Default)]
pub(super) struct Piece {
    pub facets: Vec<u32>,
    /// Number of the facets' triangles.
    triangles: usize,
    grid: FxHashMap<[i32; 2], Vec<u32>>,
}

/// A forest of hinges that places all facets, with the pieces that it makes of them.
pub(super) struct Net<'a> {
    pub(super) solid: &'a Polyhedron,
    pub(super) hinges: Vec<Hinge>,
    triangles: Vec<Vec<u32>>,
    /// Numbers of each facet's hinges.
    pub(super) around: Vec<Vec<u32>>,
    pub(super) is_joined: Vec<bool>,
    pub(super) motions: Vec<Motion>,
    pub(super) piece_of: Vec<u32>,
    pub(super) pieces: Vec<Piece>,
    cell: f64,
    /// The last comparison of a triangle with others in which each triangle took part, of so many.
    compared: Vec<usize>,
    comparisons: usize,
    /// Width and height within which each piece has to lie, if it has to.
    room: Option<[f64; 2]>,
    pub(super) choices: EdgeChoices,
    pub(super) work: usize,
}

impl<'a> Net<'a> {
    /// Places the facets of a polyhedron so that few pieces arise and short cuts between them; each piece lies within
    /// `room`, width and height in either order, if that is given and no single facet is larger.
    ///
    /// # Errors
    /// [`Error::Unsupported`] if facets that are to be joined would lie on others.
    pub(super) fn new(
        solid: &'a Polyhedron,
        room: Option<[f64; 2]>,
        choices: EdgeChoices,
    ) -> Result<Net<'a>> {
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
        // A triangle touches about as many cells as lie in it and along its sides.
        let sides = 0..solid.twins.len() as u32;
        let length: f64 = sides.map(|side| solid.length(side)).sum();
        let mut net = Net {
            solid,
            is_joined: vec![false; hinges.len()],
            hinges,
            triangles,
            around,
            motions: vec![Motion::IDENTITY; count],
            piece_of: (0..count as u32).collect(),
            pieces: std::iter::repeat_with(Piece::default).take(count).collect(),
            cell: (area / solid.triangles.len() as f64)
                .sqrt()
                .max(length / (MAX_CELLS_PER_TRIANGLE * solid.triangles.len() as f64)),
            compared: vec![0; solid.triangles.len()],
            comparisons: 0,
            room,
            choices,
            work: 0,
        };
        for facet in 0..count as u32 {
            net.insert(facet, facet);
        }
        let (first, rest): (Vec<usize>, Vec<usize>) =
            (0..net.hinges.len()).partition(|hinge| net.is_to_be_joined(*hinge));
        first
            .into_iter()
            .chain(rest)
            .for_each(|hinge| net.join(hinge));
        net.improve()?;
        let is_open = net.open_joins().next().is_some();
        match is_open {
            false => Ok(net),
            true => Err(Error::Unsupported {
                format: "pattern",
                reason: "with all the edges of `join` as folds faces would lie on each other, or on no page; leave out some"
                    .into(),
            }),
        }
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
        self.solid.flat[triangle as usize].map(|p| motion.apply(p))
    }

    pub(super) fn placed_ends(&self, half_edge: u32) -> [Point2; 2] {
        let motion = self.motions[self.solid.facet(half_edge) as usize];
        self.solid.flat_ends(half_edge).map(|p| motion.apply(p))
    }

    pub(super) fn is_to_be_joined(&self, hinge: usize) -> bool {
        self.choices.join.contains(&self.hinges[hinge].facets)
    }

    /// Hinges that are to be joined and are open.
    pub(super) fn open_joins(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.hinges.len()).filter(|hinge| {
            self.is_to_be_joined(*hinge) && !self.is_closed(self.hinges[*hinge].side)
        })
    }

    /// Whether both sides of an edge lie on each other, so that it is no cut.
    pub(super) fn is_closed(&self, half_edge: u32) -> bool {
        let twin = self.solid.twins[half_edge as usize];
        if twin == NO_INDEX {
            return false;
        }
        let mut facets = [half_edge, twin].map(|side| self.solid.facet(side));
        facets.sort_unstable();
        if self.choices.cut.contains(&facets) {
            return false;
        }
        let [one, other] =
            [half_edge, twin].map(|side| self.piece_of[self.solid.facet(side) as usize]);
        let ([a, b], [d, c]) = (self.placed_ends(half_edge), self.placed_ends(twin));
        let near = self.solid.rounding;
        one == other && (a - c).norm() <= near && (b - d).norm() <= near
    }

    /// Cells of the grid that a triangle touches, row by row.
    fn cells(&self, corners: &[Point2; 3]) -> impl Iterator<Item = [i32; 2]> + use<> {
        let (cell, corners) = (self.cell, *corners);
        let number = move |v: f64| (v / cell).floor() as i32;
        let heights = corners.map(|p| p.im);
        let low = heights.iter().copied().fold(f64::INFINITY, f64::min);
        let high = heights.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        (number(low)..=number(high)).flat_map(move |row| {
            let [below, above] = [0, 1].map(|k| f64::from(row + k) * cell);
            // The ends of each side's part within the row.
            let ends = (0..3).flat_map(|k| {
                let (a, b) = (corners[k], corners[(k + 1) % 3]);
                let (low, high) = if a.im < b.im { (a, b) } else { (b, a) };
                let reach = if low.im > above || high.im < below {
                    0..0
                } else {
                    0..2
                };
                reach.map(move |end| {
                    let y = [below, above][end].clamp(low.im, high.im);
                    match high.im > low.im {
                        true => low.re + (high.re - low.re) * ((y - low.im) / (high.im - low.im)),
                        false => [low.re, high.re][end],
                    }
                })
            });
            let [left, right] = ends
                .fold([f64::INFINITY, f64::NEG_INFINITY], |[left, right], x| {
                    [left.min(x), right.max(x)]
                });
            (number(left)..=number(right)).map(move |column| [column, row])
        })
    }

    pub(super) fn insert(&mut self, piece: u32, facet: u32) {
        self.piece_of[facet as usize] = piece;
        let mut own = std::mem::take(&mut self.pieces[piece as usize]);
        own.facets.push(facet);
        own.triangles += self.triangles[facet as usize].len();
        for triangle in &self.triangles[facet as usize] {
            for cell in self.cells(&self.placed(*triangle)) {
                own.grid.entry(cell).or_default().push(*triangle);
                self.work += 1;
            }
        }
        self.pieces[piece as usize] = own;
    }

    /// Takes facets out of their pieces.
    pub(super) fn remove(&mut self, facets: &[u32]) {
        let mut touched: Vec<u32> = Vec::new();
        for facet in facets {
            let piece = std::mem::replace(&mut self.piece_of[*facet as usize], NO_INDEX);
            touched.push(piece);
            let mut own = std::mem::take(&mut self.pieces[piece as usize]);
            own.triangles -= self.triangles[*facet as usize].len();
            for triangle in &self.triangles[*facet as usize] {
                for cell in self.cells(&self.placed(*triangle)) {
                    own.grid.entry(cell).or_default().retain(|t| t != triangle);
                    self.work += 1;
                }
            }
            self.pieces[piece as usize] = own;
        }
        touched.sort_unstable();
        touched.dedup();
        for piece in touched {
            let own = &mut self.pieces[piece as usize];
            own.facets
                .retain(|facet| self.piece_of[*facet as usize] == piece);
            if own.facets.is_empty() {
                *own = Piece::default();
            }
        }
    }

    /// Joins the pieces on both sides of a hinge if nothing comes to lie on anything else.
    pub(super) fn join(&mut self, number: usize) {
        let hinge = &self.hinges[number];
        if self.choices.cut.contains(&hinge.facets) {
            return;
        }
        let twin = self.solid.twins[hinge.side as usize];
        let [mut from, mut to] = [twin, hinge.side];
        let piece = |side: u32| self.piece_of[self.solid.facet(side) as usize];
        if piece(from) == piece(to) {
            return;
        }
        let size = |side: u32| self.pieces[piece(side) as usize].triangles;
        if size(from) > size(to) {
            std::mem::swap(&mut from, &mut to);
        }
        let ([a, b], [d, c]) = (self.placed_ends(from), self.placed_ends(to));
        let motion = Motion::between(&[a, b], &[c, d]);
        let (small, large) = (piece(from), piece(to));
        if self.overlaps(small, large, &motion) || !self.fits(small, large, &motion) {
            return;
        }
        for facet in std::mem::take(&mut self.pieces[small as usize]).facets {
            let own = &mut self.motions[facet as usize];
            *own = own.then(&motion);
            self.insert(large, facet);
        }
        self.is_joined[number] = true;
    }

    fn overlaps(&mut self, small: u32, large: u32, motion: &Motion) -> bool {
        let grid = &self.pieces[large as usize].grid;
        let mut compared = std::mem::take(&mut self.compared);
        let (mut work, mut number) = (0, self.comparisons);
        let facets = self.pieces[small as usize].facets.iter();
        let mut triangles = facets.flat_map(|facet| &self.triangles[*facet as usize]);
        let found = triangles.any(|triangle| {
            number += 1;
            let corners = self.placed(*triangle).map(|p| motion.apply(p));
            let near = self.cells(&corners).filter_map(|cell| grid.get(&cell));
            near.flatten().any(|other| {
                work += 1;
                // Triangles that share many cells are compared once.
                std::mem::replace(&mut compared[*other as usize], number) != number
                    && overlap(&corners, &self.placed(*other), 2.0 * self.solid.rounding)
            })
        });
        (self.compared, self.comparisons) = (compared, number);
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
                let corners = self.placed(*triangle).map(|p| motion.apply(p));
                all.extend(corners.map(|p| [p.re, p.im]));
            }
        }
        let work = all.len();
        let sorted = |[a, b]: [f64; 2]| [f64::min(a, b), f64::max(a, b)];
        let ([a, b], [c, d]) = (sorted(LeastBox::around(all).size), sorted(room));
        self.work += work;
        a <= c && b <= d
    }
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::mesh::Mesh;

    #[test]
    fn slender_triangles_do_not_fill_the_grid() {
        // A fan of slivers in all directions, each a hundred thousand times as long as wide.
        let count = 200;
        let mut points = Vec::new();
        let mut triangles = Vec::new();
        for k in 0..count {
            let (sin, cos) = (0.03 * f64::from(k)).sin_cos();
            let first = 3 * k as u32;
            let high = f64::from(k);
            points.extend([
                [0.0, 0.0, high],
                [1e3 * cos, 1e3 * sin, high],
                [1e3 * cos - 1e-2 * sin, 1e3 * sin + 1e-2 * cos, high],
            ]);
            triangles.push([first, first + 1, first + 2]);
        }
        let solid = Polyhedron::new(&Mesh::new(points, triangles).unwrap()).unwrap();
        let net = Net::new(&solid, None, EdgeChoices::default()).unwrap();
        let cells: usize = net.pieces.iter().map(|piece| piece.grid.len()).sum();
        assert!(cells as f64 <= 64.0 * f64::from(count) + 1e6, "{cells}");
        // Each sliver touches the cells along it, and not those of its bounding box.
        assert!(cells < 2_000 * count as usize, "{cells}");
    }
}

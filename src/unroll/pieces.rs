//! The triangles laid flat one by one: what the unrolled sheet would have to be made of.
//!
//! The plane is that of the complex numbers, where a rotation is a number of modulus 1.

use nalgebra::{Complex, Vector3};

use super::grid::Grid;
use crate::error::{Error, Result, try_filled};

pub(crate) type Point = Complex<f64>;

/// A triangle in the plane, its corners counted counter-clockwise: the first at 0, the second on
/// the positive real axis. Lengths are in units of the lattice spacing. All zero where there is
/// no triangle, so that it weighs nothing.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct Piece {
    /// The second corner.
    pub(super) second: f64,
    /// The third corner.
    pub(super) third: Point,
    /// Half the cotangents of the angles opposite the edges 1–2, 2–3 and 3–1.
    pub(super) weights: [f64; 3],
}

impl Piece {
    /// The triangle over one of the lattice, from the rises along its edges 1–2 and 1–3.
    fn new(rise2: f64, rise3: f64) -> Self {
        // In plan the edges are unit vectors at 60°.
        let (square2, square3) = (1.0 + rise2 * rise2, 1.0 + rise3 * rise3);
        let dot = 0.5 + rise2 * rise3;
        let second = square2.sqrt();
        // Twice the area: no cancellation, unlike `square2 · square3 − dot²`.
        let doubled = (0.75 + rise2 * rise2 + rise3 * rise3 - rise2 * rise3).sqrt();
        let half = 0.5 / doubled;
        Piece {
            second,
            third: Point::new(dot / second, doubled / second),
            weights: [square3 - dot, dot, square2 - dot].map(|cosine| half * cosine),
        }
    }

    /// The triangle between three points in space, in their own unit; all zero if it has no area.
    pub(crate) fn between([a, b, c]: [[f64; 3]; 3]) -> Self {
        let edge = |p: [f64; 3], q: [f64; 3]| [0, 1, 2].map(|k| q[k] - p[k]);
        let dot = |u: [f64; 3], v: [f64; 3]| u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
        let (ab, ac) = (edge(a, b), edge(a, c));
        let (square2, square3, cosine) = (dot(ab, ab), dot(ac, ac), dot(ab, ac));
        let cross = [0, 1, 2].map(|k| {
            let (i, j) = ((k + 1) % 3, (k + 2) % 3);
            ab[i] * ac[j] - ab[j] * ac[i]
        });
        let doubled = dot(cross, cross).sqrt();
        if !(doubled > 0.0 && doubled.is_finite()) {
            return Piece::default();
        }
        let (second, half) = (square2.sqrt(), 0.5 / doubled);
        Piece {
            second,
            third: Point::new(cosine / second, doubled / second),
            weights: [square3 - cosine, cosine, square2 - cosine].map(|c| half * c),
        }
    }

    pub(crate) fn exists(&self) -> bool {
        self.second > 0.0
    }

    /// Its third corner, where the first one is at 0 and the second one at 1.
    pub(crate) fn third_corner(&self) -> Point {
        self.third / self.second
    }

    pub(crate) fn area(&self) -> f64 {
        0.5 * self.second * self.third.im
    }
}

/// A piece by its first corner's cell, and whether it is the one to the east.
pub(super) type Name = (usize, usize);

/// The pieces of a surface: two for each cell `v`, `[v, SW, SE]` and `[v, SE, E]`.
#[derive(Debug, Clone)]
pub(super) struct Pieces {
    pub grid: Grid,
    pub of: Vec<[Piece; 2]>,
    /// Sum of their areas.
    pub area: f64,
}

impl Pieces {
    /// From heights in units of the spacing, NaN where there is none and in all padding, for those
    /// triangles that are `wanted`.
    pub(super) fn new(grid: Grid, heights: &[f64], wanted: impl Fn(Name) -> bool) -> Result<Self> {
        let mut of = try_filled("unrolling", grid.cells(), [Piece::default(); 2])?;
        let mut area = 0.0;
        for row in 0..grid.rows() {
            let offsets = grid.offsets(row);
            for cell in grid.row(row) {
                let rise =
                    |offset: isize| heights[cell.wrapping_add_signed(offset)] - heights[cell];
                let [sw, se, e] = [rise(offsets.south_west), rise(offsets.south_east), rise(1)];
                let rises = [[sw, se], [se, e]].into_iter().enumerate();
                for (piece, (side, [a, b])) in of[cell].iter_mut().zip(rises) {
                    if !(a.is_nan() || b.is_nan()) && wanted((cell, side)) {
                        *piece = Piece::new(a, b);
                        area += piece.area();
                    }
                }
            }
        }
        if !area.is_finite() {
            return Err(Error::Overflow { spacing: 1.0 });
        }
        Ok(Pieces { grid, of, area })
    }

    /// The pieces there are.
    pub(super) fn names(&self) -> impl Iterator<Item = Name> + '_ {
        let cells = (0..self.grid.rows()).flat_map(|row| self.grid.row(row));
        cells
            .flat_map(|cell| [(cell, 0), (cell, 1)])
            .filter(|name| self.get(*name).exists())
    }

    pub(super) fn get(&self, (cell, side): Name) -> &Piece {
        &self.of[cell][side]
    }

    /// The cells of the corners of a piece.
    pub(super) fn corners(&self, (cell, side): Name) -> [usize; 3] {
        let offsets = self.grid.offsets(self.grid.vertex(cell).0);
        let south_east = cell.wrapping_add_signed(offsets.south_east);
        match side {
            0 => [
                cell,
                cell.wrapping_add_signed(offsets.south_west),
                south_east,
            ],
            _ => [cell, south_east, cell + 1],
        }
    }

    /// The pieces that have a cell for a corner.
    pub(super) fn around(&self, cell: usize) -> impl Iterator<Item = Name> + '_ {
        let offsets = self.grid.offsets(self.grid.vertex(cell).0);
        let ne = cell.wrapping_add_signed(offsets.north_east);
        let nw = cell.wrapping_add_signed(offsets.north_west);
        [
            (cell, 0),
            (cell, 1),
            (ne, 0),
            (nw, 0),
            (nw, 1),
            (cell - 1, 1),
        ]
        .into_iter()
        .filter(|name| self.get(*name).exists())
    }

    /// The edges with a piece on one side only, as cells in the order in which that has them.
    pub(super) fn border(&self) -> impl Iterator<Item = [usize; 2]> + '_ {
        self.names().flat_map(|name| {
            let [a, b, c] = self.corners(name);
            let north_east = self.grid.offsets(self.grid.vertex(a).0).north_east;
            let beyond = match name.1 {
                0 => [(a - 1, 1), (b, 1), (a, 1)],
                _ => [(a, 0), (c, 0), (a.wrapping_add_signed(north_east), 0)],
            };
            let edges = [[a, b], [b, c], [c, a]].into_iter().zip(beyond);
            edges
                .filter(|(_, other)| !self.get(*other).exists())
                .map(|(edge, _)| edge)
        })
    }

    /// How far the pieces are from fitting together at the given places of the vertices, each
    /// turned as it fits best (Liu et al. 2008, Eq. 3 and 6): the sum of `area · ‖J − R‖²`.
    /// `pull` becomes minus half its gradient.
    pub(super) fn pull(&self, places: &[Point], pull: &mut [Point]) -> f64 {
        pull.fill(Point::default());
        let mut energy = 0.0;
        for row in 0..self.grid.rows() {
            let offsets = self.grid.offsets(row);
            for cell in self.grid.row(row) {
                let [down, side] = &self.of[cell];
                let se = cell.wrapping_add_signed(offsets.south_east);
                if down.exists() {
                    let sw = cell.wrapping_add_signed(offsets.south_west);
                    energy += down.pull(places, pull, [cell, sw, se]);
                }
                if side.exists() {
                    energy += side.pull(places, pull, [cell, se, cell + 1]);
                }
            }
        }
        energy
    }
}

impl Piece {
    #[inline(always)]
    pub(super) fn pull(&self, places: &[Point], pull: &mut [Point], [a, b, c]: [usize; 3]) -> f64 {
        let [wab, wbc, wca] = self.weights;
        let (ab, ac) = (places[b] - places[a], places[c] - places[a]);
        let bc = ac - ab;
        let own_bc = self.third - self.second;
        // The best rotation: the direction of the weighted correlation of the edges.
        let correlation =
            ab * (wab * self.second) + bc * own_bc.conj() * wbc + ac * self.third.conj() * wca;
        let square = correlation.norm_sqr();
        let turn = if square > 0.0 {
            correlation * (1.0 / square.sqrt())
        } else {
            Point::new(1.0, 0.0)
        };
        let (dab, dbc, dac) = (
            turn * self.second - ab,
            turn * own_bc - bc,
            turn * self.third - ac,
        );
        let (pab, pbc, pac) = (dab * wab, dbc * wbc, dac * wca);
        pull[a] -= pab + pac;
        pull[b] += pab - pbc;
        pull[c] += pac + pbc;
        wab * dab.norm_sqr() + wbc * dbc.norm_sqr() + wca * dac.norm_sqr()
    }

    /// The same for places in space. ‖J − R‖² is smallest for the polar factor of `J`'s correlation.
    pub(super) fn pull_in_space(
        &self,
        places: &[Vector3<f64>],
        pull: &mut [Vector3<f64>],
        [a, b, c]: [usize; 3],
    ) -> f64 {
        let [wab, wbc, wca] = self.weights;
        let (ab, ac) = (places[b] - places[a], places[c] - places[a]);
        let bc = ac - ab;
        let own_bc = self.third - self.second;
        let first = ab * (wab * self.second) + bc * (wbc * own_bc.re) + ac * (wca * self.third.re);
        let second = bc * (wbc * own_bc.im) + ac * (wca * self.third.im);
        let (p, q, r) = (
            first.norm_squared(),
            first.dot(&second),
            second.norm_squared(),
        );
        // The root of the symmetric 2×2 matrix, and its inverse.
        let root = (p * r - q * q).max(0.0).sqrt();
        let trace = (p + r + 2.0 * root).sqrt();
        let (s, t, u) = ((p + root) / trace, q / trace, (r + root) / trace);
        let determinant = s * u - t * t;
        if !(determinant > 0.0 && determinant.is_finite()) {
            return 0.0;
        }
        let right = (first * u - second * t) / determinant;
        let up = (second * s - first * t) / determinant;
        let dab = right * self.second - ab;
        let dbc = right * own_bc.re + up * own_bc.im - bc;
        let dac = right * self.third.re + up * self.third.im - ac;
        let (pab, pbc, pac) = (dab * wab, dbc * wbc, dac * wca);
        pull[a] -= pab + pac;
        pull[b] += pab - pbc;
        pull[c] += pac + pbc;
        wab * dab.norm_squared() + wbc * dbc.norm_squared() + wca * dac.norm_squared()
    }

    /// Singular values of the map from the piece to three places, the second one negative where
    /// it turns the piece over.
    pub(crate) fn stretches(&self, [a, b, c]: [Point; 3]) -> [f64; 2] {
        // The map is e ↦ αe + βē.
        let sum = (b - a) / self.second;
        let difference = ((c - a) - sum * self.third.re) / Point::new(0.0, self.third.im);
        let (alpha, beta) = (
            0.5 * (sum + difference).norm(),
            0.5 * (sum - difference).norm(),
        );
        [alpha + beta, alpha - beta]
    }
}

//! The triangles of a heightfield, each laid flat by itself.

use super::flat_triangle::{FlatTriangle, Point, Position};
use super::padded_lattice::PaddedLattice;
use crate::error::{Error, Result, try_filled};

/// Identifies a triangle of the lattice: the cell (index into the padded lattice) of its first corner, and 0 for the
/// triangle below that corner or 1 for the one beside it.
pub(super) type TriangleId = (usize, usize);

/// The triangles of a heightfield, each moved to a plane of its own: two for each cell `v` (a vertex's index in the
/// padded lattice), with the corners `[v, SW, SE]` and `[v, SE, E]`.
#[derive(Debug, Clone)]
pub(super) struct LatticeTriangles {
    pub grid: PaddedLattice,
    pub of: Vec<[FlatTriangle; 2]>,
    /// Sum of the triangles' areas, in units of the squared spacing.
    pub area: f64,
}

impl LatticeTriangles {
    /// Creates the flat triangles of a heightfield for which `wanted` is true. Heights are in units of the spacing, and
    /// NaN in the padding and where there is no data.
    ///
    /// # Errors
    /// [`Error::Overflow`] if areas are not finite, [`Error::OutOfMemory`].
    pub(super) fn new(
        grid: PaddedLattice,
        heights: &[f64],
        wanted: impl Fn(TriangleId) -> bool,
    ) -> Result<Self> {
        let mut of = try_filled("unrolling", grid.cells(), [FlatTriangle::default(); 2])?;
        let mut area = 0.0;
        for row in 0..grid.rows() {
            let offsets = grid.offsets(row);
            for cell in grid.row(row) {
                let rise =
                    |offset: isize| heights[cell.wrapping_add_signed(offset)] - heights[cell];
                let [sw, se, e] = [rise(offsets.south_west), rise(offsets.south_east), rise(1)];
                let rises = [[sw, se], [se, e]].into_iter().enumerate();
                for (triangle, (side, [a, b])) in of[cell].iter_mut().zip(rises) {
                    if !(a.is_nan() || b.is_nan()) && wanted((cell, side)) {
                        *triangle = FlatTriangle::from_rises(a, b);
                        area += triangle.area();
                    }
                }
            }
        }
        if !area.is_finite() {
            return Err(Error::Overflow { spacing: 1.0 });
        }
        Ok(LatticeTriangles { grid, of, area })
    }

    /// Lists all triangles of the lattice that exist.
    pub(super) fn ids(&self) -> impl Iterator<Item = TriangleId> + '_ {
        let cells = (0..self.grid.rows()).flat_map(|row| self.grid.row(row));
        cells
            .flat_map(|cell| [(cell, 0), (cell, 1)])
            .filter(|id| self.get(*id).exists())
    }

    pub(super) fn get(&self, (cell, side): TriangleId) -> &FlatTriangle {
        &self.of[cell][side]
    }

    /// Returns the cells (indices into the padded lattice) of a triangle's three corners.
    #[inline]
    pub(super) fn corners(&self, (cell, side): TriangleId) -> [usize; 3] {
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

    /// Lists the triangles of the lattice around a vertex.
    #[inline]
    pub(super) fn around(&self, cell: usize) -> impl Iterator<Item = TriangleId> + '_ {
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
        .filter(|id| self.get(*id).exists())
    }

    /// Finds the edges on the surface's border, which have a triangle on one side only, each directed as in that
    /// triangle.
    pub(super) fn border(&self) -> impl Iterator<Item = [usize; 2]> + '_ {
        self.ids().flat_map(|id| {
            let [a, b, c] = self.corners(id);
            let north_east = self.grid.offsets(self.grid.vertex(a).0).north_east;
            let beyond = match id.1 {
                0 => [(a - 1, 1), (b, 1), (a, 1)],
                _ => [(a, 0), (c, 0), (a.wrapping_add_signed(north_east), 0)],
            };
            let edges = [[a, b], [b, c], [c, a]].into_iter().zip(beyond);
            edges
                .filter(|(_, other)| !self.get(*other).exists())
                .map(|(edge, _)| edge)
        })
    }

    /// Computes the as-rigid-as-possible energy at given flat positions of the vertices: the sum of `area · ‖J − R‖²`
    /// over the triangles, each with its best rotation `R` (the local step; Liu et al. 2008, Eq. 3 and 6). Writes minus
    /// half the energy's gradient to `descent`.
    pub(super) fn energy(&self, places: &[Point], descent: &mut [Point]) -> f64 {
        descent.fill(Point::default());
        let mut energy = 0.0;
        for row in 0..self.grid.rows() {
            let offsets = self.grid.offsets(row);
            for cell in self.grid.row(row) {
                let [down, side] = &self.of[cell];
                let se = cell.wrapping_add_signed(offsets.south_east);
                if down.exists() {
                    let sw = cell.wrapping_add_signed(offsets.south_west);
                    energy += Point::local_step(down, places, descent, [cell, sw, se]);
                }
                if side.exists() {
                    energy += Point::local_step(side, places, descent, [cell, se, cell + 1]);
                }
            }
        }
        energy
    }
}

//! The hexagonal lattice: positions and neighbours of its vertices, and the triangle around a point.

use crate::error::{Error, Result, checked_cells, positive};

/// Distance between the rows of a lattice of spacing 1: `√3 / 2`.
pub(crate) const ROW_SPACING: f64 = 0.866_025_403_784_438_6;

/// A hexagonal lattice of `rows × cols` vertices, stored row by row.
///
/// Row 0 is at the top and `y` points up. Rows are `spacing · √3/2` apart and
/// every odd row is shifted to the left by half a spacing, so that vertex
/// `(r, c)` lies at
///
/// ```text
/// x = origin.x + (c − ½·(r odd)) · spacing
/// y = origin.y − r · spacing · √3/2
/// ```
///
/// and has its six neighbours, all at distance `spacing`, at
///
/// ```text
///     NW (r−1, c+o−1)   NE (r−1, c+o)
///  W (r, c−1)                  E (r, c+1)      o = 1 on even rows,
///     SW (r+1, c+o−1)   SE (r+1, c+o)          o = 0 on odd rows.
/// ```
///
/// Lengths are in the user's units. ([Paper](crate#references), Sec. 3.1.)
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lattice {
    rows: usize,
    cols: usize,
    spacing: f64,
    origin: [f64; 2],
}

/// The lattice triangle around a point of the plane: its three vertices (row, column), signed because they may lie
/// outside the lattice, and the point's barycentric coordinates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Located {
    pub vertices: [(isize, isize); 3],
    pub weights: [f64; 3],
}

impl Lattice {
    /// Makes a lattice whose vertex `(0, 0)` lies at the origin of the plane; `spacing` is the distance of neighbours.
    ///
    /// # Errors
    /// [`Error::Empty`] without rows or columns, [`Error::Option`] if `spacing` is not positive and finite,
    /// [`Error::TooLarge`] above [`MAX_CELLS`](crate::MAX_CELLS) vertices.
    pub fn new(rows: usize, cols: usize, spacing: f64) -> Result<Self> {
        if rows == 0 || cols == 0 {
            return Err(Error::Empty { what: "lattice" });
        }
        checked_cells("lattice", rows, cols)?;
        Ok(Lattice {
            rows,
            cols,
            spacing: positive("spacing", spacing)?,
            origin: [0.0, 0.0],
        })
    }

    /// Moves the lattice so that vertex `(0, 0)` lies at `origin`.
    ///
    /// # Errors
    /// [`Error::Option`] if `origin` is not finite.
    pub fn with_origin(self, origin: [f64; 2]) -> Result<Self> {
        if !origin.iter().all(|v| v.is_finite()) {
            return Err(Error::option("origin", origin, "must be finite"));
        }
        Ok(Lattice { origin, ..self })
    }

    /// Makes the smallest lattice with vertex `(0, 0)` at the top left corner of the box from `min` to `max` whose
    /// vertices reach every point of the box from inside it: no vertex lies more than one cell beyond it.
    ///
    /// # Errors
    /// As [`Lattice::new`]; the size is checked before anything is allocated.
    pub fn covering(min: [f64; 2], max: [f64; 2], spacing: f64) -> Result<Self> {
        let h = positive("spacing", spacing)?;
        let (width, height) = (max[0] - min[0], max[1] - min[1]);
        if !(width.is_finite() && height.is_finite() && width >= 0.0 && height >= 0.0) {
            return Err(Error::Empty {
                what: "the box to cover with a lattice",
            });
        }
        // A hair of tolerance: a box of exactly n cells takes n + 1 vertices, however it rounds.
        let cells = |length: f64, step: f64| (length / step + 1e-9).floor() + 1.0;
        // Odd rows are shifted to the left, so one more column lets them reach the right edge.
        let cols = cells(width, h) + 1.0;
        let rows = cells(height, h * ROW_SPACING);
        if rows * cols > crate::MAX_CELLS as f64 {
            return Err(Error::TooLarge {
                what: "lattice",
                requested: (rows * cols).min(usize::MAX as f64) as usize,
                limit: crate::MAX_CELLS,
            });
        }
        Lattice::new(rows as usize, cols as usize, h)?.with_origin([min[0], max[1]])
    }

    /// Number of rows of the lattice.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Number of vertices in each row.
    pub fn cols(&self) -> usize {
        self.cols
    }

    /// Number of vertices, `rows · cols`.
    #[allow(clippy::len_without_is_empty)] // never empty
    pub fn len(&self) -> usize {
        self.rows * self.cols
    }

    /// Distance between neighbouring vertices, in the user's unit of length.
    pub fn spacing(&self) -> f64 {
        self.spacing
    }

    /// Distance between neighbouring rows, `spacing · √3/2`.
    pub fn row_spacing(&self) -> f64 {
        self.spacing * ROW_SPACING
    }

    /// Position of vertex `(0, 0)` in the plane.
    pub fn origin(&self) -> [f64; 2] {
        self.origin
    }

    /// Position of vertex `(row, col)` in the plane, also for rows and columns beyond the lattice's edge.
    pub fn position(&self, row: usize, col: usize) -> [f64; 2] {
        [
            self.origin[0] + (col as f64 - shift(row)) * self.spacing,
            self.origin[1] - row as f64 * self.row_spacing(),
        ]
    }

    /// Returns row and column of the six neighbours W, E, NW, NE, SW, SE of vertex `(row, col)`; `None` for a neighbour
    /// beyond the lattice's edge.
    pub fn neighbours(&self, row: usize, col: usize) -> [Option<(usize, usize)>; 6] {
        NEIGHBOUR_DIRECTIONS.map(|towards| {
            let (r, c) = towards.step(row as isize, col as isize);
            self.contains(r, c).then_some((r as usize, c as usize))
        })
    }

    /// Iterates over the indices of a vertex's neighbours, without those beyond the lattice's edge; the vertex is given
    /// by its index.
    pub(crate) fn around(&self, index: usize) -> impl Iterator<Item = usize> + use<> {
        let lattice = *self;
        let neighbours = self.neighbours(index / self.cols, index % self.cols);
        (neighbours.into_iter().flatten()).map(move |(row, col)| lattice.index(row, col))
    }

    pub(crate) fn contains(&self, row: isize, col: isize) -> bool {
        (0..self.rows as isize).contains(&row) && (0..self.cols as isize).contains(&col)
    }

    /// Index of vertex `(row, col)` in row-major arrays. The vertex must be one of the lattice's: no check is made.
    pub fn index(&self, row: usize, col: usize) -> usize {
        row * self.cols + col
    }

    /// Finds the lattice triangle around the point `(x, y)`, which may lie outside the lattice.
    pub(crate) fn locate(&self, [x, y]: [f64; 2]) -> Located {
        let v = (self.origin[1] - y) / self.row_spacing();
        let row = v.floor();
        let down = v - row; // 0 on the row above the point, 1 on the row below
        let top = row as isize;
        // Position along the upper row, in spacings from its column 0.
        let shift = if top.rem_euclid(2) == 1 { 0.5 } else { 0.0 };
        let u = (x - self.origin[0]) / self.spacing + shift;
        // The rows' strip is sheared into squares, each cut by a diagonal: going one
        // row down along the SW edge moves half a spacing to the left.
        let s = u + 0.5 * down;
        let col = s.floor();
        let along = s - col;
        let a = (top, col as isize);
        let sw = Towards::SouthWest.step(a.0, a.1);
        let se = Towards::SouthEast.step(a.0, a.1);
        let e = Towards::East.step(a.0, a.1);
        if along >= down {
            // Upright edge at the top: a, e, and se below both.
            Located {
                vertices: [a, e, se],
                weights: [1.0 - along, along - down, down],
            }
        } else {
            Located {
                vertices: [a, sw, se],
                weights: [1.0 - down, down - along, along],
            }
        }
    }
}

/// A direction from a lattice vertex to one of its six neighbours.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Towards {
    West,
    East,
    NorthWest,
    NorthEast,
    SouthWest,
    SouthEast,
}

/// Directions from a lattice vertex to its six neighbours: W, E, NW, NE, SW, SE, the order used everywhere.
pub(crate) const NEIGHBOUR_DIRECTIONS: [Towards; 6] = [
    Towards::West,
    Towards::East,
    Towards::NorthWest,
    Towards::NorthEast,
    Towards::SouthWest,
    Towards::SouthEast,
];

/// For each of the six [`NEIGHBOUR_DIRECTIONS`] the index of the opposite one: an edge to neighbour `k` is, from its
/// other end, one to neighbour `OPPOSITE_DIRECTION[k]`.
pub(crate) const OPPOSITE_DIRECTION: [usize; 6] = [1, 0, 5, 4, 3, 2];

/// Distance by which a row of the lattice is shifted to the left of an even row, in spacings: 0 or ½.
pub(crate) fn shift(row: usize) -> f64 {
    if row % 2 == 1 { 0.5 } else { 0.0 }
}

impl Towards {
    /// Returns row and column of the neighbour of vertex `(row, col)` in this direction.
    pub(crate) fn step(self, row: isize, col: isize) -> (isize, isize) {
        let o = 1 - row.rem_euclid(2);
        match self {
            Towards::West => (row, col - 1),
            Towards::East => (row, col + 1),
            Towards::NorthWest => (row - 1, col + o - 1),
            Towards::NorthEast => (row - 1, col + o),
            Towards::SouthWest => (row + 1, col + o - 1),
            Towards::SouthEast => (row + 1, col + o),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lattice() -> Lattice {
        Lattice::new(7, 9, 0.3)
            .unwrap()
            .with_origin([2.0, -1.0])
            .unwrap()
    }

    #[test]
    fn neighbours_are_one_spacing_away_in_their_direction() {
        let l = lattice();
        let angle = [180.0f64, 0.0, 120.0, 60.0, 240.0, 300.0];
        for row in 1..6 {
            for col in 1..8 {
                let [x, y] = l.position(row, col);
                for (k, n) in l.neighbours(row, col).into_iter().enumerate() {
                    let (r, c) = n.unwrap();
                    let [nx, ny] = l.position(r, c);
                    let (dy, dx) = angle[k].to_radians().sin_cos();
                    assert!((nx - x - 0.3 * dx).abs() < 1e-12, "{row} {col} {k}");
                    assert!((ny - y - 0.3 * dy).abs() < 1e-12, "{row} {col} {k}");
                }
            }
        }
    }

    #[test]
    fn corners_lack_the_neighbours_beyond_the_edge() {
        let l = lattice();
        let present = |r, c| l.neighbours(r, c).map(|n| n.is_some());
        assert_eq!(present(0, 0), [false, true, false, false, true, true]);
        assert_eq!(present(1, 0), [false, true, false, true, false, true]);
        assert_eq!(present(6, 8), [true, false, true, false, false, false]);
    }

    #[test]
    fn located_points_are_the_weighted_mean_of_their_triangle() {
        let l = lattice();
        for i in 0..40 {
            for j in 0..40 {
                let p = [1.7 + 0.073 * i as f64, -2.9 + 0.051 * j as f64];
                let t = l.locate(p);
                let mut q = [0.0; 2];
                for ((r, c), w) in t.vertices.into_iter().zip(t.weights) {
                    assert!((-1e-12..=1.0 + 1e-12).contains(&w));
                    // position() takes unsigned indices; rows above or left of 0 by symmetry.
                    let (ur, uc) = ((r + 100) as usize, (c + 100) as usize);
                    let [x, y] = l.position(ur, uc);
                    q[0] += w * (x - 100.0 * 0.3);
                    q[1] += w * (y + 100.0 * 0.3 * ROW_SPACING);
                }
                assert!((q[0] - p[0]).abs() < 1e-10 && (q[1] - p[1]).abs() < 1e-10);
                assert!((t.weights.iter().sum::<f64>() - 1.0).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn covering_reaches_all_four_sides() {
        let l = Lattice::covering([0.0, 0.0], [4.0, 3.0], 0.5).unwrap();
        assert_eq!(l.origin(), [0.0, 3.0]);
        let [x, y] = l.position(l.rows() - 1, l.cols() - 1);
        assert!((4.0..=4.0 + 0.5).contains(&x), "{x}");
        assert!(y >= 0.0 && y - l.row_spacing() < 0.0);
    }

    #[test]
    fn nonsense_is_refused() {
        assert_eq!(Lattice::new(0, 3, 1.0).unwrap_err().code(), "EMPTY");
        assert_eq!(Lattice::new(3, 3, 0.0).unwrap_err().code(), "OPTION");
        assert_eq!(Lattice::new(3, 3, f64::NAN).unwrap_err().code(), "OPTION");
        assert_eq!(
            Lattice::new(1 << 20, 1 << 20, 1.0).unwrap_err().code(),
            "TOO_LARGE"
        );
        assert_eq!(
            Lattice::covering([0.0; 2], [1.0; 2], 1e-9)
                .unwrap_err()
                .code(),
            "TOO_LARGE"
        );
    }
}

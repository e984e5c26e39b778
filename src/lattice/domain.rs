//! The domain of a solve: which vertices of a lattice take part, as interior and boundary vertices, and which
//! are omitted.

use super::bands::Bands;
use super::hexagonal::{Lattice, NEIGHBOUR_DIRECTIONS};
use super::runs::RowRuns;
use crate::error::{Error, Result, try_filled};

/// Role of a lattice vertex in a solve: without height, omitted, boundary or interior (paper, Sec. 3.1 and Fig. 9).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
pub enum Role {
    /// The vertex has no height.
    #[default]
    Empty,
    /// The vertex has a height, but neither itself nor a neighbour is interior: it is left out of the solve and
    /// extrapolated afterwards.
    Omitted,
    /// The vertex is not interior, but a neighbour of an interior one: the paper's set `∂I`.
    Boundary,
    /// The vertex and its six neighbours have heights, and no occlusion tears the surface there, so that it has a
    /// Hessian: the paper's set `I`.
    Interior,
}

impl Role {
    /// Returns whether the height of a vertex of this role is an unknown of the solve: interior and boundary vertices.
    pub fn is_active(self) -> bool {
        self >= Role::Boundary
    }
}

impl PartialOrd for Role {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        (*self as u8).partial_cmp(&(*other as u8))
    }
}

/// The vertices of a lattice by their [`Role`] in a solve, for heightfields of any shape: with holes, islands, and
/// single interior vertices.
///
/// Arrays over a domain cover the bounding box of the vertices with heights, and one cell of padding all around, so
/// that every vertex of the box has six neighbours at offsets that are constant along a row.
#[derive(Debug, Clone)]
pub struct Domain {
    lattice: Lattice,
    /// Lattice row and column of the bounding box's first vertex; the row is even, so that odd rows of the box are the
    /// shifted ones of the lattice.
    corner: (usize, usize),
    rows: usize,
    stride: usize,
    roles: Vec<Role>,
    interior: RowRuns,
    active: RowRuns,
    bands: Bands,
    omitted: usize,
    occluded: usize,
}

impl Domain {
    /// Finds the role of each lattice vertex. `valid` says of a vertex, by its index, whether it has a height;
    /// `occluded` whether an occlusion tears the surface there, so that it has no Hessian (paper, Fig. 9).
    ///
    /// # Errors
    /// [`Error::NoInterior`] if no vertex has all six neighbours valid.
    pub(crate) fn from_validity(
        lattice: Lattice,
        valid: impl Fn(usize) -> bool,
        occluded: impl Fn(usize) -> bool,
    ) -> Result<Self> {
        let valid = |row: usize, col: usize| valid(lattice.index(row, col));
        let no_interior = |valid| Error::NoInterior {
            rows: lattice.rows(),
            cols: lattice.cols(),
            valid,
        };
        let (corner, last) = bounding_box(&lattice, valid).ok_or(no_interior(0))?;
        let rows = last.0 - corner.0 + 1;
        let cols = last.1 - corner.1 + 1;
        let stride = cols + 2;
        let mut roles = try_filled("domain", (rows + 2) * stride, Role::Empty)?;

        for row in 0..rows {
            for col in 0..cols {
                if valid(corner.0 + row, corner.1 + col) {
                    roles[(row + 1) * stride + col + 1] = Role::Omitted;
                }
            }
        }
        // Interior first, then what its stencils touch: neither step sees its own changes.
        let valid = roles.clone();
        let mut torn = 0;
        let offsets = |row: usize| neighbour_offsets(row, stride);
        for row in 1..=rows {
            for i in row * stride + 1..(row + 1) * stride - 1 {
                let all = |j: isize| valid[j as usize] == Role::Omitted;
                if valid[i] == Role::Omitted && offsets(row).iter().all(|o| all(i as isize + o)) {
                    let col = i - row * stride - 1 + corner.1;
                    if occluded(lattice.index(row - 1 + corner.0, col)) {
                        torn += 1;
                    } else {
                        roles[i] = Role::Interior;
                    }
                }
            }
        }
        for row in 1..=rows {
            for i in row * stride + 1..(row + 1) * stride - 1 {
                if roles[i] == Role::Interior {
                    for o in offsets(row) {
                        let neighbour = &mut roles[(i as isize + o) as usize];
                        if *neighbour == Role::Omitted {
                            *neighbour = Role::Boundary;
                        }
                    }
                }
            }
        }

        let count = |role| roles.iter().filter(|r| **r == role).count();
        let omitted = count(Role::Omitted);
        let interior = RowRuns::new(&roles, stride, |r| r == Role::Interior);
        let active = RowRuns::new(&roles, stride, Role::is_active);
        if interior.len() == 0 {
            return Err(no_interior(omitted));
        }
        Ok(Domain {
            lattice,
            corner,
            rows,
            stride,
            roles,
            interior,
            bands: Bands::new(&active, rows, stride),
            active,
            omitted,
            occluded: torn,
        })
    }

    /// The lattice that the domain is a part of.
    pub fn lattice(&self) -> &Lattice {
        &self.lattice
    }

    /// Returns the role of lattice vertex `(row, col)`, or [`Role::Empty`] if the lattice has no such vertex.
    pub fn role(&self, row: usize, col: usize) -> Role {
        self.cell((row as isize, col as isize))
            .map_or(Role::Empty, |cell| self.roles[cell])
    }

    /// Number of interior vertices, `|I|`.
    pub fn interior_len(&self) -> usize {
        self.interior.len()
    }

    /// Number of boundary vertices, `|∂I|`.
    pub fn boundary_len(&self) -> usize {
        self.active.len() - self.interior.len()
    }

    /// Number of vertices that have heights but are left out of the solve, because neither they nor a neighbour are
    /// interior.
    pub fn omitted_len(&self) -> usize {
        self.omitted
    }

    /// Number of vertices that would be interior if no occlusion tore the surface there.
    pub fn occluded_len(&self) -> usize {
        self.occluded
    }

    /// Lattice row and column of the vertex that stands in row 1, column 1 of the padded bounding box; the row is even.
    pub(crate) fn corner(&self) -> (usize, usize) {
        self.corner
    }

    /// Number of rows of the bounding box without its padding; they are numbered from 1.
    pub(crate) fn rows(&self) -> usize {
        self.rows
    }

    /// Number of cells in a row of the padded bounding box.
    pub(crate) fn stride(&self) -> usize {
        self.stride
    }

    /// Number of cells of the padded bounding box, which is the length of arrays over the domain.
    pub(crate) fn cells(&self) -> usize {
        (self.rows + 2) * self.stride
    }

    pub(crate) fn roles(&self) -> &[Role] {
        &self.roles
    }

    /// Runs of consecutive interior vertices, row by row.
    pub(crate) fn interior(&self) -> &RowRuns {
        &self.interior
    }

    /// Runs of consecutive active vertices (interior and boundary), row by row.
    pub(crate) fn active(&self) -> &RowRuns {
        &self.active
    }

    /// Bands of rows, which threads work on side by side.
    pub(crate) fn bands(&self) -> &Bands {
        &self.bands
    }

    /// Divides the rows into about a number of bands.
    #[cfg(test)]
    pub(crate) fn with_bands(self, number: usize) -> Self {
        let bands = Bands::with_number(number, &self.active, self.rows, self.stride);
        Domain { bands, ..self }
    }

    /// Returns the index of a lattice vertex (row, column) in arrays over the domain, or `None` outside of the bounding
    /// box.
    pub(crate) fn cell(&self, (row, col): (isize, isize)) -> Option<usize> {
        let row = row - self.corner.0 as isize;
        let col = col - self.corner.1 as isize;
        let inside =
            (0..self.rows as isize).contains(&row) && (0..self.stride as isize - 2).contains(&col);
        inside.then(|| (row + 1) as usize * self.stride + (col + 1) as usize)
    }

    /// Returns the index of a lattice vertex (row, column) in arrays over the domain if its role is `wanted`, or
    /// `None`.
    pub(crate) fn cell_of(
        &self,
        vertex: (isize, isize),
        wanted: impl Fn(Role) -> bool,
    ) -> Option<usize> {
        self.cell(vertex).filter(|cell| wanted(self.roles[*cell]))
    }

    /// Converts an index in arrays over the domain, not of padding, to the index of that vertex in the lattice's
    /// row-major arrays.
    pub(crate) fn lattice_index(&self, cell: usize) -> usize {
        let (row, col) = self.lattice_vertex(cell);
        self.lattice.index(row, col)
    }

    /// Iterates over the vertices of runs, row by row: index in arrays over the domain, with row and column in the
    /// lattice.
    pub(crate) fn vertices<'a>(
        &'a self,
        runs: &'a RowRuns,
    ) -> impl Iterator<Item = (usize, (usize, usize))> + Clone + 'a {
        let (top, left) = self.corner;
        (1..=self.rows).flat_map(move |row| {
            let first = row * self.stride + 1;
            let cells = runs.row(row).iter().flat_map(|run| run.start..run.end);
            cells.map(move |cell| (cell, (row - 1 + top, cell - first + left)))
        })
    }

    /// Converts an index in arrays over the domain, not of padding, to row and column of that vertex in the lattice.
    pub(crate) fn lattice_vertex(&self, cell: usize) -> (usize, usize) {
        (
            cell / self.stride - 1 + self.corner.0,
            cell % self.stride - 1 + self.corner.1,
        )
    }

    /// Returns the offsets, in arrays over the domain, from a vertex in a row of the padded box to its neighbours W, E,
    /// NW, NE, SW and SE.
    pub(crate) fn neighbour_offsets(&self, row: usize) -> [isize; 6] {
        neighbour_offsets(row, self.stride)
    }
}

/// Returns the offsets, in arrays over the padded box with rows of `stride` cells, from a vertex to its neighbours W,
/// E, NW, NE, SW and SE. Rows of the padded box count from 1, so that its odd rows are the lattice's even ones.
fn neighbour_offsets(row: usize, stride: usize) -> [isize; 6] {
    let row = row as isize - 1;
    NEIGHBOUR_DIRECTIONS.map(|towards| {
        let (r, c) = towards.step(row, 0);
        (r - row) * stride as isize + c
    })
}

/// Returns the first and the last row and column of the bounding box of all valid vertices, its first row made
/// even; `None` if no vertex is valid.
fn bounding_box(
    lattice: &Lattice,
    valid: impl Fn(usize, usize) -> bool,
) -> Option<((usize, usize), (usize, usize))> {
    let mut bounds: Option<(usize, usize, usize, usize)> = None;
    for row in 0..lattice.rows() {
        let mut cols = (0..lattice.cols()).filter(|col| valid(row, *col));
        if let Some(first) = cols.next() {
            let last = cols.next_back().unwrap_or(first);
            let (top, left, _, right) = bounds.unwrap_or((row, first, row, last));
            bounds = Some((top, left.min(first), row, right.max(last)));
        }
    }
    bounds.map(|(top, left, bottom, right)| ((top - top % 2, left), (bottom, right)))
}

#[cfg(all(test, not(target_arch = "wasm32")))] // proptest is native
pub(crate) mod tests {
    use super::*;
    use crate::heights::heightfield::Heightfield;
    use proptest::prelude::*;

    /// A field over a random domain: holes, islands, whatever the bits say.
    pub(crate) fn arbitrary_field() -> impl Strategy<Value = Heightfield> {
        (3usize..14, 3usize..14)
            .prop_flat_map(|(rows, cols)| {
                let cell =
                    (0u8..10, -1.0..1.0f64).prop_map(|(k, z)| if k == 0 { f64::NAN } else { z });
                (
                    Just((rows, cols)),
                    prop::collection::vec(cell, rows * cols),
                    0.05..2.0f64,
                )
            })
            .prop_map(|((rows, cols), heights, spacing)| {
                Heightfield::new(Lattice::new(rows, cols, spacing).unwrap(), heights).unwrap()
            })
    }

    /// A domain with one interior vertex, in the middle of the ring of its neighbours.
    pub(crate) fn single_ring() -> Heightfield {
        let lattice = Lattice::new(5, 6, 1.0).unwrap();
        let mut heights = vec![f64::NAN; lattice.len()];
        let (row, col) = (3, 2);
        heights[lattice.index(row, col)] = 1.0;
        for (r, c) in lattice.neighbours(row, col).into_iter().flatten() {
            heights[lattice.index(r, c)] = 0.0;
        }
        Heightfield::new(lattice, heights).unwrap()
    }

    #[test]
    fn a_ring_has_one_interior_vertex() {
        let domain = Domain::new(&single_ring()).unwrap();
        assert_eq!(domain.interior_len(), 1);
        assert_eq!(domain.boundary_len(), 6);
        assert_eq!(domain.omitted_len(), 0);
        assert_eq!(domain.role(3, 2), Role::Interior);
        assert_eq!(domain.role(2, 2), Role::Boundary);
        assert_eq!(domain.role(0, 0), Role::Empty);
    }

    #[test]
    fn too_thin_a_shape_is_an_error() {
        let lattice = Lattice::new(2, 50, 1.0).unwrap();
        let field = Heightfield::from_fn(lattice, |x, _| x).unwrap();
        assert_eq!(
            Domain::new(&field).unwrap_err(),
            Error::NoInterior {
                rows: 2,
                cols: 50,
                valid: 100
            }
        );
        let field = Heightfield::from_fn(lattice, |_, _| f64::NAN).unwrap();
        assert_eq!(Domain::new(&field).unwrap_err().code(), "NO_INTERIOR");
    }

    proptest! {
        #[test]
        fn roles_follow_their_definition(field in arbitrary_field()) {
            let l = *field.lattice();
            let valid = |(r, c): (usize, usize)| !field.height(r, c).is_nan();
            let interior = |v: (usize, usize)| {
                valid(v) && l.neighbours(v.0, v.1).iter().all(|n| n.is_some_and(valid))
            };
            let mut counts = [0; 3];
            let domain = Domain::new(&field);
            for row in 0..l.rows() {
                for col in 0..l.cols() {
                    let expected = if !valid((row, col)) {
                        Role::Empty
                    } else if interior((row, col)) {
                        Role::Interior
                    } else if l.neighbours(row, col).into_iter().flatten().any(interior) {
                        Role::Boundary
                    } else {
                        Role::Omitted
                    };
                    if expected != Role::Empty {
                        counts[expected as usize - 1] += 1;
                    }
                    if let Ok(domain) = &domain {
                        prop_assert_eq!(domain.role(row, col), expected);
                    }
                }
            }
            match domain {
                Ok(d) => prop_assert_eq!(
                    [d.omitted_len(), d.boundary_len(), d.interior_len()], counts),
                Err(_) => prop_assert_eq!(counts[2], 0),
            }
        }
    }
}

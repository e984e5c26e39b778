//! Occlusions: edges of the lattice across which a heightfield jumps, as a scan does where one thing hides another
//! behind it (paper, Sec. 4.1 and Fig. 9).

use super::heightfield::Heightfield;
use crate::error::{Result, check_shape, positive};
use crate::heights::normalization::Normalization;
use crate::lattice::hexagonal::{Lattice, NEIGHBOUR_DIRECTIONS, OPPOSITE_DIRECTION, Towards};
use crate::lattice::stencil::HessianMap;

/// Occlusions of a heightfield: edges of the lattice across which the surface is torn, and vertices without a
/// Hessian.
///
/// Both ends of a broken edge leave the interior: no Hessian is taken there, though they may still serve their
/// neighbours' stencils. Vertices that no stencil touches any more are omitted, and extrapolated after the
/// solve.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Occlusions {
    /// For each vertex six bits: bit `k` is set if the edge to neighbour `k` is broken.
    edges: Vec<u8>,
    /// For each vertex 1 if no Hessian is to be taken there, else 0.
    vertices: Vec<u8>,
}

/// Curvature above which an edge of the lattice counts as an occlusion, in coordinates normalised to the unit square:
/// the paper's value.
pub const OCCLUSION_THRESHOLD: f64 = 4e4;

impl Occlusions {
    /// Detects occlusions: marks the edges next to which the surface has a second derivative above `threshold`, in
    /// coordinates scaled by `normalization`. It is measured by the exact quadratic through the six vertices of a
    /// triangle of side `2h`; the edges are those of the triangle in its middle. [`OCCLUSION_THRESHOLD`] is the
    /// paper's.
    ///
    /// Linear cost.
    ///
    /// # Errors
    /// [`Error::Option`](crate::Error::Option) unless the threshold is finite and above zero.
    pub fn detect(
        field: &Heightfield,
        threshold: f64,
        normalization: Normalization,
    ) -> Result<Self> {
        let threshold = positive("occlusion_threshold", threshold)?;
        let lattice = field.lattice();
        let map = HessianMap::new(lattice.spacing());
        // Second derivatives are inversely proportional to lengths.
        let limit = threshold * normalization.factor(field);
        let height = |(row, col)| match lattice.contains(row, col) {
            true => field.height(row as usize, col as usize),
            false => f64::NAN,
        };
        let difference = |(r, c), towards: Towards, back: Towards| {
            height(towards.step(r, c)) - 2.0 * height((r, c)) + height(back.step(r, c))
        };
        let mut edges = vec![0; lattice.len()];
        for row in 0..lattice.rows() as isize {
            for col in 0..lattice.cols() as isize {
                for inner in triangles_below((row, col)) {
                    // Each side of the patch has one of the inner triangle's corners in its middle.
                    let [a, b, c] = inner;
                    let hessian = map.hessian([
                        difference(a, Towards::West, Towards::East),
                        difference(b, Towards::NorthWest, Towards::SouthEast),
                        difference(c, Towards::NorthEast, Towards::SouthWest),
                    ]);
                    // NaN, where a vertex of the patch is missing, is not above anything.
                    let [high, low] = hessian.eigenvalues();
                    if high > limit || low < -limit {
                        for vertex in inner {
                            mark(lattice, &mut edges, vertex, &inner);
                        }
                    }
                }
            }
        }
        Ok(Occlusions::of_edges(edges))
    }

    /// Makes occlusions from the broken edges of each vertex, as six bits; both ends of a broken edge have no Hessian.
    fn of_edges(edges: Vec<u8>) -> Self {
        let vertices = edges.iter().map(|bits| u8::from(*bits != 0)).collect();
        Occlusions { edges, vertices }
    }

    /// Makes occlusions from vertices: where `mask` is not 0, no Hessian is taken.
    ///
    /// # Errors
    /// [`Error::Shape`](crate::Error::Shape) if there is not one value for each vertex.
    pub fn from_vertices(lattice: &Lattice, mask: &[u8]) -> Result<Self> {
        check_shape("occlusions", lattice.rows(), lattice.cols(), mask.len())?;
        Ok(Occlusions {
            edges: vec![0; mask.len()],
            vertices: mask.iter().map(|keep| u8::from(*keep != 0)).collect(),
        })
    }

    /// Makes occlusions from broken edges: bit `k` of a vertex's byte stands for the edge to its neighbour `k` in the
    /// order W, E, NW, NE, SW, SE. An edge is broken if either of its ends says so.
    ///
    /// # Errors
    /// [`Error::Shape`](crate::Error::Shape) if there is not one byte for each vertex.
    pub fn from_edges(lattice: &Lattice, edges: &[u8]) -> Result<Self> {
        check_shape("broken edges", lattice.rows(), lattice.cols(), edges.len())?;
        let mut both = vec![0; edges.len()];
        for (i, bits) in edges.iter().enumerate() {
            let (row, col) = (i / lattice.cols(), i % lattice.cols());
            for (k, neighbour) in lattice.neighbours(row, col).into_iter().enumerate() {
                if let Some((r, c)) = neighbour.filter(|_| bits >> k & 1 != 0) {
                    both[i] |= 1 << k;
                    both[lattice.index(r, c)] |= 1 << OPPOSITE_DIRECTION[k];
                }
            }
        }
        Ok(Occlusions::of_edges(both))
    }

    /// Returns the union of two sets of occlusions.
    ///
    /// # Errors
    /// [`Error::Shape`](crate::Error::Shape) if they are of different lattices.
    pub fn union(mut self, other: &Occlusions) -> Result<Self> {
        check_shape("occlusions", 1, self.vertices.len(), other.vertices.len())?;
        for (a, b) in self.edges.iter_mut().zip(&other.edges) {
            *a |= b;
        }
        for (a, b) in self.vertices.iter_mut().zip(&other.vertices) {
            *a |= b;
        }
        Ok(self)
    }

    /// For each vertex, row by row, 1 if no Hessian is taken there, else 0.
    pub fn vertices(&self) -> &[u8] {
        &self.vertices
    }

    /// Broken edges as six bits for each vertex, in the order of [`Occlusions::from_edges`]; each broken edge is set at
    /// both of its ends.
    pub fn edges(&self) -> &[u8] {
        &self.edges
    }

    /// Number of vertices at occlusions, where no Hessian is taken.
    pub fn len(&self) -> usize {
        self.vertices.iter().filter(|v| **v != 0).count()
    }

    /// Whether there are no occlusions.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// The two triangles of the lattice that have a vertex as their top or as their upper left corner. Corners are in the
/// order opposite the sides along W–E, NW–SE and NE–SW.
fn triangles_below((row, col): (isize, isize)) -> [[(isize, isize); 3]; 2] {
    let at = (row, col);
    let [sw, se, e] =
        [Towards::SouthWest, Towards::SouthEast, Towards::East].map(|t| t.step(row, col));
    [[at, sw, se], [se, e, at]]
}

/// Marks the edges from a vertex to the other `corners` of a triangle as broken.
fn mark(
    lattice: &Lattice,
    edges: &mut [u8],
    (row, col): (isize, isize),
    corners: &[(isize, isize)],
) {
    for (k, towards) in NEIGHBOUR_DIRECTIONS.into_iter().enumerate() {
        if corners.contains(&towards.step(row, col)) {
            edges[lattice.index(row as usize, col as usize)] |= 1 << k;
        }
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))] // proptest is native
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn detect(field: &Heightfield, threshold: f64) -> Occlusions {
        Occlusions::detect(field, threshold, Normalization::Off).unwrap()
    }

    proptest! {
        /// The curvature of a quadratic is found exactly, whatever its direction.
        #[test]
        fn quadratics_are_measured_exactly(
            [xx, xy, yy, gx, gy] in prop::array::uniform5(-5.0..5.0f64), h in 0.05..3.0f64,
        ) {
            let largest = crate::Sym2::new(xx, xy, yy).eigenvalues().map(f64::abs);
            let largest = largest[0].max(largest[1]);
            prop_assume!(largest > 0.1);
            let field = Heightfield::from_fn(Lattice::new(6, 7, h).unwrap(), |x, y| {
                0.5 * (xx * x * x + yy * y * y) + xy * x * y + gx * x + gy * y
            }).unwrap();
            prop_assert!(detect(&field, 1.000001 * largest).is_empty());
            // Every vertex but those on the border is in a triangle whose patch is whole.
            let found = detect(&field, 0.999999 * largest);
            for row in 1..5 {
                for col in 1..6 {
                    prop_assert_eq!(found.vertices()[field.lattice().index(row, col)], 1);
                }
            }
        }

        /// A step in any direction is found, and nothing but the step.
        #[test]
        fn a_step_is_flagged_within_a_cell_of_it(angle in 0.0..6.3f64, offset in -1.0..1.0f64) {
            let lattice = Lattice::new(20, 20, 1.0).unwrap();
            let (sin, cos) = angle.sin_cos();
            let across = |x: f64, y: f64| (x - 10.0) * cos + (y + 8.5) * sin - offset;
            let field = Heightfield::from_fn(lattice, |x, y| {
                0.3 * x - 0.2 * y + 0.001 * x * y + if across(x, y) > 0.0 { 5.0 } else { 0.0 }
            }).unwrap();
            let found = detect(&field, 1.0);
            prop_assert!(!found.is_empty());
            for row in 0..20 {
                for col in 0..20 {
                    let [x, y] = lattice.position(row, col);
                    let flagged = found.vertices()[lattice.index(row, col)] != 0;
                    // Within one cell: its patch crosses the step, whose vertices are 2h apart.
                    prop_assert!(!flagged || across(x, y).abs() <= 3f64.sqrt(), "{x} {y}");
                    // No stencil that is left reaches across.
                    let inside = (1..19).contains(&row) && (1..19).contains(&col);
                    if inside && !flagged {
                        let sides = lattice.neighbours(row, col).into_iter().flatten().map(|(r, c)| {
                            let [x, y] = lattice.position(r, c);
                            across(x, y) > 0.0
                        });
                        let side = across(x, y) > 0.0;
                        let near_border = !((3..=16).contains(&row) && (3..=16).contains(&col));
                        prop_assert!(near_border || sides.clone().all(|s| s == side), "{row} {col}");
                    }
                }
            }
        }
    }

    #[test]
    fn a_smooth_surface_has_none_and_normalisation_keeps_the_threshold() {
        let bump = |size: f64| {
            let lattice = Lattice::new(80, 80, size / 80.0).unwrap();
            Heightfield::from_fn(lattice, |x, y| {
                size * 0.3 * (6.0 * x / size).sin() * (5.0 * y / size).cos()
            })
            .unwrap()
        };
        for size in [1.0, 30.0] {
            let field = bump(size);
            let found = |t| Occlusions::detect(&field, t, Normalization::UnitSquare).unwrap();
            assert!(found(OCCLUSION_THRESHOLD).is_empty());
            // Largest curvature: 0.3 · 36, whatever the units.
            assert!(found(11.5).is_empty());
            assert!(!found(9.5).is_empty());
        }
    }

    #[test]
    fn given_edges_and_vertices_are_both_kept() {
        let lattice = Lattice::new(4, 4, 1.0).unwrap();
        let mut bits = vec![0; 16];
        bits[lattice.index(1, 1)] = 1 << 1; // to the east
        let edge = Occlusions::from_edges(&lattice, &bits).unwrap();
        assert_eq!(edge.edges()[lattice.index(1, 2)], 1 << 0);
        assert_eq!(edge.len(), 2);
        let mut mask = vec![0; 16];
        mask[0] = 7;
        let both = Occlusions::from_vertices(&lattice, &mask)
            .unwrap()
            .union(&edge)
            .unwrap();
        assert_eq!((both.len(), both.vertices()[0]), (3, 1));
        assert_eq!(
            Occlusions::from_edges(&lattice, &[0]).unwrap_err().code(),
            "SHAPE"
        );
        let detected = Occlusions::detect(
            &Heightfield::from_fn(lattice, |x, _| x).unwrap(),
            -1.0,
            Normalization::Off,
        );
        assert_eq!(detected.unwrap_err().code(), "OPTION");
    }
}

//! The surface as triangles: those of the lattice whose three vertices have heights.

use crate::error::{Error, Result, try_filled};
use crate::heightfield::Heightfield;
use crate::lattice::{Lattice, Towards};

/// Marks a lattice vertex that no triangle uses.
const UNUSED: u32 = u32::MAX;

/// The lattice triangles with three heights, and the vertices that these use.
///
/// Vertices are in the lattice's row-major order. Triangles are counter-clockwise seen from above
/// (from `+z`), in the order of their upper left vertex.
#[derive(Debug, Clone, PartialEq)]
pub struct Triangulation {
    lattice: Lattice,
    vertices: Vec<u32>,
    positions: Vec<[f64; 3]>,
    triangles: Vec<[u32; 3]>,
}

impl Triangulation {
    /// The triangles of a surface; costs `O(vertices)`.
    ///
    /// # Errors
    /// [`Error::Unsupported`] if there is no whole triangle, [`Error::OutOfMemory`].
    pub fn new(surface: &Heightfield) -> Result<Self> {
        Triangulation::of_some(surface, |_| true)
    }

    /// Those of the triangles of a surface, by the lattice indices of their corners, that are
    /// wanted.
    pub(crate) fn of_some(
        surface: &Heightfield,
        wanted: impl Fn([usize; 3]) -> bool,
    ) -> Result<Self> {
        let lattice = *surface.lattice();
        let triangles = || whole_triangles(surface).filter(|triangle| wanted(*triangle));
        let mut numbers = try_filled("triangles", lattice.len(), UNUSED)?;
        let mut count = 0;
        for triangle in triangles() {
            count += 1;
            for i in triangle {
                numbers[i] = 0;
            }
        }
        if count == 0 {
            return Err(Error::Unsupported {
                format: "surface",
                reason: "no triangle of the lattice has a height at all three vertices".into(),
            });
        }
        let mut numbered = try_filled("triangles", count, [0; 3])?;
        let mut used = 0;
        for number in numbers.iter_mut().filter(|number| **number != UNUSED) {
            *number = used;
            used += 1;
        }
        let mut vertices = try_filled("triangles", used as usize, 0)?;
        let mut positions = try_filled("triangles", used as usize, [0.0; 3])?;
        for (i, number) in numbers.iter().enumerate().filter(|(_, n)| **n != UNUSED) {
            let [x, y] = lattice.position(i / lattice.cols(), i % lattice.cols());
            vertices[*number as usize] = i as u32;
            positions[*number as usize] = [x, y, surface.heights()[i]];
        }
        for (out, triangle) in numbered.iter_mut().zip(triangles()) {
            *out = triangle.map(|i| numbers[i]);
        }
        Ok(Triangulation {
            lattice,
            vertices,
            positions,
            triangles: numbered,
        })
    }

    /// The lattice.
    pub fn lattice(&self) -> &Lattice {
        &self.lattice
    }

    /// Row-major index in the lattice of each vertex, ascending.
    pub fn vertices(&self) -> &[u32] {
        &self.vertices
    }

    /// `x, y, z` of each vertex.
    pub fn positions(&self) -> &[[f64; 3]] {
        &self.positions
    }

    /// The vertices of each triangle, counted from 0 in [`Triangulation::vertices`].
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// Normal of a triangle with its doubled area as length, all in units of the spacing, so that
    /// it neither over- nor underflows.
    pub(crate) fn normal(&self, triangle: [u32; 3]) -> [f64; 3] {
        let [a, b, c] = triangle.map(|v| {
            self.positions[v as usize].map(|coordinate| coordinate / self.lattice.spacing())
        });
        let edge = |to: [f64; 3]| [to[0] - a[0], to[1] - a[1], to[2] - a[2]];
        let ([ux, uy, uz], [vx, vy, vz]) = (edge(b), edge(c));
        [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx]
    }
}

/// Lattice indices of the corners of each triangle with three heights.
fn whole_triangles(surface: &Heightfield) -> impl Iterator<Item = [usize; 3]> {
    let lattice = *surface.lattice();
    let vertices = (0..lattice.rows()).flat_map(move |r| (0..lattice.cols()).map(move |c| (r, c)));
    vertices
        .flat_map(|(row, col)| {
            let a = (row as isize, col as isize);
            let [e, sw, se] = [Towards::East, Towards::SouthWest, Towards::SouthEast]
                .map(|towards| towards.step(a.0, a.1));
            [[a, sw, se], [a, se, e]]
        })
        .filter(move |triangle| {
            (triangle.iter()).all(|(row, col)| {
                lattice.contains(*row, *col)
                    && surface.height(*row as usize, *col as usize).is_finite()
            })
        })
        .map(move |triangle| triangle.map(|(row, col)| lattice.index(row as usize, col as usize)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn flat(rows: usize, cols: usize) -> Heightfield {
        Heightfield::from_fn(Lattice::new(rows, cols, 0.5).unwrap(), |x, y| x + y).unwrap()
    }

    #[test]
    fn a_full_lattice_has_two_triangles_for_each_parallelogram() {
        let triangles = Triangulation::new(&flat(5, 7)).unwrap();
        assert_eq!(triangles.vertices().len(), 35);
        assert_eq!(triangles.triangles().len(), 2 * 4 * 6);
        for triangle in triangles.triangles() {
            // Counter-clockwise, and twice the area of an equilateral triangle of side 1.
            let up = triangles.normal(*triangle)[2];
            assert!((up - 3f64.sqrt() / 2.0).abs() < 1e-12, "{up}");
        }
    }

    #[test]
    fn a_hole_takes_its_six_triangles_and_no_other_vertex() {
        let field = flat(5, 7);
        let mut keep = vec![1; 35];
        keep[2 * 7 + 3] = 0;
        let triangles = Triangulation::new(&field.clone().masked(&keep).unwrap()).unwrap();
        assert_eq!(triangles.triangles().len(), 48 - 6);
        assert_eq!(triangles.vertices().len(), 34);
        assert!(!triangles.vertices().contains(&17));
        for (v, [x, y, z]) in triangles.vertices().iter().zip(triangles.positions()) {
            let position = field.lattice().position(*v as usize / 7, *v as usize % 7);
            assert_eq!((position, *z), ([*x, *y], x + y));
        }
    }

    #[test]
    fn without_a_triangle_there_is_no_surface() {
        let column = Heightfield::from_fn(Lattice::new(9, 1, 1.0).unwrap(), |_, _| 0.0).unwrap();
        assert_eq!(
            Triangulation::new(&column).unwrap_err().code(),
            "UNSUPPORTED"
        );
    }
}

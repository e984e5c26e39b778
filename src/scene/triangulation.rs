//! Triangulation of a heightfield to a mesh in space.

use super::mesh::Mesh;
use super::view::Frame;
use crate::error::{Error, Result, check_count, try_filled};
use crate::heights::heightfield::Heightfield;
use crate::lattice::hexagonal::{Lattice, Towards};
use crate::math::index::NO_INDEX;
use crate::math::lanes;

/// Triangulation of a heightfield: a mesh, with the lattice vertex of each of its vertices.
///
/// It has every triangle of the lattice whose three vertices have heights, counter-clockwise as seen from above (from
/// where the heights point), ordered by upper left vertex; and the vertices that these use, in the lattice's
/// row-major order. The normal of a vertex is the mean of those of its triangles, weighted by area.
#[derive(Debug, Clone, PartialEq)]
pub struct Triangulation {
    lattice: Lattice,
    vertices: Vec<u32>,
    mesh: Mesh,
}

impl Triangulation {
    /// Triangulates a heightfield and places it in space by a frame: [`Frame::default`] gives positions `x y z` as in
    /// the lattice, the frame of [`Samples`](crate::Samples) positions in the axes of the sampled mesh.
    ///
    /// Costs `O(vertices)`.
    ///
    /// # Errors
    /// [`Error::Unsupported`] if there is no whole triangle, [`Error::OutOfMemory`].
    pub fn new(surface: &Heightfield, frame: &Frame) -> Result<Self> {
        Triangulation::of_some(surface, frame, |_| true)
    }

    /// Triangulates a part of a heightfield: `wanted` tells for the lattice indices of a triangle's corners whether it
    /// belongs to the part.
    pub(crate) fn of_some(
        surface: &Heightfield,
        frame: &Frame,
        wanted: impl Fn([usize; 3]) -> bool,
    ) -> Result<Self> {
        let lattice = *surface.lattice();
        let whole = || whole_triangles(surface).filter(|triangle| wanted(*triangle));
        let mut numbers = try_filled("mesh", lattice.len(), NO_INDEX)?;
        let mut count = 0;
        for triangle in whole() {
            count += 1;
            triangle.iter().for_each(|i| numbers[*i] = 0);
        }
        if count == 0 {
            return Err(Error::Unsupported {
                format: "surface",
                reason: "no triangle of the lattice has a height at all three vertices".into(),
            });
        }
        let used = numbers.iter().filter(|n| **n != NO_INDEX).count();
        let mut vertices = with_capacity(used)?;
        let mut positions = with_capacity(used)?;
        for (i, number) in numbers
            .iter_mut()
            .enumerate()
            .filter(|(_, n)| **n != NO_INDEX)
        {
            *number = vertices.len() as u32;
            vertices.push(i as u32);
            let [x, y] = lattice.position(i / lattice.cols(), i % lattice.cols());
            positions.push(frame.to_world([x, y, surface.heights()[i]]));
        }
        let mut triangles = with_capacity(count)?;
        triangles.extend(whole().map(|triangle| triangle.map(|i| numbers[i])));
        let mesh = Mesh::new(positions, triangles)?;
        let normals = normals(&mesh, lattice.spacing())?;
        Ok(Triangulation {
            lattice,
            vertices,
            mesh: mesh.with_normals(normals)?,
        })
    }

    /// Returns the triangulation with colours, given for each vertex of the lattice as [`Mesh::with_colors`] takes
    /// them. NaN becomes the mean of its neighbours, from a hole's rim inwards.
    ///
    /// # Errors
    /// [`Error::Shape`] if there is not one for each vertex of the lattice, [`Error::OutOfMemory`].
    pub fn with_colors(self, colors: &[[f32; 3]]) -> Result<Self> {
        let colors = self.picked("colours of the surface", colors)?;
        let mesh = self.mesh.with_colors(colors)?;
        Ok(Triangulation { mesh, ..self })
    }

    /// Returns the triangulation with texture coordinates, given for each vertex of the lattice.
    ///
    /// # Errors
    /// As [`Triangulation::with_colors`].
    pub fn with_uvs(self, uvs: &[[f32; 2]]) -> Result<Self> {
        let uvs = self.picked("texture coordinates of the surface", uvs)?;
        let mesh = self.mesh.with_uvs(uvs)?;
        Ok(Triangulation { mesh, ..self })
    }

    /// The lattice of the triangulated heightfield.
    pub fn lattice(&self) -> &Lattice {
        &self.lattice
    }

    /// Row-major index in the lattice of each of the mesh's vertices, ascending.
    pub fn vertices(&self) -> &[u32] {
        &self.vertices
    }

    /// Position `x, y, z` in space of each of the mesh's vertices.
    pub fn positions(&self) -> &[[f64; 3]] {
        self.mesh.positions()
    }

    /// Vertices of each triangle, as indices into [`Triangulation::vertices`].
    pub fn triangles(&self) -> &[[u32; 3]] {
        self.mesh.triangles()
    }

    /// The heightfield's triangle mesh.
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// Returns the triangle mesh, without the lattice indices of its vertices.
    pub fn into_mesh(self) -> Mesh {
        self.mesh
    }

    /// Normal vector of a triangle, with twice the triangle's area as its length, in units of the lattice spacing.
    pub(crate) fn normal(&self, triangle: [u32; 3]) -> [f64; 3] {
        normal(self.mesh.corners(triangle), self.lattice.spacing())
    }

    /// Picks the values at the mesh's vertices from those at the lattice's vertices. A missing value, as in a bridged
    /// hole, becomes the mean of its neighbours' values, from the hole's rim inwards, or 0 if it has none.
    pub(crate) fn picked<const N: usize>(
        &self,
        what: &'static str,
        values: &[[f32; N]],
    ) -> Result<Vec<[f32; N]>> {
        check_count(what, self.lattice.len(), N, N * values.len())?;
        let known = |value: &[f32; N]| value.iter().all(|v| v.is_finite());
        let mut picked = with_capacity(self.vertices.len())?;
        picked.extend(self.vertices.iter().map(|i| values[*i as usize]));
        let mut missing = picked.iter().filter(|value| !known(value)).count();
        while missing > 0 {
            let mut sums = try_filled("mesh", picked.len(), ([0.0; N], 0.0))?;
            for triangle in self.triangles() {
                for to in triangle.map(|v| v as usize) {
                    for from in triangle.map(|v| v as usize) {
                        if !known(&picked[to]) && known(&picked[from]) {
                            let (sum, count) = &mut sums[to];
                            (0..N).for_each(|k| sum[k] += picked[from][k]);
                            *count += 1.0;
                        }
                    }
                }
            }
            let before = missing;
            for (value, (sum, count)) in picked.iter_mut().zip(sums) {
                if count > 0.0 {
                    *value = sum.map(|sum| sum / count);
                    missing -= 1;
                }
            }
            if missing == before {
                break;
            }
        }
        if missing > 0 {
            for value in picked.iter_mut().filter(|value| !known(value)) {
                *value = [0.0; N];
            }
        }
        Ok(picked)
    }
}

fn with_capacity<T>(len: usize) -> Result<Vec<T>> {
    let mut list = Vec::new();
    list.try_reserve_exact(len)
        .map_err(|_| Error::OutOfMemory {
            what: "mesh",
            bytes: len * size_of::<T>(),
        })?;
    Ok(list)
}

/// Lattice indices of the corners of each triangle whose three vertices have heights.
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

/// Computes the unit normal of each vertex: the mean of its triangles' normals, weighted by area.
fn normals(mesh: &Mesh, spacing: f64) -> Result<Vec<[f32; 3]>> {
    let mut sums = try_filled("mesh", mesh.positions().len(), [0.0; 3])?;
    for triangle in mesh.triangles() {
        let normal = normal(mesh.corners(*triangle), spacing);
        for vertex in triangle {
            (0..3).for_each(|k| sums[*vertex as usize][k] += normal[k]);
        }
    }
    let mut normals = with_capacity(sums.len())?;
    normals.extend(sums.into_iter().map(|[x, y, z]: [f64; 3]| {
        let length = x.hypot(y).hypot(z);
        [x, y, z].map(|v| lanes::single(v / length))
    }));
    Ok(normals)
}

/// Normal vector of a triangle, with twice the triangle's area as its length. Lengths are in units of the lattice
/// spacing, so that nothing over- or underflows.
fn normal(corners: [[f64; 3]; 3], spacing: f64) -> [f64; 3] {
    let [a, b, c] = corners.map(|corner| corner.map(|coordinate| coordinate / spacing));
    let edge = |to: [f64; 3]| [to[0] - a[0], to[1] - a[1], to[2] - a[2]];
    let ([ux, uy, uz], [vx, vy, vz]) = (edge(b), edge(c));
    [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn flat(rows: usize, cols: usize) -> Heightfield {
        Heightfield::from_fn(Lattice::new(rows, cols, 0.5).unwrap(), |x, y| x + y).unwrap()
    }

    #[test]
    fn a_full_lattice_has_two_triangles_for_each_parallelogram() {
        let triangles = Triangulation::new(&flat(5, 7), &Frame::default()).unwrap();
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
        let triangles =
            Triangulation::new(&field.clone().masked(&keep).unwrap(), &Frame::default()).unwrap();
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
            Triangulation::new(&column, &Frame::default())
                .unwrap_err()
                .code(),
            "UNSUPPORTED"
        );
    }
}

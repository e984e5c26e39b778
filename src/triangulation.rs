//! A heightfield as a triangle mesh in space, for files and for drawing.

use crate::error::{Error, Result, check_count, try_filled};
use crate::heightfield::Heightfield;
use crate::lattice::Towards;
use crate::mesh::Mesh;
use crate::view::Frame;

/// Marks a lattice vertex that no triangle uses.
const UNUSED: u32 = u32::MAX;

/// The lattice's triangles as a mesh, and which lattice vertex each of its vertices is.
///
/// Every triangle of the lattice whose three vertices have heights is in it,
/// counter-clockwise seen from above (from where the heights point), and only
/// the vertices that these use. Each has a normal: the mean of those of the
/// triangles around it, weighted by area.
#[derive(Debug, Clone, PartialEq)]
pub struct Triangulation {
    mesh: Mesh,
    vertices: Vec<u32>,
    /// Number of vertices of the lattice.
    lattice: usize,
}

impl Triangulation {
    /// The triangles of a heightfield over the plane of a frame:
    /// [`Frame::default`] gives positions `x y z` as in the lattice, the frame
    /// of [`Samples`](crate::Samples) those of the mesh that was seen.
    ///
    /// Costs `O(vertices)`.
    ///
    /// # Errors
    /// [`Error::Unsupported`] if there is no whole triangle, [`Error::OutOfMemory`].
    pub fn new(surface: &Heightfield, frame: &Frame) -> Result<Self> {
        let lattice = surface.lattice();
        let mut sums = try_filled("mesh", lattice.len(), [0.0; 3])?;
        let mut numbers = try_filled("mesh", lattice.len(), UNUSED)?;
        let mut count = 0;
        for triangle in whole_triangles(surface) {
            count += 1;
            let normal = normal(surface, triangle);
            for (row, col) in triangle {
                let i = lattice.index(row, col);
                numbers[i] = 0;
                (0..3).for_each(|k| sums[i][k] += normal[k]);
            }
        }
        let used = numbers.iter().filter(|n| **n != UNUSED).count();
        if used == 0 {
            return Err(Error::Unsupported {
                format: "surface",
                reason: "no triangle of the lattice has a height at all three vertices, so there \
                         is nothing to make a mesh of"
                    .into(),
            });
        }
        let mut positions = room(used)?;
        let mut normals = room(used)?;
        let mut vertices = room(used)?;
        for (i, number) in numbers
            .iter_mut()
            .enumerate()
            .filter(|(_, n)| **n != UNUSED)
        {
            *number = vertices.len() as u32;
            vertices.push(i as u32);
            let [x, y] = lattice.position(i / lattice.cols(), i % lattice.cols());
            positions.push(frame.unview([x, y, surface.heights()[i]]));
            let [x, y, z] = frame.unview(sums[i]);
            let length = x.hypot(y).hypot(z);
            normals.push([x, y, z].map(|v| (v / length) as f32));
        }
        let mut triangles = room(count)?;
        triangles.extend(
            whole_triangles(surface)
                .map(|triangle| triangle.map(|(row, col)| numbers[lattice.index(row, col)])),
        );
        Ok(Triangulation {
            mesh: Mesh::new(positions, triangles)?.with_normals(normals)?,
            vertices,
            lattice: lattice.len(),
        })
    }

    /// The same with colours, given for each vertex of the lattice as [`Mesh::with_colors`] takes
    /// them; NaN becomes 0.
    ///
    /// # Errors
    /// [`Error::Shape`] if there is not one for each vertex of the lattice, [`Error::OutOfMemory`].
    pub fn with_colors(self, colors: &[[f32; 3]]) -> Result<Self> {
        let colors = self.picked("colours of the surface", colors)?;
        let mesh = self.mesh.with_colors(colors)?;
        Ok(Triangulation { mesh, ..self })
    }

    /// The same with texture coordinates likewise.
    ///
    /// # Errors
    /// As [`Triangulation::with_colors`].
    pub fn with_uvs(self, uvs: &[[f32; 2]]) -> Result<Self> {
        let uvs = self.picked("texture coordinates of the surface", uvs)?;
        let mesh = self.mesh.with_uvs(uvs)?;
        Ok(Triangulation { mesh, ..self })
    }

    /// The mesh.
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// The mesh, without the rest.
    pub fn into_mesh(self) -> Mesh {
        self.mesh
    }

    /// For each vertex of the mesh its index in the lattice's row-major arrays.
    pub fn vertices(&self) -> &[u32] {
        &self.vertices
    }

    fn picked<const N: usize>(
        &self,
        what: &'static str,
        values: &[[f32; N]],
    ) -> Result<Vec<[f32; N]>> {
        check_count(what, self.lattice, N, N * values.len())?;
        let mut picked = room(self.vertices.len())?;
        let finite = |v: f32| if v.is_finite() { v } else { 0.0 };
        picked.extend(
            self.vertices
                .iter()
                .map(|i| values[*i as usize].map(finite)),
        );
        Ok(picked)
    }
}

fn room<T>(len: usize) -> Result<Vec<T>> {
    let mut list = Vec::new();
    list.try_reserve_exact(len)
        .map_err(|_| Error::OutOfMemory {
            what: "mesh",
            bytes: len * size_of::<T>(),
        })?;
    Ok(list)
}

type Vertex = (usize, usize);

/// The lattice's triangles with three heights, each counter-clockwise with `y` up.
fn whole_triangles(surface: &Heightfield) -> impl Iterator<Item = [Vertex; 3]> {
    let lattice = surface.lattice();
    let vertices = (0..lattice.rows()).flat_map(|r| (0..lattice.cols()).map(move |c| (r, c)));
    vertices
        .flat_map(|(row, col)| {
            let a = (row as isize, col as isize);
            let [e, sw, se] = [Towards::East, Towards::SouthWest, Towards::SouthEast]
                .map(|towards| towards.step(a.0, a.1));
            [[a, sw, se], [a, se, e]]
        })
        .filter(|triangle| {
            triangle.iter().all(|(r, c)| {
                surface.lattice().contains(*r, *c)
                    && surface.height(*r as usize, *c as usize).is_finite()
            })
        })
        .map(|triangle| triangle.map(|(r, c)| (r as usize, c as usize)))
}

/// Normal of a triangle, in units of the spacing so that it neither over- nor underflows.
fn normal(surface: &Heightfield, triangle: [Vertex; 3]) -> [f64; 3] {
    let lattice = surface.lattice();
    let [a, b, c] = triangle.map(|(row, col)| {
        let ([x, y], z) = (lattice.position(row, col), surface.height(row, col));
        [x, y, z].map(|v| v / lattice.spacing())
    });
    let edge = |to: [f64; 3]| [to[0] - a[0], to[1] - a[1], to[2] - a[2]];
    let ([ux, uy, uz], [vx, vy, vz]) = (edge(b), edge(c));
    [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx]
}

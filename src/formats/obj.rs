//! Wavefront OBJ: the lattice as a triangle mesh.

use std::io::{self, Write};

use super::Buffer;
use crate::error::{Error, Result, try_filled};
use crate::heightfield::Heightfield;
use crate::lattice::Towards;
use crate::view::Frame;

/// Marks a vertex that no triangle uses.
const UNUSED: u32 = 0;

/// An OBJ file of the surface: every lattice triangle whose three vertices have
/// heights, counter-clockwise seen from above (from +z), and only the vertices
/// these use, with a normal each.
///
/// Positions are `x y z` as in the lattice: `x` to the right, `y` up the image,
/// `z` the height, all in the same unit, with as many digits as it takes to
/// read back the same 64-bit floats. Normals are the means of those of the
/// triangles around, weighted by area.
///
/// Costs `O(vertices)`.
///
/// # Errors
/// [`Error::Unsupported`] if there is no whole triangle, [`Error::OutOfMemory`].
pub fn write_obj(surface: &Heightfield) -> Result<Vec<u8>> {
    let own = Frame {
        right: [1.0, 0.0, 0.0],
        up: [0.0, 1.0, 0.0],
        towards: [0.0, 0.0, 1.0],
    };
    write_obj_in(surface, &own)
}

/// An OBJ file of a surface over what was seen of a mesh, turned back to the mesh's own axes: as
/// [`write_obj`], with `x`, `y` and `z` along the axes of the frame.
///
/// # Errors
/// As [`write_obj`].
pub fn write_obj_in(surface: &Heightfield, frame: &Frame) -> Result<Vec<u8>> {
    let vertices = surface.heights().len();
    let mut normals = try_filled("OBJ file", vertices, [0.0; 3])?;
    let mut numbers = try_filled("OBJ file", vertices, UNUSED)?;
    for triangle in triangles(surface) {
        let normal = normal(surface, triangle);
        for vertex in triangle {
            let i = index(surface, vertex);
            numbers[i] = 1;
            normals[i]
                .iter_mut()
                .zip(normal)
                .for_each(|(sum, n)| *sum += n);
        }
    }
    let mut used = 0;
    for number in numbers.iter_mut().filter(|n| **n != UNUSED) {
        used += 1;
        *number = used;
    }
    if used == 0 {
        return Err(Error::Unsupported {
            format: "OBJ",
            reason: "no triangle of the lattice has a height at all three vertices, so there is \
                     no surface to write"
                .into(),
        });
    }
    let mut file = Buffer::default();
    let written = write(&mut file, surface, frame, &numbers, &normals);
    file.finish("OBJ file", written)
}

fn write(
    file: &mut Buffer,
    surface: &Heightfield,
    frame: &Frame,
    numbers: &[u32],
    normals: &[[f64; 3]],
) -> io::Result<()> {
    let lattice = surface.lattice();
    let used = || (0..numbers.len()).filter(|i| numbers[*i] != UNUSED);
    let Frame { right, up, towards } = frame;
    writeln!(
        file,
        "# height surface: {right:?} to the right, {up:?} up, {towards:?} the height"
    )?;
    for i in used() {
        let [x, y] = lattice.position(i / lattice.cols(), i % lattice.cols());
        let [x, y, z] = frame.unview([x, y, surface.heights()[i]]);
        writeln!(file, "v {x} {y} {z}")?;
    }
    for i in used() {
        let [x, y, z] = frame.unview(normals[i]);
        let length = x.hypot(y).hypot(z);
        writeln!(
            file,
            "vn {:.6} {:.6} {:.6}",
            x / length,
            y / length,
            z / length
        )?;
    }
    for triangle in triangles(surface) {
        let [a, b, c] = triangle.map(|v| numbers[index(surface, v)]);
        writeln!(file, "f {a}//{a} {b}//{b} {c}//{c}")?;
    }
    Ok(())
}

type Vertex = (usize, usize);

fn index(surface: &Heightfield, (row, col): Vertex) -> usize {
    surface.lattice().index(row, col)
}

/// The lattice's triangles with three heights, each counter-clockwise with `y` up.
fn triangles(surface: &Heightfield) -> impl Iterator<Item = [Vertex; 3]> {
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

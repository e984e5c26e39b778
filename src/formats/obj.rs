//! Wavefront OBJ: the lattice as a triangle mesh.

use std::io::{self, Write};

use super::Buffer;
use crate::error::{Result, try_filled};
use crate::heightfield::Heightfield;
use crate::triangulation::Triangulation;
use crate::view::Frame;

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
/// [`Error::Unsupported`](crate::Error::Unsupported) if there is no whole triangle,
/// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
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
    let mesh = Triangulation::new(surface)?;
    let mut normals = try_filled("OBJ file", mesh.vertices().len(), [0.0; 3])?;
    for triangle in mesh.triangles() {
        let normal = mesh.normal(*triangle);
        for vertex in triangle {
            (normals[*vertex as usize].iter_mut().zip(normal)).for_each(|(sum, n)| *sum += n);
        }
    }
    let mut file = Buffer::default();
    let written = write(&mut file, &mesh, frame, &normals);
    file.finish("OBJ file", written)
}

fn write(
    file: &mut Buffer,
    mesh: &Triangulation,
    frame: &Frame,
    normals: &[[f64; 3]],
) -> io::Result<()> {
    let Frame { right, up, towards } = frame;
    writeln!(
        file,
        "# height surface: {right:?} to the right, {up:?} up, {towards:?} the height"
    )?;
    for position in mesh.positions() {
        let [x, y, z] = frame.unview(*position);
        writeln!(file, "v {x} {y} {z}")?;
    }
    for normal in normals {
        let [x, y, z] = frame.unview(*normal);
        let length = x.hypot(y).hypot(z);
        writeln!(
            file,
            "vn {:.6} {:.6} {:.6}",
            x / length,
            y / length,
            z / length
        )?;
    }
    for triangle in mesh.triangles() {
        // The file counts from 1.
        let [a, b, c] = triangle.map(|v| v + 1);
        writeln!(file, "f {a}//{a} {b}//{b} {c}//{c}")?;
    }
    Ok(())
}

//! Writes surfaces and meshes as Wavefront OBJ, with a material file (MTL).

use std::io::{self, Write};

use super::buffer::Buffer;
use crate::error::{Error, Result};
use crate::heights::heightfield::Heightfield;
use crate::scene::mesh::Mesh;
use crate::scene::triangulation::Triangulation;
use crate::scene::view::Frame;

/// Writes a surface as an OBJ file, as [`write_obj_mesh`] writes the surface's [`Triangulation`]: positions are `x y z`
/// as in the lattice, `x` to the right, `y` up the image, `z` the height, all in the same unit.
///
/// # Errors
/// As [`Triangulation::new`].
pub fn write_obj(surface: &Heightfield) -> Result<Vec<u8>> {
    write_obj_in(surface, &Frame::default())
}

/// Writes a surface as an OBJ file in the axes of the mesh that it was sampled from: as [`write_obj`], with `x`, `y`
/// and `z` along the axes of the frame.
///
/// # Errors
/// As [`write_obj`].
pub fn write_obj_in(surface: &Heightfield, frame: &Frame) -> Result<Vec<u8>> {
    write_obj_mesh(Triangulation::new(surface, frame)?.mesh())
}

/// Writes a mesh as an OBJ file: positions with as many digits as it takes to read back the same 64-bit floats, then
/// what the mesh has of colours (three more numbers for each vertex, which not all readers know), texture coordinates
/// and normals.
///
/// Costs `O(vertices + triangles)`.
///
/// # Errors
/// [`Error::OutOfMemory`].
pub fn write_obj_mesh(mesh: &Mesh) -> Result<Vec<u8>> {
    write_obj_textured(mesh, None)
}

/// Writes a mesh as an OBJ file, as [`write_obj_mesh`] does, with the name of its material file ([`write_mtl`]), if
/// there is one. The material's picture takes the place of colours, because readers would multiply the two.
///
/// # Errors
/// [`Error::Option`] for a name that is empty or of several lines,
/// [`Error::Unsupported`] for a mesh without texture coordinates,
/// [`Error::OutOfMemory`].
pub fn write_obj_textured(mesh: &Mesh, materials: Option<&str>) -> Result<Vec<u8>> {
    let mut head = String::new();
    if let Some(name) = materials {
        if mesh.uvs().is_none() {
            return Err(Error::Unsupported {
                format: "OBJ",
                reason: "a material's picture needs texture coordinates, and the mesh has none"
                    .into(),
            });
        }
        head = format!(
            "mtllib {}\nusemtl {MATERIAL_NAME}\n",
            one_line("materials", name)?
        );
    }
    let mut file = Buffer::default();
    let written = file.write_all(head.as_bytes());
    let written = written.and_then(|()| write(&mut file, mesh, materials.is_none()));
    file.finish("OBJ file", written)
}

/// Name of the only material in the MTL file (Wavefront's material file).
const MATERIAL_NAME: &str = "surface";

/// Writes a Wavefront material file (MTL) for [`write_obj_textured`]: one material, with the name of its picture's
/// file.
///
/// # Errors
/// [`Error::Option`] for a name that is empty or of several lines.
pub fn write_mtl(picture: &str) -> Result<Vec<u8>> {
    let picture = one_line("picture", picture)?;
    Ok(format!("newmtl {MATERIAL_NAME}\nKd 1 1 1\nmap_Kd {picture}\n").into_bytes())
}

fn one_line<'a>(option: &'static str, name: &'a str) -> Result<&'a str> {
    if name.trim().is_empty() || name.contains(['\n', '\r']) {
        return Err(Error::option(
            option,
            name,
            "must be a file's name, on one line",
        ));
    }
    Ok(name)
}

fn write(file: &mut Buffer, mesh: &Mesh, colored: bool) -> io::Result<()> {
    for (i, [x, y, z]) in mesh.positions().iter().enumerate() {
        write!(file, "v {x} {y} {z}")?;
        match mesh.colors().filter(|_| colored) {
            Some(colors) => {
                let [r, g, b] = colors[i];
                writeln!(file, " {r} {g} {b}")?;
            }
            None => writeln!(file)?,
        }
    }
    for [u, v] in mesh.uvs().unwrap_or_default() {
        writeln!(file, "vt {u} {v}")?;
    }
    for [x, y, z] in mesh.normals().unwrap_or_default() {
        writeln!(file, "vn {x:.6} {y:.6} {z:.6}")?;
    }
    let corner: fn(u32) -> String = match (mesh.uvs(), mesh.normals()) {
        (Some(_), Some(_)) => |i| format!("{i}/{i}/{i}"),
        (Some(_), None) => |i| format!("{i}/{i}"),
        (None, Some(_)) => |i| format!("{i}//{i}"),
        (None, None) => |i| format!("{i}"),
    };
    for triangle in mesh.triangles() {
        // OBJ counts vertices from 1.
        let [a, b, c] = triangle.map(|i| corner(i + 1));
        writeln!(file, "f {a} {b} {c}")?;
    }
    Ok(())
}

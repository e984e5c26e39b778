//! Writes surfaces and meshes as Wavefront OBJ, with a material file (MTL).

use std::io::{self, Write};

use super::buffer::Buffer;
use crate::error::{Error, Result};
use crate::files::failure::unsupported;
use crate::scene::mesh::Mesh;

/// Writes a mesh as an OBJ file: positions with as many digits as it takes to read back the same 64-bit floats, then
/// what the mesh has of colours (three more numbers for each vertex, which not all readers know), texture coordinates
/// and normals. `materials` is the name of its material file ([`write_mtl`]), if there is one: the material's picture takes the
/// place of colours, because readers would multiply the two.
///
/// A surface is written as its [`Triangulation`](crate::Triangulation). Costs `O(vertices + triangles)`.
///
/// # Errors
/// [`Error::Option`] for a name that is empty or of several lines,
/// [`Error::Unsupported`] for materials of a mesh without texture coordinates,
/// [`Error::OutOfMemory`].
pub fn write_obj(mesh: &Mesh, materials: Option<&str>) -> Result<Vec<u8>> {
    let mut head = String::new();
    if let Some(name) = materials {
        if mesh.uvs().is_none() {
            return Err(unsupported(
                "OBJ",
                "a material's picture needs texture coordinates, and the mesh has none",
            ));
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

/// Writes a Wavefront material file (MTL) for [`write_obj`]: one material, with the name of its picture's
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

//! Reads and writes meshes in the Stanford format (PLY).

mod header;
mod values;

use std::io::{self, Write};

use self::header::{Element, Header};
use self::values::Values;
use super::beside::Beside;
use super::builder::{MeshBuilder, NO_TEXTURE, scale_levels};
use super::corners::Corners;
use super::narrow::byte;
use super::rows::whole;
use crate::error::Result;
use crate::files::buffer::Buffer;
use crate::files::failure::{damaged, not_read};
use crate::files::number_type::NumberType;
use crate::scene::mesh::Mesh;

pub(super) fn read(bytes: &[u8], beside: &Beside, parts: &mut MeshBuilder) -> Result<()> {
    let (header, rest) = Header::parse(bytes)?;
    let mut values = Values::new(rest, header.encoding);
    let mut pictures = Vec::new();
    for name in &header.textures {
        pictures.push(match beside.find(name) {
            Some((name, bytes)) => parts.picture(name, bytes)?,
            None => NO_TEXTURE,
        });
    }
    let mut faces = Faces {
        pictures,
        corners: None,
    };
    // An element without properties takes no bytes, however many there are.
    for element in header.elements.iter().filter(|e| !e.properties.is_empty()) {
        let has = |name: &str| element.properties.iter().any(|p| p.name == name);
        let polygons = matches!(element.name.as_str(), "face" | "tristrips");
        if polygons && !has("vertex_indices") && !has("vertex_index") {
            let reason = format!(
                "elements `{}` have no list of whole numbers `vertex_indices`",
                element.name
            );
            return Err(damaged(reason));
        }
        parts.has_lines |= element.name == "edge" && element.count > 0;
        if let ("vertex", Some(missing)) = (
            element.name.as_str(),
            ["x", "y", "z"].into_iter().find(|name| !has(name)),
        ) {
            let reason = format!(
                "its vertices have no property `{missing}`; save it with x, y and z for each vertex"
            );
            return Err(not_read(reason));
        }
        for _ in 0..element.count {
            match element.name.as_str() {
                "vertex" => vertex(element, &mut values, parts)?,
                "face" | "tristrips" => faces.read(element, &mut values, parts)?,
                _ => each_value(element, &mut values, |_, _, _| Ok(()))?,
            }
        }
    }
    // Floats and wide integers may be shares, or levels up to 255.
    scale_levels(parts.colors.iter_mut());
    Ok(())
}

/// Reads an element and calls a function with each value, its property's name, and the value that would be white, which is 1 where
/// the type does not tell.
fn each_value(
    element: &Element,
    values: &mut Values,
    mut take: impl FnMut(&str, f64, f64) -> Result<()>,
) -> Result<()> {
    for property in &element.properties {
        let count = match property.length {
            Some(kind) => whole(values.next(kind)?)?,
            None => 1,
        };
        for _ in 0..count {
            take(
                &property.name,
                values.next(property.kind)?,
                match property.kind {
                    NumberType::U8 | NumberType::U16 => property.kind.one(),
                    _ => 1.0,
                },
            )?;
        }
    }
    Ok(())
}

/// Reads a vertex, and adds it to the mesh with what it has of colours and texture coordinates.
fn vertex(element: &Element, values: &mut Values, parts: &mut MeshBuilder) -> Result<()> {
    let (mut position, mut color, mut uv) = ([f64::NAN; 3], [f32::NAN; 3], [f32::NAN; 2]);
    each_value(element, values, |name, value, white| {
        match name {
            "x" => position[0] = value,
            "y" => position[1] = value,
            "z" => position[2] = value,
            "s" | "u" | "texture_u" => uv[0] = value as f32,
            "t" | "v" | "texture_v" => uv[1] = value as f32,
            _ => add_channel(&mut color, name, value, white),
        }
        Ok(())
    })?;
    parts.position(position)?;
    if !color.iter().any(|c| c.is_nan()) {
        parts.colors.push(color);
    }
    if !uv.iter().any(|c| c.is_nan()) {
        parts.uvs.push(uv);
    }
    Ok(())
}

/// Sets a channel of a colour by the property that has it, whose value for white is given.
fn add_channel(color: &mut [f32; 3], name: &str, value: f64, white: f64) {
    let channel = match name {
        "red" | "r" | "diffuse_red" => 0,
        "green" | "g" | "diffuse_green" => 1,
        "blue" | "b" | "diffuse_blue" => 2,
        _ => return,
    };
    color[channel] = (value / white) as f32;
}

/// Reads the faces and triangle strips of a file, which may have texture coordinates at their corners.
struct Faces {
    /// Number of each texture that the header names.
    pictures: Vec<i32>,
    /// The vertices as the file has them, where texture coordinates at corners make others of them.
    corners: Option<Corners>,
}

impl Faces {
    fn read(
        &mut self,
        element: &Element,
        values: &mut Values,
        parts: &mut MeshBuilder,
    ) -> Result<()> {
        let (mut indices, mut uvs, mut texture) = (Vec::new(), Vec::new(), 0.0);
        let mut color = [f32::NAN; 3];
        each_value(element, values, |name, value, white| {
            match name {
                "vertex_indices" | "vertex_index" => indices.push(value),
                "texcoord" => uvs.push(value as f32),
                "texnumber" => texture = value,
                _ => add_channel(&mut color, name, value, white),
            }
            Ok(())
        })?;
        if element.name == "tristrips" {
            // -1 begins another strip.
            for strip in indices.split(|index| *index == -1.0) {
                let strip = strip
                    .iter()
                    .map(|i| whole(*i))
                    .collect::<Result<Vec<_>>>()?;
                parts.strip(&strip)?;
            }
        } else {
            let mut face = indices
                .iter()
                .map(|i| whole(*i))
                .collect::<Result<Vec<_>>>()?;
            let has_uvs = element.properties.iter().any(|p| p.name == "texcoord");
            // Where vertices have colours or texture coordinates, these count.
            let is_plain =
                self.corners.is_some() || parts.colors.is_empty() && parts.uvs.is_empty();
            let color = (is_plain && !color.iter().any(|c| c.is_nan())).then_some(color);
            if has_uvs || color.is_some() {
                let corners = (self.corners).get_or_insert_with(|| Corners::taken_from(parts));
                corners.split(&mut face, &uvs, color, parts)?;
            }
            parts.polygon(&face)?;
        }
        // Numbers below 0 stand for none.
        let picture = (texture >= 0.0)
            .then(|| self.pictures.get(texture as usize))
            .flatten();
        parts.texture(picture.copied().unwrap_or(NO_TEXTURE));
        Ok(())
    }
}

/// Writes a mesh as a PLY file (binary, little-endian).
///
/// Positions are written as 64-bit floats, exactly; normals and texture
/// coordinates (`s`, `t`) as 32-bit floats; colours as bytes, 0 to 255 for 0 to
/// 1. What the mesh does not have is left out. Costs `O(vertices + triangles)`.
///
/// # Errors
/// [`Error::Unsupported`](crate::Error::Unsupported) from 2³¹ vertices,
/// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
pub fn write_ply(mesh: &Mesh) -> Result<Vec<u8>> {
    if mesh.positions().len() > i32::MAX as usize {
        return Err(not_read("more than 2³¹ vertices are not written"));
    }
    let mut file = Buffer::default();
    let written = write(&mut file, mesh);
    file.finish("PLY file", written)
}

fn write(file: &mut Buffer, mesh: &Mesh) -> io::Result<()> {
    writeln!(file, "ply\nformat binary_little_endian 1.0")?;
    writeln!(file, "element vertex {}", mesh.positions().len())?;
    let groups = [
        (true, "double", ["x", "y", "z"].as_slice()),
        (mesh.normals().is_some(), "float", &["nx", "ny", "nz"]),
        (mesh.colors().is_some(), "uchar", &["red", "green", "blue"]),
        (mesh.uvs().is_some(), "float", &["s", "t"]),
    ];
    for (_, kind, names) in groups.iter().filter(|(there, ..)| *there) {
        for name in *names {
            writeln!(file, "property {kind} {name}")?;
        }
    }
    writeln!(file, "element face {}", mesh.triangles().len())?;
    writeln!(file, "property list uchar int vertex_indices\nend_header")?;
    for (i, position) in mesh.positions().iter().enumerate() {
        file.write_all(position.map(f64::to_le_bytes).as_flattened())?;
        if let Some(normals) = mesh.normals() {
            file.write_all(normals[i].map(f32::to_le_bytes).as_flattened())?;
        }
        if let Some(colors) = mesh.colors() {
            file.write_all(&colors[i].map(byte))?;
        }
        if let Some(uvs) = mesh.uvs() {
            file.write_all(uvs[i].map(f32::to_le_bytes).as_flattened())?;
        }
    }
    for triangle in mesh.triangles() {
        file.write_all(&[3])?;
        file.write_all(triangle.map(u32::to_le_bytes).as_flattened())?;
    }
    Ok(())
}

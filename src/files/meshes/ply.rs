//! Reads and writes meshes in the Stanford format (PLY) by the `ply-rs-bw` crate.

use std::io::{self, Cursor};

use ply_rs_bw::parser::{Parser, Reader};
use ply_rs_bw::ply::{
    Addable, ElementDef, Encoding, Header, Property, PropertyAccess, PropertyAccessResult,
    PropertyDef, PropertyType, ScalarType,
};
use ply_rs_bw::writer::Writer;

use super::beside::Beside;
use super::builder::{MeshBuilder, damaged, unsupported};
use super::narrow::byte;
use crate::error::Result;
use crate::files::buffer::Buffer;
use crate::scene::mesh::Mesh;

pub(super) fn read(bytes: &[u8], beside: &Beside, parts: &mut MeshBuilder) -> Result<()> {
    let mut reader = Reader::new(Cursor::new(bytes));
    let header = Parser::<SkippedElement>::new()
        .read_header(&mut reader)
        .map_err(|error| damaged("PLY", error))?;
    for element in header.elements.values() {
        // Each element takes at least a byte, unless it has no properties.
        if element.count > bytes.len() || element.properties.is_empty() && element.count > 0 {
            return Err(damaged(
                "PLY",
                format!(
                    "the header states {} elements `{}`, for which the file is too short",
                    element.count, element.name
                ),
            ));
        }
        match element.name.as_str() {
            "vertex" => {
                let vertices = Parser::<Vertex>::new()
                    .read_payload_for_element(&mut reader, element, &header)
                    .map_err(|error| damaged("PLY", error))?;
                vertices.iter().try_for_each(|vertex| vertex.add(parts))?;
            }
            "face" => {
                let faces = Parser::<Face>::new()
                    .read_payload_for_element(&mut reader, element, &header)
                    .map_err(|error| damaged("PLY", error))?;
                for (i, face) in faces.iter().enumerate() {
                    match &face.0 {
                        Some(corners) => parts.fan(corners)?,
                        None => {
                            return Err(damaged(
                                "PLY",
                                format!("face {i} has no list of whole numbers `vertex_indices`"),
                            ));
                        }
                    }
                }
            }
            "tristrips" => {
                return Err(unsupported(
                    "PLY",
                    "triangle strips are not read; save the file with faces",
                ));
            }
            _ => {
                Parser::<SkippedElement>::new()
                    .read_payload_for_element(&mut reader, element, &header)
                    .map_err(|error| damaged("PLY", error))?;
            }
        }
    }
    // Several textures would need a number at each face, for which there is no standard name.
    let mut names = (header.comments.iter()).filter_map(|c| c.trim().strip_prefix("TextureFile"));
    if let (Some(name), None) = (names.next().map(str::trim), names.next())
        && let Some((name, bytes)) = beside.find(name)
    {
        let number = parts.picture(name, bytes)?;
        parts.texture(number);
    }
    Ok(())
}

/// An element of a PLY file, such as an edge, whose values are skipped.
struct SkippedElement;

impl PropertyAccess for SkippedElement {
    fn new() -> Self {
        SkippedElement
    }
}

/// A vertex read from a PLY file: position, colour and texture coordinates, NaN where the file lacks them.
struct Vertex {
    position: [f64; 3],
    color: [f32; 3],
    uv: [f32; 2],
}

impl Vertex {
    fn add(&self, parts: &mut MeshBuilder) -> Result<()> {
        parts.position(self.position)?;
        if !self.color.iter().any(|c| c.is_nan()) {
            parts.colors.push(self.color);
        }
        if !self.uv.iter().any(|c| c.is_nan()) {
            parts.uvs.push(self.uv);
        }
        Ok(())
    }
}

impl PropertyAccess for Vertex {
    fn new() -> Self {
        Vertex {
            position: [f64::NAN; 3],
            color: [f32::NAN; 3],
            uv: [f32::NAN; 2],
        }
    }

    fn set_property(&mut self, name: &str, property: Property) -> PropertyAccessResult {
        let Some((value, white)) = number(&property) else {
            return PropertyAccessResult::Ignored;
        };
        let color = (value / white) as f32;
        match name {
            "x" => self.position[0] = value,
            "y" => self.position[1] = value,
            "z" => self.position[2] = value,
            "red" => self.color[0] = color,
            "green" => self.color[1] = color,
            "blue" => self.color[2] = color,
            "s" | "u" | "texture_u" => self.uv[0] = value as f32,
            "t" | "v" | "texture_v" => self.uv[1] = value as f32,
            _ => return PropertyAccessResult::Ignored,
        }
        PropertyAccessResult::Set
    }
}

/// Reads a number from a PLY file, and returns it with the value that stands for white in its type.
fn number(property: &Property) -> Option<(f64, f64)> {
    Some(match property {
        Property::Char(v) => (f64::from(*v), f64::from(i8::MAX)),
        Property::UChar(v) => (f64::from(*v), f64::from(u8::MAX)),
        Property::Short(v) => (f64::from(*v), f64::from(i16::MAX)),
        Property::UShort(v) => (f64::from(*v), f64::from(u16::MAX)),
        Property::Int(v) => (f64::from(*v), f64::from(i32::MAX)),
        Property::UInt(v) => (f64::from(*v), f64::from(u32::MAX)),
        Property::Float(v) => (f64::from(*v), 1.0),
        Property::Double(v) => (*v, 1.0),
        _ => return None,
    })
}

struct Face(Option<Vec<u32>>);

impl PropertyAccess for Face {
    fn new() -> Self {
        Face(None)
    }

    fn set_property(&mut self, name: &str, property: Property) -> PropertyAccessResult {
        if !matches!(name, "vertex_indices" | "vertex_index") {
            return PropertyAccessResult::Ignored;
        }
        self.0 = property.to_u32_list();
        PropertyAccessResult::Set
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
        return Err(unsupported("PLY", "more than 2³¹ vertices are not written"));
    }
    let mut file = Buffer::default();
    let written = write(&mut file, mesh);
    file.finish("PLY file", written)
}

fn write(file: &mut Buffer, mesh: &Mesh) -> io::Result<()> {
    let mut properties = vec![(["x", "y", "z"].as_slice(), ScalarType::Double)];
    if mesh.normals().is_some() {
        properties.push((&["nx", "ny", "nz"], ScalarType::Float));
    }
    if mesh.colors().is_some() {
        properties.push((&["red", "green", "blue"], ScalarType::UChar));
    }
    if mesh.uvs().is_some() {
        properties.push((&["s", "t"], ScalarType::Float));
    }
    let mut vertex = ElementDef::new("vertex".into());
    vertex.count = mesh.positions().len();
    for (names, kind) in properties {
        for name in names {
            let kind = PropertyType::Scalar(kind.clone());
            vertex
                .properties
                .add(PropertyDef::new((*name).into(), kind));
        }
    }
    let mut face = ElementDef::new("face".into());
    face.count = mesh.triangles().len();
    let list = PropertyType::List(ScalarType::UChar, ScalarType::Int);
    face.properties
        .add(PropertyDef::new("vertex_indices".into(), list));

    let mut header = Header::new();
    header.encoding = Encoding::BinaryLittleEndian;
    header.elements.add(vertex.clone());
    header.elements.add(face.clone());
    let writer = Writer::<Element>::new();
    writer.write_header(file, &header)?;
    for i in 0..mesh.positions().len() {
        writer.write_little_endian_element(file, &Element::vertex(mesh, i), &vertex)?;
    }
    for triangle in mesh.triangles() {
        let corners = Element::Triangle(triangle.map(|i| i as i32));
        writer.write_little_endian_element(file, &corners, &face)?;
    }
    Ok(())
}

/// An element of a PLY file that is being written: a vertex or a triangle.
enum Element {
    Vertex {
        position: [f64; 3],
        normal: [f32; 3],
        color: [u8; 3],
        uv: [f32; 2],
    },
    Triangle([i32; 3]),
}

impl Element {
    fn vertex(mesh: &Mesh, i: usize) -> Self {
        Element::Vertex {
            position: mesh.positions()[i],
            normal: mesh.normals().map_or([0.0; 3], |n| n[i]),
            color: mesh.colors().map_or([0; 3], |c| c[i].map(byte)),
            uv: mesh.uvs().map_or([0.0; 2], |uv| uv[i]),
        }
    }
}

impl PropertyAccess for Element {
    fn new() -> Self {
        Element::Triangle([0; 3])
    }

    fn get_double(&self, name: &str) -> Option<f64> {
        let Element::Vertex { position, .. } = self else {
            return None;
        };
        ["x", "y", "z"]
            .iter()
            .position(|axis| *axis == name)
            .map(|k| position[k])
    }

    fn get_float(&self, name: &str) -> Option<f32> {
        let Element::Vertex { normal, uv, .. } = self else {
            return None;
        };
        Some(match name {
            "nx" => normal[0],
            "ny" => normal[1],
            "nz" => normal[2],
            "s" => uv[0],
            "t" => uv[1],
            _ => return None,
        })
    }

    fn get_uchar(&self, name: &str) -> Option<u8> {
        let Element::Vertex { color, .. } = self else {
            return None;
        };
        ["red", "green", "blue"]
            .iter()
            .position(|channel| *channel == name)
            .map(|k| color[k])
    }

    fn get_list_int(&self, _: &str) -> Option<&[i32]> {
        match self {
            Element::Triangle(corners) => Some(corners),
            Element::Vertex { .. } => None,
        }
    }
}

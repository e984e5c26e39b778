//! The mesh formats: their names, and how the contents of a file tell which one it has.

use std::str::FromStr;

use super::image_format::is_text_grid;
use super::signature::contains;
use super::table::Table;
use super::text::{decoded, lines};
use crate::error::{Error, Result};

/// A mesh file format that can be read.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum MeshFormat {
    /// Wavefront OBJ: all groups together, with colours after the coordinates, and with the diffuse colours and
    /// textures of the materials (MTL).
    Obj,
    /// The Stanford format PLY, ASCII or binary of either byte order; a texture is named by a comment,
    /// `TextureFile`.
    Ply,
    /// Stereolithography, ASCII or binary, with colours as VisCAM or Magics writes them. Each triangle has vertices of its own.
    Stl,
    /// glTF 2.0 as JSON, or binary (GLB): the meshes of the default scene, with
    /// their nodes' transforms applied, and the base colours and textures of
    /// their materials.
    Gltf,
    /// 3D Manufacturing Format: the objects that are to be built, with their transforms and the file's unit.
    ThreeMf,
    /// Object File Format in text, with or without colours and normals at the vertices, or colours of the faces.
    Off,
    /// Points in text (XYZ): x, y, z in each line, with or without red, green and blue from 0 to 255 at its end.
    Xyz,
}

impl MeshFormat {
    /// Returns the name of the mesh format: `"obj"`, `"ply"`, `"stl"`, `"gltf"`, `"3mf"`, `"off"` or `"xyz"`.
    pub fn name(self) -> &'static str {
        MESH_FORMATS[self as usize].1
    }

    /// Detects the format of a mesh file from the file's contents. OBJ has no signature: a line that begins with `v`
    /// and a blank is taken for OBJ; lines of numbers are points unless these lie on a grid or are few. Costs `O(bytes)`.
    pub fn detect(bytes: &[u8]) -> Option<MeshFormat> {
        let mut text = bytes
            .strip_prefix(b"\xef\xbb\xbf")
            .unwrap_or(bytes)
            .trim_ascii_start();
        while text.starts_with(b"#") {
            let end = text.iter().position(|byte| b"\r\n".contains(byte));
            text = text[end.unwrap_or(text.len())..].trim_ascii_start();
        }
        let mut heads = text.split(|byte| b"\r\n".contains(byte));
        let line = heads.next().unwrap_or_default().trim_ascii();
        // The signature may be in capitals, as trimesh and assimp read it, too.
        if line.eq_ignore_ascii_case(b"ply") {
            return Some(MeshFormat::Ply);
        }
        if bytes.starts_with(b"glTF") || text.starts_with(b"{") && contains(bytes, GLTF_ASSET) {
            return Some(MeshFormat::Gltf);
        }
        if bytes.starts_with(b"PK\x03\x04") {
            return contains(bytes, b".model").then_some(MeshFormat::ThreeMf);
        }
        let line = String::from_utf8_lossy(line);
        let mut words = line.split_whitespace();
        let kinds = words.next().and_then(|word| word.strip_suffix("OFF"));
        if ["", "C", "N", "CN", "NC", "ST", "STC", "STN", "STCN"].contains(&kinds.unwrap_or("?"))
            && words.all(|word| word == "BINARY" || word.parse::<u32>().is_ok())
        {
            return Some(MeshFormat::Off);
        }
        if is_binary_stl(bytes) || begins_as_solid(bytes) && !is_other_text(bytes) {
            return Some(MeshFormat::Stl);
        }
        let is_vertex = |line: &str| {
            let mut words = line.split_whitespace();
            words.next() == Some("v")
                && words.next().is_some_and(|word| word.parse::<f64>().is_ok())
        };
        if (lines(&decoded(bytes))).any(|(_, line)| is_vertex(&line)) {
            return Some(MeshFormat::Obj);
        }
        (is_text_grid(bytes) && Table::is_cloud(bytes)).then_some(MeshFormat::Xyz)
    }

    pub(in crate::files) fn title(self) -> &'static str {
        MESH_FORMATS[self as usize].2
    }
}

/// Mesh formats with their names in options and their titles in messages.
const MESH_FORMATS: [(MeshFormat, &str, &str); 7] = [
    (MeshFormat::Obj, "obj", "OBJ"),
    (MeshFormat::Ply, "ply", "PLY"),
    (MeshFormat::Stl, "stl", "STL"),
    (MeshFormat::Gltf, "gltf", "glTF"),
    (MeshFormat::ThreeMf, "3mf", "3MF"),
    (MeshFormat::Off, "off", "OFF"),
    (MeshFormat::Xyz, "xyz", "XYZ"),
];

/// Property that every glTF file in text has.
const GLTF_ASSET: &[u8] = b"\"asset\"";

/// Number of bytes before the first triangle of a binary STL file.
pub(super) const STL_HEADER_BYTES: usize = 84;

/// Number of bytes of each triangle of a binary STL file.
pub(super) const STL_TRIANGLE_BYTES: usize = 50;

/// Returns whether a file has exactly the length of a binary STL file with the number of triangles in its header.
fn is_binary_stl(bytes: &[u8]) -> bool {
    stl_length(bytes) == Some(bytes.len())
}

/// Returns whether a file begins as an ASCII STL file does. Binary files may do so, too.
fn begins_as_solid(bytes: &[u8]) -> bool {
    let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    (text.trim_ascii_start().get(..5)).is_some_and(|word| word.eq_ignore_ascii_case(b"solid"))
}

/// Returns whether a text that begins as an STL file has no line of one.
fn is_other_text(bytes: &[u8]) -> bool {
    let is_statement = |line: &str| {
        let first = line.split_whitespace().next().unwrap_or_default();
        ["facet", "endsolid"]
            .iter()
            .any(|name| first.eq_ignore_ascii_case(name))
    };
    is_ascii_stl(bytes) && !lines(&decoded(bytes)).any(|(_, line)| is_statement(&line))
}

/// Returns whether an STL file is a text: it has no zero where the highest byte of a binary file's number of triangles is.
pub(super) fn is_ascii_stl(bytes: &[u8]) -> bool {
    let highest = bytes.get(STL_HEADER_BYTES - 1);
    begins_as_solid(bytes) && !is_binary_stl(bytes) && highest != Some(&0)
}

/// Length of a binary STL file by the number of triangles in its header, in bytes.
pub(super) fn stl_length(bytes: &[u8]) -> Option<usize> {
    let count = bytes.get(STL_HEADER_BYTES - 4..STL_HEADER_BYTES)?;
    let triangles = u32::from_le_bytes(count.try_into().ok()?) as usize;
    triangles
        .checked_mul(STL_TRIANGLE_BYTES)?
        .checked_add(STL_HEADER_BYTES)
}

impl FromStr for MeshFormat {
    type Err = Error;

    /// Parses the name of a mesh format, as [`MeshFormat::name`] returns it; `glb` is also glTF.
    fn from_str(name: &str) -> Result<Self> {
        let name = if name == "glb" { "gltf" } else { name };
        let mut formats = MESH_FORMATS.into_iter();
        let requirement = "must be `obj`, `ply`, `stl`, `gltf`, `glb`, `3mf`, `off` or `xyz`";
        (formats.find_map(|(format, known, _)| (name == known).then_some(format)))
            .ok_or_else(|| Error::option("format", name, requirement))
    }
}

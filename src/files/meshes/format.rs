//! The mesh formats: their names, and how the contents of a file tell which one it has.

use std::str::FromStr;

use super::{obj, off, stl};
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
    /// Stereolithography, ASCII or binary. Each triangle has vertices of its own.
    Stl,
    /// glTF 2.0 as JSON, or binary (GLB): the meshes of the default scene, with
    /// their nodes' transforms applied, and the base colours and textures of
    /// their materials.
    Gltf,
    /// 3D Manufacturing Format: the objects that are to be built, with their transforms and the file's unit.
    ThreeMf,
    /// Object File Format in text, with or without colours and normals at the vertices.
    Off,
}

impl MeshFormat {
    /// Returns the name of the mesh format: `"obj"`, `"ply"`, `"stl"`, `"gltf"`, `"3mf"` or `"off"`.
    pub fn name(self) -> &'static str {
        match self {
            MeshFormat::Obj => "obj",
            MeshFormat::Ply => "ply",
            MeshFormat::Stl => "stl",
            MeshFormat::Gltf => "gltf",
            MeshFormat::ThreeMf => "3mf",
            MeshFormat::Off => "off",
        }
    }

    /// Detects the format of a mesh file from the file's contents. OBJ has no signature: a line that begins with `v`
    /// and a blank is taken for OBJ.
    pub fn detect(bytes: &[u8]) -> Option<MeshFormat> {
        if bytes.starts_with(b"ply") && bytes.get(3).is_some_and(u8::is_ascii_whitespace) {
            return Some(MeshFormat::Ply);
        }
        let text = bytes
            .strip_prefix(b"\xef\xbb\xbf")
            .unwrap_or(bytes)
            .trim_ascii_start();
        if bytes.starts_with(b"glTF") || text.starts_with(b"{") {
            return Some(MeshFormat::Gltf);
        }
        if bytes.starts_with(b"PK\x03\x04") {
            return Some(MeshFormat::ThreeMf);
        }
        if off::detect(bytes) {
            return Some(MeshFormat::Off);
        }
        if stl::is_binary(bytes)
            || text
                .get(..5)
                .is_some_and(|word| word.eq_ignore_ascii_case(b"solid"))
        {
            return Some(MeshFormat::Stl);
        }
        obj::detect(bytes).then_some(MeshFormat::Obj)
    }

    pub(super) fn title(self) -> &'static str {
        match self {
            MeshFormat::Obj => "OBJ",
            MeshFormat::Ply => "PLY",
            MeshFormat::Stl => "STL",
            MeshFormat::Gltf => "glTF",
            MeshFormat::ThreeMf => "3MF",
            MeshFormat::Off => "OFF",
        }
    }
}

impl FromStr for MeshFormat {
    type Err = Error;

    /// Parses the name of a mesh format, as [`MeshFormat::name`] returns it; `glb` is also glTF.
    fn from_str(name: &str) -> Result<Self> {
        match name {
            "obj" => Ok(MeshFormat::Obj),
            "ply" => Ok(MeshFormat::Ply),
            "stl" => Ok(MeshFormat::Stl),
            "gltf" | "glb" => Ok(MeshFormat::Gltf),
            "3mf" => Ok(MeshFormat::ThreeMf),
            "off" => Ok(MeshFormat::Off),
            _ => Err(Error::option(
                "format",
                name,
                "must be `obj`, `ply`, `stl`, `gltf`, `glb`, `3mf` or `off`",
            )),
        }
    }
}

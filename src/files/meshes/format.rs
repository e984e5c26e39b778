//! The mesh formats: their names, and how the contents of a file tell which one it has.

use std::str::FromStr;

use super::{obj, stl};
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
}

impl MeshFormat {
    /// Returns the name of the mesh format: `"obj"`, `"ply"`, `"stl"` or `"gltf"`.
    pub fn name(self) -> &'static str {
        match self {
            MeshFormat::Obj => "obj",
            MeshFormat::Ply => "ply",
            MeshFormat::Stl => "stl",
            MeshFormat::Gltf => "gltf",
        }
    }

    /// Detects the format of a mesh file from the file's contents. OBJ has no signature: a line that begins with `v`
    /// and a blank is taken for OBJ.
    pub fn detect(bytes: &[u8]) -> Option<MeshFormat> {
        if bytes.starts_with(b"ply\n") || bytes.starts_with(b"ply\r") {
            return Some(MeshFormat::Ply);
        }
        if bytes.starts_with(b"glTF") || bytes.trim_ascii_start().starts_with(b"{") {
            return Some(MeshFormat::Gltf);
        }
        if stl::is_binary(bytes) || bytes.starts_with(b"solid") {
            return Some(MeshFormat::Stl);
        }
        obj::lines(bytes)
            .any(|line| obj::is_vertex(&line))
            .then_some(MeshFormat::Obj)
    }

    pub(super) fn title(self) -> &'static str {
        match self {
            MeshFormat::Obj => "OBJ",
            MeshFormat::Ply => "PLY",
            MeshFormat::Stl => "STL",
            MeshFormat::Gltf => "glTF",
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
            _ => Err(Error::option(
                "format",
                name,
                "must be `obj`, `ply`, `stl`, `gltf` or `glb`",
            )),
        }
    }
}

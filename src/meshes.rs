//! Meshes from and to files held in memory: reads OBJ, PLY, STL, glTF and GLB, writes PLY, STL
//! and GLB. (OBJ is written by [`formats`](crate::formats).)
//!
//! Damaged files are errors, never panics, and no more memory is asked for than
//! in proportion to the bytes that are there; scenes in which a few bytes stand
//! for many triangles end at [`MAX_CELLS`] triangles.

mod glb;
mod gltf;
mod narrow;
mod obj;
mod ply;
mod stl;

use std::fmt::Display;
use std::str::FromStr;

use crate::error::{Error, MAX_CELLS, Result};
use crate::mesh::Mesh;

pub use glb::write_glb;
pub use ply::write_ply;
pub use stl::write_stl;

/// A mesh file format that can be read.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum MeshFormat {
    /// Wavefront OBJ. All groups together; materials are passed over; colours
    /// after the coordinates are read.
    Obj,
    /// The Stanford format, ASCII or binary of either byte order.
    Ply,
    /// Stereolithography, ASCII or binary. Each triangle has vertices of its own.
    Stl,
    /// glTF 2.0 as JSON with embedded buffers, or binary (GLB): the meshes of
    /// the default scene, with their nodes' transforms applied.
    Gltf,
}

impl MeshFormat {
    /// `"obj"`, `"ply"`, `"stl"` or `"gltf"`.
    pub fn name(self) -> &'static str {
        match self {
            MeshFormat::Obj => "obj",
            MeshFormat::Ply => "ply",
            MeshFormat::Stl => "stl",
            MeshFormat::Gltf => "gltf",
        }
    }

    /// The format that a file seems to have. OBJ has nothing it must begin
    /// with: a line that begins with `v` and a blank is taken for one.
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

    fn title(self) -> &'static str {
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

    /// From [`MeshFormat::name`]; `glb` is glTF.
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

/// The mesh in a file; of a format that is not given, the one it seems to have.
///
/// Where there are points but no faces, they are a point cloud
/// ([`Mesh::is_cloud`]). Polygons are cut into fans. Colours and texture coordinates are kept where
/// every vertex has them. Costs `O(bytes)`.
///
/// # Errors
/// [`Error::Format`] for damage, [`Error::Unsupported`] for an unknown format,
/// a file with nothing in it, compression or buffers in other
/// files, [`Error::NotFinite`] for a coordinate that is not, [`Error::TooLarge`]
/// above [`MAX_CELLS`] triangles, [`Error::OutOfMemory`].
pub fn read_mesh(bytes: &[u8], format: Option<MeshFormat>) -> Result<Mesh> {
    let format = match format.or_else(|| MeshFormat::detect(bytes)) {
        Some(format) => format,
        None if bytes.is_empty() => return Err(damaged("a mesh", "the file is empty")),
        None => {
            return Err(Error::Unsupported {
                format: "a mesh file of unknown format",
                reason: "OBJ, PLY, STL, glTF and GLB can be read".into(),
            });
        }
    };
    let mut parts = Parts::default();
    match format {
        MeshFormat::Obj => obj::read(bytes, &mut parts)?,
        MeshFormat::Ply => ply::read(bytes, &mut parts)?,
        MeshFormat::Stl => stl::read(bytes, &mut parts)?,
        MeshFormat::Gltf => gltf::read(bytes, &mut parts)?,
    }
    parts.into_mesh(format)
}

/// A mesh that is put together.
#[derive(Default)]
struct Parts {
    positions: Vec<[f64; 3]>,
    triangles: Vec<[u32; 3]>,
    colors: Vec<[f32; 3]>,
    uvs: Vec<[f32; 2]>,
}

impl Parts {
    fn position(&mut self, position: [f64; 3]) -> Result<()> {
        push(&mut self.positions, position, 3 * MAX_CELLS)
    }

    fn triangle(&mut self, triangle: [u32; 3]) -> Result<()> {
        push(&mut self.triangles, triangle, MAX_CELLS)
    }

    /// A polygon as triangles that all share its first corner.
    fn fan(&mut self, corners: &[u32]) -> Result<()> {
        let [first, rest @ ..] = corners else {
            return Ok(());
        };
        rest.windows(2)
            .try_for_each(|edge| self.triangle([*first, edge[0], edge[1]]))
    }

    /// Colours and texture coordinates that only some of the vertices have are left out.
    fn into_mesh(self, format: MeshFormat) -> Result<Mesh> {
        let vertices = self.positions.len();
        let named = |error| match error {
            Error::Format { reason, .. } => damaged(format.title(), reason),
            Error::Unsupported { reason, .. } => unsupported(format.title(), reason),
            other => other,
        };
        let cloud = self.triangles.is_empty() && vertices > 0 && format != MeshFormat::Stl;
        let mut mesh = if cloud {
            Mesh::cloud(self.positions)
        } else {
            Mesh::new(self.positions, self.triangles)
        }
        .map_err(named)?;
        if self.colors.len() == vertices {
            mesh = mesh.with_colors(self.colors)?;
        }
        if self.uvs.len() == vertices {
            mesh = mesh.with_uvs(self.uvs)?;
        }
        Ok(mesh)
    }
}

fn push<T>(list: &mut Vec<T>, value: T, limit: usize) -> Result<()> {
    if list.len() >= limit {
        return Err(Error::TooLarge {
            what: "mesh",
            requested: limit + 1,
            limit,
        });
    }
    // Asked only where the list has to grow, for that alone costs anything.
    if list.len() == list.capacity() {
        list.try_reserve(1).map_err(|_| Error::OutOfMemory {
            what: "mesh",
            bytes: list.len() * size_of::<T>(),
        })?;
    }
    list.push(value);
    Ok(())
}

/// Most characters of what a decoder says: some quote the line, which may be the whole file.
const LONGEST: usize = 160;

fn damaged(format: &'static str, reason: impl Display) -> Error {
    let said = reason.to_string();
    let words = said.split_whitespace();
    let mut reason = words.collect::<Vec<_>>().join(" ");
    if let Some((end, _)) = reason.char_indices().nth(LONGEST) {
        reason.truncate(end);
        reason.push('…');
    }
    Error::Format { format, reason }
}

fn unsupported(format: &'static str, reason: impl Into<String>) -> Error {
    Error::Unsupported {
        format,
        reason: reason.into(),
    }
}

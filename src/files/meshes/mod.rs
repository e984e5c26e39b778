//! Meshes from and to files held in memory: reads OBJ, PLY, STL, glTF and GLB, writes PLY, STL
//! and GLB. (OBJ is written by [`formats`](super::images).)
//!
//! Damaged files are errors, never panics, and no more memory is asked for than
//! in proportion to the bytes that are there; scenes in which a few bytes stand
//! for many triangles end at [`MAX_CELLS`] triangles.

mod beside;
mod glb;
mod gltf;
mod narrow;
mod obj;
mod ply;
mod stl;

use std::fmt::Display;
use std::str::FromStr;

use crate::error::{Error, MAX_CELLS, Result};
use crate::scene::mesh::Mesh;

use beside::Beside;
pub use beside::Texture;
pub use glb::write_glb;
pub use ply::write_ply;
pub use stl::write_stl;

/// A mesh file format that can be read.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum MeshFormat {
    /// Wavefront OBJ. All groups together; colours after the coordinates are
    /// read, and the diffuse colours and textures of its materials (MTL).
    Obj,
    /// The Stanford format, ASCII or binary of either byte order; a texture is
    /// named by a comment, `TextureFile`.
    Ply,
    /// Stereolithography, ASCII or binary. Each triangle has vertices of its own.
    Stl,
    /// glTF 2.0 as JSON, or binary (GLB): the meshes of the default scene, with
    /// their nodes' transforms applied, and the base colours and textures of
    /// their materials.
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

/// A mesh from a file, and the pictures on it.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct MeshFile {
    /// The mesh. Where there are textures, [`Mesh::textures`] says which triangle has which.
    pub mesh: Mesh,
    /// The pictures, each once, in the order of their numbers.
    pub textures: Vec<Texture>,
    /// Names of the materials and textures that were not given: without them the mesh has the
    /// colours that are left.
    pub missing: Vec<String>,
}

/// The mesh in a file; of a format that is not given, the one it seems to have. As
/// [`read_mesh_beside`], without other files.
///
/// # Errors
/// As [`read_mesh_beside`].
pub fn read_mesh(bytes: &[u8], format: Option<MeshFormat>) -> Result<Mesh> {
    Ok(read_mesh_beside(bytes, format, &[])?.mesh)
}

/// The mesh in a file, with the materials, textures and buffers that the file names: `files` are
/// what may lie beside it, by name. A name is looked for as it is and then without its folders.
///
/// Where there are points but no faces, they are a point cloud
/// ([`Mesh::is_cloud`]). Polygons are cut into fans. Colours and texture coordinates are kept where
/// every vertex has them; vertices without a colour of their own have that of their material, which
/// is white where nothing says otherwise, and where there are textures, those without any need no
/// coordinates. Colours are not changed: those of glTF are linear by its
/// specification, and are so here. Costs `O(bytes)`.
///
/// # Errors
/// [`Error::Format`] for damage, [`Error::Unsupported`] for an unknown format,
/// a file with nothing in it, compression or buffers in other files that are not
/// given, [`Error::NotFinite`] for a coordinate that is not, [`Error::TooLarge`]
/// above [`MAX_CELLS`] triangles, [`Error::OutOfMemory`].
pub fn read_mesh_beside(
    bytes: &[u8],
    format: Option<MeshFormat>,
    files: &[(&str, &[u8])],
) -> Result<MeshFile> {
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
    let mut parts = Parts {
        room: bytes.len() + files.iter().map(|(_, bytes)| bytes.len()).sum::<usize>(),
        ..Parts::default()
    };
    let beside = Beside::new(files);
    match format {
        MeshFormat::Obj => obj::read(bytes, &beside, &mut parts)?,
        MeshFormat::Ply => ply::read(bytes, &beside, &mut parts)?,
        MeshFormat::Stl => stl::read(bytes, &mut parts)?,
        MeshFormat::Gltf => gltf::read(bytes, &beside, &mut parts)?,
    }
    let textures = std::mem::take(&mut parts.pictures);
    Ok(MeshFile {
        mesh: parts.into_mesh(format)?,
        textures,
        missing: beside.missing(),
    })
}

/// Colour of a vertex to which the file gives none.
const DEFAULT_VERTEX_COLOUR: [f32; 3] = [1.0; 3];

/// The texture coordinates of vertices that have none.
const NO_UV: [f32; 2] = [f32::MIN; 2];

/// The number of no texture.
const NO_TEXTURE: i32 = -1;

/// A mesh that is put together.
#[derive(Default)]
struct Parts {
    positions: Vec<[f64; 3]>,
    triangles: Vec<[u32; 3]>,
    colors: Vec<[f32; 3]>,
    uvs: Vec<[f32; 2]>,
    /// The texture of each triangle; shorter where the last ones have none.
    textures: Vec<i32>,
    pictures: Vec<Texture>,
    /// How many bytes of pictures there can be.
    room: usize,
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

    /// The same colour for all vertices from one on.
    fn material(&mut self, start: usize, color: [f32; 3]) {
        let vertices = self.positions.len() - start;
        self.colors.extend(std::iter::repeat_n(color, vertices));
    }

    /// The last vertices have no texture coordinates, which others may have.
    fn no_uvs(&mut self) {
        self.uvs.resize(self.positions.len(), NO_UV);
    }

    /// The number of a picture by its name; of one that has none, a new one.
    fn picture(&mut self, name: &str, bytes: &[u8]) -> Result<i32> {
        let known = (self.pictures.iter()).position(|p| !name.is_empty() && p.name == name);
        if let Some(number) = known {
            return Ok(number as i32);
        }
        // The same bytes may go by any number of names.
        self.room = (self.room.checked_sub(bytes.len()))
            .ok_or_else(|| damaged("textures", "together they are larger than their files"))?;
        self.pictures.push(Texture {
            name: name.into(),
            bytes: bytes.into(),
        });
        Ok(self.pictures.len() as i32 - 1)
    }

    /// Gives a texture to all triangles that have not been given one yet.
    fn texture(&mut self, number: i32) {
        self.textures.resize(self.triangles.len(), number);
    }

    /// Colours and texture coordinates that only some of the vertices have are left out.
    fn into_mesh(mut self, format: MeshFormat) -> Result<Mesh> {
        let (vertices, triangles) = (self.positions.len(), self.triangles.len());
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
        if self.colors.len() == vertices
            && self
                .colors
                .iter()
                .any(|color| *color != DEFAULT_VERTEX_COLOUR)
        {
            mesh = mesh.with_colors(self.colors)?;
        }
        let textured = self.textures.iter().any(|number| *number != NO_TEXTURE);
        let complete = self.uvs.len() == vertices;
        if complete && (textured || !self.uvs.contains(&NO_UV)) {
            let without = self.uvs.iter_mut().filter(|uv| **uv == NO_UV);
            without.for_each(|uv| *uv = [0.0; 2]);
            mesh = mesh.with_uvs(self.uvs)?;
            if textured {
                self.textures.resize(triangles, NO_TEXTURE);
                mesh = mesh.with_textures(self.textures)?;
            }
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

/// Largest number of characters that are kept of a decoder's message: some quote the line, which may be the
/// whole file.
const MAX_MESSAGE_CHARACTERS: usize = 160;

fn damaged(format: &'static str, reason: impl Display) -> Error {
    let said = reason.to_string();
    let words = said.split_whitespace();
    let mut reason = words.collect::<Vec<_>>().join(" ");
    if let Some((end, _)) = reason.char_indices().nth(MAX_MESSAGE_CHARACTERS) {
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

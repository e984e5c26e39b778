//! Meshes from and to files held in memory: reads OBJ, PLY, STL, glTF and GLB, writes PLY, STL
//! and GLB. (OBJ is written by [`formats`](super::images).)
//!
//! Damaged files are errors, never panics, and no more memory is asked for than
//! in proportion to the bytes that are there; scenes in which a few bytes stand
//! for many triangles end at [`MAX_CELLS`](crate::MAX_CELLS) triangles.

mod beside;
mod builder;
mod format;
mod glb;
mod gltf;
mod narrow;
mod obj;
mod ply;
mod stl;
mod unit;

use crate::error::{Error, Result};
use crate::files::{Assumption, Unit};
use crate::scene::mesh::Mesh;

use beside::Beside;
pub use beside::Texture;
use builder::{MeshBuilder, damaged};
pub use format::MeshFormat;
pub use glb::write_glb;
pub use ply::write_ply;
pub use stl::write_stl;
pub use unit::FileUnit;

/// A mesh read from a file, with the pictures of its textures.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct MeshFile {
    /// The mesh that was read. Where there are textures, [`Mesh::textures`] says which triangle has which.
    pub mesh: Mesh,
    /// The pictures of all textures, each once, in the order of the numbers that [`Mesh::textures`] uses.
    pub textures: Vec<Texture>,
    /// Names of material and texture files that the mesh file refers to but that were not given.
    pub missing: Vec<String>,
    /// Unit of all lengths: the one that the file states, or one that its size suggests, which is then among the
    /// assumptions. `None` where neither tells.
    pub unit: Option<Unit>,
    /// What the reader assumed because the file does not say it.
    pub assumptions: Vec<Assumption>,
}

/// Reads a mesh file of the given format (`None`: the format detected from its contents), without any files beside it;
/// see [`read_mesh_beside`].
///
/// # Errors
/// As [`read_mesh_beside`].
pub fn read_mesh(bytes: &[u8], format: Option<MeshFormat>) -> Result<Mesh> {
    Ok(read_mesh_beside(bytes, format, &[])?.mesh)
}

/// Reads a mesh file, with the materials, textures and buffers that the file names: `files` are the files beside it, by
/// name. Each name is looked up as it is and then without its folders.
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
/// above [`MAX_CELLS`](crate::MAX_CELLS) triangles, [`Error::OutOfMemory`].
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
    let mut parts = MeshBuilder {
        room: bytes.len() + files.iter().map(|(_, bytes)| bytes.len()).sum::<usize>(),
        ..MeshBuilder::default()
    };
    let beside = Beside::new(files);
    match format {
        MeshFormat::Obj => obj::read(bytes, &beside, &mut parts)?,
        MeshFormat::Ply => ply::read(bytes, &beside, &mut parts)?,
        MeshFormat::Stl => stl::read(bytes, &mut parts)?,
        MeshFormat::Gltf => gltf::read(bytes, &beside, &mut parts)?,
    }
    let textures = std::mem::take(&mut parts.pictures);
    let mut assumptions = std::mem::take(&mut parts.assumptions);
    let stated = parts.unit;
    let mesh = parts.into_mesh(format.title(), format != MeshFormat::Stl)?;
    let unit = match stated {
        Some(_) => stated,
        None => {
            let (unit, assumption) = unit::assumed_unit(&mesh);
            assumptions.push(assumption);
            unit
        }
    };
    Ok(MeshFile {
        mesh,
        textures,
        missing: beside.missing(),
        unit,
        assumptions,
    })
}

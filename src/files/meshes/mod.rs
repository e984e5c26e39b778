//! Meshes from and to files held in memory: reads OBJ, PLY, STL, glTF, GLB, 3MF, OFF and points in text (XYZ), writes PLY, STL
//! and GLB. (OBJ is written by [`formats`](super::images).)
//!
//! Damaged files are errors, never panics, and no more memory is asked for than
//! in proportion to the bytes that are there; scenes in which a few bytes stand
//! for many triangles end at [`MAX_CELLS`](crate::MAX_CELLS) triangles.

mod beside;
mod builder;
mod corners;
mod glb;
mod gltf;
mod mesh_file;
mod mtl;
mod narrow;
mod obj;
mod off;
mod ply;
mod rows;
mod stl;
mod threemf;
mod unit;
mod xyz;

use crate::error::Result;
use crate::scene::mesh::Mesh;

use super::failure::in_format;
use super::image_format::Format;
use super::kind::{Purpose, foreign, refused};
pub use super::mesh_format::MeshFormat;
use beside::Beside;
pub use beside::Texture;
use builder::MeshBuilder;
pub use glb::write_glb;
pub use mesh_file::MeshFile;
pub use ply::write_ply;
pub use stl::write_stl;
pub use unit::FileUnit;

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
/// ([`Mesh::is_cloud`]). Polygons are cut into triangles. Colours and texture coordinates are kept where
/// every vertex has them; vertices without a colour of their own have that of their material, which
/// is white where nothing says otherwise, and where there are textures, those without any need no
/// coordinates. Colours are not changed: those of glTF are linear by its
/// specification, and are so here. Costs `O(bytes)`.
///
/// # Errors
/// [`Error::Format`](crate::Error::Format) for damage, [`Error::Unsupported`](crate::Error::Unsupported) for an unknown format,
/// a file with nothing in it, compression or buffers in other files that are not
/// given, [`Error::NotFinite`](crate::Error::NotFinite) for a coordinate that is not, [`Error::TooLarge`](crate::Error::TooLarge)
/// above [`MAX_CELLS`](crate::MAX_CELLS) triangles, [`Error::OutOfMemory`](crate::Error::OutOfMemory).
pub fn read_mesh_beside(
    bytes: &[u8],
    format: Option<MeshFormat>,
    files: &[(&str, &[u8])],
) -> Result<MeshFile> {
    let format = match format.or_else(|| MeshFormat::detect(bytes)) {
        Some(format) => format,
        None if Format::detect(bytes).is_none()
            && foreign(bytes).is_none()
            && stl::may_be_stl(bytes) =>
        {
            MeshFormat::Stl
        }
        None => return Err(refused(bytes, Purpose::Mesh)),
    };
    let mut parts = MeshBuilder {
        room: bytes.len() + files.iter().map(|(_, bytes)| bytes.len()).sum::<usize>(),
        ..MeshBuilder::default()
    };
    let beside = Beside::new(files);
    let mut stated = None;
    match format {
        MeshFormat::Obj => obj::read(bytes, &beside, &mut parts),
        MeshFormat::Ply => ply::read(bytes, &beside, &mut parts),
        MeshFormat::Stl => stl::read(bytes, &mut parts),
        MeshFormat::Gltf => {
            stated = Some(FileUnit::new("m")?);
            gltf::read(bytes, &beside, &mut parts)
        }
        MeshFormat::ThreeMf => threemf::read(bytes, &mut parts).map(|unit| stated = Some(unit)),
        MeshFormat::Off => off::read(bytes, &mut parts),
        MeshFormat::Xyz => xyz::read(bytes, &mut parts),
    }
    .map_err(in_format(format.title()))?;
    let textures = std::mem::take(&mut parts.pictures);
    let (mesh, assumptions) =
        (parts.into_mesh(format != MeshFormat::Stl)).map_err(in_format(format.title()))?;
    let mut file = MeshFile {
        assumptions: unit::coarse_coordinates(&mesh)
            .into_iter()
            .chain(assumptions)
            .collect(),
        mesh,
        textures,
        missing: beside.missing(),
        unit: None,
        factor: 1.0,
    };
    if let Some(unit) = stated {
        return file.in_unit(unit);
    }
    let (unit, assumption) = unit::assumed_unit(&file.mesh);
    file.unit = unit;
    file.assumptions.push(assumption);
    Ok(file)
}

//! Writes meshes as glTF 2.0 in one binary file (GLB).

use super::narrow::{byte, narrowed, near_origin};
use crate::error::Result;
use crate::files::failure::unsupported;
use crate::files::glb::{GlbFile, list};
use crate::scene::mesh::Mesh;

/// OpenGL's number for bytes, by which glTF names component types.
const GL_UNSIGNED_BYTE: u32 = 5121;

/// Writes a mesh as a GLB file: positions rounded to 32-bit floats, and what the mesh has of normals, colours (as
/// bytes, 0 to 255 for 0 to 1) and texture coordinates, in one material that is seen from both sides. The texture is a
/// PNG or JPEG file, which is embedded as it is; it takes the place of colours, for the two would be multiplied.
///
/// A mesh that is small beside its distance from the origin is written around
/// an origin of its own, its node's translation: of coordinates on a map, 32
/// bits would not hold the heights.
///
/// Positions keep the mesh's axes; viewers of glTF take +y for up and look at
/// it along -z. Costs `O(vertices + triangles)`.
///
/// # Errors
/// [`Error::NotFinite`](crate::Error::NotFinite) for a position beyond what 32 bits hold,
/// [`Error::Unsupported`](crate::Error::Unsupported) for a texture that is neither PNG nor JPEG, for one
/// of a mesh without texture coordinates, and from 4 GiB,
/// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
pub fn write_glb(mesh: &Mesh, texture: Option<&[u8]>) -> Result<Vec<u8>> {
    let media_type = texture.map(|image| media_type(image, mesh)).transpose()?;
    let mut file = GlbFile::default();
    let origin = near_origin(mesh);
    let positions = file.floats(&narrowed("GLB file", mesh, origin)?, true)?;
    let mut attributes = format!(r#""POSITION":{positions}"#);
    if let Some(normals) = mesh.normals() {
        attributes += &format!(r#","NORMAL":{}"#, file.floats(normals, false)?);
    }
    if let Some(uvs) = mesh.uvs() {
        // glTF counts texture coordinates from the top.
        let uvs: Vec<_> = uvs.iter().map(|[u, v]| [*u, 1.0 - v]).collect();
        attributes += &format!(r#","TEXCOORD_0":{}"#, file.floats(&uvs, false)?);
    }
    if let Some(colors) = mesh.colors().filter(|_| texture.is_none()) {
        // Colours have an alpha, because every element must begin at a multiple of four bytes.
        let view = file.view(colors.iter().map(|color| {
            let [r, g, b] = color.map(byte);
            [r, g, b, u8::MAX]
        }))?;
        let normalized = r#","normalized":true"#;
        let colors = file.accessor(view, GL_UNSIGNED_BYTE, colors.len(), 4, normalized);
        attributes += &format!(r#","COLOR_0":{colors}"#);
    }
    let shape = match mesh.is_cloud() {
        true => r#""mode":0"#.into(),
        false => format!(r#""indices":{}"#, file.indices(mesh.triangles())?),
    };
    let translation = match origin == [0.0; 3] {
        true => String::new(),
        false => format!(r#","translation":{}"#, list(&origin.map(|v| v as f32))),
    };
    let [mut images, mut base] = [String::new(), String::new()];
    if let (Some(image), Some(kind)) = (texture, media_type) {
        let view = file.view(image.iter().map(|byte| [*byte]))?;
        base = r#""baseColorTexture":{"index":0},"#.into();
        images = format!(
            r#","textures":[{{"source":0}}],"images":[{{"bufferView":{view},"mimeType":"{kind}"}}]"#
        );
    }
    file.finish(&format!(
        r#""scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0{translation}}}],"meshes":[{{"primitives":[{{"attributes":{{{attributes}}},{shape},"material":0}}]}}],"materials":[{{"doubleSided":true,"pbrMetallicRoughness":{{{base}"metallicFactor":0}}}}]{images}"#
    ))
}

/// Returns the media type of a texture picture (PNG or JPEG); an error if the mesh has no texture coordinates.
fn media_type(image: &[u8], mesh: &Mesh) -> Result<&'static str> {
    let refused = |reason| Err(unsupported("GLB", reason));
    if mesh.uvs().is_none() {
        return refused("a texture needs texture coordinates, and the mesh has none");
    }
    match image {
        [0x89, b'P', b'N', b'G', ..] => Ok("image/png"),
        [0xff, 0xd8, 0xff, ..] => Ok("image/jpeg"),
        _ => refused("a texture must be a PNG or JPEG file"),
    }
}

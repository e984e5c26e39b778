//! Writes meshes as glTF 2.0 in one binary file (GLB).

use std::borrow::Cow;
use std::collections::BTreeMap;

use gltf::Glb;
use gltf::binary::Header;
use gltf::json::accessor::{ComponentType, GenericComponentType, Type};
use gltf::json::buffer::{Target, View};
use gltf::json::image::MimeType;
use gltf::json::material::{PbrMetallicRoughness, StrengthFactor};
use gltf::json::mesh::{Mode, Primitive, Semantic};
use gltf::json::texture::{Info, Texture};
use gltf::json::validation::{Checked, USize64};
use gltf::json::{Accessor, Buffer, Image, Index, Material, Mesh as GltfMesh};
use gltf::json::{Node, Root, Scene, Value};

use super::builder::unsupported;
use super::narrow::{byte, narrowed, near_origin};
use crate::error::{Error, Result};
use crate::scene::mesh::Mesh;

/// Name of the GLB format in error messages.
const FORMAT_NAME: &str = "GLB";

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
/// [`Error::NotFinite`] for a position beyond what 32 bits hold,
/// [`Error::Unsupported`] for a texture that is neither PNG nor JPEG, for one
/// of a mesh without texture coordinates, and from 4 GiB,
/// [`Error::OutOfMemory`].
pub fn write_glb(mesh: &Mesh, texture: Option<&[u8]>) -> Result<Vec<u8>> {
    let texture = texture.map(|image| checked(image, mesh)).transpose()?;
    let mut file = File::default();
    let material = file.material(texture)?;
    let origin = near_origin(mesh);
    let primitive = file.primitive(mesh, origin, material, texture.is_some())?;
    file.finish(primitive, origin)
}

/// Checks a texture picture and returns it with its media type (PNG or JPEG); an error if the mesh has no texture
/// coordinates.
fn checked<'a>(image: &'a [u8], mesh: &Mesh) -> Result<(&'a [u8], &'static str)> {
    if mesh.uvs().is_none() {
        let reason = "a texture needs texture coordinates, and the mesh has none";
        return Err(unsupported(FORMAT_NAME, reason));
    }
    if image.starts_with(b"\x89PNG") {
        Ok((image, "image/png"))
    } else if image.starts_with(b"\xff\xd8\xff") {
        Ok((image, "image/jpeg"))
    } else {
        Err(unsupported(
            FORMAT_NAME,
            "a texture must be a PNG or JPEG file",
        ))
    }
}

/// A GLB file of a mesh that is being written: its text part (JSON) and its binary part.
#[derive(Default)]
struct File {
    root: Root,
    bin: Vec<u8>,
}

impl File {
    fn material(&mut self, texture: Option<(&[u8], &str)>) -> Result<Index<Material>> {
        let texture = match texture {
            Some((image, kind)) => Some(self.texture(image, kind)?),
            None => None,
        };
        Ok(self.root.push(Material {
            double_sided: true,
            pbr_metallic_roughness: PbrMetallicRoughness {
                base_color_texture: texture,
                metallic_factor: StrengthFactor(0.0),
                ..Default::default()
            },
            ..Default::default()
        }))
    }

    fn texture(&mut self, image: &[u8], kind: &str) -> Result<Info> {
        let view = self.view(image.len(), image.iter().map(|b| [*b]), None)?;
        let source = self.root.push(Image {
            buffer_view: Some(view),
            mime_type: Some(MimeType(kind.into())),
            uri: None,
            extensions: None,
            extras: Default::default(),
        });
        let index = self.root.push(Texture {
            sampler: None,
            source,
            extensions: None,
            extras: Default::default(),
        });
        Ok(Info {
            index,
            tex_coord: 0,
            extensions: None,
            extras: Default::default(),
        })
    }

    fn primitive(
        &mut self,
        mesh: &Mesh,
        origin: [f64; 3],
        material: Index<Material>,
        textured: bool,
    ) -> Result<Primitive> {
        let mut attributes = BTreeMap::new();
        let mut add = |semantic, index| attributes.insert(Checked::Valid(semantic), index);
        let positions = narrowed("GLB file", mesh, origin)?;
        let vertices = positions.len();
        let index = self.floats(&positions, Type::Vec3)?;
        let accessor = &mut self.root.accessors[index.value()];
        accessor.min = Some(extreme(&positions, f32::min));
        accessor.max = Some(extreme(&positions, f32::max));
        add(Semantic::Positions, index);
        if let Some(normals) = mesh.normals() {
            add(Semantic::Normals, self.floats(normals, Type::Vec3)?);
        }
        if let Some(uvs) = mesh.uvs() {
            // glTF counts texture coordinates from the top.
            let uvs: Vec<_> = uvs.iter().map(|[u, v]| [*u, 1.0 - v]).collect();
            add(Semantic::TexCoords(0), self.floats(&uvs, Type::Vec2)?);
        }
        if let Some(colors) = mesh.colors().filter(|_| !textured) {
            // Colours have an alpha, because every element must begin at a multiple of four bytes.
            let bytes = colors.iter().map(|c| {
                let [r, g, b] = c.map(byte);
                [r, g, b, u8::MAX]
            });
            let view = self.view(4 * vertices, bytes, Some(Target::ArrayBuffer))?;
            let accessor = accessor_of(view, vertices, ComponentType::U8, Type::Vec4);
            add(
                Semantic::Colors(0),
                self.root.push(Accessor {
                    normalized: true,
                    ..accessor
                }),
            );
        }
        let (mode, indices) = if mesh.is_cloud() {
            (Mode::Points, None)
        } else {
            (Mode::Triangles, Some(self.indices(mesh)?))
        };
        Ok(Primitive {
            attributes,
            extensions: None,
            extras: Default::default(),
            indices,
            material: Some(material),
            mode: Checked::Valid(mode),
            targets: None,
        })
    }

    fn indices(&mut self, mesh: &Mesh) -> Result<Index<Accessor>> {
        let corners = mesh.triangles().as_flattened();
        let bytes = corners.iter().map(|i| i.to_le_bytes());
        let view = self.view(4 * corners.len(), bytes, Some(Target::ElementArrayBuffer))?;
        let indices = accessor_of(view, corners.len(), ComponentType::U32, Type::Scalar);
        Ok(self.root.push(indices))
    }

    fn floats<const N: usize>(
        &mut self,
        values: &[[f32; N]],
        kind: Type,
    ) -> Result<Index<Accessor>> {
        let numbers = values.as_flattened();
        let bytes = numbers.iter().map(|v| v.to_le_bytes());
        let view = self.view(4 * numbers.len(), bytes, Some(Target::ArrayBuffer))?;
        let accessor = accessor_of(view, values.len(), ComponentType::F32, kind);
        Ok(self.root.push(accessor))
    }

    /// Appends bytes to the binary part of a GLB file, beginning at a multiple of four bytes.
    fn view<const N: usize>(
        &mut self,
        length: usize,
        bytes: impl Iterator<Item = [u8; N]>,
        target: Option<Target>,
    ) -> Result<Index<View>> {
        let start = self.bin.len().next_multiple_of(4);
        let end = start.saturating_add(length);
        if end > u32::MAX as usize {
            return Err(unsupported(FORMAT_NAME, "files from 4 GiB are not written"));
        }
        self.bin
            .try_reserve(end - self.bin.len())
            .map_err(|_| Error::OutOfMemory {
                what: "GLB file",
                bytes: end,
            })?;
        self.bin.resize(start, 0);
        self.bin.extend(bytes.flatten());
        Ok(self.root.push(View {
            buffer: Index::new(0),
            byte_length: USize64::from(length),
            byte_offset: Some(USize64::from(start)),
            byte_stride: None,
            target: target.map(Checked::Valid),
            extensions: None,
            extras: Default::default(),
        }))
    }

    fn finish(mut self, primitive: Primitive, origin: [f64; 3]) -> Result<Vec<u8>> {
        self.root.push(Buffer {
            byte_length: USize64::from(self.bin.len()),
            uri: None,
            extensions: None,
            extras: Default::default(),
        });
        let mesh = self.root.push(GltfMesh {
            primitives: vec![primitive],
            weights: None,
            extensions: None,
            extras: Default::default(),
        });
        let node = self.root.push(Node {
            mesh: Some(mesh),
            translation: (origin != [0.0; 3]).then(|| origin.map(|v| v as f32)),
            ..Default::default()
        });
        let scene = self.root.push(Scene {
            nodes: vec![node],
            extensions: None,
            extras: Default::default(),
        });
        self.root.scene = Some(scene);
        self.root.asset.generator = Some("developable".into());
        let failed = |error: &dyn ToString| unsupported(FORMAT_NAME, error.to_string());
        let json = self.root.to_vec().map_err(|error| failed(&error))?;
        let glb = Glb {
            // Its writer makes a header of its own.
            header: Header {
                magic: *b"glTF",
                version: 2,
                length: 0,
            },
            json: Cow::Owned(json),
            bin: Some(Cow::Owned(self.bin)),
        };
        glb.to_vec().map_err(|error| failed(&error))
    }
}

fn accessor_of(view: Index<View>, count: usize, component: ComponentType, kind: Type) -> Accessor {
    Accessor {
        buffer_view: Some(view),
        byte_offset: None,
        count: USize64::from(count),
        component_type: Checked::Valid(GenericComponentType(component)),
        type_: Checked::Valid(kind),
        min: None,
        max: None,
        normalized: false,
        sparse: None,
        extensions: None,
        extras: Default::default(),
    }
}

/// Computes the smallest or the largest value of each coordinate of a mesh's positions.
fn extreme(positions: &[[f32; 3]], pick: fn(f32, f32) -> f32) -> Value {
    let first = positions.first().copied().unwrap_or_default();
    let extreme = positions
        .iter()
        .fold(first, |m, p| std::array::from_fn(|k| pick(m[k], p[k])));
    Value::from(extreme.to_vec())
}

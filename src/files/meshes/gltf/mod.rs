//! glTF 2.0 and GLB: the scene is read by the `gltf` crate, its buffers directly, because their ranges may
//! differ from those that the file states.

mod data;

use std::borrow::Cow;

use gltf::buffer::Source;
use gltf::json::{Image, Root};
use gltf::mesh::Mode;
use gltf::{Document, Glb, Primitive, Semantic};
use nalgebra::{Matrix4, Vector4};

use self::data::{FORMAT_NAME, embedded, floats, plain, whole};
use super::beside::Beside;
use super::builder::{DEFAULT_VERTEX_COLOUR, MeshBuilder, NO_TEXTURE, damaged, unsupported};
use crate::error::{Error, Result};
use crate::files::Unit;

pub(super) fn read(bytes: &[u8], beside: &Beside, parts: &mut MeshBuilder) -> Result<()> {
    parts.unit = Some(Unit::Metre);
    let binary = bytes.starts_with(b"glTF");
    let (json, bin) = if binary {
        // `gltf` subtracts the header's own length from the stated length.
        let length = bytes.get(8..12).and_then(|length| length.try_into().ok());
        if length.is_none_or(|length| u32::from_le_bytes(length) < 12) {
            return Err(damaged(
                FORMAT_NAME,
                "its header states a length that cannot be",
            ));
        }
        let glb = Glb::from_slice(bytes).map_err(|error| damaged(FORMAT_NAME, error))?;
        (glb.json, glb.bin)
    } else {
        (bytes.into(), None)
    };
    let root: Root =
        gltf::json::deserialize::from_slice(&json).map_err(|error| damaged(FORMAT_NAME, error))?;
    if let Some(name) = root.extensions_required.first() {
        return Err(unsupported(
            FORMAT_NAME,
            format!(
                "the file cannot be read without the extension {}; save it without, or without \
                 compression",
                name.chars().take(60).collect::<String>()
            ),
        ));
    }
    // The crate's validation looks indices up unchecked.
    let attributes = |mesh: &gltf::json::Mesh| {
        let primitives = mesh.primitives.iter();
        primitives
            .map(|p| p.attributes.values().map(|i| i.value()).max())
            .max()
            .flatten()
    };
    if root
        .meshes
        .iter()
        .filter_map(attributes)
        .any(|i| i >= root.accessors.len())
    {
        return Err(damaged(
            FORMAT_NAME,
            "an attribute names an accessor that is not there",
        ));
    }
    let document = Document::from_json(root).map_err(|error| damaged(FORMAT_NAME, error))?;
    let buffers = document
        .buffers()
        .map(|buffer| match buffer.source() {
            Source::Bin => bin
                .as_deref()
                .map(Cow::Borrowed)
                .ok_or_else(|| damaged(FORMAT_NAME, "there is no binary chunk")),
            Source::Uri(uri) => match embedded(uri)? {
                Some(bytes) => Ok(Cow::Owned(bytes)),
                None => match beside.find(&plain(uri)) {
                    Some((_, bytes)) => Ok(Cow::Borrowed(bytes)),
                    None => Err(elsewhere(uri)),
                },
            },
        })
        .collect::<Result<Vec<_>>>()?;
    let scene = Scene {
        document: &document,
        buffers: &buffers,
        beside,
    };
    scene.visit(parts)
}

fn elsewhere(uri: &str) -> Error {
    let name = uri.chars().take(60).collect::<String>();
    let reason = format!(
        "its buffer {name} is another file, which is missing; save it as GLB, or give that file too"
    );
    unsupported(FORMAT_NAME, reason)
}

/// A glTF document with the bytes of its buffers.
struct Scene<'a> {
    document: &'a Document,
    buffers: &'a [Cow<'a, [u8]>],
    beside: &'a Beside<'a>,
}

/// A texture picture: the name of its file, empty for an embedded picture, and the file's bytes.
type NamedPicture<'a> = (&'a str, Cow<'a, [u8]>);

/// Appearance of a primitive (triangles of one material) by its material: a base colour, the number of a texture, and
/// which set of texture coordinates that texture uses.
struct Appearance {
    color: [f32; 3],
    texture: i32,
    set: u32,
}

impl Scene<'_> {
    /// Visits every node of the glTF scene, with the product of the transforms of all nodes above it.
    fn visit(&self, parts: &mut MeshBuilder) -> Result<()> {
        let document = self.document;
        let Some(scene) = document
            .default_scene()
            .or_else(|| document.scenes().next())
        else {
            return Err(unsupported(FORMAT_NAME, "there is no scene in it"));
        };
        let mut pictures = vec![None; document.as_json().images.len()];
        let mut seen = vec![false; document.nodes().len()];
        let mut open: Vec<_> = scene
            .nodes()
            .map(|node| (node, Matrix4::identity()))
            .collect();
        while let Some((node, above)) = open.pop() {
            if std::mem::replace(&mut seen[node.index()], true) {
                return Err(damaged(
                    FORMAT_NAME,
                    "a node has two parents, or is its own ancestor",
                ));
            }
            let own = Matrix4::from(node.transform().matrix()).cast::<f64>();
            let transform = above * own;
            for primitive in node.mesh().iter().flat_map(|mesh| mesh.primitives()) {
                let look = self.look(&primitive, &mut pictures, parts)?;
                self.add(&primitive, &transform, &look, parts)?;
            }
            open.extend(node.children().map(|child| (child, transform)));
        }
        Ok(())
    }

    /// Reads the base colour and the texture of a primitive's material; each texture is read once.
    fn look(
        &self,
        primitive: &Primitive,
        pictures: &mut [Option<i32>],
        parts: &mut MeshBuilder,
    ) -> Result<Appearance> {
        let mut look = Appearance {
            color: DEFAULT_VERTEX_COLOUR,
            texture: NO_TEXTURE,
            set: 0,
        };
        let root = self.document.as_json();
        let material = primitive.material().index();
        let Some(material) = material.and_then(|index| root.materials.get(index)) else {
            return Ok(look);
        };
        let base = &material.pbr_metallic_roughness;
        let [r, g, b, _] = base.base_color_factor.0;
        look.color = [r, g, b];
        let Some(info) = &base.base_color_texture else {
            return Ok(look);
        };
        let texture = root.textures.get(info.index.value());
        let Some(image) = texture.map(|texture| texture.source.value()) else {
            return Ok(look);
        };
        let (Some(picture), Some(known)) = (root.images.get(image), pictures.get_mut(image)) else {
            return Ok(look);
        };
        look.set = info.tex_coord;
        look.texture = match *known {
            Some(number) => number,
            None => {
                let number = match self.picture(picture)? {
                    Some((name, bytes)) => parts.picture(name, &bytes)?,
                    None => NO_TEXTURE,
                };
                *known = Some(number);
                number
            }
        };
        Ok(look)
    }

    /// Returns the bytes of a glTF image and the name of the image's file; `None` if the file was not given.
    fn picture(&self, image: &Image) -> Result<Option<NamedPicture<'_>>> {
        if let Some(uri) = &image.uri {
            return match embedded(uri)? {
                Some(bytes) => Ok(Some(("", bytes.into()))),
                None => Ok(self
                    .beside
                    .find(&plain(uri))
                    .map(|(name, b)| (name, b.into()))),
            };
        }
        let view = image.buffer_view.map(|index| index.value());
        let views = &self.document.as_json().buffer_views;
        let bytes = || {
            let view = views.get(view?)?;
            let start = usize::try_from(view.byte_offset.unwrap_or_default().0).ok()?;
            let end = start.checked_add(usize::try_from(view.byte_length.0).ok()?)?;
            self.buffers.get(view.buffer.value())?.get(start..end)
        };
        let bytes =
            bytes().ok_or_else(|| damaged(FORMAT_NAME, "an image reaches beyond its buffer"))?;
        Ok(Some(("", bytes.into())))
    }

    fn add(
        &self,
        primitive: &Primitive,
        transform: &Matrix4<f64>,
        look: &Appearance,
        parts: &mut MeshBuilder,
    ) -> Result<()> {
        let buffers = self.buffers;
        let mode = primitive.mode();
        if !matches!(
            mode,
            Mode::Points | Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan
        ) {
            return Ok(()); // lines
        }
        let Some(positions) = primitive.get(&Semantic::Positions) else {
            return Ok(());
        };
        let start = parts.positions.len();
        for p in floats::<3>(&positions, buffers)? {
            let point = transform * Vector4::new(p[0], p[1], p[2], 1.0);
            parts.position([point.x, point.y, point.z])?;
        }
        let vertices = parts.positions.len() - start;
        if let Some(colors) = primitive.get(&Semantic::Colors(0)) {
            let colors = floats::<3>(&colors, buffers)?;
            parts
                .colors
                .extend(colors.iter().take(vertices).map(|c| c.map(|v| v as f32)));
        } else {
            parts.material(start, look.color);
        }
        if let Some(uvs) = primitive.get(&Semantic::TexCoords(look.set)) {
            let uvs = floats::<2>(&uvs, buffers)?;
            parts.uvs.extend(
                uvs.iter()
                    .take(vertices)
                    .map(|[u, v]| [*u as f32, (1.0 - v) as f32]),
            );
        } else {
            parts.no_uvs();
        }
        if mode == Mode::Points {
            return Ok(());
        }
        let indices = match primitive.indices() {
            Some(accessor) => whole(&accessor, buffers)?,
            None => (0..vertices as u32).collect(),
        };
        if let Some(outside) = indices.iter().find(|i| **i as usize >= vertices) {
            return Err(damaged(
                FORMAT_NAME,
                format!("a triangle names vertex {outside} of {vertices}"),
            ));
        }
        let indices: Vec<u32> = indices.iter().map(|i| i + start as u32).collect();
        match mode {
            Mode::TriangleFan => parts.fan(&indices),
            Mode::TriangleStrip => indices.windows(3).enumerate().try_for_each(|(i, t)| {
                let [a, b] = if i % 2 == 0 {
                    [t[0], t[1]]
                } else {
                    [t[1], t[0]]
                };
                parts.triangle([a, b, t[2]])
            }),
            _ => indices
                .chunks_exact(3)
                .try_for_each(|t| parts.triangle([t[0], t[1], t[2]])),
        }?;
        parts.texture(look.texture);
        Ok(())
    }
}

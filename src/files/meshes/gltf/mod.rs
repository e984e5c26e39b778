//! Reads glTF 2.0 and GLB.

mod data;
mod json;

use std::borrow::Cow;
use std::collections::BTreeSet;

use nalgebra::{Matrix4, Quaternion, UnitQuaternion, Vector4};

use self::data::{Data, FORMAT_NAME, embedded, plain};
use self::json::{Image, Node, Primitive, Root, TextureTransform};
use super::beside::Beside;
use super::builder::{DEFAULT_VERTEX_COLOUR, MeshBuilder, NO_TEXTURE, damaged, unsupported};
use crate::error::{Error, Result};

/// Extensions without which the triangles of a file that requires them cannot be read, and the command of glTF Transform
/// that takes them out. All others are about looks, or
/// say how numbers are stored that are read as they are.
const GEOMETRY_EXTENSIONS: [(&str, &str); 4] = [
    ("KHR_draco_mesh_compression", "copy"),
    ("EXT_meshopt_compression", "copy"),
    ("KHR_meshopt_compression", "copy"),
    ("EXT_mesh_gpu_instancing", "uninstance"),
];

pub(super) fn read(bytes: &[u8], beside: &Beside, parts: &mut MeshBuilder) -> Result<()> {
    let (json, bin) = match bytes.starts_with(b"glTF") {
        true => chunks(bytes)?,
        false => (bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes), None),
    };
    let root: Root = serde_json::from_slice(json).map_err(|error| damaged(FORMAT_NAME, error))?;
    let is_required = |name: &str| root.extensions_required.iter().any(|one| one == name);
    if let Some((name, command)) = (GEOMETRY_EXTENSIONS.iter()).find(|(name, _)| is_required(name))
    {
        let reason = format!(
            "its triangles are stored by the extension {name}; `gltf-transform {command} IN.glb \
             OUT.glb` writes a file without it"
        );
        return Err(unsupported(FORMAT_NAME, reason));
    }
    let buffers = (root.buffers.iter())
        .map(|buffer| match &buffer.uri {
            None => bin
                .map(Cow::Borrowed)
                .ok_or_else(|| damaged(FORMAT_NAME, "there is no binary chunk")),
            Some(uri) => match embedded(uri)? {
                Some(bytes) => Ok(Cow::Owned(bytes)),
                None => match beside.find(&plain(uri)) {
                    Some((_, bytes)) => Ok(Cow::Borrowed(bytes)),
                    None => Err(elsewhere(uri)),
                },
            },
        })
        .collect::<Result<Vec<_>>>()?;
    let data = Data {
        root: &root,
        buffers: &buffers,
    };
    let scene = Scene { data, beside };
    scene.visit(parts)
}

/// Splits a GLB file into its text part and its binary part, if it has one.
fn chunks(bytes: &[u8]) -> Result<(&[u8], Option<&[u8]>)> {
    let damaged = || damaged(FORMAT_NAME, "its chunks are not as its header states");
    if bytes.get(4..8) != Some(&[2, 0, 0, 0]) {
        return Err(unsupported(FORMAT_NAME, "only version 2 is read"));
    }
    let mut rest = bytes.get(12..).ok_or_else(damaged)?;
    let (mut json, mut bin) = (None, None);
    while let Some((head, tail)) = rest.split_first_chunk::<8>() {
        let length = u32::from_le_bytes([head[0], head[1], head[2], head[3]]) as usize;
        let chunk = tail.get(..length).ok_or_else(damaged)?;
        match &head[4..] {
            b"JSON" => json = json.or(Some(chunk)),
            b"BIN\0" => bin = bin.or(Some(chunk)),
            _ => {}
        }
        rest = &tail[length..];
    }
    Ok((json.ok_or_else(damaged)?, bin))
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
    data: Data<'a>,
    beside: &'a Beside<'a>,
}

/// A texture picture: the name of its file, empty for an embedded picture, and the file's bytes.
type NamedPicture<'a> = (&'a str, Cow<'a, [u8]>);

/// Appearance of a primitive (triangles of one material) by its material: a base colour, the number of a texture,
/// which set of texture coordinates that texture uses, and their transform.
struct Appearance {
    color: [f32; 3],
    texture: i32,
    set: u32,
    transform: TextureTransform,
}

impl Scene<'_> {
    /// Visits every node of the glTF scene, with the product of the transforms of all nodes above it.
    fn visit(&self, parts: &mut MeshBuilder) -> Result<()> {
        let root = self.data.root;
        let mut pictures = vec![None; root.images.len()];
        let mut seen = vec![false; root.nodes.len()];
        let mut open: Vec<_> = self
            .top()?
            .into_iter()
            .map(|n| (n, Matrix4::identity()))
            .collect();
        while let Some((number, above)) = open.pop() {
            let missing = || damaged(FORMAT_NAME, format!("node {number} is not there"));
            let node = root.nodes.get(number).ok_or_else(missing)?;
            if std::mem::replace(&mut seen[number], true) {
                return Err(damaged(
                    FORMAT_NAME,
                    "a node has two parents, or is its own ancestor",
                ));
            }
            let transform = above * matrix(node);
            if let Some(number) = node.mesh {
                let missing = || damaged(FORMAT_NAME, format!("mesh {number} is not there"));
                let mesh = root.meshes.get(number).ok_or_else(missing)?;
                for primitive in &mesh.primitives {
                    let look = self.look(primitive, &mut pictures, parts)?;
                    self.add(primitive, &transform, &look, parts)?;
                }
            }
            open.extend(node.children.iter().map(|child| (*child, transform)));
        }
        Ok(())
    }

    /// Returns the nodes of the default scene or else of the first one; without scenes those that are below no other.
    fn top(&self) -> Result<Vec<usize>> {
        let root = self.data.root;
        if let Some(scene) = root.scenes.get(root.scene.unwrap_or(0)) {
            return Ok(scene.nodes.clone());
        }
        if root.scene.is_some() {
            return Err(damaged(FORMAT_NAME, "its default scene is not there"));
        }
        let below: BTreeSet<usize> = (root.nodes.iter())
            .flat_map(|n| n.children.iter().copied())
            .collect();
        Ok((0..root.nodes.len())
            .filter(|number| !below.contains(number))
            .collect())
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
            transform: TextureTransform::default(),
        };
        let root = self.data.root;
        let Some(material) = primitive
            .material
            .and_then(|number| root.materials.get(number))
        else {
            return Ok(look);
        };
        let base = &material.pbr_metallic_roughness;
        if let Some([r, g, b, _]) = base.base_color_factor {
            look.color = [r, g, b];
        }
        let Some(info) = &base.base_color_texture else {
            return Ok(look);
        };
        let texture = root.textures.get(info.index);
        let source = texture.and_then(|texture| texture.source.or(texture.extensions.webp.source));
        let Some((number, image)) = source.and_then(|n| Some((n, root.images.get(n)?))) else {
            return Ok(look);
        };
        look.transform = info.extensions.transform.unwrap_or_default();
        look.set = look.transform.tex_coord.unwrap_or(info.tex_coord);
        look.texture = match pictures[number] {
            Some(known) => known,
            None => match self.picture(image)? {
                Some((name, bytes)) => parts.picture(name, &bytes)?,
                None => NO_TEXTURE,
            },
        };
        pictures[number] = Some(look.texture);
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
        let bytes = image.buffer_view.and_then(|number| self.data.view(number));
        let bytes =
            bytes.ok_or_else(|| damaged(FORMAT_NAME, "an image reaches beyond its buffer"))?;
        Ok(Some(("", bytes.into())))
    }

    fn add(
        &self,
        primitive: &Primitive,
        transform: &Matrix4<f64>,
        look: &Appearance,
        parts: &mut MeshBuilder,
    ) -> Result<()> {
        let mode = primitive.mode.unwrap_or(TRIANGLES);
        if !matches!(mode, POINTS | TRIANGLES | TRIANGLE_STRIP | TRIANGLE_FAN) {
            return Ok(()); // lines
        }
        let attribute = |name: &str| primitive.attributes.get(name).copied();
        let Some(positions) = attribute("POSITION") else {
            return Ok(());
        };
        let start = parts.positions.len();
        for p in self.data.floats::<3>(positions)? {
            let point = transform * Vector4::new(p[0], p[1], p[2], 1.0);
            parts.position([point.x, point.y, point.z])?;
        }
        let vertices = parts.positions.len() - start;
        match attribute("COLOR_0") {
            Some(colors) => {
                let colors = self.data.floats::<3>(colors)?;
                let colors = colors.iter().take(vertices);
                parts.colors.extend(colors.map(|c| c.map(|v| v as f32)));
            }
            None => parts.material(start, look.color),
        }
        match attribute(&format!("TEXCOORD_{}", look.set)) {
            Some(uvs) => {
                let uvs = self.data.floats::<2>(uvs)?;
                let uvs = uvs
                    .iter()
                    .take(vertices)
                    .map(|uv| look.transform.apply(*uv));
                parts
                    .uvs
                    .extend(uvs.map(|[u, v]| [u as f32, (1.0 - v) as f32]));
            }
            None => parts.no_uvs(),
        }
        if mode == POINTS {
            return Ok(());
        }
        let indices = match primitive.indices {
            Some(number) => self.data.whole(number)?,
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
            TRIANGLE_FAN => parts.fan(&indices),
            TRIANGLE_STRIP => parts.strip(&indices),
            _ => indices
                .chunks_exact(3)
                .try_for_each(|t| parts.triangle([t[0], t[1], t[2]])),
        }?;
        parts.texture(look.texture);
        Ok(())
    }
}

/// Modes of primitives, as glTF numbers them.
const POINTS: u32 = 0;
const TRIANGLES: u32 = 4;
const TRIANGLE_STRIP: u32 = 5;
const TRIANGLE_FAN: u32 = 6;

/// Returns the transform of a node: its matrix, or its scale, rotation and translation in this order.
fn matrix(node: &Node) -> Matrix4<f64> {
    if let Some(matrix) = &node.matrix {
        return Matrix4::from_column_slice(matrix);
    }
    let rotation = node.rotation.map_or(Matrix4::identity(), |[x, y, z, w]| {
        UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z)).to_homogeneous()
    });
    let scale = node.scale.unwrap_or([1.0; 3]);
    Matrix4::new_translation(&node.translation.into())
        * rotation
        * Matrix4::new_nonuniform_scaling(&scale.into())
}

impl TextureTransform {
    /// Transforms texture coordinates, of which the second counts from the top of the picture.
    fn apply(&self, uv: [f64; 2]) -> [f64; 2] {
        let scale = self.scale.unwrap_or([1.0; 2]);
        let [u, v] = [uv[0] * scale[0], uv[1] * scale[1]];
        let (sin, cos) = self.rotation.sin_cos();
        [
            cos * u + sin * v + self.offset[0],
            cos * v - sin * u + self.offset[1],
        ]
    }
}

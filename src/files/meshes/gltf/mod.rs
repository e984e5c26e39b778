//! Reads glTF 2.0 and GLB.

mod data;

use std::borrow::Cow;
use std::collections::BTreeSet;

use nalgebra::{Matrix4, Quaternion, UnitQuaternion, Vector4};
use percent_encoding::percent_decode_str;
use serde_json::Value;

use self::data::{Data, embedded, list, numbers, whole};
use super::beside::Beside;
use super::builder::{DEFAULT_VERTEX_COLOUR, MeshBuilder, NO_TEXTURE};
use crate::error::{Error, Result};
use crate::files::failure::{damaged, not_read, undecodable};

/// What is said of files of version 1.
const OTHER_VERSION: &str =
    "only version 2 is read; `gltf-pipeline -i IN -o OUT.glb` converts version 1";

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
    let root: Value = serde_json::from_slice(json).map_err(undecodable)?;
    if (root["asset"]["version"].as_str()).is_some_and(|version| !version.starts_with("2.")) {
        return Err(not_read(OTHER_VERSION));
    }
    let required = list(&root["extensionsRequired"]);
    if let Some((name, command)) =
        (GEOMETRY_EXTENSIONS.iter()).find(|(name, _)| required.iter().any(|one| one == name))
    {
        let reason = format!(
            "its triangles are stored by the extension {name}; `gltf-transform {command} IN.glb \
             OUT.glb` writes a file without it"
        );
        return Err(not_read(reason));
    }
    let buffers = (list(&root["buffers"]).iter())
        .map(|buffer| match buffer["uri"].as_str() {
            None => bin
                .map(Cow::Borrowed)
                .ok_or_else(|| damaged("there is no binary chunk")),
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
    let damaged = || damaged("its chunks are not as its header states");
    if bytes.get(4..8) != Some(&[2, 0, 0, 0]) {
        return Err(not_read(OTHER_VERSION));
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

/// Decodes percent-encoded characters, such as blanks, in the name of a file that a glTF file refers to.
fn plain(uri: &str) -> Cow<'_, str> {
    percent_decode_str(uri).decode_utf8_lossy()
}

fn elsewhere(uri: &str) -> Error {
    let name = uri.chars().take(60).collect::<String>();
    let place = match uri.contains("://") {
        true => "on another machine, and is not fetched",
        false => "another file, which is missing",
    };
    let reason =
        format!("its buffer {name} is {place}; save it as GLB, or give that file beside it");
    not_read(reason)
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
    set: usize,
    transform: TextureTransform,
}

impl Scene<'_> {
    /// Visits every node of the glTF scene, with the product of the transforms of all nodes above it.
    fn visit(&self, parts: &mut MeshBuilder) -> Result<()> {
        let root = self.data.root;
        let mut pictures = vec![None; list(&root["images"]).len()];
        let mut seen = vec![false; list(&root["nodes"]).len()];
        let mut open: Vec<_> = (self.top()?.into_iter())
            .map(|n| (n, Matrix4::identity()))
            .collect();
        while let Some((number, above)) = open.pop() {
            let node = self.data.element("nodes", number)?;
            if std::mem::replace(&mut seen[number], true) {
                let reason = "a node has two parents, or is its own ancestor";
                return Err(damaged(reason));
            }
            let transform = above * matrix(node);
            if let Some(number) = whole(node, "mesh") {
                for primitive in list(&self.data.element("meshes", number)?["primitives"]) {
                    let look = self.look(primitive, &mut pictures, parts)?;
                    self.add(primitive, &transform, &look, parts)?;
                }
            }
            open.extend(children(node).map(|child| (child, transform)));
        }
        Ok(())
    }

    /// Returns the nodes of the default scene or else of the first one; without scenes those that are below no other.
    fn top(&self) -> Result<Vec<usize>> {
        let root = self.data.root;
        let default = whole(root, "scene");
        if let Some(scene) = root["scenes"].get(default.unwrap_or(0)) {
            return Ok(numbered(&scene["nodes"]).collect());
        }
        if default.is_some() {
            return Err(damaged("its default scene is not there"));
        }
        let nodes = list(&root["nodes"]);
        let below: BTreeSet<usize> = nodes.iter().flat_map(children).collect();
        Ok((0..nodes.len())
            .filter(|number| !below.contains(number))
            .collect())
    }

    /// Reads the base colour and the texture of a primitive's material; each texture is read once.
    fn look(
        &self,
        primitive: &Value,
        pictures: &mut [Option<i32>],
        parts: &mut MeshBuilder,
    ) -> Result<Appearance> {
        let root = self.data.root;
        let element = |kind: &str, number: Option<usize>| root[kind].get(number?);
        let material = element("materials", whole(primitive, "material")).unwrap_or(&Value::Null);
        let base = &material["pbrMetallicRoughness"];
        let mut look = Appearance {
            color: numbers(&base["baseColorFactor"])
                .map_or(DEFAULT_VERTEX_COLOUR, |color| color.map(|v| v as f32)),
            texture: NO_TEXTURE,
            set: 0,
            transform: TextureTransform::new(&Value::Null),
        };
        let info = &base["baseColorTexture"];
        let texture = element("textures", whole(info, "index")).unwrap_or(&Value::Null);
        let source = whole(texture, "source")
            .or_else(|| whole(&texture["extensions"]["EXT_texture_webp"], "source"));
        let (Some(number), Some(image)) = (source, element("images", source)) else {
            return Ok(look);
        };
        let transform = &info["extensions"]["KHR_texture_transform"];
        look.transform = TextureTransform::new(transform);
        look.set = whole(transform, "texCoord")
            .or_else(|| whole(info, "texCoord"))
            .unwrap_or(0);
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
    fn picture(&self, image: &Value) -> Result<Option<NamedPicture<'_>>> {
        if let Some(uri) = image["uri"].as_str() {
            return match embedded(uri)? {
                Some(bytes) => Ok(Some(("", bytes.into()))),
                None => Ok((self.beside.find(&plain(uri))).map(|(name, b)| (name, b.into()))),
            };
        }
        let bytes = whole(image, "bufferView").and_then(|number| self.data.view(number));
        let bytes = bytes.ok_or_else(|| damaged("an image reaches beyond its buffer"))?;
        Ok(Some(("", bytes.into())))
    }

    fn add(
        &self,
        primitive: &Value,
        transform: &Matrix4<f64>,
        look: &Appearance,
        parts: &mut MeshBuilder,
    ) -> Result<()> {
        let mode = whole(primitive, "mode").unwrap_or(TRIANGLES_MODE);
        if !matches!(
            mode,
            POINTS_MODE | TRIANGLES_MODE | TRIANGLE_STRIP_MODE | TRIANGLE_FAN_MODE
        ) {
            return Ok(()); // lines
        }
        let attribute = |name: &str| whole(&primitive["attributes"], name);
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
        if mode == POINTS_MODE {
            return Ok(());
        }
        let indices = match whole(primitive, "indices") {
            Some(number) => self.data.indices(number)?,
            None => (0..vertices as u32).collect(),
        };
        if let Some(outside) = indices.iter().find(|i| **i as usize >= vertices) {
            return Err(damaged(format!(
                "a triangle names vertex {outside} of {vertices}"
            )));
        }
        let indices: Vec<u32> = indices.iter().map(|i| i + start as u32).collect();
        match mode {
            TRIANGLE_FAN_MODE => parts.fan(&indices),
            TRIANGLE_STRIP_MODE => parts.strip(&indices),
            _ => indices
                .chunks_exact(3)
                .try_for_each(|t| parts.triangle([t[0], t[1], t[2]])),
        }?;
        parts.texture(look.texture);
        Ok(())
    }
}

/// Mode of a primitive of points in the glTF format.
const POINTS_MODE: usize = 0;
/// Mode of a primitive of triangles in the glTF format, which goes without saying.
const TRIANGLES_MODE: usize = 4;
/// Mode of a primitive of triangles in a strip in the glTF format.
const TRIANGLE_STRIP_MODE: usize = 5;
/// Mode of a primitive of triangles around a corner in the glTF format.
const TRIANGLE_FAN_MODE: usize = 6;

/// Returns the numbers of a list of whole numbers.
fn numbered(value: &Value) -> impl Iterator<Item = usize> {
    (list(value).iter()).filter_map(|number| usize::try_from(number.as_u64()?).ok())
}

/// Returns the numbers of the nodes below a node.
fn children(node: &Value) -> impl Iterator<Item = usize> {
    numbered(&node["children"])
}

/// Returns the transform of a node: its matrix, column by column, or its scale, rotation (a unit quaternion x, y, z, w) and
/// translation in this order.
fn matrix(node: &Value) -> Matrix4<f64> {
    if let Some(matrix) = numbers::<16>(&node["matrix"]) {
        return Matrix4::from_column_slice(&matrix);
    }
    let [x, y, z, w] = numbers(&node["rotation"]).unwrap_or([0.0, 0.0, 0.0, 1.0]);
    let rotation = UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z));
    Matrix4::new_translation(&numbers(&node["translation"]).unwrap_or([0.0; 3]).into())
        * rotation.to_homogeneous()
        * Matrix4::new_nonuniform_scaling(&numbers(&node["scale"]).unwrap_or([1.0; 3]).into())
}

/// The transform of the extension `KHR_texture_transform`: an offset, an angle in radians, counter-clockwise around the picture's
/// upper left corner, and a scale.
struct TextureTransform {
    offset: [f64; 2],
    rotation: f64,
    scale: [f64; 2],
}

impl TextureTransform {
    fn new(transform: &Value) -> Self {
        TextureTransform {
            offset: numbers(&transform["offset"]).unwrap_or([0.0; 2]),
            rotation: transform["rotation"].as_f64().unwrap_or(0.0),
            scale: numbers(&transform["scale"]).unwrap_or([1.0; 2]),
        }
    }

    /// Transforms texture coordinates, of which the second counts from the top of the picture.
    fn apply(&self, uv: [f64; 2]) -> [f64; 2] {
        let [u, v] = [uv[0] * self.scale[0], uv[1] * self.scale[1]];
        let (sin, cos) = self.rotation.sin_cos();
        [
            cos * u + sin * v + self.offset[0],
            cos * v - sin * u + self.offset[1],
        ]
    }
}

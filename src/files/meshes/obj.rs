//! Reads Wavefront OBJ meshes.

use super::beside::Beside;
use super::builder::{MeshBuilder, NO_TEXTURE, scale_levels};
use super::corners::Corners;
use super::mtl::{self, Material};
use super::rows::{numbers, point};
use crate::error::Result;
use crate::files::failure::{damaged, not_read};
use crate::files::text::{decoded, lines};

/// Statements of curves and surfaces that are no meshes.
const FREE_FORM_STATEMENTS: [&str; 5] = ["cstype", "curv", "curv2", "surf", "bzp"];

pub(super) fn read(bytes: &[u8], beside: &Beside, parts: &mut MeshBuilder) -> Result<()> {
    let text = decoded(bytes);
    let mut reader = Reader::default();
    let (mut uvs, mut has_faces, mut free_form) = (Vec::new(), false, None);
    for (row, line) in lines(&text) {
        let mut words = words(&line);
        match words.next() {
            Some("v") => reader.vertex(row, words)?,
            Some("vt") => {
                let numbers = numbers(row, words.take(2))?;
                uvs.push([0, 1].map(|k| numbers.get(k).copied().unwrap_or_default() as f32));
            }
            Some("f" | "fo") => has_faces = true,
            Some("l") => parts.has_lines = true,
            Some(name) if FREE_FORM_STATEMENTS.contains(&name) => free_form = Some(row),
            _ => {}
        }
    }
    if let (Some(row), false) = (free_form, has_faces) {
        let reason = format!(
            "line {row} begins a free-form surface, and there are no faces; let a CAD program \
             save it as a mesh"
        );
        return Err(not_read(reason));
    }
    scale_levels(reader.corners.colors.iter_mut().flatten());
    if !has_faces {
        // Without faces its points are a cloud.
        for point in 0..reader.corners.positions.len() {
            reader.corners.vertex(point, None, None, parts)?;
        }
        return Ok(());
    }
    reader.faces(&text, &uvs, beside, parts)
}

/// What an OBJ file has stated so far.
#[derive(Default)]
struct Reader {
    corners: Corners,
    materials: Vec<Material>,
}

impl Reader {
    /// Reads a vertex: a position, perhaps its weight, or a colour and perhaps its opacity, as MeshLab and trimesh read it.
    fn vertex<'a>(&mut self, row: usize, words: impl Iterator<Item = &'a str>) -> Result<()> {
        let (position, rest) = point(row, words)?;
        self.corners.positions.push(position);
        let color = match rest[..] {
            [r, g, b] | [r, g, b, _] => Some([r, g, b].map(|v| v as f32)),
            _ => None,
        };
        self.corners.colors.push(color);
        Ok(())
    }

    /// Reads the faces, each with the material before it. The vertices are known already.
    fn faces(
        &mut self,
        text: &str,
        uvs: &[[f32; 2]],
        beside: &Beside,
        parts: &mut MeshBuilder,
    ) -> Result<()> {
        let mut counts = [0; 2];
        let (mut color, mut texture) = (None, NO_TEXTURE);
        let mut face = Vec::new();
        for (row, line) in lines(text) {
            let mut words = words(&line);
            match words.next() {
                Some("v") => counts[0] += 1,
                Some("vt") => counts[1] += 1,
                Some("mtllib") => self.materials.extend(mtl::library(rest_of(&line), beside)),
                Some("usemtl") => {
                    parts.texture(texture);
                    let name = rest_of(&line);
                    let found = self.materials.iter().find(|m| m.name == name);
                    color = found.map(|m| m.color);
                    let picture = found.and_then(|m| m.picture.as_deref());
                    texture = match picture.and_then(|name| beside.find(name)) {
                        Some((name, bytes)) => parts.picture(name, bytes)?,
                        None => NO_TEXTURE,
                    };
                }
                Some("f" | "fo") => {
                    face.clear();
                    for corner in words {
                        let mut indices = corner.split('/');
                        let position = index(indices.next(), counts[0]);
                        let position = position
                            .filter(|i| *i < self.corners.positions.len())
                            .ok_or_else(|| {
                                let reason = format!(
                                    "line {row} names the vertex {corner:?}, which is not there"
                                );
                                damaged(reason)
                            })?;
                        let uv = index(indices.next(), counts[1]);
                        let uv = uv.and_then(|i| uvs.get(i)).copied();
                        face.push(self.corners.vertex(position, uv, color, parts)?);
                    }
                    parts.polygon(&face)?;
                }
                _ => {}
            }
        }
        parts.texture(texture);
        Ok(())
    }
}

/// Parses an index from 1, or one that counts back from the last of `count` elements; returns it from 0.
fn index(word: Option<&str>, count: usize) -> Option<usize> {
    match word?.parse::<i64>().ok()? {
        0 => None,
        back if back < 0 => count.checked_sub(usize::try_from(back.unsigned_abs()).ok()?),
        number => usize::try_from(number - 1).ok(),
    }
}

/// Iterates over the words of a line up to a comment.
fn words(line: &str) -> impl Iterator<Item = &str> {
    line.split_whitespace()
        .take_while(|word| !word.starts_with('#'))
}

/// Returns a line without its first word.
fn rest_of(line: &str) -> &str {
    let line = line.trim();
    line.split_once(char::is_whitespace)
        .map_or("", |(_, rest)| rest.trim())
}

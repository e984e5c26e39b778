//! Makes vertices of the corners of faces, whose files give positions and texture coordinates apart.

use rustc_hash::FxHashMap;

use super::builder::{DEFAULT_VERTEX_COLOUR, MeshBuilder, NO_UV};
use super::narrow::byte;
use crate::error::Result;
use crate::files::failure::damaged;

/// Positions and colours that the corners of faces name by number, and the vertices made of them so far.
#[derive(Default)]
pub(super) struct Corners {
    pub(super) positions: Vec<[f64; 3]>,
    /// Colour of each position; shorter than the positions, or `None`, where the file states none.
    pub(super) colors: Vec<Option<[f32; 3]>>,
    /// Vertex of each position with given texture coordinates (their bits) and material.
    pub(super) vertices: FxHashMap<(usize, [u32; 2], usize), u32>,
}

/// Appearance of the corners of faces of one material: its number, and its colour.
#[derive(Clone, Copy)]
pub(super) struct CornerMaterial {
    pub(super) number: usize,
    pub(super) color: [f32; 3],
}

impl Default for CornerMaterial {
    fn default() -> Self {
        CornerMaterial {
            number: 0,
            color: DEFAULT_VERTEX_COLOUR,
        }
    }
}

impl CornerMaterial {
    /// Creates the material of a face that has a colour of its own, if it has one.
    pub(super) fn of_face(color: Option<[f32; 3]>) -> Self {
        color.map_or_else(CornerMaterial::default, |color| {
            let [r, g, b] = color.map(byte);
            CornerMaterial {
                number: u32::from_be_bytes([1, r, g, b]) as usize,
                color,
            }
        })
    }
}

impl Corners {
    /// Takes the vertices of a mesh, of which the corners of faces make others.
    pub(super) fn taken_from(parts: &mut MeshBuilder) -> Self {
        parts.uvs.clear();
        Corners {
            positions: std::mem::take(&mut parts.positions),
            colors: parts.colors.drain(..).map(Some).collect(),
            ..Corners::default()
        }
    }

    /// Replaces the corners of a face by vertices that have the corners' texture coordinates and the face's colour.
    pub(super) fn split(
        &mut self,
        face: &mut [u32],
        uvs: &[f32],
        material: CornerMaterial,
        parts: &mut MeshBuilder,
    ) -> Result<()> {
        for (k, index) in face.iter_mut().enumerate() {
            if *index as usize >= self.positions.len() {
                let reason = format!("a face names vertex {index} of {}", self.positions.len());
                return Err(damaged(reason));
            }
            let uv = uvs.get(2 * k..2 * k + 2).map(|uv| [uv[0], uv[1]]);
            *index = self.vertex(*index as usize, uv, material, parts)?;
        }
        Ok(())
    }

    /// Returns the vertex of a corner, and adds it to the mesh where there is none yet. The position must be there.
    pub(super) fn vertex(
        &mut self,
        position: usize,
        uv: Option<[f32; 2]>,
        material: CornerMaterial,
        parts: &mut MeshBuilder,
    ) -> Result<u32> {
        let uv = uv.unwrap_or(NO_UV);
        let key = (position, uv.map(f32::to_bits), material.number);
        if let Some(vertex) = self.vertices.get(&key) {
            return Ok(*vertex);
        }
        let vertex = parts.positions.len() as u32;
        parts.position(self.positions[position])?;
        let own = self.colors.get(position).copied().flatten();
        parts.colors.push(own.unwrap_or(material.color));
        parts.uvs.push(uv);
        self.vertices.insert(key, vertex);
        Ok(vertex)
    }
}

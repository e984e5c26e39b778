//! Makes vertices of the corners of faces, whose files give positions and texture coordinates apart.

use rustc_hash::FxHashMap;

use super::builder::{DEFAULT_VERTEX_COLOUR, MeshBuilder, NO_UV};
use crate::error::Result;

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

impl Corners {
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

//! Makes vertices of the corners of faces, whose files give positions and texture coordinates apart.

use rustc_hash::FxHashMap;

use super::builder::{DEFAULT_VERTEX_COLOUR, MeshBuilder, NO_UV};
use crate::error::Result;
use crate::files::failure::damaged;

/// Positions and colours that the corners of faces name by number, and the vertices made of them so far.
#[derive(Default)]
pub(super) struct Corners {
    pub(super) positions: Vec<[f64; 3]>,
    /// Colour of each position; shorter than the positions, or `None`, where the file states none.
    pub(super) colors: Vec<Option<[f32; 3]>>,
    /// Vertex of each position with given texture coordinates and colour, by their bits.
    vertices: FxHashMap<(usize, [u32; 2], [u32; 3]), u32>,
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
        color: Option<[f32; 3]>,
        parts: &mut MeshBuilder,
    ) -> Result<()> {
        for (k, index) in face.iter_mut().enumerate() {
            let uv = uvs.get(2 * k..2 * k + 2).map(|uv| [uv[0], uv[1]]);
            *index = self.vertex(*index as usize, uv, color, parts)?;
        }
        Ok(())
    }

    /// Returns the vertex of a corner, and adds it to the mesh where there is none yet. The colour counts where the position has
    /// none of its own.
    pub(super) fn vertex(
        &mut self,
        position: usize,
        uv: Option<[f32; 2]>,
        color: Option<[f32; 3]>,
        parts: &mut MeshBuilder,
    ) -> Result<u32> {
        let uv = uv.unwrap_or(NO_UV);
        let own = self.colors.get(position).copied().flatten();
        let color = own.or(color).unwrap_or(DEFAULT_VERTEX_COLOUR);
        let key = (position, uv.map(f32::to_bits), color.map(f32::to_bits));
        if let Some(vertex) = self.vertices.get(&key) {
            return Ok(*vertex);
        }
        let Some(place) = self.positions.get(position) else {
            let reason = format!("a face names vertex {position} of {}", self.positions.len());
            return Err(damaged(reason));
        };
        let vertex = parts.positions.len() as u32;
        parts.position(*place)?;
        parts.colors.push(color);
        parts.uvs.push(uv);
        self.vertices.insert(key, vertex);
        Ok(vertex)
    }
}

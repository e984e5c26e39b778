//! The contents of a mesh file.

use super::beside::Texture;
use crate::files::{Assumption, Unit};
use crate::scene::mesh::Mesh;

/// A mesh read from a file, with the pictures of its textures.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct MeshFile {
    /// The mesh that was read. Where there are textures, [`Mesh::textures`] says which triangle has which.
    pub mesh: Mesh,
    /// The pictures of all textures, each once, in the order of the numbers that [`Mesh::textures`] uses.
    pub textures: Vec<Texture>,
    /// Names of material and texture files that the mesh file refers to but that were not given.
    pub missing: Vec<String>,
    /// Unit of all lengths: the one that the file states, or one that its size suggests, which is then among the
    /// assumptions. `None` where neither tells.
    pub unit: Option<Unit>,
    /// What the reader assumed because the file does not say it.
    pub assumptions: Vec<Assumption>,
    /// Factor from the file's lengths to those of the mesh.
    pub(super) factor: f64,
}

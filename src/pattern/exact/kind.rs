//! Tells the kinds of meshes, each of which is laid flat in its own way.

use super::FoundFaces;
use super::noisy::noisy_faces;
use super::rolled::divided_bends;
use crate::error::Result;
use crate::scene::exactness::{Exactness, has_few_faces};
use crate::scene::mesh::Mesh;
use crate::scene::polyhedron::Polyhedron;

/// What a mesh is, and the faces that were found in it. Each kind is laid flat in its own way.
pub enum MeshKind {
    /// The faces of the mesh are exact, or few: [`pattern_exact`](super::pattern_exact) lays them flat.
    Faces,
    /// The vertices of the mesh have noise about flat faces.
    NoisyFaces(FoundFaces),
    /// The vertices of the mesh are exact, and lie on flat faces, walls of any profile, cylinders and circular cones.
    Bends(FoundFaces),
    /// The vertices of the mesh are exact, those of a smooth surface.
    Surface,
    /// The vertices of the mesh have noise: it is to be fitted first.
    Noisy,
}

impl MeshKind {
    /// Recognises a mesh; costs what [`noisy_faces`] and [`rolled_faces`](super::rolled_faces) cost.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn of(mesh: &Mesh) -> Result<MeshKind> {
        let Ok(solid) = Polyhedron::new(mesh) else {
            return Ok(MeshKind::Noisy);
        };
        let exactness = Exactness::of_solid(&solid);
        let known = match has_few_faces(&solid) {
            true => Exactness::Faces,
            false => exactness,
        };
        let rolled = divided_bends(&solid, known);
        if rolled.is_none()
            && exactness == Exactness::None
            && let Some(found) = noisy_faces(mesh)?
        {
            return Ok(MeshKind::NoisyFaces(found));
        }
        Ok(match (rolled, known) {
            (Some(found), _) => MeshKind::Bends(found),
            (None, Exactness::Faces) => MeshKind::Faces,
            (None, Exactness::Vertices) => MeshKind::Surface,
            (None, Exactness::None) => MeshKind::Noisy,
        })
    }
}

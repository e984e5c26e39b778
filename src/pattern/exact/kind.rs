//! Tells the kinds of meshes, each of which is laid flat in its own way.

use super::FoundFaces;
use super::noisy::noisy_faces;
use super::rolled::divided_bends;
use crate::error::Result;
use crate::scene::exactness::{Exactness, has_few_faces};
use crate::scene::mesh::Mesh;
use crate::scene::polyhedron::Polyhedron;

/// The kind of a mesh, which decides whether a fit gains anything and how the mesh is laid flat.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(rename_all = "camelCase")
)]
#[non_exhaustive]
pub enum MeshKind {
    /// Its faces are exact, as in CAD and low-poly models, or few, and are moved into the plane as they are.
    Faces,
    /// As `faces`, but some of its bends are triangulated irregularly, and are divided along their lines first.
    Bends,
    /// Its vertices have noise about flat faces, as in scans of roofs and boxes; the faces are laid flat without it.
    NoisyFaces,
    /// Its vertices have no noise, so that a fit gains nothing, but it is no part of planes, cylinders and cones.
    Surface,
    /// Its vertices have noise.
    #[default]
    Noisy,
}

/// The kind of a mesh, and the faces that were found in it.
#[derive(Default)]
#[non_exhaustive]
pub struct RecognizedMesh {
    /// Whether a fit gains anything, and how the mesh is laid flat without one.
    pub kind: MeshKind,
    /// The faces that stand for the mesh, of [`MeshKind::Bends`] and [`MeshKind::NoisyFaces`].
    pub faces: Option<FoundFaces>,
}

impl From<MeshKind> for RecognizedMesh {
    fn from(kind: MeshKind) -> RecognizedMesh {
        RecognizedMesh { kind, faces: None }
    }
}

impl RecognizedMesh {
    /// Recognises a mesh. Costs `O(triangles · log(triangles))`, and `O(triangles)` for each bend.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn of(mesh: &Mesh) -> Result<RecognizedMesh> {
        let Ok(solid) = Polyhedron::new(mesh) else {
            return Ok(RecognizedMesh::default());
        };
        let exactness = Exactness::of_solid(&solid);
        let known = match has_few_faces(&solid) {
            true => Exactness::Faces,
            false => exactness,
        };
        let with_faces = |kind, faces| {
            Ok(RecognizedMesh {
                kind,
                faces: Some(faces),
            })
        };
        if let Some(divided) = divided_bends(&solid, known) {
            return with_faces(MeshKind::Bends, divided);
        }
        if exactness == Exactness::None
            && let Some(found) = noisy_faces(mesh)?
        {
            return with_faces(MeshKind::NoisyFaces, found);
        }
        Ok(RecognizedMesh::from(match known {
            Exactness::Faces => MeshKind::Faces,
            Exactness::Vertices => MeshKind::Surface,
            Exactness::None => MeshKind::Noisy,
        }))
    }
}

//! Patterns of meshes with exact faces: polyhedra, low-poly models and parts of CAD, whose faces are moved into the plane
//! as they are.
//!
//! Coplanar triangles are one facet. Facets are placed by rigid motions along the edges where they meet, so that no sheet has
//! strain, and both sides of each cut are equally long. Where sheets would overlap they are cut apart.

mod net;
mod patches;
mod polyhedron;
mod recognition;
mod sheets;

use super::mesh::MeshPattern;
use crate::error::Result;
use crate::scene::mesh::Mesh;
use net::Net;
use patches::FlatPatches;
use polyhedron::Polyhedron;
pub use recognition::has_exact_faces;

/// Lays a mesh flat as it is, face by face: without strain, in few sheets with short cuts. Edges of more than two triangles
/// are cut; the mesh may have borders and several components. Each edge between two faces is a fold or a cut.
///
/// With `room`, width and height in the mesh's units, sheets are cut so that each fits, in either orientation, unless a
/// single face is larger.
///
/// Costs some seconds at most for the search, and `O(triangles log triangles)` beside it.
///
/// # Errors
/// [`Error::Unsupported`](crate::Error::Unsupported) if the triangles have no area.
pub fn pattern_exact(mesh: &Mesh, room: Option<[f64; 2]>) -> Result<MeshPattern> {
    let solid = Polyhedron::new(mesh)?;
    let net = Net::new(&solid, room);
    let patches = FlatPatches::new(&solid, &net)?;
    sheets::draw(&solid, &net, &patches)
}

//! Patterns of meshes with exact faces: polyhedra, low-poly models and parts of CAD, whose faces are moved into the plane
//! as they are.
//!
//! Coplanar triangles are one facet. Facets are placed by rigid motions along the edges where they meet, so that no sheet has
//! strain, and both sides of each cut are equally long. Where sheets would overlap they are cut apart.

mod bends;
mod growth;
mod kind;
mod metal;
mod net;
mod noisy;
mod patches;
mod planes;
mod rolled;
mod search;
mod sheets;
mod straight;

use super::sheets::{Pattern, Simplified};
use crate::error::{Error, Result};
use crate::scene::decimation::decimate;
use crate::scene::mesh::Mesh;
use crate::scene::polyhedron::Polyhedron;
pub use metal::{SheetMetal, sheet_metal};
use net::{EdgeChoices, Net};
use patches::FlatPatches;

pub use kind::{MeshKind, RecognizedMesh};

/// Options of a net: the room for its sheets, and edges that a person decides about.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct NetOptions {
    /// Width and height, in the mesh's units, within which each sheet lies, in either orientation, unless a single face is
    /// larger.
    pub room: Option<[f64; 2]>,
    /// Pairs of patches whose common edges are cut, by the patches' numbers in the pattern that these options without `cut` and
    /// `join` give.
    pub cut: Vec<[u32; 2]>,
    /// Pairs of patches, likewise, whose common edges are folds.
    pub join: Vec<[u32; 2]>,
}

/// Lays a mesh flat as it is, face by face: without strain, in few sheets with short cuts. Solids that touch each other are laid
/// flat each by itself; other edges of more than two triangles are cut. The mesh may have borders and several components. Each edge
/// between two faces is a fold or a cut.
///
/// Costs some seconds at most for the search, twice that with edges to cut or join, and `O(triangles log triangles)` beside it.
///
/// # Errors
/// [`Error::Unsupported`](crate::Error::Unsupported) if the triangles have no area, for a pair of patches without a common
/// edge, and for edges that cannot all be folds.
pub fn pattern_exact(mesh: &Mesh, options: &NetOptions) -> Result<Pattern> {
    pattern_of(&Polyhedron::new(mesh)?, options)
}

/// The faces of a mesh whose triangles are too many or too noisy to be its faces themselves.
pub struct FoundFaces {
    /// Number of faces.
    pub count: usize,
    /// Standard deviation of the mesh's vertices from the faces, in the mesh's unit.
    pub noise: f64,
    solid: Polyhedron,
}

impl FoundFaces {
    /// Lays the faces flat, as [`pattern_exact`] does.
    ///
    /// # Errors
    /// The errors of [`pattern_exact`].
    pub fn pattern(&self, options: &NetOptions) -> Result<Pattern> {
        pattern_of(&self.solid, options)
    }
}

/// Simplifies a mesh to at most so many flat faces, by contracting edges (Garland and Heckbert 1997), whether or not it has noise, and
/// lays these flat: any shape can be built so. The faces are more only where fewer would not leave the surface's connections as they are,
/// as those of a mesh of many parts. Costs `O(triangles · log(triangles))` beside the search of [`pattern_exact`].
///
/// # Errors
/// The errors of [`pattern_exact`].
pub(super) fn pattern_simplified(
    mesh: &Mesh,
    max_faces: usize,
    options: &NetOptions,
) -> Result<Pattern> {
    let found = decimate(&Polyhedron::new(mesh)?, max_faces);
    let places = found.places.iter().map(|place| (*place).into()).collect();
    let solid = Polyhedron::new(&Mesh::new(places, found.triangles)?)?;
    Ok(Pattern {
        simplified: Some(Simplified {
            faces: solid.areas.len(),
            distance: found.distance,
        }),
        ..pattern_of(&solid, options)?
    })
}

fn pattern_of(solid: &Polyhedron, options: &NetOptions) -> Result<Pattern> {
    let mut choices = EdgeChoices::default();
    if !(options.cut.is_empty() && options.join.is_empty()) {
        let net = Net::new(solid, options.room, EdgeChoices::default())?;
        let patches = FlatPatches::new(solid, &net)?;
        choices.cut = patches.facets_between(solid, &options.cut)?;
        choices.join = patches.facets_between(solid, &options.join)?;
        if choices.join.iter().any(|pair| choices.cut.contains(pair)) {
            return Err(Error::Unsupported {
                format: "pattern",
                reason:
                    "the same edge is to be cut and to be a fold: leave it out of `cut` or `join`"
                        .into(),
            });
        }
    }
    let net = Net::new(solid, options.room, choices)?;
    let patches = FlatPatches::new(solid, &net)?;
    sheets::draw(solid, &net, &patches)
}

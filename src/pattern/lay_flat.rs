//! A surface of any kind laid flat, in the way that suits what it is.

use super::MAX_FEW_FACES;
use super::exact::{MeshKind, NetOptions, RecognizedMesh, pattern_exact, pattern_simplified};
use super::options::PatternOptions;
use super::sheets::Pattern;
use super::surface::{pattern, pattern_mesh};
use crate::error::{Error, Result};
use crate::heights::heightfield::Heightfield;
use crate::progress;
use crate::scene::mesh::Mesh;
use crate::scene::triangulation::Triangulation;
use crate::scene::view::Frame;
use crate::shape::patches::{MeshPatches, PatchOptions, Patches};

/// A surface to be laid flat.
#[derive(Debug, Clone, Copy)]
pub enum Shape<'a> {
    /// Heights, whose creases are found.
    Heights(&'a Heightfield),
    /// A mesh, which is recognised.
    Mesh(&'a Mesh),
}

/// How a surface is laid flat.
#[derive(Debug, Clone, Default)]
pub struct FlatOptions {
    /// What counts as a crease and as a patch, where the surface is cut.
    pub patches: PatchOptions,
    /// Limits of strain and gaps, where the surface is cut.
    pub sheets: PatternOptions,
    /// Room for sheets, and edges that a person decides about, where flat faces are laid flat.
    pub net: NetOptions,
    /// Whether the triangles of a mesh are its faces, and not a surface to be cut; `None`: as [`RecognizedMesh`] says.
    pub exact: Option<bool>,
    /// Maximum number of flat faces that stand for the surface. `None`: the surface is laid flat as it is, and simplified to
    /// [`MAX_FEW_FACES`] only where no cut lays it flat; 0: never.
    pub faces: Option<usize>,
}

/// Lays a surface flat, in the way that suits what it is: flat faces as they are, by [`pattern_exact`] or as they are
/// [recognised](RecognizedMesh); what has noise or is smooth by cuts, with [`pattern`] and [`pattern_mesh`]; and what no cut lays flat by few flat
/// faces that stand for it ([`Pattern::simplified`]).
///
/// ```
/// use developable::pattern::{FlatOptions, Shape, lay_flat};
/// # fn main() -> developable::Result<()> {
/// let corners = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
/// let tetrahedron = developable::Mesh::new(corners, vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]])?;
/// let found = lay_flat(Shape::Mesh(&tetrahedron), &FlatOptions::default())?;
/// assert_eq!((found.sheets.len(), found.sheets[0].folds.len()), (1, 3));
/// # Ok(())
/// # }
/// ```
///
/// # Errors
/// The errors of the calls named, of which [`Error::NotFlat`] only where `faces` is given; [`Error::Option`] for edges that a person decides
/// about where the surface is cut.
pub fn lay_flat(surface: Shape, options: &FlatOptions) -> Result<Pattern> {
    let simplified = |faces| match surface {
        Shape::Mesh(mesh) => pattern_simplified(mesh, faces, &options.net),
        Shape::Heights(field) => {
            let mesh = Triangulation::new(field, &Frame::default())?.into_mesh();
            pattern_simplified(&mesh, faces, &options.net)
        }
    };
    if let Some(faces) = options.faces.filter(|faces| *faces > 0) {
        return simplified(faces);
    }
    let found = match surface {
        Shape::Heights(field) => cut_heights(field, options),
        Shape::Mesh(mesh) => pattern_of_mesh(mesh, options),
    };
    match found {
        Err(Error::NotFlat { .. }) if options.faces.is_none() => simplified(MAX_FEW_FACES),
        found => found,
    }
}

fn cut_heights(field: &Heightfield, options: &FlatOptions) -> Result<Pattern> {
    check_undecided(&options.net)?;
    let patches = progress::part(0.1, || Patches::new(field, &options.patches))?;
    progress::part(0.95, || pattern(field, &patches, &options.sheets))
}

fn pattern_of_mesh(mesh: &Mesh, options: &FlatOptions) -> Result<Pattern> {
    let RecognizedMesh { kind, faces } = match options.exact {
        Some(true) => MeshKind::Faces.into(),
        Some(false) => MeshKind::Noisy.into(),
        None => RecognizedMesh::of(mesh)?,
    };
    if let Some(faces) = faces {
        return faces.pattern(&options.net);
    }
    if kind == MeshKind::Faces {
        return pattern_exact(mesh, &options.net);
    }
    check_undecided(&options.net)?;
    let patches = progress::part(0.1, || MeshPatches::new(mesh, &options.patches))?;
    progress::part(0.95, || pattern_mesh(mesh, &patches, &options.sheets))
}

/// Checks that a person has decided about no edge: where a surface is cut it has no flat faces with edges between them.
fn check_undecided(NetOptions { cut, join, .. }: &NetOptions) -> Result<()> {
    let given = [("cut", cut), ("join", join)];
    match given.iter().find(|(_, pairs)| !pairs.is_empty()) {
        Some((name, _)) => Err(Error::Option {
            name,
            value: "given".into(),
            requirement: "it is for meshes with flat faces: `faces` makes any surface one",
        }),
        None => Ok(()),
    }
}

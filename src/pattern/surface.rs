//! Patterns of heightfields and of meshes.

use super::cutting::{PatchedMesh, cut_into_sheets};
use super::options::PatternOptions;
use super::sheets::Pattern;
use super::smooth_creases::smooth_creases;
use super::surface_mesh::SurfaceMesh;
use crate::error::{Result, check_count};
use crate::fit::mesh::topology::Topology;
use crate::heights::heightfield::Heightfield;
use crate::scene::mesh::Mesh;
use crate::shape::patches::bend_angles::NORMAL_DISTANCE_VERTICES;
use crate::shape::patches::{MeshPatches, Patches};

/// Cuts a heightfield into flat sheets; the first sheet is the one with the largest patch.
///
/// The heightfield becomes a mesh whose creases are edges, of twenty thousand vertices besides those on creases and border
/// ([`Sheet::spacing`](super::Sheet::spacing) is the length of its edges); holes smaller than its triangles are closed. Then it is
/// cut as [`pattern_mesh`] says. The surface is also cut at its steps, and the walls there are on no sheet
/// ([`Pattern::missing`]).
///
/// # Errors
/// [`Error::Shape`](crate::Error::Shape) or [`Error::Mismatch`](crate::Error::Mismatch) if the patches belong to another surface,
/// and else as [`pattern_mesh`].
pub fn pattern(
    surface: &Heightfield,
    patches: &Patches,
    options: &PatternOptions,
) -> Result<Pattern> {
    patches.check_of(surface)?;
    let mesh = SurfaceMesh::new(surface, patches)?;
    let mut found = cut_into_sheets(
        PatchedMesh {
            places: mesh.places,
            triangles: mesh.triangles,
            patches: mesh.patches,
            bend: patches.bend() * mesh.step as f64,
            crease_width: NORMAL_DISTANCE_VERTICES as f64 * surface.lattice().spacing(),
        },
        options,
    )?;
    found.missing.vertices = found.missing.vertices * mesh.step * mesh.step + mesh.loose;
    found.missing.area +=
        mesh.loose as f64 * surface.lattice().spacing() * surface.lattice().row_spacing();
    found.missing.steps = mesh.steps;
    found.missing.step_area = mesh.step_area;
    Ok(found)
}

/// Cuts a mesh into flat sheets; the first is the one with the largest patch. The mesh may be closed, overhanging
/// or of several components.
///
/// Every sheet has a simple outline and has a strain of at most [`PatternOptions::max_strain`]. A patch with a
/// larger strain is cut in two, repeatedly, by the plane normal to one of its principal axes whose cut is shortest for the strain
/// that it takes away. Then parts are joined along the seams whose sides fit, the longest first, so that a tube gets one slit; a seam
/// that fits along a part of its length is a fold there and a cut elsewhere. Last, cuts are closed again, whole or in part, where
/// strain and outlines stay valid. A part that cannot be cut further is left out, and so is a sheet that is a crumb, less than a
/// thousandth of the area ([`Pattern::missing`]).
/// Both sides of a cut have the same length on the mesh, and on the sheets except for strain.
///
/// Costs an unrolling of each patch, a dozen short ones for each cut and one or two for each seam.
///
/// # Errors
/// [`Error::Shape`](crate::Error::Shape) if the patches belong to another mesh,
/// [`Error::Option`](crate::Error::Option) for a seam gap or a strain that is not positive and finite,
/// [`Error::Topology`](crate::Error::Topology) for a mesh that is not a surface,
/// [`Error::NotFlat`](crate::Error::NotFlat) if a tenth of the area does not lie flat in 500 parts.
pub fn pattern_mesh(
    mesh: &Mesh,
    patches: &MeshPatches,
    options: &PatternOptions,
) -> Result<Pattern> {
    check_count(
        "patches of the mesh",
        mesh.triangles().len(),
        1,
        patches.labels().len(),
    )?;
    let topology = Topology::new(mesh)?;
    let place = |vertex: &u32| mesh.positions()[*vertex as usize].into();
    let labels = topology.from.iter().map(|t| patches.labels()[*t as usize]);
    let labels: Vec<u32> = labels.collect();
    let mut places: Vec<_> = topology.source.iter().map(place).collect();
    smooth_creases(&mut places, &topology.triangles, &labels);
    let mesh = PatchedMesh {
        places,
        triangles: topology.triangles.clone(),
        patches: labels,
        bend: patches.bend(),
        crease_width: 0.0,
    };
    cut_into_sheets(mesh, options)
}

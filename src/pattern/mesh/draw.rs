//! The sheets of a mesh that was cut into parts and joined.

use super::body::Body;
use super::join::Joined;
use super::junction::Junctions;
use super::seams::Seams;
use crate::error::Result;
use crate::math::index::NO_INDEX;
use crate::pattern::crumbs::remove_crumbs;
use crate::pattern::flat_mesh::FlatMesh;
use crate::pattern::{Direction, Missing, Seam, Sheet};
use crate::shape::patches::{Crease, Patch};
use crate::unroll::flat_triangle::Point;

/// A mesh cut into flat sheets.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct MeshPattern {
    /// The sheets; the first is the one with the largest patch. They are seen from outside, the side that the
    /// mesh's triangles face.
    pub sheets: Vec<Sheet>,
    /// The patches of the sheets, the largest area first: the connected components of the patches that were given,
    /// or the parts that these were cut into.
    pub patches: Vec<Patch>,
    /// The creases between the patches, with the cuts inside of patches among them.
    pub creases: Vec<Crease>,
    /// Vertices and area of the mesh that are on no sheet.
    pub missing: Missing,
}

pub(super) fn draw_sheets(
    body: &Body,
    seams: &Seams,
    joined: &[Joined],
    mut missing: Missing,
) -> Result<MeshPattern> {
    let junctions = Junctions::new(body, seams, joined);
    let flat = flat_mesh(body, seams, joined);
    let sheet = |own: &Joined| {
        // A cut that is within the sheet and hardly opens is no outline, but a hole of the mesh is, however small.
        let least = |line: &[u32]| match line.iter().all(|side| seams.of(*side).is_some()) {
            true => body.spacing.powi(2),
            false => 0.0,
        };
        Sheet {
            spacing: body.spacing,
            area: own.laid.area,
            strain: own.laid.strain,
            seam_gap: own.gap,
            ..flat.sheet(&own.laid.members, least, |vertex| junctions.at(vertex))
        }
    };
    let mut sheets: Vec<Sheet> = joined.iter().map(sheet).collect();
    let areas = body.areas();
    let counted = flat.vertices_of_patches(areas.len());
    let patch = |(vertices, area): (usize, f64)| Patch { vertices, area };
    let patches: Vec<Patch> = counted.into_iter().zip(areas).map(patch).collect();
    remove_crumbs(&mut sheets, &patches, &mut missing, |_| false);
    sheets.sort_by_key(|sheet| sheet.patches[0]);
    let crease = |seam: &super::seams::Seam| Crease {
        patches: seam.parts,
        points: (seam.vertices.iter())
            .map(|v| body.places[*v as usize].into())
            .collect(),
        length: seam.length,
        fold: seam.angle.abs(),
    };
    Ok(MeshPattern {
        sheets,
        patches,
        creases: seams.all.iter().map(crease).collect(),
        missing,
    })
}

/// The triangles of a mesh on its sheets, cut along the seams that are not joined.
fn flat_mesh<'a>(body: &'a Body, seams: &'a Seams, joined: &[Joined]) -> FlatMesh<'a> {
    let mut whole = vec![false; seams.all.len()];
    let mut flat = vec![[Point::default(); 3]; body.triangles.len()];
    for sheet in joined {
        sheet.whole.iter().for_each(|seam| whole[*seam] = true);
        for (t, corners) in sheet.laid.members.iter().zip(&sheet.laid.triangles) {
            flat[*t as usize] = corners.map(|v| sheet.laid.places[v as usize]);
        }
    }
    let sides = 0..seams.twins.len() as u32;
    let seam = |(number, seam): (usize, &super::seams::Seam)| Seam {
        crease: number,
        patches: seam.parts,
        direction: Direction::from_ridge(seam.angle >= 0.0),
        angle: seam.angle.abs(),
        slit: seam.smooth,
        torn: false,
    };
    FlatMesh {
        places: &body.places,
        triangles: &body.triangles,
        twins: &seams.twins,
        textured: &[],
        closed: (sides.clone())
            .map(|side| {
                seams.twins[side as usize] != NO_INDEX
                    && seams.of(side).is_none_or(|seam| whole[seam])
            })
            .collect(),
        flat,
        patches: body.parts.clone(),
        seams: seams.all.iter().enumerate().map(seam).collect(),
        seam_of: (sides)
            .map(|side| seams.of(side).map_or(NO_INDEX, |seam| seam as u32))
            .collect(),
        rounding: 0.0,
    }
}

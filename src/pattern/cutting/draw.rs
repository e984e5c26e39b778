//! The sheets of a mesh that was cut into parts and joined.

use rustc_hash::FxHashSet;

use super::body::Body;
use super::join::Joined;
use super::junction::junctions;
use super::lay::FlatPart;
use super::refold::refold_sheet;
use super::seams::Seams;
use crate::error::Result;
use crate::math::index::NO_INDEX;
use crate::math::motion::Motion;
use crate::math::union_find::UnionFind;
use crate::pattern::crumbs::remove_crumbs;
use crate::pattern::flat_mesh::FlatMesh;
use crate::pattern::{Direction, Missing, Pattern, Seam, Sheet, Spot};
use crate::shape::patches::{Crease, Patch};
use crate::unroll::flat_triangle::Point;

/// Distance on a sheet, in edge lengths of the mesh, within which points of a line lie on a straight one.
/// `benches/patterns.md` has what others give.
const STRAIGHTNESS_LENGTHS: f64 = 2e-3;

pub(super) fn draw_sheets(
    body: &Body,
    seams: &Seams,
    joined: &[Joined],
    mut missing: Missing,
    refold: bool,
) -> Result<Pattern> {
    let mut is_whole = vec![false; seams.all.len()];
    (joined.iter().flat_map(|sheet| &sheet.whole)).for_each(|seam| is_whole[*seam] = true);
    let flat = flat_mesh(body, seams, joined, &is_whole);
    let mut junctions = junctions(body, seams, &is_whole, &flat.flat);
    let areas = body.areas();
    let mut regions = smooth_regions(areas.len(), seams, joined)?;
    let sheet = |own: &Joined| {
        // A cut that is within the sheet and hardly opens is no outline, but a hole of the mesh is, however small.
        let least = |line: &[u32]| match line.iter().all(|side| seams.of(*side).is_some()) {
            true => body.spacing.powi(2),
            false => 0.0,
        };
        let mut drawn = flat.sheet(&own.laid.members, least);
        label_regions(&mut drawn.spots, &mut regions);
        Ok(Sheet {
            spacing: body.spacing,
            area: own.laid.area,
            strain: own.laid.strain,
            seam_gap: own.gap,
            junctions: (own.laid.source.iter())
                .filter_map(|vertex| junctions.remove(vertex))
                .collect(),
            refolding: match refold {
                true => Some(refold_sheet(body, &own.laid)?),
                false => None,
            },
            ..drawn
        })
    };
    let mut sheets = joined.iter().map(sheet).collect::<Result<Vec<Sheet>>>()?;
    let counted = flat.vertices_of_patches(areas.len());
    let patch = |(vertices, area): (usize, f64)| Patch { vertices, area };
    let patches: Vec<Patch> = counted.into_iter().zip(areas).map(patch).collect();
    remove_crumbs(&mut sheets, &patches, &mut missing);
    sheets.sort_by_key(|sheet| sheet.patches[0]);
    let crease = |seam: &super::seams::Seam| Crease {
        patches: seam.parts,
        points: (seam.vertices.iter())
            .map(|v| body.places[*v as usize].into())
            .collect(),
        length: seam.length,
        fold: seam.angle.abs(),
    };
    Ok(Pattern {
        sheets,
        patches,
        creases: seams.all.iter().map(crease).collect(),
        missing,
        simplified: None,
    })
}

/// The parts of a mesh that are one smooth region again, since they were joined along a cut inside of a patch.
fn smooth_regions(parts: usize, seams: &Seams, joined: &[Joined]) -> Result<UnionFind> {
    let mut regions = UnionFind::new("labels", parts)?;
    let whole = joined.iter().flat_map(|sheet| &sheet.whole);
    for seam in whole.map(|seam| &seams.all[*seam]) {
        if seam.smooth {
            regions.union(seam.parts[0], seam.parts[1]);
        }
    }
    Ok(regions)
}

/// Keeps one label for each smooth region of a sheet, where it has most room, with the lowest number of the region's parts.
fn label_regions(spots: &mut Vec<Spot>, regions: &mut UnionFind) {
    spots.sort_by(|a, b| b.room.total_cmp(&a.room));
    let mut labelled = FxHashSet::default();
    spots.retain_mut(|spot| {
        spot.patch = regions.find(spot.patch);
        labelled.insert(spot.patch)
    });
    spots.sort_by_key(|spot| spot.patch);
}

/// The triangles of a mesh on its sheets, cut along the seams that are not joined.
fn flat_mesh<'a>(
    body: &'a Body,
    seams: &'a Seams,
    joined: &[Joined],
    is_whole: &[bool],
) -> FlatMesh<'a> {
    let mut flat = vec![[Point::default(); 3]; body.triangles.len()];
    for sheet in joined {
        let upright = upright(body, &sheet.laid);
        for (t, corners) in sheet.laid.members.iter().zip(&sheet.laid.triangles) {
            flat[*t as usize] = corners.map(|v| upright.apply(sheet.laid.places[v as usize]));
        }
    }
    let sides = 0..seams.twins.len() as u32;
    let seam = |(number, seam): (usize, &super::seams::Seam)| Seam {
        crease: number,
        patches: seam.parts,
        direction: Direction::from_ridge(seam.angle >= 0.0),
        angle: seam.angle.abs(),
        slit: seam.smooth,
    };
    FlatMesh {
        places: &body.places,
        triangles: &body.triangles,
        twins: &seams.twins,
        textured: &[],
        closed: (sides.clone())
            .map(|side| {
                seams.twins[side as usize] != NO_INDEX
                    && seams.of(side).is_none_or(|seam| is_whole[seam])
            })
            .collect(),
        flat,
        patches: body.parts.clone(),
        seams: seams.all.iter().enumerate().map(seam).collect(),
        seam_of: (sides)
            .map(|side| seams.of(side).map_or(NO_INDEX, |seam| seam as u32))
            .collect(),
        rounding: 0.0,
        straightness: STRAIGHTNESS_LENGTHS * body.spacing,
    }
}

/// The motion that brings a sheet nearest to the surface as it is seen from above.
fn upright(body: &Body, laid: &FlatPart) -> Motion {
    let plan = laid.source.iter().map(|v| {
        let place = body.places[*v as usize];
        Point::new(place.x, place.y)
    });
    Motion::between(&laid.places, &plan.collect::<Vec<Point>>())
}

//! The sheets of a net, and the creases along which its edges are cut and folded.

use rustc_hash::FxHashMap;

use super::bends::{mark_bends, radii};
use super::net::Net;
use super::patches::FlatPatches;
use crate::error::Result;
use crate::math::index::NO_INDEX;
use crate::math::planar::{LeastBox, Point2};
use crate::math::union_find::UnionFind;
use crate::pattern::flat_mesh::FlatMesh;
use crate::pattern::{Direction, Missing, Pattern, Seam, Sheet};
use crate::scene::half_edges::half_edge_ends;
use crate::scene::polyhedron::Polyhedron;
use crate::shape::patches::chains::chains;
use crate::shape::patches::{Crease, Patch};

pub(super) fn draw(solid: &Polyhedron, net: &Net, patches: &FlatPatches) -> Result<Pattern> {
    let mut pieces = net.pieces();
    let mut flat = FlatMesh {
        places: &solid.places,
        triangles: &solid.triangles,
        twins: &solid.twins,
        textured: &solid.textured,
        closed: (0..solid.twins.len() as u32)
            .map(|side| net.is_closed(side))
            .collect(),
        flat: upright(solid, net, &pieces),
        patches: (solid.facets.iter())
            .map(|facet| patches.of[*facet as usize])
            .collect(),
        seams: Vec::new(),
        seam_of: vec![NO_INDEX; solid.twins.len()],
        rounding: solid.rounding,
        straightness: solid.rounding,
    };
    let creases = find_creases(solid, &mut flat)?;
    let edges = solid.twins.len() as f64;
    let sides = 0..solid.twins.len() as u32;
    let spacing = sides.map(|side| solid.length(side)).sum::<f64>() / edges;
    let radii = radii(solid, patches);
    // The bend that goes on or ends at each fold, with its radii, and the angle at the line along which a bend all around is cut.
    let mut bend_at: Vec<Option<(u32, [f64; 2])>> = vec![None; creases.len()];
    let mut cut_angles: FxHashMap<u32, f64> = FxHashMap::default();
    for side in solid.inner_sides() {
        let [a, b] = [side, solid.twins[side as usize]].map(|s| solid.facet(s));
        let bend = patches.bends[a as usize];
        if !net.is_closed(side) && bend == patches.bends[b as usize] {
            cut_angles.insert(bend, solid.angle(side).abs());
        }
        let [first, second] = [(a, b), (b, a)].map(|(own, other)| {
            let bend = patches
                .goes_on(own, other)
                .then(|| patches.bends[own as usize])?;
            Some((bend, radii[bend as usize]?))
        });
        let found = &mut bend_at[flat.seam_of[side as usize] as usize];
        *found = found.or(first).or(second);
    }
    let area = |facets: &[u32]| facets.iter().map(|f| solid.areas[*f as usize]).sum::<f64>();
    let sheet = |facets: &Vec<u32>| {
        let mut is_own = vec![false; solid.normals.len()];
        facets
            .iter()
            .for_each(|facet| is_own[*facet as usize] = true);
        let members = (0u32..).zip(&solid.facets);
        let members = members.filter(|(_, facet)| is_own[**facet as usize]);
        let members: Vec<u32> = members.map(|(t, _)| t).collect();
        let mut sheet = flat.sheet(&members, |_| 0.0);
        mark_bends(&mut sheet.folds, &cut_angles, |fold| {
            bend_at[fold.seam.crease]
        });
        Sheet {
            spacing,
            area: area(facets),
            exact: true,
            ..sheet
        }
    };
    // Triangles without a width that nothing else joins are no sheet.
    pieces.retain(|facets| area(facets) > solid.rounding * spacing);
    let mut sheets: Vec<Sheet> = pieces.iter().map(sheet).collect();
    sheets.sort_by_key(|sheet| sheet.patches[0]);
    let counted = flat.vertices_of_patches(patches.areas.len());
    let patch = |(vertices, area): (usize, &f64)| Patch {
        vertices,
        area: *area,
    };
    Ok(Pattern {
        sheets,
        patches: counted.into_iter().zip(&patches.areas).map(patch).collect(),
        creases,
        missing: Missing::default(),
        simplified: None,
    })
}

/// Positions of all triangles' corners in their pieces, each in the smallest box.
fn upright(solid: &Polyhedron, net: &Net, pieces: &[Vec<u32>]) -> Vec<[Point2; 3]> {
    let count = solid.triangles.len() as u32;
    let mut flat: Vec<[Point2; 3]> = (0..count).map(|t| net.placed(t)).collect();
    let mut own = vec![Vec::new(); solid.normals.len()];
    for (t, facet) in solid.facets.iter().enumerate() {
        own[*facet as usize].push(t);
    }
    for piece in pieces {
        let members = || piece.iter().flat_map(|facet| &own[*facet as usize]);
        let corners = members().flat_map(|t| flat[*t]).map(|p| [p.re, p.im]);
        let [cos, sin] = LeastBox::turned_and_upright(corners.collect()).0.turn;
        for t in members() {
            flat[*t] = flat[*t].map(|p| p * Point2::new(cos, sin));
        }
    }
    flat
}

/// Groups edges to creases: cuts that follow each other on both sides between the same patches, and folds along one line. Each
/// crease is a seam of the mesh.
fn find_creases(solid: &Polyhedron, flat: &mut FlatMesh) -> Result<Vec<Crease>> {
    let mut sets = UnionFind::new("edges", solid.twins.len())?;
    let patch = |side: u32| flat.patches[side as usize / 3];
    let sides: Vec<u32> = solid.inner_sides().collect();
    for side in 0..solid.twins.len() as u32 {
        let twin = solid.twins[side as usize];
        if twin == NO_INDEX || solid.facet(side) == solid.facet(twin) {
            continue;
        }
        sets.union(side, twin);
        if !flat.closed[side as usize] {
            let next = flat.next_on_outline(side);
            let other = solid.twins[next as usize];
            if other != NO_INDEX
                && solid.facet(next) != solid.facet(other)
                && patch(next) == patch(side)
                && patch(other) == patch(twin)
                && flat.next_on_outline(other) == twin
            {
                sets.union(side, next);
            }
        }
    }
    // Edges of a fold are between the same two facets.
    let mut between: FxHashMap<[u32; 2], u32> = FxHashMap::default();
    for side in sides.iter().filter(|side| flat.closed[**side as usize]) {
        let (a, b) = (solid.facet(*side), solid.facet(solid.twins[*side as usize]));
        let first = *between.entry([a.min(b), a.max(b)]).or_insert(*side);
        sets.union(first, *side);
    }
    let mut groups: Vec<(u32, u32)> = sides.iter().map(|side| (sets.find(*side), *side)).collect();
    groups.sort_unstable();
    let mut creases = Vec::new();
    for group in groups.chunk_by(|a, b| a.0 == b.0) {
        let number = creases.len();
        let sides: Vec<u32> = group.iter().map(|(_, side)| *side).collect();
        let (mut length, mut sum, mut signed) = (0.0, 0.0, 0.0);
        for side in &sides {
            flat.seam_of[*side as usize] = number as u32;
            flat.seam_of[solid.twins[*side as usize] as usize] = number as u32;
            let (long, angle) = (solid.length(*side), solid.angle(*side));
            length += long;
            sum += long * angle.abs();
            signed += long * angle;
        }
        let mut patches =
            [sides[0], solid.twins[sides[0] as usize]].map(|side| flat.patches[side as usize / 3]);
        patches.sort_unstable();
        let fold = sum / length.max(f64::MIN_POSITIVE);
        let ends = |side: &u32| half_edge_ends(&solid.triangles, *side);
        let lines = chains(&sides.iter().map(ends).collect::<Vec<_>>(), |_| false);
        creases.push(Crease {
            patches,
            points: (lines[0].vertices.iter())
                .map(|v| solid.places[*v as usize].into())
                .collect(),
            length,
            fold,
        });
        flat.seams.push(Seam {
            crease: number,
            patches,
            direction: Direction::from_ridge(signed >= 0.0),
            angle: fold,
            slit: false,
        });
    }
    Ok(creases)
}

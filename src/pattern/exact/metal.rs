//! Solids of sheet metal: two parallel skins at a constant distance, and the rim between them.

use std::collections::{BTreeMap, BTreeSet};

use nalgebra::Matrix3;

use crate::error::Result;
use crate::math::index::NO_INDEX;
use crate::math::union_find::UnionFind;
use crate::scene::half_edges::half_edge_ends;
use crate::scene::mesh::Mesh;
use crate::scene::polyhedron::{Place, Polyhedron};

/// Maximum difference of a skin's depth from the thickness, as a share of it: the depth between the chords of a bend is less
/// than between its arcs. `benches/patterns.md` has what others give.
const MAX_DEPTH_DIFFERENCE: f64 = 0.15;

/// Maximum cosine of the angle between the normals of a skin and of what lies below it. `benches/patterns.md` has what others give.
const MAX_OPPOSITE_COSINE: f64 = -0.9;

/// Maximum thickness of a sheet, as a share of the side of a square with the area of a skin. `benches/patterns.md` has what others
/// give.
const MAX_THICKNESS_SHARE: f64 = 0.1;

/// Maximum mean cosine of the angle between the larger skin, or both, and the rim along them: a blank is cut straight through. It is 0
/// where edges are sharp or slanted alike on both skins, 0.7 where they are chamfered (`benches/exactness.md`).
const MAX_MEAN_LEAN: f64 = 0.1;

/// Maximum product of the numbers of facets and triangles: some seconds of search in wasm.
const MAX_FACET_TRIANGLE_PAIRS: usize = 100_000_000;

/// A solid of sheet metal, or several of the same: their thickness, and of each the one of its skins that has the larger area.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct SheetMetal {
    /// Distance of the two skins, in the mesh's units.
    pub thickness: f64,
    /// The skins as an open mesh, seen from outside of the solids. Laid flat with a
    /// [`Bending`](crate::drawing::Bending) of the thickness it is the blank that the solid is bent from.
    pub skin: Mesh,
}

/// Recognises solids of sheet metal: a closed mesh with exact faces most of whose area has, at one depth, a parallel face
/// below it, in each of its components. `None` for any other mesh, and for one of so many facets and triangles that the search would
/// take seconds.
/// Costs `O(facets · triangles)`.
///
/// # Errors
/// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
pub fn sheet_metal(mesh: &Mesh) -> Result<Option<SheetMetal>> {
    let Ok(solid) = Polyhedron::new(mesh) else {
        return Ok(None);
    };
    let pairs = solid.areas.len().saturating_mul(solid.triangles.len());
    if solid.twins.contains(&NO_INDEX) || pairs > MAX_FACET_TRIANGLE_PAIRS {
        return Ok(None);
    }
    let depths = depths(&solid);
    let mut bodies = UnionFind::new("facets", solid.areas.len())?;
    for (side, twin) in (0u32..).zip(&solid.twins) {
        bodies.union(solid.facet(side), solid.facet(*twin));
    }
    let mut facets: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
    for facet in 0..solid.areas.len() as u32 {
        facets.entry(bodies.find(facet)).or_default().push(facet);
    }
    // Each body is to be cut from the same sheet.
    let mut thickness: Option<f64> = None;
    let mut is_skin = vec![false; solid.areas.len()];
    for body in facets.values() {
        let Some((own, skin)) = skin(&solid, &depths, body)? else {
            return Ok(None);
        };
        let first = *thickness.get_or_insert(own);
        if !is_alike(own, first) {
            return Ok(None);
        }
        skin.iter()
            .for_each(|facet| is_skin[*facet as usize] = true);
    }
    let Some(thickness) = thickness else {
        return Ok(None);
    };
    let own = (solid.triangles.iter().zip(&solid.facets))
        .filter(|(_, facet)| is_skin[**facet as usize])
        .map(|(corners, _)| *corners);
    let own = own.collect();
    let places = solid.places.iter().map(|place| (*place).into()).collect();
    Ok(Some(SheetMetal {
        thickness,
        skin: Mesh::new(places, own)?,
    }))
}

/// Whether a depth is a thickness.
fn is_alike(depth: f64, thickness: f64) -> bool {
    (depth - thickness).abs() <= MAX_DEPTH_DIFFERENCE * thickness
}

/// The thickness of a body, given by its facets, and the facets of its larger skin; `None` if it is no sheet.
fn skin(
    solid: &Polyhedron,
    depths: &[Option<Depth>],
    body: &[u32],
) -> Result<Option<(f64, Vec<u32>)>> {
    let area = |facet: &u32| solid.areas[*facet as usize];
    let mut sorted: Vec<(f64, f64)> = (body.iter())
        .filter_map(|facet| Some((depths[*facet as usize]?.depth, area(facet))))
        .collect();
    sorted.sort_by(|a, b| a.0.total_cmp(&b.0));
    let whole: f64 = body.iter().map(area).sum();
    let parallel: f64 = sorted.iter().map(|(_, area)| area).sum();
    let mut below = 0.0;
    let median = sorted.iter().find(|(_, area)| {
        below += area;
        below >= 0.5 * parallel
    });
    let Some(thickness) = median.map(|(depth, _)| *depth) else {
        return Ok(None);
    };
    let depths: Vec<Option<Depth>> = (depths.iter())
        .map(|own| own.filter(|own| is_alike(own.depth, thickness)))
        .collect();
    let rim = rim(solid, &depths);
    let is_skin = |facet: u32| depths[facet as usize].is_some() && !rim[facet as usize];
    let mut sets = UnionFind::new("facets", solid.areas.len())?;
    for side in solid.inner_sides() {
        let [a, b] = [side, solid.twins[side as usize]].map(|side| solid.facet(side));
        if is_skin(a) && is_skin(b) {
            sets.union(a, b);
        }
    }
    let mut skins: BTreeMap<u32, (f64, Vec<u32>)> = BTreeMap::new();
    for facet in body.iter().filter(|facet| is_skin(**facet)) {
        let own = skins.entry(sets.find(*facet)).or_default();
        own.0 += area(facet);
        own.1.push(*facet);
    }
    let mut skins: Vec<(f64, Vec<u32>)> = skins.into_values().collect();
    skins.sort_by(|a, b| b.0.total_cmp(&a.0));
    let [first, second, ..] = &skins[..] else {
        return Ok(None);
    };
    // Below each skin is the other one.
    let above = |facets: &[u32], other: &[u32]| -> Vec<u32> {
        let below = |facet: &u32| depths[*facet as usize].map(|depth| depth.below);
        let is_above = |facet: &&u32| below(facet).is_some_and(|b| other.binary_search(&b).is_ok());
        facets.iter().filter(is_above).copied().collect()
    };
    let [own, other] = [above(&first.1, &second.1), above(&second.1, &first.1)];
    let [large, small] = [&own, &other].map(|facets| facets.iter().map(area).sum::<f64>());
    // The rim has less area than either skin, and goes around both alike: ribs and domes are on one of them only.
    let is_thin = small.min(large) >= whole - large - small
        && thickness <= MAX_THICKNESS_SHARE * large.sqrt();
    if !is_thin {
        return Ok(None);
    }
    let [border, other] = [&own, &other].map(|facets| Border::new(solid, facets));
    let (border, other) = (border?, other?);
    let is_straight = |leaning: f64, length: f64| leaning.abs() <= MAX_MEAN_LEAN * length;
    let is_cut = is_straight(border.leaning, border.length)
        || is_straight(border.leaning + other.leaning, border.length + other.length);
    let is_sheet = border.lines == other.lines && is_cut;
    Ok(is_sheet.then_some((thickness, own)))
}

/// Which facets are parts of the rim: they meet a larger facet and the one below it.
fn rim(solid: &Polyhedron, depths: &[Option<Depth>]) -> Vec<bool> {
    let mut around: Vec<BTreeSet<u32>> = vec![BTreeSet::new(); solid.areas.len()];
    for side in solid.inner_sides() {
        let [a, b] = [side, solid.twins[side as usize]].map(|side| solid.facet(side));
        around[a as usize].insert(b);
        around[b as usize].insert(a);
    }
    let is_rim = |(own, around): (&f64, &BTreeSet<u32>)| {
        let mut larger = around.iter().filter(|f| solid.areas[**f as usize] > *own);
        larger.any(|f| depths[*f as usize].is_some_and(|depth| around.contains(&depth.below)))
    };
    solid.areas.iter().zip(&around).map(is_rim).collect()
}

/// The border of a skin: the number of its closed lines, their length, and the integral of the cosine of the angle between the skin and
/// the rim along them.
struct Border {
    lines: usize,
    length: f64,
    leaning: f64,
}

impl Border {
    /// `facets` are the skin's, in ascending order.
    fn new(solid: &Polyhedron, facets: &[u32]) -> Result<Border> {
        let is_own = |side: u32| facets.binary_search(&solid.facet(side)).is_ok();
        let mut lines = UnionFind::new("vertices", solid.places.len())?;
        let mut on_border = Vec::new();
        let (mut length, mut leaning) = (0.0, 0.0);
        for (side, twin) in (0u32..).zip(&solid.twins) {
            if is_own(side) && !is_own(*twin) {
                let [a, b] = half_edge_ends(&solid.triangles, side);
                lines.union(a, b);
                on_border.push(a);
                length += solid.length(side);
                leaning += solid.length(side) * solid.angle(side).cos();
            }
        }
        let mut found: Vec<u32> = on_border.into_iter().map(|v| lines.find(v)).collect();
        found.sort_unstable();
        found.dedup();
        Ok(Border {
            lines: found.len(),
            length,
            leaning,
        })
    }
}

/// How deep a solid is below a facet, and the facet that ends it there.
#[derive(Clone, Copy)]
struct Depth {
    depth: f64,
    below: u32,
}

/// Depth of the solid below the middle of each facet's largest triangle, where a parallel face ends it.
fn depths(solid: &Polyhedron) -> Vec<Option<Depth>> {
    let depth = |(facet, largest): (usize, usize)| {
        let from = solid.corners(largest).iter().sum::<Place>() / 3.0;
        let down = -solid.normals[facet];
        let hits = (0..solid.triangles.len()).filter(|t| solid.facets[*t] as usize != facet);
        let hits = hits.filter_map(|t| Some((distance_along(from, down, solid.corners(t))?, t)));
        let (depth, t) = hits.min_by(|a, b| a.0.total_cmp(&b.0))?;
        let below = solid.facets[t];
        let cosine = solid.normals[below as usize].dot(&solid.normals[facet]);
        (cosine <= MAX_OPPOSITE_COSINE).then_some(Depth { depth, below })
    };
    let largest = solid.largest_triangles();
    largest.into_iter().enumerate().map(depth).collect()
}

/// Distance from a point to a triangle along a direction, if it is met.
fn distance_along(from: Place, along: Place, [a, b, c]: [Place; 3]) -> Option<f64> {
    let inverse = Matrix3::from_columns(&[b - a, c - a, -along]).try_inverse()?;
    let hit = inverse * (from - a);
    let is_inside = hit.x >= 0.0 && hit.y >= 0.0 && hit.x + hit.y <= 1.0;
    (is_inside && hit.z > 0.0).then_some(hit.z)
}

//! Solids of sheet metal: two parallel skins at a constant distance, and the rim between them.

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

/// Maximum product of the numbers of facets and triangles: some seconds of search in wasm.
const MAX_FACET_TRIANGLE_PAIRS: usize = 100_000_000;

/// A solid of sheet metal: its thickness, and the one of its skins that has the larger area.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct SheetMetal {
    /// Distance of the two skins, in the mesh's units.
    pub thickness: f64,
    /// The skin as an open mesh, seen from outside of the solid. Laid flat with a
    /// [`Bending`](crate::drawing::Bending) of the thickness it is the blank that the solid is bent from.
    pub skin: Mesh,
}

/// Recognises a solid of sheet metal: a closed mesh with exact faces most of whose area has, at one depth, a parallel face
/// below it. `None` for any other mesh, and for one of so many facets and triangles that the search would take seconds.
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
    let mut sorted: Vec<(f64, f64)> = (depths.iter().zip(&solid.areas))
        .filter_map(|(depth, area)| Some(((*depth)?, *area)))
        .collect();
    sorted.sort_by(|a, b| a.0.total_cmp(&b.0));
    let whole: f64 = solid.areas.iter().sum();
    let parallel: f64 = sorted.iter().map(|(_, area)| area).sum();
    let mut below = 0.0;
    let median = sorted.iter().find(|(_, area)| {
        below += area;
        below >= 0.5 * parallel
    });
    let Some(thickness) = median.map(|(depth, _)| *depth) else {
        return Ok(None);
    };
    let is_skin = |facet: u32| {
        let depth = depths[facet as usize];
        depth.is_some_and(|d| (d - thickness).abs() <= MAX_DEPTH_DIFFERENCE * thickness)
    };
    let mut sets = UnionFind::new("facets", solid.areas.len())?;
    for (side, twin) in (0u32..).zip(&solid.twins) {
        let [a, b] = [side, *twin].map(|side| solid.facet(side));
        if is_skin(a) && is_skin(b) {
            sets.union(a, b);
        }
    }
    let mut skins = vec![0.0; solid.areas.len()];
    for facet in (0..solid.areas.len() as u32).filter(|facet| is_skin(*facet)) {
        skins[sets.find(facet) as usize] += solid.areas[facet as usize];
    }
    let mut order: Vec<u32> = (0..skins.len() as u32).collect();
    order.sort_by(|a, b| skins[*b as usize].total_cmp(&skins[*a as usize]));
    let [large, small] = [0, 1].map(|k| order.get(k).map_or(0.0, |root| skins[*root as usize]));
    // The rim has less area than either skin, and goes around both alike: ribs and domes are on one of them only.
    let is_sheet =
        small >= whole - large - small && thickness <= MAX_THICKNESS_SHARE * large.sqrt();
    if !is_sheet {
        return Ok(None);
    }
    let counts = [0, 1].map(|k| borders(&solid, |facet| sets.find(facet) == order[k]));
    let [own, other] = counts;
    if own? != other? {
        return Ok(None);
    }
    let own = (solid.triangles.iter().zip(&solid.facets))
        .filter(|(_, facet)| sets.find(**facet) == order[0])
        .map(|(corners, _)| *corners);
    let own = own.collect();
    let places = solid.places.iter().map(|place| (*place).into()).collect();
    Ok(Some(SheetMetal {
        thickness,
        skin: Mesh::new(places, own)?,
    }))
}

/// Number of the closed lines around some facets.
fn borders(solid: &Polyhedron, mut is_own: impl FnMut(u32) -> bool) -> Result<usize> {
    let mut lines = UnionFind::new("vertices", solid.places.len())?;
    let mut on_border = Vec::new();
    for (side, twin) in (0u32..).zip(&solid.twins) {
        if is_own(solid.facet(side)) && !is_own(solid.facet(*twin)) {
            let [a, b] = half_edge_ends(&solid.triangles, side);
            lines.union(a, b);
            on_border.push(a);
        }
    }
    let mut found: Vec<u32> = on_border.into_iter().map(|v| lines.find(v)).collect();
    found.sort_unstable();
    found.dedup();
    Ok(found.len())
}

/// Depth of the solid below the middle of each facet's largest triangle, where a parallel face ends it.
fn depths(solid: &Polyhedron) -> Vec<Option<f64>> {
    let mut largest: Vec<Option<(f64, Place)>> = vec![None; solid.areas.len()];
    for (t, facet) in solid.facets.iter().enumerate() {
        let [a, b, c] = solid.corners(t);
        let area = (b - a).cross(&(c - a)).norm();
        let best = &mut largest[*facet as usize];
        if best.is_none_or(|(most, _)| area > most) {
            *best = Some((area, (a + b + c) / 3.0));
        }
    }
    let depth = |(facet, largest): (usize, &Option<(f64, Place)>)| {
        let (_, from) = (*largest)?;
        let down = -solid.normals[facet];
        let hits = (0..solid.triangles.len()).filter(|t| solid.facets[*t] as usize != facet);
        let hits = hits.filter_map(|t| Some((distance_along(from, down, solid.corners(t))?, t)));
        let (depth, t) = hits.min_by(|a, b| a.0.total_cmp(&b.0))?;
        let below = solid.normals[solid.facets[t] as usize];
        (below.dot(&solid.normals[facet]) <= MAX_OPPOSITE_COSINE).then_some(depth)
    };
    largest.iter().enumerate().map(depth).collect()
}

/// Distance from a point to a triangle along a direction, if it is met.
fn distance_along(from: Place, along: Place, [a, b, c]: [Place; 3]) -> Option<f64> {
    let inverse = Matrix3::from_columns(&[b - a, c - a, -along]).try_inverse()?;
    let hit = inverse * (from - a);
    let is_inside = hit.x >= 0.0 && hit.y >= 0.0 && hit.x + hit.y <= 1.0;
    (is_inside && hit.z > 0.0).then_some(hit.z)
}

//! Tells meshes with exact faces from scans and from smooth surfaces.

use super::patches::{bend_steps, inner_sides};
use super::polyhedron::Polyhedron;
use crate::math::index::NO_INDEX;
use crate::scene::half_edges::half_edge_ends;
use crate::scene::mesh::Mesh;

/// Minimum share of all inner edges that are flat to rounding: noise leaves none, and faces of CAD have one for each triangle
/// beside the first.
const MIN_FLAT_SHARE: f64 = 0.25;

/// Minimum share of the facets that are strips of bends, and maximum share of those that are neither strips nor faces.
const MIN_STRIP_SHARE: f64 = 0.5;

/// Minimum angle, in degrees, between all neighbouring facets but a tenth: a smooth surface has smaller ones everywhere.
const MIN_FACET_ANGLE: f64 = 0.3;

/// Minimum median angle, in degrees, between the faces of a low-poly model; a ball of 500 triangles has 9.
const MIN_LOW_POLY_ANGLE: f64 = 8.0;

/// Minimum correlation of the bends at both ends of an edge. Noise has a negative one, as a vertex that stands out makes
/// valleys around it; models of 350 and 1500 triangles have 0.5 and 0.35.
const MIN_BEND_CORRELATION: f64 = 0.2;

/// Returns whether the faces of a mesh are exact, so that nothing is gained by a fit: they meet in planes or along the lines
/// of bends to rounding, or they are so few that each is a face of its own, without the noise of a scan.
///
/// [`pattern_exact`](super::pattern_exact) lays such a mesh flat as it is.
pub fn has_exact_faces(mesh: &Mesh) -> bool {
    let Ok(solid) = Polyhedron::new(mesh) else {
        return false;
    };
    let hinges: Vec<u32> = inner_sides(&solid).collect();
    let mut angles: Vec<f64> = hinges
        .iter()
        .map(|side| solid.angle(*side).abs().to_degrees())
        .collect();
    angles.sort_by(f64::total_cmp);
    let (Some(tenth), Some(median)) = (angles.get(angles.len() / 10), angles.get(angles.len() / 2))
    else {
        return true;
    };
    let inner = solid.twins.iter().filter(|twin| **twin != NO_INDEX).count() / 2;
    let flat = 1.0 - hinges.len() as f64 / inner as f64;
    let steps = bend_steps(&solid);
    let share = |is_wanted: &dyn Fn(usize) -> bool| {
        (0..steps.len()).filter(|facet| is_wanted(*facet)).count() as f64 / steps.len() as f64
    };
    let strips = share(&|facet| steps[facet].len() == 2);
    let irregular = share(&|facet| steps[facet].len() > 2);
    *tenth >= MIN_FACET_ANGLE
        && (strips >= MIN_STRIP_SHARE
            || (flat >= MIN_FLAT_SHARE && irregular < 1.0 - MIN_STRIP_SHARE)
            || (*median >= MIN_LOW_POLY_ANGLE
                && bend_correlation(&solid, &hinges) >= MIN_BEND_CORRELATION))
}

/// Correlation, about 0, of the bends at both ends of an edge: angles times lengths of the edges at a vertex.
fn bend_correlation(solid: &Polyhedron, hinges: &[u32]) -> f64 {
    let mut bends = vec![0.0; solid.places.len()];
    for side in hinges {
        let [a, b] = solid.ends(*side);
        let bend = solid.angle(*side) * (b - a).norm();
        half_edge_ends(&solid.triangles, *side)
            .iter()
            .for_each(|v| bends[*v as usize] += bend);
    }
    let (mut products, mut squares) = (0.0, 0.0);
    for side in hinges {
        let [a, b] = half_edge_ends(&solid.triangles, *side).map(|v| bends[v as usize]);
        products += a * b;
        squares += 0.5 * (a * a + b * b);
    }
    products / squares
}

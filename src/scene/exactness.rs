//! Tells meshes with exact faces from scans and from smooth surfaces.

use super::half_edges::half_edge_ends;
use super::mesh::Mesh;
use super::polyhedron::Polyhedron;
use crate::math::index::NO_INDEX;

/// Minimum share of the facets that are strips of bends, and maximum share of those that are neither strips nor faces. Of
/// triangles with noise, however steep, less than half have two neighbours at small angles.
const MIN_STRIP_SHARE: f64 = 0.5;

/// Minimum correlation of the bends at both ends of an edge. What noise lifts makes valleys around it: a scan with noise has
/// 0.14 or less, one of whole heights 0.02; parts of CAD have 0.65 or more, models of 350 and 1500 triangles 0.5 and 0.35.
const MIN_BEND_CORRELATION: f64 = 0.25;

/// Minimum share of all inner edges that are flat to rounding: faces of CAD have one for each triangle beside the first.
const MIN_FLAT_SHARE: f64 = 0.25;

/// Minimum angle, in degrees, between all neighbouring facets but a tenth: a smooth surface has smaller ones everywhere.
const MIN_FACET_ANGLE: f64 = 0.3;

/// Minimum median angle, in degrees, between the faces of a low-poly model; a ball of 500 triangles has 9.
const MIN_LOW_POLY_ANGLE: f64 = 8.0;

/// Minimum share of the area of a mesh without noise that lies in planes of several triangles.
const MIN_PLANAR_SHARE: f64 = 0.5;

/// The part of a mesh that is exact, so that nothing is gained by a fit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Exactness {
    /// The faces: the mesh is made of strips that bend, or its vertices have no noise and its faces are planes of several
    /// triangles, or so few that each is a face of its own. [`pattern_exact`](crate::pattern::pattern_exact) lays such a mesh
    /// flat as it is.
    Faces,
    /// The vertices, though the faces may be those of a smooth surface: half of the area lies in planes of several triangles to
    /// rounding, and bends are alike at neighbours.
    Vertices,
    /// Nothing: the vertices have noise, or may have.
    None,
}

impl Exactness {
    /// Tells which part of a mesh is exact. Costs `O(triangles · log(triangles))`.
    pub fn of(mesh: &Mesh) -> Exactness {
        match Polyhedron::new(mesh) {
            Ok(solid) if are_faces_exact(&solid) => Exactness::Faces,
            Ok(solid) if are_vertices_exact(&solid) => Exactness::Vertices,
            _ => Exactness::None,
        }
    }
}

impl Mesh {
    /// Whether the vertices of the mesh have no noise, so that nothing is gained by a fit: see [`Exactness`]. Costs
    /// `O(triangles · log(triangles))`.
    pub fn is_exact(&self) -> bool {
        Exactness::of(self) != Exactness::None
    }
}

fn are_faces_exact(solid: &Polyhedron) -> bool {
    let hinges: Vec<u32> = solid.inner_sides().collect();
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
    let steps = solid.bend_steps();
    let share = |is_wanted: &dyn Fn(usize) -> bool| {
        (0..steps.len()).filter(|facet| is_wanted(*facet)).count() as f64 / steps.len() as f64
    };
    let strips = share(&|facet| steps[facet].len() == 2);
    let irregular = share(&|facet| steps[facet].len() > 2);
    let has_faces = (flat >= MIN_FLAT_SHARE && irregular < 1.0 - MIN_STRIP_SHARE)
        || *median >= MIN_LOW_POLY_ANGLE;
    strips >= MIN_STRIP_SHARE
        || (*tenth >= MIN_FACET_ANGLE
            && has_faces
            && bend_correlation(solid, &hinges) >= MIN_BEND_CORRELATION)
}

fn are_vertices_exact(solid: &Polyhedron) -> bool {
    let mut counts = vec![0; solid.areas.len()];
    (solid.facets.iter()).for_each(|facet| counts[*facet as usize] += 1);
    let planar = counts
        .iter()
        .zip(&solid.areas)
        .filter(|(count, _)| **count > 1);
    let planar: f64 = planar.map(|(_, area)| area).sum();
    let hinges: Vec<u32> = solid.inner_sides().collect();
    planar >= MIN_PLANAR_SHARE * solid.areas.iter().sum::<f64>()
        && (hinges.is_empty() || bend_correlation(solid, &hinges) >= MIN_BEND_CORRELATION)
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

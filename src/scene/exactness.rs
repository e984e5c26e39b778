//! Tells meshes with exact faces from scans and from smooth surfaces.

use super::half_edges::half_edge_ends;
use super::mesh::Mesh;
use super::polyhedron::Polyhedron;
use crate::math::statistics::median;

/// Minimum share of the facets that are strips of bends, and maximum share of those that are neither strips nor faces. Of
/// triangles with noise, however steep, less than half have two neighbours at small angles (`benches/exactness.md`).
const MIN_STRIP_SHARE: f64 = 0.5;

/// Minimum share of the edges whose ends bend the same way, less that of the others: what noise lifts makes valleys around it
/// (`benches/exactness.md`).
const MIN_ALIKE_SHARE: f64 = 0.25;

/// Minimum median angle, in degrees, between the faces of a low-poly model; a ball of 500 triangles has 9 (`benches/exactness.md`).
const MIN_LOW_POLY_ANGLE: f64 = 8.0;

/// Maximum number of faces of a model that is built face by face, however little these fold: a ball of as many folds by 9
/// degrees at each edge, other surfaces by less (`benches/exactness.md`).
pub const MAX_FEW_FACES: usize = 500;

/// Minimum share of the area of a mesh without noise that lies in planes of several triangles (`benches/exactness.md`).
const MIN_PLANAR_SHARE: f64 = 0.15;

/// Minimum number of edges between the triangles of a plane that counts whole; planes of fewer, in which triangles of a scan lie by
/// chance, count by their number (`benches/exactness.md`).
const FULL_PLANE_EDGES: f64 = 5.0;

/// The part of a mesh that is exact, so that nothing is gained by a fit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Exactness {
    /// The faces: the mesh is made of strips that bend, or its vertices have no noise and its faces are planes of several
    /// triangles, or meet at large angles. [`pattern_exact`](crate::pattern::pattern_exact) lays such a mesh flat as it is.
    Faces,
    /// The vertices, though the faces may be those of a smooth surface: a part of the area lies in planes of several triangles to
    /// rounding, and bends are alike at neighbours.
    Vertices,
    /// Nothing: the vertices have noise, or may have.
    None,
}

impl Exactness {
    /// Tells which part of a mesh is exact. Costs `O(triangles · log(triangles))`.
    pub fn of(mesh: &Mesh) -> Exactness {
        Polyhedron::new(mesh).map_or(Exactness::None, |solid| Exactness::of_solid(&solid))
    }

    /// Tells which part of a mesh is exact by its facets.
    pub(crate) fn of_solid(solid: &Polyhedron) -> Exactness {
        if are_faces_exact(solid) {
            Exactness::Faces
        } else if are_vertices_exact(solid) {
            Exactness::Vertices
        } else {
            Exactness::None
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
    let mut angles: Vec<f64> = (solid.inner_sides())
        .map(|side| solid.angle(side).abs().to_degrees())
        .collect();
    let Some(median) = median(&mut angles) else {
        return true;
    };
    let steps = solid.bend_steps();
    let share = |is_wanted: &dyn Fn(usize) -> bool| {
        (0..steps.len()).filter(|facet| is_wanted(*facet)).count() as f64 / steps.len() as f64
    };
    let strips = share(&|facet| steps[facet].len() == 2);
    let irregular = share(&|facet| steps[facet].len() > 2);
    let has_faces = irregular < 1.0 - MIN_STRIP_SHARE || median >= MIN_LOW_POLY_ANGLE;
    strips >= MIN_STRIP_SHARE || (has_faces && has_no_noise(solid))
}

/// Whether a mesh has so few faces that whoever asks for its pattern means each of them. Noise in so few would not be told from shape,
/// and is removed by a fit if that is asked for.
pub(crate) fn has_few_faces(solid: &Polyhedron) -> bool {
    solid.normals.len() <= MAX_FEW_FACES
}

fn are_vertices_exact(solid: &Polyhedron) -> bool {
    let mut counts = vec![0.0; solid.areas.len()];
    (solid.facets.iter()).for_each(|facet| counts[*facet as usize] += 1.0);
    let of_plane = |(count, area): (&f64, &f64)| area * ((count - 1.0) / FULL_PLANE_EDGES).min(1.0);
    let planar: f64 = counts.iter().zip(&solid.areas).map(of_plane).sum();
    planar >= MIN_PLANAR_SHARE * solid.areas.iter().sum::<f64>() && has_no_noise(solid)
}

/// Whether vertices bend the way that their neighbours do, more than noise would let them and the number of edges leave to chance.
/// The bend of a vertex is the sum of angles times lengths of the edges there.
fn has_no_noise(solid: &Polyhedron) -> bool {
    let hinges: Vec<u32> = solid.inner_sides().collect();
    let mut bends = vec![0.0; solid.places.len()];
    for side in &hinges {
        let [a, b] = solid.ends(*side);
        let bend = solid.angle(*side) * (b - a).norm();
        half_edge_ends(&solid.triangles, *side)
            .iter()
            .for_each(|v| bends[*v as usize] += bend);
    }
    let is_alike = |side: &&u32| {
        let [a, b] = half_edge_ends(&solid.triangles, **side).map(|v| bends[v as usize]);
        a * b > 0.0
    };
    let count = hinges.len() as f64;
    let alike = hinges.iter().filter(is_alike).count() as f64;
    2.0 * alike - count >= MIN_ALIKE_SHARE * count - count.sqrt()
}

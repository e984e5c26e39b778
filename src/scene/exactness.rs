//! Tells meshes with exact faces from scans and from smooth surfaces.

use super::half_edges::half_edge_ends;
use super::mesh::Mesh;
use super::polyhedron::Polyhedron;

/// Minimum share of the facets that are strips of bends, and maximum share of those that are neither strips nor faces. Of
/// triangles with noise, however steep, less than half have two neighbours at small angles.
const MIN_STRIP_SHARE: f64 = 0.5;

/// Minimum agreement of the bends at both ends of an edge, from −1 to 1: what noise lifts makes valleys around it. Spheres, roofs
/// and cylinders of 4,000 triangles with noise of a tenth of an edge or more have 0.33 or less; of 17 models without noise a
/// saddle of 128 triangles has 0.46, a cow 0.66, and the others 0.77 or more; a saddle of 20,000 has 0.38.
const MIN_BEND_AGREEMENT: f64 = 0.4;

/// Minimum angle, in degrees, between all neighbouring facets but a tenth: a smooth surface has smaller ones everywhere.
const MIN_FACET_ANGLE: f64 = 0.3;

/// Minimum median angle, in degrees, between the faces of a low-poly model of more than [`MAX_FEW_TRIANGLES`]; a ball of 500
/// triangles has 9.
const MIN_LOW_POLY_ANGLE: f64 = 8.0;

/// Number of triangles up to which each is one that was meant: a ball of as many has [`MIN_LOW_POLY_ANGLE`], other surfaces less.
const MAX_FEW_TRIANGLES: usize = 500;

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
    /// rounding, or there are few triangles, and bends are alike at neighbours.
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
    let steps = solid.bend_steps();
    let share = |is_wanted: &dyn Fn(usize) -> bool| {
        (0..steps.len()).filter(|facet| is_wanted(*facet)).count() as f64 / steps.len() as f64
    };
    let strips = share(&|facet| steps[facet].len() == 2);
    let irregular = share(&|facet| steps[facet].len() > 2);
    let has_faces = irregular < 1.0 - MIN_STRIP_SHARE || *median >= MIN_LOW_POLY_ANGLE;
    strips >= MIN_STRIP_SHARE
        || (*tenth >= MIN_FACET_ANGLE
            && has_faces
            && bend_agreement(solid, &hinges) >= MIN_BEND_AGREEMENT)
}

/// Whether triangles without noise are so few that each face is one that was meant.
pub(crate) fn are_few(triangles: &[[u32; 3]]) -> bool {
    triangles.len() <= MAX_FEW_TRIANGLES
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
    (are_few(&solid.triangles) || planar >= MIN_PLANAR_SHARE * solid.areas.iter().sum::<f64>())
        && (hinges.is_empty() || bend_agreement(solid, &hinges) >= MIN_BEND_AGREEMENT)
}

/// Agreement in sign of the bends at both ends of an edge, weighted by their product: 1 where all agree. The bend of a vertex is the
/// sum of angles times lengths of the edges there, whose number must not matter: at the tip of a cone many edges meet.
fn bend_agreement(solid: &Polyhedron, hinges: &[u32]) -> f64 {
    let mut bends = vec![0.0; solid.places.len()];
    for side in hinges {
        let [a, b] = solid.ends(*side);
        let bend = solid.angle(*side) * (b - a).norm();
        half_edge_ends(&solid.triangles, *side)
            .iter()
            .for_each(|v| bends[*v as usize] += bend);
    }
    let (mut products, mut sizes) = (0.0, 0.0);
    for side in hinges {
        let [a, b] = half_edge_ends(&solid.triangles, *side).map(|v| bends[v as usize]);
        products += a * b;
        sizes += (a * b).abs();
    }
    // Nothing bends, or all bends of a vertex cancel.
    match sizes > 0.0 {
        true => products / sizes,
        false => 1.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn vertices_of_few_faces_are_exact_however_little_these_fold() {
        // Squares of a saddle, and the same with a tenth of their size of noise.
        let saddle = |noise: f64| {
            let n = 10u32;
            let point = |i: u32| {
                let (x, y) = (f64::from(i % n), f64::from(i / n));
                let off = noise * ((f64::from(i) * 12.9898).sin() * 43758.5453).fract();
                [x, y, 0.04 * (x - 4.5) * (y - 4.5) + off]
            };
            let squares = (0..n - 1).flat_map(|j| (0..n - 1).map(move |i| j * n + i));
            let triangles = squares.flat_map(|a| [[a, a + 1, a + 11], [a, a + 11, a + 10]]);
            Exactness::of(&Mesh::new((0..n * n).map(point).collect(), triangles.collect()).unwrap())
        };
        assert_eq!(saddle(0.0), Exactness::Vertices);
        assert_eq!(saddle(0.1), Exactness::None);
    }

    #[test]
    fn an_open_pyramid_of_many_sides_is_exact() {
        let sides = 12u32;
        let mut points = vec![[0.0, 0.0, 60.0]];
        points.extend((0..sides).map(|k| {
            let (sin, cos) = (std::f64::consts::TAU * f64::from(k) / f64::from(sides)).sin_cos();
            [20.0 * cos, 20.0 * sin, 0.0]
        }));
        let triangles = (0..sides).map(|k| [0, 1 + k, 1 + (k + 1) % sides]);
        let mesh = Mesh::new(points, triangles.collect()).unwrap();
        assert_eq!(Exactness::of(&mesh), Exactness::Faces);
    }
}

//! Geometry of the vertices of a mesh: normals, areas, smoothing and folded triangles.

use nalgebra::Vector3;

use super::input::MeshInput;
use super::topology::Topology;

pub(crate) type Point = Vector3<f64>;

/// Share of the way to the mean of its neighbours that a vertex moves in one smoothing step; at 1, smoothing
/// oscillates on some meshes.
const SMOOTHING_STEP_SHARE: f64 = 0.7;

/// Minimum squared length of a hint's component across a normal; a shorter one gives no tangent direction.
const MIN_HINT_SQUARE: f64 = 1e-6;

/// An orthonormal frame at a vertex: its normal and two tangents.
#[derive(Debug, Clone)]
pub(crate) struct Frame {
    pub normal: Point,
    pub tangents: [Point; 2],
}

impl Frame {
    /// The frame with a normal whose first tangent is nearest to a hint.
    pub(crate) fn from_normal(normal: Point, hint: Point) -> Self {
        let mut along = hint - normal * normal.dot(&hint);
        if along.norm_squared() < MIN_HINT_SQUARE {
            let least = normal.iamin();
            along = Point::ith(least, 1.0) - normal * normal[least];
        }
        let along = along.normalize();
        Frame {
            normal,
            tangents: [along, normal.cross(&along)],
        }
    }

    /// Coordinates of a vector along both tangents and the normal.
    pub(crate) fn coordinates(&self, v: Point) -> [f64; 3] {
        let [t1, t2] = &self.tangents;
        [v.dot(t1), v.dot(t2), v.dot(&self.normal)]
    }
}

/// Unit normals of vertices, weighted by the areas of their triangles; where these cancel, that of the `old`
/// ones.
pub(crate) fn normals(topology: &Topology, x: &[Point], old: Option<&[Point]>) -> Vec<Point> {
    let mut sums = vec![Point::zeros(); x.len()];
    for triangle in &topology.triangles {
        let area = twice_area(x, triangle);
        for corner in triangle {
            sums[*corner as usize] += area;
        }
    }
    for (vertex, sum) in sums.iter_mut().enumerate() {
        let size = sum.norm();
        *sum = match size > 0.0 && size.is_finite() {
            true => *sum / size,
            false => old.map_or(Point::z(), |old| old[vertex]),
        };
    }
    sums
}

/// Normal of a triangle times twice its area.
pub(super) fn twice_area(x: &[Point], triangle: &[u32; 3]) -> Point {
    let [a, b, c] = triangle.map(|i| x[i as usize]);
    (b - a).cross(&(c - a))
}

/// Area of each vertex: a third of those of its triangles.
pub(super) fn areas(topology: &Topology, x: &[Point]) -> Vec<f64> {
    let mut areas = vec![0.0; x.len()];
    for triangle in &topology.triangles {
        let area = twice_area(x, triangle).norm() / 6.0;
        for corner in triangle {
            areas[*corner as usize] += area;
        }
    }
    areas
}

/// Volume that the surface encloses.
pub(super) fn volume(topology: &Topology, x: &[Point]) -> f64 {
    let tetrahedra = topology.triangles.iter();
    tetrahedra
        .map(|t| x[t[0] as usize].dot(&twice_area(x, t)) / 6.0)
        .sum()
}

/// Moves each vertex towards the mean of its neighbours (the umbrella operator), and vertices on the border
/// towards that of their neighbours along it.
pub(super) fn smooth(topology: &Topology, x: &mut [Point], steps: usize) {
    let mut old = x.to_vec();
    for _ in 0..steps {
        old.copy_from_slice(x);
        for (vertex, x) in x.iter_mut().enumerate() {
            let (mut sum, mut count) = (Point::zeros(), 0.0);
            if topology.inside[vertex] {
                for other in topology.around(vertex) {
                    sum += old[*other as usize];
                    count += 1.0;
                }
            } else {
                for other in topology.along_rim(vertex) {
                    sum += old[other];
                    count += 1.0;
                }
                // Corners, and places where borders meet, stay.
                if count != 2.0 {
                    continue;
                }
            }
            *x += SMOOTHING_STEP_SHARE * (sum / count - old[vertex]);
        }
    }
}

/// Whether a triangle faces away from the normals `up` of its corners.
pub(super) fn faces_away(x: &[Point], up: &[Point], triangle: &[u32; 3]) -> bool {
    let sum: Point = triangle.iter().map(|i| up[*i as usize]).sum();
    twice_area(x, triangle).dot(&sum) < 0.0
}

/// Maximum number of steps in which folded triangles are laid flat.
const MAX_UNFOLDING_STEPS: usize = 40;

/// Lays triangles flat that face away from the normals of their corners: moves their vertices towards the mean
/// of their neighbours, along the surface and within their reach. Vertices that are held stay.
pub(super) fn unfold(given: &MeshInput, x: &mut [Point], up: &[Point]) {
    let topology = &given.topology;
    let mut folded = vec![false; x.len()];
    let mut moved = vec![true; x.len()];
    for _ in 0..MAX_UNFOLDING_STEPS {
        folded.fill(false);
        let mut any = false;
        for triangle in &topology.triangles {
            // Triangles whose vertices stayed face as before.
            let may = triangle.iter().any(|i| moved[*i as usize]);
            if may && faces_away(x, up, triangle) {
                any = true;
                for corner in triangle {
                    folded[*corner as usize] = true;
                }
            }
        }
        if !any {
            return;
        }
        moved.copy_from_slice(&folded);
        for vertex in 0..x.len() {
            let ring = topology.around(vertex);
            // A vertex with one triangle only moves to the other side of its neighbours.
            let share = match (topology.inside[vertex], ring.len()) {
                (true, _) => 0.5,
                (false, 2) => 1.5,
                _ => continue,
            };
            if !folded[vertex] || given.held[vertex] {
                continue;
            }
            let sum: Point = ring.iter().map(|other| x[*other as usize]).sum();
            let towards = sum / ring.len() as f64 - x[vertex];
            let step = share * (towards - up[vertex] * up[vertex].dot(&towards));
            x[vertex] = given.within_reach(vertex, x[vertex] + step);
        }
    }
}

/// Points whose coordinate along each ray is that of `x`, and whose coordinates perpendicular to it are those of
/// `places`.
pub(super) fn across(x: &[Point], places: &[Point], rays: &[Point]) -> Vec<Point> {
    let all = x.iter().zip(places).zip(rays);
    all.map(|((x, place), ray)| place + ray * ray.dot(&(x - place)))
        .collect()
}

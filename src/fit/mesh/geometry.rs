//! Geometry of the vertices of a mesh: normals, areas, smoothing and folded triangles.

use nalgebra::Vector3;

use super::topology::Topology;

pub(crate) type Point = Vector3<f64>;

/// Share of the way to the mean of its neighbours that a vertex, or a value there, moves in one smoothing step; at 1, smoothing
/// oscillates on some meshes (`benches/whole.md`).
pub(super) const SMOOTHING_STEP_SHARE: f64 = 0.7;

/// Minimum squared length of a hint's component across a frame's normal; a shorter one gives no tangent direction.
const MIN_HINT_SQUARE: f64 = 1e-6;

/// An orthonormal frame at a vertex: its normal and two tangents.
#[derive(Debug, Clone)]
pub(crate) struct Frame {
    pub normal: Point,
    pub tangents: [Point; 2],
}

impl Frame {
    /// Makes the frame with a unit normal whose first tangent is nearest to the direction `hint`.
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

    /// Returns a vector's coordinates along both tangents and the normal of the frame.
    pub(crate) fn coordinates(&self, v: Point) -> [f64; 3] {
        let [t1, t2] = &self.tangents;
        [v.dot(t1), v.dot(t2), v.dot(&self.normal)]
    }
}

/// Computes the unit normal of each vertex: the mean of its triangles' normals, weighted by their areas; where these
/// cancel, the vertex's normal in `old`.
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

/// Returns the normal of a triangle, with twice the triangle's area as its length.
pub(super) fn twice_area(x: &[Point], [a, b, c]: &[u32; 3]) -> Point {
    let [a, b, c] = [&x[*a as usize], &x[*b as usize], &x[*c as usize]];
    (b - a).cross(&(c - a))
}

/// Computes the area of each vertex: a third of the areas of its triangles.
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

/// Computes the volume that a closed surface encloses.
pub(super) fn volume(topology: &Topology, x: &[Point]) -> f64 {
    let tetrahedra = topology.triangles.iter();
    tetrahedra
        .map(|t| x[t[0] as usize].dot(&twice_area(x, t)) / 6.0)
        .sum()
}

/// Smooths a surface: moves each vertex towards the mean of its neighbours (the umbrella operator), and each border
/// vertex towards the mean of its two neighbours along the border.
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

/// Returns whether a triangle faces away from the vertex normals `up` of its corners.
pub(super) fn faces_away(x: &[Point], up: &[Point], triangle: &[u32; 3]) -> bool {
    let sum: Point = triangle.iter().map(|i| up[*i as usize]).sum();
    twice_area(x, triangle).dot(&sum) < 0.0
}

/// Combines two sets of points: the result has the coordinate of `x` along each ray, and the coordinates of `places`
/// perpendicular to the ray.
pub(super) fn across(x: &[Point], places: &[Point], rays: &[Point]) -> Vec<Point> {
    let all = x.iter().zip(places).zip(rays);
    all.map(|((x, place), ray)| place + ray * ray.dot(&(x - place)))
        .collect()
}

//! Triangles that are turned over, turned back by the smallest moves along the surface.

use super::geometry::{Point, faces_away, twice_area};
use super::input::MeshInput;
use super::topology::Topology;

/// Maximum number of steps in which folded triangles are laid flat (`benches/whole.md`).
const MAX_UNFOLDING_STEPS: usize = 40;

/// Maximum number of rounds over the triangles that are turned over (`benches/whole.md`).
const MAX_TURNING_ROUNDS: usize = 200;

/// Height of a triangle that has been turned back, as a share of its longest side: flatter than any triangle that
/// matters.
const TURNED_BACK_HEIGHT_SHARE: f64 = 1e-3;

/// Minimum cosine of the angle between a triangle and the flat surface around it; less at a sharp edge. The normals of a
/// noisy surface are wrong by some degrees, so that a triangle which stands steeper counts as turned over
/// (`benches/irregular.md`).
const MIN_TRIANGLE_COSINE: f64 = 0.2;

/// Ratio of the area seen along the normals that a triangle is given to the area at which it counts as turned over, so
/// that rounding leaves it on the right side.
const TURNED_BACK_MARGIN: f64 = 1.1;

/// Turns triangles back that face away from the surface around them, or stand steep on it, and returns whether there were
/// any. Their corners move along the surface and within their reach; those that are held stay. Normals are at first those
/// over two rings, so that few small triangles which are turned over together do not decide, then those over one. Costs
/// `O(triangles)`, and in each round what has moved.
pub(super) fn turn_back(given: &MeshInput, x: &mut [Point]) -> bool {
    let topology = &given.topology;
    let mut found = false;
    for is_wide in [true, false] {
        let mut normals = MeanNormals::new(topology, x, is_wide);
        let mut is_due = vec![true; topology.triangles.len()];
        for _ in 0..MAX_TURNING_ROUNDS {
            let mut moved = Vec::new();
            for (triangle, corners) in topology.triangles.iter().enumerate() {
                if !std::mem::take(&mut is_due[triangle]) {
                    continue;
                }
                let before = corners.map(|corner| x[corner as usize]);
                found |= raise(given, x, &normals.up, corners);
                for (corner, before) in corners.iter().zip(before) {
                    if x[*corner as usize] != before {
                        moved.push(*corner);
                        let own = topology.triangles_around(*corner as usize).iter();
                        own.for_each(|other| is_due[*other as usize] = true);
                    }
                }
            }
            if moved.is_empty() {
                break;
            }
            for vertex in normals.update(topology, x, moved) {
                let own = topology.triangles_around(vertex as usize).iter();
                own.for_each(|other| is_due[*other as usize] = true);
            }
        }
    }
    found
}

/// Mean unit normals of the triangles around each vertex, weighted by area, over one ring or two: their length is 1 on a
/// plane and small on a sharp edge.
pub(super) struct MeanNormals {
    pub up: Vec<Point>,
    is_wide: bool,
    /// Sums of the normals, with twice the areas as lengths, and of these lengths, over the triangles around each vertex.
    sums: Vec<(Point, f64)>,
}

impl MeanNormals {
    pub(super) fn new(topology: &Topology, x: &[Point], is_wide: bool) -> Self {
        let mut normals = MeanNormals {
            up: vec![Point::zeros(); x.len()],
            is_wide,
            sums: vec![(Point::zeros(), 0.0); x.len()],
        };
        normals.update(topology, x, (0..x.len() as u32).collect());
        normals
    }

    /// Computes those anew that depend on vertices that have moved, and returns where they do.
    fn update(&mut self, topology: &Topology, x: &[Point], moved: Vec<u32>) -> Vec<u32> {
        let near = topology.within_rings(moved, 1);
        for vertex in &near {
            let own = topology.triangles_around(*vertex as usize).iter();
            let sides = own.map(|t| twice_area(x, &topology.triangles[*t as usize]));
            self.sums[*vertex as usize] = sides.fold((Point::zeros(), 0.0), |(sum, size), side| {
                (sum + side, size + side.norm())
            });
        }
        let stale = topology.within_rings(near, usize::from(self.is_wide));
        for vertex in &stale {
            let vertex = *vertex as usize;
            let ring = topology.around(vertex).iter().filter(|_| self.is_wide);
            let (sum, size) = ring.fold(self.sums[vertex], |(sum, size), other| {
                let (more, area) = self.sums[*other as usize];
                (sum + more, size + area)
            });
            self.up[vertex] = if size > 0.0 { sum / size } else { sum };
        }
        stale
    }
}

/// Moves the corners of a triangle that is turned over, as seen along the normals `up`, until it has a small area seen
/// along them: one Newton step in the direction of that area's gradient. Returns whether it was turned over.
fn raise(given: &MeshInput, x: &mut [Point], up: &[Point], triangle: &[u32; 3]) -> bool {
    let mean = triangle.iter().map(|i| up[*i as usize]).sum::<Point>() / 3.0;
    let Some(normal) = mean.try_normalize(0.0) else {
        return false;
    };
    let own = twice_area(x, triangle);
    let (seen, least) = (
        own.dot(&normal),
        MIN_TRIANGLE_COSINE * mean.norm() * own.norm(),
    );
    let corners = triangle.map(|i| x[i as usize]);
    let opposite = [0, 1, 2].map(|k| corners[(k + 2) % 3] - corners[(k + 1) % 3]);
    let gradients = opposite.map(|side| normal.cross(&side));
    let free = triangle.map(|i| !given.held[i as usize]);
    let squares: f64 = (gradients.iter().zip(free))
        .map(|(gradient, free)| if free { gradient.norm_squared() } else { 0.0 })
        .sum();
    if seen > 0.0 && seen >= least || squares == 0.0 {
        return false;
    }
    let longest = opposite.iter().map(|side| side.norm_squared());
    let longest = longest.fold(0.0, f64::max);
    let wanted = (TURNED_BACK_HEIGHT_SHARE * longest).max(TURNED_BACK_MARGIN * least);
    for ((vertex, gradient), free) in triangle.iter().zip(gradients).zip(free) {
        if free {
            let vertex = *vertex as usize;
            let moved = x[vertex] + gradient * ((wanted - seen) / squares);
            x[vertex] = given.within_reach_across(vertex, moved, &normal);
        }
    }
    true
}

/// Lays folded triangles flat, which face away from the vertex normals `up` of their corners: moves their vertices
/// towards the mean of the neighbours, along the surface and within their reach. Vertices that are held stay.
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
            x[vertex] = given.within_reach_across(vertex, x[vertex] + step, &up[vertex]);
        }
    }
}

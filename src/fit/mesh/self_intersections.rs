//! Removal of self-intersections of a mesh: triangles that cross others near them, or are folded over, are separated.
//!
//! Vertices can pass each other where their rays converge, as along creases in coarse noise. The triangles between
//! them then turn over together, so that their normals do not show it. Parts of a surface that intersect far from
//! each other along it, as two bodies that overlap, are left as they are.

use super::geometry::{Point, twice_area};
use super::input::MeshInput;
use super::orientation::MeanNormals;
use super::topology::Topology;

/// Minimum cosine of the angle between the normals of a triangle and of its vertex at which the triangles around that
/// vertex are assumed not to cross others.
const MIN_NORMAL_COSINE: f64 = 0.5;

/// Number of rings around a triangle whose triangles are tested for crossing it (`benches/whole.md`).
const CROSSING_SEARCH_RINGS: usize = 3;

/// Maximum number of rounds in which crossing triangles are separated (`benches/whole.md`).
const MAX_MENDING_ROUNDS: usize = 60;

/// Maximum number of visits to vertices in the search for crossing triangles, per vertex of the mesh: bounds the time
/// on a mesh that intersects itself everywhere.
const MAX_VISITS_PER_VERTEX: usize = 4;

/// Number of visits to vertices in the search for crossing triangles that are allowed on any mesh in addition to those
/// per vertex, so that small meshes are mended completely.
const EXTRA_VISITS: usize = 100_000;

/// Number of rounds of separating triangles after which the neighbours of moved vertices are moved, too (`benches/whole.md`).
const WIDENING_ROUNDS: usize = 10;

/// Separates crossing triangles and turns folded ones back: moves their vertices along the surface towards the mean of
/// their neighbours, those on creases along these first, and all within their reach. Vertices that are held stay.
pub(super) fn separate_self_intersections(
    given: &MeshInput,
    x: &mut [Point],
    creased: &dyn Fn(usize) -> bool,
) {
    let topology = &given.topology;
    let mut bad = all_entangled(given, x);
    let mut up = MeanNormals::new(topology, x, true).up;
    up.iter_mut()
        .for_each(|up| *up = up.try_normalize(0.0).unwrap_or_default());
    let mut left = MAX_VISITS_PER_VERTEX * topology.len() + EXTRA_VISITS;
    let mut moving: Vec<u32> = Vec::new();
    for round in 0..MAX_MENDING_ROUNDS {
        if bad.is_empty() || left == 0 {
            return;
        }
        moving.clear();
        for triangle in &bad {
            moving.extend(topology.triangles[*triangle as usize]);
        }
        if round % WIDENING_ROUNDS == WIDENING_ROUNDS - 1 {
            moving = topology.within_rings(moving, 1);
        }
        moving.sort_unstable();
        moving.dedup();
        for &vertex in &moving {
            let vertex = vertex as usize;
            if given.held[vertex] {
                continue;
            }
            let along = round < WIDENING_ROUNDS && creased(vertex);
            let beside = mean_beside(topology, x, vertex, along.then_some(creased));
            if let Some(mean) = beside {
                let mut step = 0.5 * (mean - x[vertex]);
                if !creased(vertex) {
                    step -= up[vertex] * up[vertex].dot(&step);
                }
                x[vertex] = given.within_reach_across(vertex, x[vertex] + step, &up[vertex]);
            }
        }
        let near = topology.within_rings(moving.clone(), CROSSING_SEARCH_RINGS);
        left = left.saturating_sub(near.len());
        bad = entangled_triangles(topology, x, &near);
    }
}

/// Finds the triangles of the surface that cross others near them or are folded over.
pub(super) fn all_entangled(given: &MeshInput, x: &[Point]) -> Vec<u32> {
    let all: Vec<u32> = (0..given.topology.len() as u32).collect();
    entangled_triangles(&given.topology, x, &all)
}

/// Returns the mean of a vertex's neighbours: of the two along the border, or of the two along a line of `creased`
/// vertices, or of all.
fn mean_beside(
    topology: &Topology,
    x: &[Point],
    vertex: usize,
    creased: Option<&dyn Fn(usize) -> bool>,
) -> Option<Point> {
    let ring = topology.around(vertex);
    let mean_of = |of: &dyn Fn(usize) -> bool| {
        let (mut sum, mut count) = (Point::zeros(), 0);
        for other in ring.iter().map(|i| *i as usize).filter(|i| of(*i)) {
            sum += x[other];
            count += 1;
        }
        (sum / f64::from(count), count)
    };
    if !topology.inside[vertex] {
        let beside = |other| topology.along_rim(vertex).any(|i| i == other);
        return Some(mean_of(&beside))
            .filter(|(_, count)| *count == 2)
            .map(|(mean, _)| mean);
    }
    let along = creased.map(mean_of).filter(|(_, count)| *count == 2);
    Some(along.unwrap_or_else(|| mean_of(&|_| true)).0)
}

/// Finds the triangles at the given vertices that cross a triangle near them, the triangles that they cross, and those
/// that face away from the normals of their corners.
fn entangled_triangles(topology: &Topology, x: &[Point], vertices: &[u32]) -> Vec<u32> {
    let triangles = &topology.triangles;
    let mut bad = Vec::new();
    let mut suspects = Vec::new();
    for vertex in vertices {
        let own = topology.triangles_around(*vertex as usize);
        let sides = own.iter().map(|t| twice_area(x, &triangles[*t as usize]));
        let up = sides.clone().sum::<Point>();
        if sides
            .clone()
            .any(|side| side.dot(&up) <= MIN_NORMAL_COSINE * side.norm() * up.norm())
        {
            suspects.extend(own);
        }
    }
    suspects.sort_unstable();
    suspects.dedup();
    let up = |vertex: &u32| {
        let own = topology.triangles_around(*vertex as usize).iter();
        let sum: Point = own.map(|t| twice_area(x, &triangles[*t as usize])).sum();
        sum.try_normalize(0.0).unwrap_or_default()
    };
    // Number of the last suspect that each vertex, and each triangle, was met from.
    let mut met = [topology.len(), triangles.len()].map(|count| vec![0u32; count]);
    let [vertices_met, triangles_met] = &mut met;
    for (number, &triangle) in (1..).zip(&suspects) {
        let corners = &triangles[triangle as usize];
        if twice_area(x, corners).dot(&corners.iter().map(up).sum()) < 0.0 {
            bad.push(triangle);
        }
        let mut near = corners.to_vec();
        for corner in corners {
            vertices_met[*corner as usize] = number;
        }
        let bounds = bounds(x, corners);
        let mut begin = 0;
        for _ in 1..CROSSING_SEARCH_RINGS {
            let end = near.len();
            for place in begin..end {
                for vertex in topology.around(near[place] as usize) {
                    if std::mem::replace(&mut vertices_met[*vertex as usize], number) != number {
                        near.push(*vertex);
                    }
                }
            }
            begin = end;
        }
        for other in near
            .iter()
            .flat_map(|vertex| topology.triangles_around(*vertex as usize))
        {
            let is_new = std::mem::replace(&mut triangles_met[*other as usize], number) != number;
            let other_corners = &triangles[*other as usize];
            if is_new && overlap(&bounds, x, other_corners) && cross(x, corners, other_corners) {
                bad.extend([triangle, *other]);
            }
        }
    }
    bad.sort_unstable();
    bad.dedup();
    bad
}

/// Smallest and largest coordinates of a triangle's corners.
fn bounds(x: &[Point], [a, b, c]: &[u32; 3]) -> [Point; 2] {
    let [a, b, c] = [&x[*a as usize], &x[*b as usize], &x[*c as usize]];
    [a.inf(b).inf(c), a.sup(b).sup(c)]
}

/// Returns whether the bounds of a triangle overlap others.
fn overlap([low, high]: &[Point; 2], x: &[Point], triangle: &[u32; 3]) -> bool {
    let [other_low, other_high] = bounds(x, triangle);
    (0..3).all(|k| low[k] <= other_high[k] && other_low[k] <= high[k])
}

/// Returns whether an edge of one triangle passes through the other one, except edges with a corner of both.
fn cross(x: &[Point], one: &[u32; 3], other: &[u32; 3]) -> bool {
    let [a, b] = [one, other].map(|t| t.map(|i| x[i as usize]));
    let through = |one: &[u32; 3], a: &[Point; 3], other: &[u32; 3], b: &[Point; 3]| {
        (0..3).any(|k| {
            let next = (k + 1) % 3;
            !other.contains(&one[k]) && !other.contains(&one[next]) && pierces(a[k], a[next], b)
        })
    };
    through(one, &a, other, &b) || through(other, &b, one, &a)
}

/// Returns whether the segment from `p` to `q` passes through the inside of a triangle.
fn pierces(p: Point, q: Point, [a, b, c]: &[Point; 3]) -> bool {
    let normal = (b - a).cross(&(c - a));
    if normal.dot(&(p - a)) * normal.dot(&(q - a)) >= 0.0 {
        return false;
    }
    let way = q - p;
    let turn = |from: &Point, to: &Point| way.dot(&(from - p).cross(&(to - p)));
    let turns = [turn(a, b), turn(b, c), turn(c, a)];
    turns.iter().all(|t| *t > 0.0) || turns.iter().all(|t| *t < 0.0)
}

//! Meshes simplified to few triangles, by contracting edges (Garland and Heckbert 1997).

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use nalgebra::Matrix3;

use super::half_edges::half_edge_ends;
use super::polyhedron::{Place, Polyhedron};
use crate::math::index::NO_INDEX;
use crate::math::symmetric_eigen::symmetric_eigen3;

/// Minimum cosine of the angle by which a contraction may turn a triangle: less would fold it over (`benches/patterns.md`, Models of any
/// shape).
const MIN_TURN_COSINE: f64 = 0.2;

/// Directions in which squared distances from the planes grow by less than this share of the most are left to the middle of the edge
/// (`benches/patterns.md`, Models of any shape).
const MIN_EIGENVALUE_SHARE: f64 = 1e-3;

/// Weight of an edge's squared length beside squared distances from planes: where these do not differ, as in a plane, short edges come
/// first (`benches/patterns.md`, Models of any shape).
const LENGTH_WEIGHT: f64 = 1e-6;

/// A mesh with few triangles in place of another one.
pub(crate) struct Decimated {
    pub places: Vec<Place>,
    pub triangles: Vec<[u32; 3]>,
    /// Root mean square distance of the given mesh's vertices.
    pub distance: f64,
}

/// Contracts edges of a mesh, those first after which vertices are nearest to the planes of the triangles that were there before,
/// until `max_triangles` are left or none can be contracted: neither the surface's connections change, nor do triangles fold over.
/// Costs `O(triangles · log(triangles))`.
pub(crate) fn decimate(solid: &Polyhedron, max_triangles: usize) -> Decimated {
    let mut left = Contraction::new(solid);
    let mut queue: BinaryHeap<Reverse<Candidate>> = (0u32..)
        .zip(&solid.twins)
        .filter(|(side, twin)| **twin == NO_INDEX || side < *twin)
        .map(|(side, _)| Reverse(left.candidate(half_edge_ends(&solid.triangles, side))))
        .collect();
    while left.count > max_triangles
        && let Some(Reverse((_, ends, ages))) = queue.pop()
    {
        if left.ages_of(ends) != ages {
            continue;
        }
        let (_, place) = left.least(ends);
        if !left.may_contract(ends, place) {
            continue;
        }
        left.contract(ends, place);
        let [kept, _] = ends;
        queue.extend(
            (left.neighbours(kept).into_iter()).map(|v| Reverse(left.candidate([kept, v]))),
        );
    }
    left.finished(solid)
}

/// Squared distances from planes, as a function of the place: `x'Ax + 2 b'x + c`.
#[derive(Clone, Copy, Default)]
struct Quadric {
    a: Matrix3<f64>,
    b: Place,
    c: f64,
}

impl Quadric {
    /// The squared distance from a plane through a place.
    fn of_plane(normal: Place, through: &Place, weight: f64) -> Quadric {
        let offset = -normal.dot(through);
        Quadric {
            a: weight * normal * normal.transpose(),
            b: weight * offset * normal,
            c: weight * offset * offset,
        }
    }

    /// The place where it is least; where several are, that nearest to `start`.
    fn least(&self, start: Place) -> Place {
        let slope = self.a * start + self.b;
        let axes = symmetric_eigen3(self.a);
        let least = MIN_EIGENVALUE_SHARE
            * axes
                .map(|(growth, _)| growth)
                .into_iter()
                .fold(0.0, f64::max);
        axes.iter()
            .filter(|(growth, _)| *growth > least)
            .fold(start, |place, (growth, along)| {
                place - along * (along.dot(&slope) / growth)
            })
    }

    fn plus(&self, other: &Quadric) -> Quadric {
        Quadric {
            a: self.a + other.a,
            b: self.b + other.b,
            c: self.c + other.c,
        }
    }

    fn at(&self, x: &Place) -> f64 {
        (x.dot(&(self.a * x)) + 2.0 * self.b.dot(x) + self.c).max(0.0)
    }
}

/// An edge that may be contracted: the bits of its cost, which is never below 0, so that they are in its own order; its ends; and how
/// often each end had been contracted when the cost was computed.
type Candidate = (u64, [u32; 2], [u32; 2]);

/// A mesh of which some edges have been contracted.
struct Contraction {
    /// Origin and unit of the places: others would lose digits in squares.
    middle: Place,
    unit: f64,
    places: Vec<Place>,
    triangles: Vec<[u32; 3]>,
    /// The triangles at each vertex; none at one that has become another.
    around: Vec<Vec<u32>>,
    quadrics: Vec<Quadric>,
    on_border: Vec<bool>,
    ages: Vec<u32>,
    /// The vertex that each has become, one step further.
    became: Vec<u32>,
    /// Number of triangles.
    count: usize,
}

impl Contraction {
    fn new(solid: &Polyhedron) -> Contraction {
        let n = solid.places.len();
        let middle = solid.places.iter().sum::<Place>() / n.max(1) as f64;
        let from_middle = solid.places.iter().map(|place| (place - middle).amax());
        let unit = from_middle.fold(f64::MIN_POSITIVE, f64::max);
        let mut left = Contraction {
            middle,
            unit,
            places: (solid.places.iter().map(|place| (place - middle) / unit)).collect(),
            triangles: solid.triangles.clone(),
            around: vec![Vec::new(); n],
            quadrics: vec![Quadric::default(); n],
            on_border: vec![false; n],
            ages: vec![0; n],
            became: (0..n as u32).collect(),
            count: solid.triangles.len(),
        };
        for (t, corners) in solid.triangles.iter().enumerate() {
            let normal = left.area_vector(t as u32, |v| left.place(v));
            let (upwards, area) = (normal.try_normalize(0.0).unwrap_or_default(), normal.norm());
            for (k, v) in corners.iter().enumerate() {
                left.around[*v as usize].push(t as u32);
                let at = left.place(*v);
                left.add(&[*v], Quadric::of_plane(upwards, &at, area));
                if solid.twins[3 * t + k] != NO_INDEX {
                    continue;
                }
                // A plane through the border, across the triangle, keeps the border where it is.
                let ends = [*v, corners[(k + 1) % 3]];
                let along = left.place(ends[1]) - at;
                let across = along.cross(&upwards).try_normalize(0.0).unwrap_or_default();
                left.add(&ends, Quadric::of_plane(across, &at, along.norm_squared()));
                ends.iter().for_each(|v| left.on_border[*v as usize] = true);
            }
        }
        left
    }

    fn add(&mut self, vertices: &[u32], quadric: Quadric) {
        for v in vertices {
            let own = &mut self.quadrics[*v as usize];
            *own = own.plus(&quadric);
        }
    }

    fn place(&self, vertex: u32) -> Place {
        self.places[vertex as usize]
    }

    /// Normal of a triangle with its vertices at the given places, as long as its area.
    fn area_vector(&self, triangle: u32, place: impl Fn(u32) -> Place) -> Place {
        let [a, b, c] = self.triangles[triangle as usize].map(place);
        0.5 * (b - a).cross(&(c - a))
    }

    fn neighbours(&self, vertex: u32) -> Vec<u32> {
        let corners = self.around[vertex as usize]
            .iter()
            .flat_map(|t| self.triangles[*t as usize]);
        let mut found: Vec<u32> = corners.filter(|v| *v != vertex).collect();
        found.sort_unstable();
        found.dedup();
        found
    }

    /// Cost of contracting an edge, and the place to which its ends would go.
    fn least(&self, ends: [u32; 2]) -> (f64, Place) {
        let [p, q] = ends.map(|v| self.place(v));
        let sum = self.quadrics[ends[0] as usize].plus(&self.quadrics[ends[1] as usize]);
        let place = sum.least(0.5 * (p + q));
        let length = LENGTH_WEIGHT * sum.a.trace() * (q - p).norm_squared();
        (sum.at(&place) + length, place)
    }

    fn ages_of(&self, ends: [u32; 2]) -> [u32; 2] {
        ends.map(|v| self.ages[v as usize])
    }

    fn candidate(&self, ends: [u32; 2]) -> Candidate {
        (self.least(ends).0.to_bits(), ends, self.ages_of(ends))
    }

    /// Whether the mesh stays a surface of the same connections, and no triangle folds over.
    fn may_contract(&self, ends: [u32; 2], place: Place) -> bool {
        let [a, b] = ends;
        let is_shared = |t: &&u32| self.triangles[**t as usize].contains(&b);
        let shared: Vec<u32> =
            (self.around[a as usize].iter().filter(is_shared).copied()).collect();
        let [around, others] = ends.map(|v| self.neighbours(v));
        let common = around.iter().filter(|v| others.contains(v)).count();
        let joins_borders =
            self.on_border[a as usize] && self.on_border[b as usize] && shared.len() != 1;
        let opposite = shared
            .iter()
            .flat_map(|t| self.triangles[*t as usize])
            .filter(|v| ![a, b].contains(v));
        // A vertex of three triangles, two of which vanish, would be left with one, seen from both sides.
        let is_thin = |v: u32| !self.on_border[v as usize] && self.around[v as usize].len() <= 3;
        if joins_borders
            || shared.is_empty()
            || common != shared.len()
            || opposite.clone().any(is_thin)
        {
            return false;
        }
        let moved = |v: u32| match ends.contains(&v) {
            true => place,
            false => self.place(v),
        };
        let others = ends.iter().flat_map(|v| &self.around[*v as usize]);
        others.filter(|t| !shared.contains(t)).all(|t| {
            let [before, after] = [
                self.area_vector(*t, |v| self.place(v)),
                self.area_vector(*t, moved),
            ];
            after.dot(&before) > MIN_TURN_COSINE * before.norm() * after.norm()
        })
    }

    fn contract(&mut self, ends: [u32; 2], place: Place) {
        let [kept, gone] = ends.map(|v| v as usize);
        for t in std::mem::take(&mut self.around[gone]) {
            let corners = &mut self.triangles[t as usize];
            if corners.contains(&(kept as u32)) {
                for v in *corners {
                    self.around[v as usize].retain(|other| *other != t);
                }
                self.count -= 1;
            } else {
                let place = corners.iter().position(|v| *v == gone as u32);
                place.into_iter().for_each(|k| corners[k] = kept as u32);
                self.around[kept].push(t);
            }
        }
        self.quadrics[kept] = self.quadrics[kept].plus(&self.quadrics[gone]);
        self.on_border[kept] |= self.on_border[gone];
        self.places[kept] = place;
        self.ages[kept] += 1;
        self.ages[gone] += 1;
        self.became[gone] = kept as u32;
    }

    /// Squared distance of a place from the mesh that is left: from the triangles around the vertex that `vertex` has become, and around
    /// the corners of the nearest one of these as long as one there is nearer.
    fn squared_distance(&self, vertex: usize, from: &Place) -> f64 {
        let mut root = vertex;
        while self.became[root] as usize != root {
            root = self.became[root] as usize;
        }
        let mut best = (f64::INFINITY, [root as u32; 3]);
        loop {
            let around = best.1.iter().flat_map(|v| &self.around[*v as usize]);
            let found = around.map(|t| {
                let corners = self.triangles[*t as usize];
                (
                    squared_distance(from, corners.map(|v| self.place(v))),
                    corners,
                )
            });
            match found.min_by(|a, b| a.0.total_cmp(&b.0)) {
                Some(nearest) if nearest.0 < best.0 => best = nearest,
                _ => break,
            }
        }
        match best.0.is_finite() {
            true => best.0,
            false => 0.0,
        }
    }

    /// The mesh that is left, with its vertices numbered anew.
    fn finished(self, given: &Polyhedron) -> Decimated {
        let squares: f64 = (given.places.iter().enumerate())
            .map(|(v, place)| self.squared_distance(v, &((place - self.middle) / self.unit)))
            .sum();
        let mut numbers = vec![NO_INDEX; self.places.len()];
        let mut places = Vec::new();
        let mut is_left = vec![false; self.triangles.len()];
        for t in self.around.iter().flatten() {
            is_left[*t as usize] = true;
        }
        let kept = self
            .triangles
            .iter()
            .zip(is_left)
            .filter(|(_, is_left)| *is_left);
        let triangles = kept
            .map(|(corners, _)| {
                corners.map(|v| {
                    let number = &mut numbers[v as usize];
                    if *number == NO_INDEX {
                        *number = places.len() as u32;
                        places.push(self.unit * self.place(v) + self.middle);
                    }
                    *number
                })
            })
            .collect();
        Decimated {
            places,
            triangles,
            distance: self.unit * (squares / given.places.len().max(1) as f64).sqrt(),
        }
    }
}

/// Squared distance of a point from a triangle.
fn squared_distance(point: &Place, corners: [Place; 3]) -> f64 {
    let [a, b, c] = corners;
    let normal = (b - a).cross(&(c - a));
    let sides = [[a, b], [b, c], [c, a]];
    let is_inside = sides
        .iter()
        .all(|[p, q]| normal.dot(&(q - p).cross(&(point - p))) >= 0.0);
    if is_inside && normal.norm_squared() > 0.0 {
        return (point - a).dot(&normal).powi(2) / normal.norm_squared();
    }
    let to_side = sides.map(|[p, q]| {
        let along = q - p;
        let share = (point - p).dot(&along) / along.norm_squared().max(f64::MIN_POSITIVE);
        (point - p - share.clamp(0.0, 1.0) * along).norm_squared()
    });
    to_side.into_iter().fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::mesh::Mesh;

    fn decimated(places: Vec<[f64; 3]>, triangles: Vec<[u32; 3]>, most: usize) -> Decimated {
        let mesh = Mesh::new(places, triangles).unwrap();
        decimate(&Polyhedron::new(&mesh).unwrap(), most)
    }

    /// A torus of so many by so many squares, of which `keep` says which are there; its radii are 2 and 1.
    fn torus(n: u32, m: u32, keep: impl Fn(u32, u32) -> bool) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
        let turn = |k: u32, n: u32| std::f64::consts::TAU * f64::from(k) / f64::from(n);
        let place = |i: u32, j: u32| {
            let (around, within) = (turn(i, n), turn(j, m));
            let far = 2.0 + within.cos();
            [far * around.cos(), far * around.sin(), within.sin()]
        };
        let vertex = |i: u32, j: u32| i % n * m + j % m;
        let squares = (0..n).flat_map(|i| (0..m).map(move |j| (i, j)));
        let triangles = squares
            .clone()
            .filter(|(i, j)| keep(*i, *j))
            .flat_map(|(i, j)| {
                let [a, b, c, d] =
                    [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)].map(|(i, j)| vertex(i, j));
                [[a, b, c], [a, c, d]]
            });
        let triangles = triangles.collect();
        (squares.map(|(i, j)| place(i, j)).collect(), triangles)
    }

    /// Vertices, edges and borders of a mesh; edges are those of the triangles, however many meet there.
    fn count(mesh: &Decimated) -> [usize; 3] {
        let mut edges = std::collections::BTreeMap::new();
        for [a, b, c] in &mesh.triangles {
            for [p, q] in [[a, b], [b, c], [c, a]] {
                *edges.entry([p.min(q), p.max(q)]).or_insert(0) += 1;
            }
        }
        assert!(edges.values().all(|triangles| *triangles <= 2));
        let border = edges.values().filter(|triangles| **triangles == 1).count();
        [mesh.places.len(), edges.len(), border]
    }

    #[test]
    fn faces_of_a_finely_divided_box_stay_where_they_are() {
        // Each side of a box of 3 by 2 by 1 is divided into squares of a quarter.
        let sides = [[3.0, 2.0, 1.0], [2.0, 1.0, 3.0], [1.0, 3.0, 2.0]];
        let (mut places, mut triangles) = (Vec::new(), Vec::new());
        for (turn, [wide, high, at]) in sides.into_iter().enumerate() {
            for end in [0.0, at] {
                for i in 0..(4.0 * wide) as u32 {
                    for j in 0..(4.0 * high) as u32 {
                        let first = places.len() as u32;
                        for [di, dj] in [[0, 0], [1, 0], [1, 1], [0, 1]] {
                            let mut place =
                                [0.25 * f64::from(i + di), 0.25 * f64::from(j + dj), end];
                            place.rotate_right(turn);
                            places.push(place);
                        }
                        triangles.extend([[0, 1, 2], [0, 2, 3]].map(|t| t.map(|k| first + k)));
                    }
                }
            }
        }
        let found = decimated(places, triangles, 12);
        assert_eq!((found.triangles.len(), count(&found)), (12, [8, 18, 0]));
        assert!(found.distance < 1e-9, "{}", found.distance);
        for place in &found.places {
            for (k, side) in [3.0, 2.0, 1.0].into_iter().enumerate() {
                assert!(
                    place[k].abs().min((place[k] - side).abs()) < 1e-9,
                    "{place}"
                );
            }
        }
    }

    #[test]
    fn a_torus_stays_one_near_its_surface() {
        let (places, triangles) = torus(90, 45, |_, _| true);
        let found = decimated(places, triangles, 400);
        let [vertices, edges, border] = count(&found);
        assert_eq!((found.triangles.len(), border), (400, 0));
        assert_eq!(vertices + 400, edges);
        // The sagitta of equilateral triangles of that area across the tighter bend, of radius 1.
        let area = 8.0 * std::f64::consts::PI.powi(2) / 400.0;
        let largest = 1.0 - (1.0 - 4.0 * area / (3.0 * 3f64.sqrt())).sqrt();
        assert!(found.distance < largest, "{} {largest}", found.distance);
        let off = |place: &Place| (place.xy().norm() - 2.0).hypot(place.z) - 1.0;
        assert!(found.places.iter().all(|place| off(place).abs() < largest));
    }

    #[test]
    fn borders_stay_and_parts_do_not_join() {
        // Half of the torus, cut open along a circle of radius 3.
        let (places, triangles) = torus(60, 30, |i, j| i < 30 && j != 0);
        let found = decimated(places, triangles, 150);
        let [vertices, edges, border] = count(&found);
        // At the border a contraction takes one triangle away.
        let faces = found.triangles.len();
        assert!((149..=150).contains(&faces) && border > 8);
        assert_eq!(vertices + faces, edges + 1);
        // Both ends, apart by 6, are there: half circles of radius 1 about (2, 0) and (-2, 0).
        for end in [2.0, -2.0] {
            let at = |place: &&Place| place.y.abs() < 0.02 && (place.x - end).hypot(place.z) > 0.9;
            assert!(found.places.iter().filter(at).count() >= 5);
        }
    }
}

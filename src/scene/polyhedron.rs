//! A mesh as a polyhedron: flat facets of coplanar triangles, and the edges along which these meet.

use std::f64::consts::PI;

use nalgebra::Vector3;
use rustc_hash::{FxHashMap, FxHashSet};

use super::half_edges::{half_edge_ends, twin_half_edges};
use super::mesh::{Mesh, TexturedTriangle};
use crate::error::{Error, Result};
use crate::math::index::NO_INDEX;
use crate::math::planar::{Point2, polygon_area};

pub(crate) type Place = Vector3<f64>;

/// Distance below which points are one and a point lies in a plane, as a share of the mesh's diagonal: files have six
/// digits or more.
const ROUNDING_SHARE: f64 = 1e-6;

/// Distance below which points of a mesh are one, in units of the last place of the largest coordinate, where all coordinates are
/// numbers of 32 bits or of six digits.
const ROUNDING_UNITS: f64 = 4.0;

/// Largest angle between neighbouring facets of a bend, in radians: circles of 16 sides or more (`benches/exactness.md`).
pub(crate) const MAX_BEND_STEP: f64 = 0.4;

/// A mesh whose triangles belong to flat facets. Half-edges are numbered as in [`half_edge_ends`].
pub(crate) struct Polyhedron {
    pub places: Vec<Place>,
    pub triangles: Vec<[u32; 3]>,
    /// The twin of each half-edge; [`NO_INDEX`] on the border, and where more than two triangles meet.
    pub twins: Vec<u32>,
    /// Number of the facet of each triangle.
    pub facets: Vec<u32>,
    /// Unit normal of each facet.
    pub normals: Vec<Place>,
    /// Area of each facet.
    pub areas: Vec<f64>,
    /// Position of each triangle's corners in the plane of its facet, seen from the side that the normal points to.
    pub flat: Vec<[Point2; 3]>,
    /// Part of its texture that each triangle shows; empty without texture coordinates, and where faces were found.
    pub textured: Vec<Option<TexturedTriangle>>,
    /// Distance below which points are one.
    pub rounding: f64,
}

/// Triangles of faces that are known, as of a mesh with noise, or rolled.
#[derive(Default)]
pub(crate) struct KnownFaces {
    pub triangles: Vec<[u32; 3]>,
    /// Number of the face of each triangle.
    pub of: Vec<u32>,
    /// Corners of each triangle in the plane of its face, anticlockwise seen from the side that the normal points to.
    pub flat: Vec<[Point2; 3]>,
    /// Unit normal of each face, of a rolled one in its middle.
    pub normals: Vec<Place>,
}

impl KnownFaces {
    pub(crate) fn push(&mut self, triangle: [u32; 3], face: u32, flat: [Point2; 3]) {
        self.triangles.push(triangle);
        self.of.push(face);
        self.flat.push(flat);
    }
}

impl Polyhedron {
    /// Joins the vertices at one place, leaves out triangles that repeat another, turns triangles to one side where they can be,
    /// and finds the facets.
    ///
    /// # Errors
    /// [`Error::Unsupported`] for a mesh whose triangles have no area.
    pub(crate) fn new(mesh: &Mesh) -> Result<Polyhedron> {
        let rounding = rounding(mesh);
        let (places, merged) = merge_points(mesh.positions(), rounding);
        let triangles = (mesh.triangles().iter()).map(|t| t.map(|v| merged[v as usize]));
        let turns = |[a, b, c]: [u32; 3]| [[a, b, c], [b, c, a], [c, a, b]].into_iter();
        let mut known = FxHashSet::default();
        let given: Vec<(usize, [u32; 3])> = triangles
            .enumerate()
            .filter(|(_, [a, b, c])| a != b && b != c && c != a)
            .filter(|(_, corners)| known.insert(turns(*corners).min()))
            .collect();
        let mut triangles: Vec<[u32; 3]> = given.iter().map(|(_, corners)| *corners).collect();
        let twins = oriented_twins(&places, &mut triangles, rounding);
        let textured = match mesh.uvs() {
            Some(_) => (given.iter().zip(&triangles))
                .map(|((number, given), turned)| {
                    let textured = mesh.textured(*number)?;
                    let uv = |v: u32| {
                        textured.uvs[usize::from(v != given[0]) + usize::from(v == given[2])]
                    };
                    Some(TexturedTriangle {
                        uvs: turned.map(uv),
                        ..textured
                    })
                })
                .collect(),
            None => Vec::new(),
        };
        let mut solid = Polyhedron {
            facets: vec![NO_INDEX; triangles.len()],
            normals: Vec::new(),
            areas: Vec::new(),
            flat: vec![[Point2::default(); 3]; triangles.len()],
            places,
            triangles,
            twins,
            textured,
            rounding,
        };
        solid.find_facets();
        match solid.areas.iter().sum::<f64>() > solid.rounding * solid.rounding {
            true => Ok(solid),
            false => Err(Error::Unsupported {
                format: "pattern",
                reason: "the triangles of the mesh have no area".into(),
            }),
        }
    }

    /// Takes triangles whose faces are known and face one side; neighbouring triangles of one face are a facet. Points within
    /// `rounding` are one.
    pub(crate) fn from_faces(places: Vec<Place>, faces: KnownFaces, rounding: f64) -> Polyhedron {
        let KnownFaces {
            triangles,
            of,
            flat,
            normals,
        } = faces;
        let mut solid = Polyhedron {
            twins: twin_half_edges(&triangles),
            facets: vec![NO_INDEX; triangles.len()],
            normals: Vec::new(),
            areas: Vec::new(),
            flat,
            places,
            triangles,
            textured: Vec::new(),
            rounding,
        };
        for seed in 0..of.len() {
            if solid.facets[seed] != NO_INDEX {
                continue;
            }
            let number = solid.normals.len() as u32;
            let (mut members, mut next) = (vec![seed], 0);
            solid.facets[seed] = number;
            while let Some(t) = members.get(next).copied() {
                next += 1;
                for twin in &solid.twins[3 * t..3 * t + 3] {
                    let other = *twin as usize / 3;
                    if *twin != NO_INDEX && of[other] == of[seed] && solid.facets[other] == NO_INDEX
                    {
                        solid.facets[other] = number;
                        members.push(other);
                    }
                }
            }
            let areas = members.iter().map(|t| polygon_area(&solid.flat[*t]));
            solid.areas.push(areas.sum());
            solid.normals.push(normals[of[seed] as usize]);
        }
        solid
    }

    pub(crate) fn corners(&self, triangle: usize) -> [Place; 3] {
        self.triangles[triangle].map(|v| self.places[v as usize])
    }

    /// The largest triangle of each facet.
    pub(crate) fn largest_triangles(&self) -> Vec<usize> {
        let mut largest = vec![(-1.0, 0); self.areas.len()];
        for (t, facet) in self.facets.iter().enumerate() {
            let [a, b, c] = self.corners(t);
            let size = (b - a).cross(&(c - a)).norm();
            if size > largest[*facet as usize].0 {
                largest[*facet as usize] = (size, t);
            }
        }
        largest.into_iter().map(|(_, t)| t).collect()
    }

    pub(crate) fn ends(&self, half_edge: u32) -> [Place; 2] {
        half_edge_ends(&self.triangles, half_edge).map(|v| self.places[v as usize])
    }

    pub(crate) fn length(&self, half_edge: u32) -> f64 {
        let [a, b] = self.ends(half_edge);
        (b - a).norm()
    }

    pub(crate) fn facet(&self, half_edge: u32) -> u32 {
        self.facets[half_edge as usize / 3]
    }

    /// Positions of a half-edge's ends in the plane of its facet.
    pub(crate) fn flat_ends(&self, half_edge: u32) -> [Point2; 2] {
        let (corners, k) = (&self.flat[half_edge as usize / 3], half_edge as usize % 3);
        [corners[k], corners[(k + 1) % 3]]
    }

    /// Angle between the facets on both sides of a half-edge with a twin, in radians: above 0 at a ridge.
    pub(crate) fn angle(&self, half_edge: u32) -> f64 {
        let [m, n] = [half_edge, self.twins[half_edge as usize]]
            .map(|side| self.normals[self.facet(side) as usize]);
        let [from, to] = self.ends(half_edge);
        let along = (to - from).normalize();
        let turn = m.cross(&n);
        let angle = turn.norm().atan2(m.dot(&n));
        // Facets that lie on each other are folded at the rim by half a turn.
        if turn.dot(&along) >= 0.0 || angle > PI - 1e-9 {
            angle
        } else {
            -angle
        }
    }

    /// One half-edge of each edge with two facets.
    pub(crate) fn inner_sides(&self) -> impl Iterator<Item = u32> + '_ {
        (0u32..).zip(&self.twins).filter_map(|(side, twin)| {
            let is_first = *twin != NO_INDEX && side < *twin;
            (is_first && self.facet(side) != self.facet(*twin)).then_some(side)
        })
    }

    /// Whether the facets on both sides of a half-edge meet at so small an angle that they may belong to one bend.
    pub(crate) fn is_step(&self, side: u32) -> bool {
        self.angle(side).abs() <= MAX_BEND_STEP
    }

    /// The facets that each facet meets at a small angle, each with the angle.
    pub(crate) fn bend_steps(&self) -> Vec<Vec<(u32, f64)>> {
        let mut steps: Vec<Vec<(u32, f64)>> = vec![Vec::new(); self.normals.len()];
        for side in self.inner_sides().filter(|side| self.is_step(*side)) {
            let [a, b] = [side, self.twins[side as usize]].map(|s| self.facet(s));
            for (own, other) in [(a, b), (b, a)] {
                if steps[own as usize].iter().all(|(facet, _)| *facet != other) {
                    steps[own as usize].push((other, self.angle(side)));
                }
            }
        }
        steps
    }

    /// Grows facets from the largest triangles on: a triangle belongs to a facet if all its corners lie in its plane.
    fn find_facets(&mut self) {
        let areas: Vec<Place> = (0..self.triangles.len())
            .map(|t| {
                let [a, b, c] = self.corners(t);
                0.5 * (b - a).cross(&(c - a))
            })
            .collect();
        let mut order: Vec<usize> = (0..areas.len()).collect();
        order.sort_by(|a, b| areas[*b].norm().total_cmp(&areas[*a].norm()));
        for seed in order {
            if self.facets[seed] != NO_INDEX {
                continue;
            }
            let number = self.normals.len() as u32;
            let [origin, to, _] = self.corners(seed);
            let size = areas[seed].norm();
            let normal = match size > 0.0 {
                true => areas[seed] / size,
                false => {
                    // A line has no plane of its own: any through it will do.
                    let along = (to - origin).normalize();
                    let axis = Place::ith(along.iamin(), 1.0);
                    along.cross(&axis).normalize()
                }
            };
            // A place in the plane of three corners is a mean of these, with weights below 0 outside of the triangle; so is what
            // their rounding does to it.
            let corners = self.corners(seed);
            let least = self.rounding * self.rounding;
            let is_in_plane = |p: &Place| {
                let weight = |k: usize| {
                    let [from, to] = [corners[(k + 1) % 3] - p, corners[(k + 2) % 3] - p];
                    0.5 * normal.dot(&from.cross(&to)).abs() / size.max(least)
                };
                let weights: f64 = (0..3).map(weight).sum();
                normal.dot(&(p - origin)).abs() <= self.rounding * weights.max(1.0)
            };
            let (mut members, mut next) = (vec![seed], 0);
            self.facets[seed] = number;
            while let Some(t) = members.get(next).copied() {
                next += 1;
                for side in 3 * t..3 * t + 3 {
                    let twin = self.twins[side];
                    if twin == NO_INDEX || self.facets[twin as usize / 3] != NO_INDEX {
                        continue;
                    }
                    let other = twin as usize / 3;
                    let [a, b] = self.ends(twin);
                    // A triangle without a height faces no side.
                    let is_needle = 2.0 * areas[other].norm() <= self.rounding * (b - a).norm();
                    if self.corners(other).iter().all(is_in_plane)
                        && (is_needle || areas[other].dot(&normal) > 0.0)
                    {
                        self.facets[other] = number;
                        members.push(other);
                    }
                }
            }
            let sum: Place = members.iter().map(|t| areas[*t]).sum();
            let normal = match sum.norm() > 0.0 {
                true => sum.normalize(),
                false => normal,
            };
            let x = (to - origin - normal * normal.dot(&(to - origin))).normalize();
            let y = normal.cross(&x);
            let mut area = 0.0;
            for t in members {
                area += areas[t].norm();
                self.flat[t] = self.corners(t).map(|p| {
                    let from = p - origin;
                    Point2::new(x.dot(&from), y.dot(&from))
                });
            }
            self.normals.push(normal);
            self.areas.push(area);
        }
    }
}

/// Distance below which points of a mesh are one.
fn rounding(mesh: &Mesh) -> f64 {
    let [low, high] = mesh.bounds().map(Place::from);
    let largest = low.amax().max(high.amax());
    // Of the coordinates, and of what a decimal number is after a division.
    let (precision, tolerance) = match mesh.has_single_precision() {
        true => (f64::from(f32::EPSILON), f64::from(f32::EPSILON)),
        false => (f64::EPSILON, f64::EPSILON.sqrt()),
    };
    let share = ROUNDING_SHARE * (high - low).norm();
    let digit = sixth_digit(largest);
    // Far from the origin six digits are too few for a mesh.
    let is_small = digit <= 10.0 * share;
    let coordinates = mesh.positions().as_flattened();
    let unit = match is_small && have_six_digits(coordinates, largest, tolerance) {
        true => digit,
        false => largest * precision,
    };
    share.max(ROUNDING_UNITS * unit)
}

/// Unit of the sixth digit of a number.
fn sixth_digit(x: f64) -> f64 {
    ROUNDING_SHARE * 10f64.powf((x.abs().log10() + 1.0).floor())
}

/// Whether numbers, of which `largest` is the largest magnitude, were rounded to six digits, to a relative tolerance: none has
/// more, and a large one has all of them, as whole numbers have not.
fn have_six_digits(numbers: &[f64], largest: f64, tolerance: f64) -> bool {
    let is_multiple = |x: f64, unit: f64| {
        let units = x / unit;
        (units - units.round()).abs() <= tolerance * units.abs()
    };
    let coarser = 10.0 * sixth_digit(largest);
    let mut large = numbers.iter().filter(|x| x.abs() >= 0.1 * largest);
    let mut others = numbers.iter().filter(|x| **x != 0.0);
    large.any(|x| !is_multiple(*x, coarser)) && others.all(|x| is_multiple(*x, sixth_digit(*x)))
}

/// Joins points nearer to each other than the rounding; returns them and the number of each given point among them.
fn merge_points(positions: &[[f64; 3]], rounding: f64) -> (Vec<Place>, Vec<u32>) {
    let mut cells: FxHashMap<[i64; 3], Vec<u32>> = FxHashMap::default();
    let mut places: Vec<Place> = Vec::new();
    let size = rounding.max(f64::MIN_POSITIVE);
    let low = [0, 1, 2].map(|k| positions.iter().map(|p| p[k]).fold(f64::INFINITY, f64::min));
    let merged = positions.iter().map(|p| {
        let place = Place::from(*p);
        let cell = [0, 1, 2].map(|k| ((p[k] - low[k]) / size).floor() as i64);
        let around = (0..27i64).map(|i| {
            let by = [i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1];
            [0, 1, 2].map(|k| cell[k] + by[k])
        });
        let near = |v: &&u32| (places[**v as usize] - place).norm() <= size;
        let found = around.filter_map(|cell| cells.get(&cell)?.iter().find(near));
        found.copied().next().unwrap_or_else(|| {
            let number = places.len() as u32;
            places.push(place);
            cells.entry(cell).or_default().push(number);
            number
        })
    });
    let merged = merged.collect();
    (places, merged)
}

/// Whether two arms of triangles at an edge lie in one plane through it, to rounding.
fn are_parallel(p: &Place, q: &Place, rounding: f64) -> bool {
    p.cross(q).norm() <= rounding * p.norm().max(q.norm())
}

/// Pairs of half-edges at an edge along which solids touch each other: the two sides of each solid. `arms` go from the edge to the
/// third corners, `axis` along the first half-edge, or against it if triangles face inwards. `None` unless triangles that face one way
/// around the edge and those that face the other way take turns, as they do not where sheets cross each other.
fn solids_at_edge(
    triangles: &[[u32; 3]],
    sides: &[u32],
    arms: &[Place],
    axis: Place,
    rounding: f64,
) -> Option<Vec<[u32; 2]>> {
    let first = half_edge_ends(triangles, *sides.first()?);
    let (x, y) = (arms[0], axis.cross(&arms[0]));
    let angle = |arm: &Place| y.dot(arm).atan2(x.dot(arm));
    // A solid ends, in the order of the angles, at a half-edge that runs as the first one does.
    let ends_solid = |side: u32| half_edge_ends(triangles, side) == first;
    let mut order: Vec<(&Place, u32)> = arms.iter().zip(sides.iter().copied()).collect();
    order.sort_by(|a, b| angle(a.0).total_cmp(&angle(b.0)));
    let n = order.len();
    // Where the faces of two solids lie on each other one ends before the other begins.
    for i in 0..n {
        let [(p, a), (q, b)] = [order[i], order[(i + 1) % n]];
        let lie_on_each_other = are_parallel(p, q, rounding) && p.dot(q) > 0.0;
        if lie_on_each_other && !ends_solid(a) && ends_solid(b) {
            order.swap(i, (i + 1) % n);
        }
    }
    let sides = (0..n).map(|i| [order[i].1, order[(i + 1) % n].1]);
    let take_turns = sides.clone().all(|[a, b]| ends_solid(a) != ends_solid(b));
    take_turns.then(|| sides.filter(|[_, b]| ends_solid(*b)).collect())
}

/// Turns triangles so that neighbours face one side, and finds the twins of their half-edges. Where more than two
/// triangles meet at an edge the sides of each solid stay together, of sheets only those in one plane; where a surface has one
/// side only it is cut.
fn oriented_twins(places: &[Place], triangles: &mut [[u32; 3]], rounding: f64) -> Vec<u32> {
    let mut edges: FxHashMap<[u32; 2], Vec<u32>> = FxHashMap::default();
    for side in 0..3 * triangles.len() as u32 {
        let [a, b] = half_edge_ends(triangles, side);
        edges.entry([a.min(b), a.max(b)]).or_default().push(side);
    }
    // The third corner of a half-edge's triangle, as seen from the edge.
    let away = |triangles: &[[u32; 3]], side: u32| {
        let [a, b] = half_edge_ends(triangles, side).map(|v| places[v as usize]);
        let c = triangles[side as usize / 3][(side as usize + 2) % 3];
        let (along, off) = ((b - a).normalize(), places[c as usize] - a);
        off - along * along.dot(&off)
    };
    let origin = places.first().copied().unwrap_or_default();
    let volumes = triangles.iter().map(|t| {
        let [a, b, c] = t.map(|v| places[v as usize] - origin);
        a.dot(&b.cross(&c))
    });
    // Makes 0 of -0.
    let outwards = (0.0 + volumes.sum::<f64>()).signum();
    let mut keys: Vec<_> = edges.keys().copied().collect();
    keys.sort_unstable();
    let mut pairs = vec![NO_INDEX; 3 * triangles.len()];
    for key in keys {
        let mut sides = edges[&key].clone();
        if sides.len() > 2 {
            // Triangles without a width are on no side of the edge.
            sides.retain(|side| away(triangles, *side).norm() > rounding);
        }
        let mut pair = |a: u32, b: u32| (pairs[a as usize], pairs[b as usize]) = (b, a);
        if let [a, b] = sides[..] {
            pair(a, b);
            continue;
        }
        let arms: Vec<Place> = sides.iter().map(|side| away(triangles, *side)).collect();
        let axis = sides.first().map_or(Place::zeros(), |side| {
            let [a, b] = half_edge_ends(triangles, *side).map(|v| places[v as usize]);
            outwards * (b - a).normalize()
        });
        if let Some(solids) = solids_at_edge(triangles, &sides, &arms, axis, rounding) {
            solids.into_iter().for_each(|[a, b]| pair(a, b));
        } else {
            // Pairs of opposite triangles in one plane; of doubled faces none, which has no single opposite.
            let opposite = |a: u32, b: u32| {
                let (p, q) = (away(triangles, a), away(triangles, b));
                are_parallel(&p, &q, rounding) && p.dot(&q) < 0.0
            };
            let all = sides.clone();
            sides.retain(|a| all.iter().filter(|b| opposite(*a, **b)).count() == 1);
            while let Some(a) = sides.pop() {
                if let Some(at) = sides.iter().position(|b| opposite(a, *b)) {
                    pair(a, sides.swap_remove(at));
                }
            }
        }
    }
    // Which triangles are turned.
    let mut turned: Vec<Option<bool>> = vec![None; triangles.len()];
    for first in 0..triangles.len() {
        if turned[first].is_some() {
            continue;
        }
        turned[first] = Some(false);
        let mut component = vec![first];
        let mut next = 0;
        while let Some(t) = component.get(next).copied() {
            next += 1;
            for side in 3 * t as u32..3 * t as u32 + 3 {
                let twin = pairs[side as usize];
                if twin == NO_INDEX || turned[twin as usize / 3].is_some() {
                    continue;
                }
                let same = half_edge_ends(triangles, side) == half_edge_ends(triangles, twin);
                turned[twin as usize / 3] = Some(same != (turned[t] == Some(true)));
                component.push(twin as usize / 3);
            }
        }
        // A closed surface faces outwards, an open one as most of its triangles do.
        let is_closed =
            (component.iter()).all(|t| (3 * t..3 * t + 3).all(|side| pairs[side] != NO_INDEX));
        let sign = |t: usize| if turned[t] == Some(true) { -1.0 } else { 1.0 };
        let origin = places[triangles[first][0] as usize];
        let sum: f64 = (component.iter())
            .map(|t| {
                let [a, b, c] = triangles[*t].map(|v| places[v as usize] - origin);
                let measure = match is_closed {
                    true => a.dot(&b.cross(&c)),
                    false => (b - a).cross(&(c - a)).norm(),
                };
                sign(*t) * measure
            })
            .sum();
        if sum < 0.0 {
            for t in component {
                turned[t] = turned[t].map(|turned| !turned);
            }
        }
    }
    // Half-edges of a turned triangle: the corners (a, b, c) become (a, c, b).
    let moved = |side: u32| match turned[side as usize / 3] {
        Some(true) => side / 3 * 3 + 2 - side % 3,
        _ => side,
    };
    let mut twins = vec![NO_INDEX; pairs.len()];
    for (side, twin) in (0u32..).zip(&pairs) {
        if *twin != NO_INDEX {
            twins[moved(side) as usize] = moved(*twin);
        }
    }
    for (t, corners) in triangles.iter_mut().enumerate() {
        if turned[t] == Some(true) {
            corners.swap(1, 2);
        }
    }
    // Where both still run the same way the surface has one side only.
    for side in 0..twins.len() as u32 {
        let twin = twins[side as usize];
        if twin != NO_INDEX && half_edge_ends(triangles, side) == half_edge_ends(triangles, twin) {
            (twins[side as usize], twins[twin as usize]) = (NO_INDEX, NO_INDEX);
        }
    }
    twins
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn faces_in_a_file_of_six_digits_are_flat() {
        // A roof of four rectangles, turned, with four decimals.
        let roof = [
            [-56.2674, 25.0082, 35.0789],
            [-48.5798, 19.2578, 27.4171],
            [-53.8315, 26.5091, 36.3965],
            [-46.1439, 20.7587, 28.7347],
            [-50.7254, 26.4737, 39.5397],
            [-43.0378, 20.7233, 31.8778],
            [-49.6815, 23.6082, 42.7377],
            [-41.9939, 17.8578, 35.0759],
            [-50.3388, 20.8640, 44.1377],
            [-42.6513, 15.1136, 36.4759],
        ];
        let triangles = vec![
            [0, 2, 3],
            [0, 3, 1],
            [2, 4, 5],
            [2, 5, 3],
            [4, 6, 5],
            [6, 7, 5],
            [6, 8, 7],
            [8, 9, 7],
        ];
        let faces = |points: Vec<[f64; 3]>, triangles| {
            let solid = Polyhedron::new(&Mesh::new(points, triangles).unwrap()).unwrap();
            solid.normals.len()
        };
        assert_eq!(faces(roof.to_vec(), triangles), 4);
        // Whole numbers far away are not rounded to six digits: a fold by a thousandth stays.
        let strips = [5995.0, 6000.0, 6005.0]
            .iter()
            .flat_map(|x: &f64| [0.0, 8.0].map(|y| [*x, y, 0.005 * (x - 6000.0).abs()]));
        let triangles = vec![[0, 2, 3], [0, 3, 1], [2, 4, 5], [2, 5, 3]];
        assert_eq!(faces(strips.collect(), triangles), 2);
    }

    /// Heights over whole numbers, be they of three decimals or of all digits, are not taken for rounded to six digits.
    #[test]
    fn squares_of_a_saddle_over_whole_numbers_are_not_flat() {
        for height in [1e-3, 4e-3 / 3.0] {
            let points = (0..101 * 101).map(|i| [i % 101, i / 101].map(f64::from));
            let points = points.map(|[x, y]| [x, y, height * (x - 50.0) * (y - 50.0)]);
            let squares = (0..100).flat_map(|j| (0..100).map(move |i| j * 101 + i));
            let triangles = squares.flat_map(|a| [[a, a + 1, a + 102], [a, a + 102, a + 101]]);
            let mesh = Mesh::new(points.collect(), triangles.collect()).unwrap();
            assert_eq!(Polyhedron::new(&mesh).unwrap().normals.len(), 20_000);
        }
    }
}

//! Bends that are parts of cylinders, however they are triangulated: divided into strips along their rulings, and rolled off.

use std::f64::consts::TAU;

use nalgebra::Matrix3;
use rustc_hash::{FxHashMap, FxHashSet};

use super::FoundFaces;
use super::growth::grow;

use crate::math::index::NO_INDEX;
use crate::math::least_squares::LeastSquares;
use crate::math::planar::Point2;
use crate::math::symmetric_eigen::symmetric_eigen3;
use crate::scene::half_edges::half_edge_ends;
use crate::scene::mesh::Mesh;
use crate::scene::polyhedron::{KnownFaces, Place, Polyhedron};

/// Number of neighbouring facets from which a cylinder is found. `benches/patterns.md` has what others give.
const SEED_FACETS: usize = 8;

/// Number of steps in which a cylinder is found by Gauss and Newton. `benches/patterns.md` has what others give.
const MAX_FIT_STEPS: usize = 12;

/// Distance from a cylinder, in units of the rounding, within which a point lies on it. `benches/patterns.md` has what others give.
const MAX_DISTANCE_ROUNDINGS: f64 = 4.0;

/// Maximum area of a slender facet, as a share of the square of its longest side. `benches/patterns.md` has what others give.
const MAX_SLENDER_SHARE: f64 = 0.05;

/// Maximum angle of a strip of a bend, in radians. `benches/patterns.md` has what others give.
const MAX_STRIP_ANGLE: f64 = 0.15;

/// Maximum angle of a bend, in radians: a tube has no two sides.
const MAX_BEND_ANGLE: f64 = 0.9 * TAU;

/// A cylinder: a point of its axis, the direction of the axis and two across, all right-handed, and its radius.
struct Cylinder {
    centre: Place,
    across: [Place; 2],
    along: Place,
    radius: f64,
}

impl Cylinder {
    /// Angle around the axis, height along it, and distance from the surface.
    fn coordinates(&self, place: &Place) -> [f64; 3] {
        let off = place - self.centre;
        let [x, y] = self.across.map(|axis| axis.dot(&off));
        [y.atan2(x), self.along.dot(&off), x.hypot(y) - self.radius]
    }

    /// Angle around the axis of a direction.
    fn angle(&self, direction: &Place) -> f64 {
        let [x, y] = self.across.map(|axis| axis.dot(direction));
        y.atan2(x)
    }

    /// Unit normal at an angle, away from the axis.
    fn outward(&self, angle: f64) -> Place {
        self.across[0] * angle.cos() + self.across[1] * angle.sin()
    }

    /// The cylinder nearest to points whose triangles have these normals, as long as their areas.
    fn fit(points: &[Place], normals: impl Iterator<Item = Place>) -> Option<Cylinder> {
        let spread: Matrix3<f64> = normals.map(|n| n * n.transpose()).sum();
        let [.., (_, mut along)] = symmetric_eigen3(spread);
        let mean = points.iter().sum::<Place>() / points.len() as f64;
        let mut found: Option<Cylinder> = None;
        for _ in 0..MAX_FIT_STEPS {
            let first = along.cross(&Place::ith(along.iamin(), 1.0)).normalize();
            let across = [first, along.cross(&first)];
            let flat = |p: &Place| across.map(|axis| axis.dot(&(p - mean)));
            let (centre, radius, tilt) = match &found {
                None => {
                    // The circle x² + y² = 2 (a x + b y) + c.
                    let mut circle = LeastSquares::<3>::new();
                    for [x, y] in points.iter().map(flat) {
                        circle.add(&[2.0 * x, 2.0 * y, 1.0].into(), [x * x + y * y], 1.0);
                    }
                    let [a, b, c]: [f64; 3] = circle.solve()?.into();
                    ([a, b], (c + a * a + b * b).max(0.0).sqrt(), [0.0; 2])
                }
                Some(last) => {
                    let mut step = LeastSquares::<5>::new();
                    for p in points {
                        let off = p - last.centre;
                        let [x, y] = across.map(|axis| axis.dot(&off));
                        let (far, high) = (x.hypot(y), along.dot(&(p - mean)));
                        let [u, v] = [x / far, y / far];
                        let row = [u, v, 1.0, u * high, v * high];
                        step.add(&row.into(), [far - last.radius], 1.0);
                    }
                    let [a, b, r, s, t]: [f64; 5] = step.solve()?.into();
                    let [x, y] = across.map(|axis| axis.dot(&(last.centre - mean)));
                    ([x + a, y + b], last.radius + r, [s, t])
                }
            };
            let place = mean + across[0] * centre[0] + across[1] * centre[1];
            along = (along + across[0] * tilt[0] + across[1] * tilt[1]).normalize();
            // Angles are counted from the middle of the points.
            let out = mean - place;
            let first = (out - along * along.dot(&out)).normalize();
            found = Some(Cylinder {
                centre: place,
                across: [first, along.cross(&first)],
                along,
                radius,
            });
        }
        found.filter(|found| found.radius.is_finite() && found.along.norm() > 0.5)
    }
}

/// A bend: its cylinder, the facets on it, those that lie partly on it and partly in a face that it goes over into, and the faces,
/// each with the angle at which it touches the cylinder.
struct Roll {
    cylinder: Cylinder,
    facets: FxHashSet<u32>,
    /// Triangles of the facets, and of the faces those that begin to bend.
    triangles: Vec<usize>,
    faces: Vec<(u32, f64)>,
    /// 1 if the facets are seen from outside of the cylinder, −1 from inside.
    side: f64,
}

/// Recognises an open mesh without noise of flat faces and bends that are parts of cylinders, triangulated in any way, and finds
/// its faces: those, and strips of each bend along its rulings. `None` for other meshes.
///
/// Costs `O(triangles)` for each bend.
pub fn rolled_faces(mesh: &Mesh) -> Option<FoundFaces> {
    let solid = Polyhedron::new(mesh).ok()?;
    let rolls = Search::new(&solid).rolls()?;
    let mut roll_of = vec![None; solid.normals.len()];
    for (k, roll) in rolls.iter().enumerate() {
        for facet in &roll.facets {
            if roll_of[*facet as usize].replace(k).is_some() {
                return None;
            }
        }
    }
    for side in solid.inner_sides() {
        let facets = [side, solid.twins[side as usize]].map(|s| solid.facet(s));
        // A bend ends at its faces, or at lines along it, and there are no others.
        let [a, b] = solid.ends(side);
        let ends_at = |k: usize, facet: u32| {
            let off = (b - a).cross(&rolls[k].cylinder.along).norm();
            off <= MAX_DISTANCE_ROUNDINGS * solid.rounding
                || rolls[k].faces.iter().any(|(face, _)| *face == facet)
        };
        let is_known = match facets.map(|facet| roll_of[facet as usize]) {
            [None, None] => !solid.is_step(side),
            [Some(k), None] => ends_at(k, facets[1]),
            [None, Some(k)] => ends_at(k, facets[0]),
            [Some(j), Some(k)] => j == k,
        };
        if !is_known {
            return None;
        }
    }
    let mut is_divided = vec![false; solid.triangles.len()];
    for t in rolls.iter().flat_map(|roll| &roll.triangles) {
        if std::mem::replace(&mut is_divided[*t], true) {
            return None;
        }
    }
    let mut divided = Division {
        solid: &solid,
        places: solid.places.clone(),
        faces: KnownFaces::default(),
    };
    for (t, facet) in solid.facets.iter().enumerate() {
        if !is_divided[t] {
            divided
                .faces
                .push(solid.triangles[t], *facet, solid.flat[t]);
        }
    }
    divided.faces.normals.clone_from(&solid.normals);
    for roll in &rolls {
        divided.divide(roll)?;
    }
    let Division { places, faces, .. } = divided;
    let solid = Polyhedron::from_faces(places, faces, MAX_DISTANCE_ROUNDINGS * solid.rounding);
    Some(FoundFaces {
        count: solid.normals.len(),
        noise: 0.0,
        solid,
    })
}

struct Search<'a> {
    solid: &'a Polyhedron,
    triangles: Vec<Vec<u32>>,
    /// Facets that each facet meets at a small angle, or at any if one of both is so slender that it faces no side.
    around: Vec<Vec<u32>>,
}

impl Search<'_> {
    fn new(solid: &Polyhedron) -> Search<'_> {
        let mut triangles = vec![Vec::new(); solid.normals.len()];
        for (t, facet) in (0u32..).zip(&solid.facets) {
            triangles[*facet as usize].push(t);
        }
        let is_slender = |(own, area): (&Vec<u32>, &f64)| {
            let sides = own.iter().flat_map(|t| 3 * t..3 * t + 3);
            let longest = sides.map(|side| solid.length(side)).fold(0.0, f64::max);
            *area < MAX_SLENDER_SHARE * longest * longest
        };
        let is_slender: Vec<bool> = triangles.iter().zip(&solid.areas).map(is_slender).collect();
        let mut around = vec![Vec::new(); solid.normals.len()];
        for side in solid.inner_sides() {
            let twin = solid.twins[side as usize];
            let [a, b] = [side, twin].map(|s| solid.facet(s));
            if solid.is_step(side) || is_slender[a as usize] || is_slender[b as usize] {
                around[a as usize].push(b);
                around[b as usize].push(a);
            }
        }
        Search {
            solid,
            triangles,
            around,
        }
    }

    /// All bends; `None` if there are none, or facets next to them are neither on them nor in faces that touch them.
    fn rolls(&self) -> Option<Vec<Roll>> {
        let mut rolls: Vec<Roll> = Vec::new();
        let mut is_tried = vec![false; self.around.len()];
        for seed in 0..self.around.len() as u32 {
            if is_tried[seed as usize] || self.around[seed as usize].is_empty() {
                continue;
            }
            let is_free = |facet: u32| !is_tried[facet as usize];
            let near = grow(&self.around, seed, |near, facet| {
                near.len() < SEED_FACETS && is_free(facet)
            });
            if let Some((cylinder, facets)) = self.cylinder(near) {
                let roll = self.roll(cylinder, facets)?;
                (roll.facets.iter()).for_each(|facet| is_tried[*facet as usize] = true);
                rolls.push(roll);
            }
        }
        (!rolls.is_empty()).then_some(rolls)
    }

    /// Adds to the facets on a cylinder those that go over into faces.
    fn roll(&self, cylinder: Cylinder, on: Vec<u32>) -> Option<Roll> {
        let solid = self.solid;
        let near = MAX_DISTANCE_ROUNDINGS * solid.rounding;
        let outward = |facet: &u32| {
            let [angle, ..] = cylinder.coordinates(&self.points(&[*facet])[0]);
            cylinder.outward(angle).dot(&solid.normals[*facet as usize])
                * solid.areas[*facet as usize]
        };
        let side = on.iter().map(outward).sum::<f64>().signum();
        // A face touches the cylinder where its normal is the cylinder's.
        let touches = |facet: u32| {
            let normal = solid.normals[facet as usize] * side;
            let angle = cylinder.angle(&normal);
            let line = cylinder.centre + cylinder.outward(angle) * cylinder.radius;
            let all = self.points(&[facet]);
            let off = all
                .iter()
                .map(|p| normal.dot(&(p - line)).abs())
                .fold(0.0, f64::max);
            // A face may hold triangles that begin to bend.
            (off <= 4.0 * near
                && normal.dot(&cylinder.along).abs() * all[0].metric_distance(&line) <= near)
                .then_some(angle)
        };
        let (mut faces, mut facets, mut open) =
            (Vec::new(), FxHashSet::from_iter(on.iter().copied()), on);
        let mut seen = facets.clone();
        while let Some(facet) = open.pop() {
            for other in &self.around[facet as usize] {
                if !seen.insert(*other) {
                    continue;
                }
                match touches(*other) {
                    Some(angle) => faces.push((*other, angle)),
                    None => {
                        facets.insert(*other);
                        open.push(*other);
                    }
                }
            }
        }
        let mut roll = Roll {
            cylinder,
            facets,
            triangles: Vec::new(),
            faces,
            side,
        };
        let own = (0..solid.triangles.len()).filter(|t| roll.facets.contains(&solid.facets[*t]));
        let mut triangles: Vec<usize> = own.collect();
        let mut seen: FxHashSet<usize> = triangles.iter().copied().collect();
        let mut next = 0;
        while let Some(t) = triangles.get(next).copied() {
            next += 1;
            for twin in solid.twins[3 * t..3 * t + 3]
                .iter()
                .filter(|twin| **twin != NO_INDEX)
            {
                let other = *twin as usize / 3;
                let is_face = roll
                    .faces
                    .iter()
                    .any(|(face, _)| *face == solid.facets[other]);
                let begins = |p: &Place| roll.begins_at(p, near);
                if is_face && solid.corners(other).iter().any(begins) && seen.insert(other) {
                    triangles.push(other);
                }
            }
        }
        roll.triangles = triangles;
        let all: Vec<Place> = roll
            .triangles
            .iter()
            .flat_map(|t| solid.corners(*t))
            .collect();
        all.iter()
            .all(|p| roll.angle(p, solid, near).is_some())
            .then_some(roll)
    }

    fn points(&self, facets: &[u32]) -> Vec<Place> {
        let triangles = facets
            .iter()
            .flat_map(|facet| &self.triangles[*facet as usize]);
        triangles
            .flat_map(|t| self.solid.corners(*t as usize))
            .collect()
    }

    /// The cylinder that some facets lie on, and all facets on it around them.
    fn cylinder(&self, mut facets: Vec<u32>) -> Option<(Cylinder, Vec<u32>)> {
        let near = MAX_DISTANCE_ROUNDINGS * self.solid.rounding;
        loop {
            let points = self.points(&facets);
            let normals = facets.iter().map(|facet| *facet as usize);
            let normals = normals.map(|facet| self.solid.normals[facet] * self.solid.areas[facet]);
            let cylinder = Cylinder::fit(&points, normals)?;
            let is_on = |points: &[Place]| {
                points
                    .iter()
                    .all(|p| cylinder.coordinates(p)[2].abs() <= near)
            };
            if !is_on(&points) {
                return None;
            }
            let all = grow(&self.around, facets[0], |_, facet| {
                is_on(&self.points(&[facet]))
            });
            if all.len() <= facets.len() {
                let angles = points.iter().map(|p| cylinder.coordinates(p)[0]);
                let [low, high] = angles.fold([f64::MAX, f64::MIN], |[low, high], a| {
                    [low.min(a), high.max(a)]
                });
                return (high - low <= MAX_BEND_ANGLE).then_some((cylinder, facets));
            }
            facets = all;
        }
    }
}

impl Roll {
    /// Whether a point lies on the cylinder beyond the line at which a face touches it.
    fn begins_at(&self, place: &Place, near: f64) -> bool {
        let [angle, _, off] = self.cylinder.coordinates(place);
        let mut touches = self.faces.iter().map(|(_, touch)| *touch);
        // Angles are counted from the middle.
        let is_beyond = |touch: f64| (touch - angle) * touch.signum() * self.cylinder.radius > near;
        off.abs() <= near && touches.all(is_beyond)
    }

    /// Angle of a point around the axis, as if faces that touch the cylinder were rolled onto it; `None` if it is on neither.
    fn angle(&self, place: &Place, solid: &Polyhedron, near: f64) -> Option<f64> {
        let [angle, _, off] = self.cylinder.coordinates(place);
        if off.abs() <= near {
            return Some(angle);
        }
        let mut found = self.faces.iter().filter_map(|(face, touch)| {
            let out = self.cylinder.outward(*touch);
            let from = place - (self.cylinder.centre + out * self.cylinder.radius);
            let is_in = solid.normals[*face as usize].dot(&from).abs() <= near;
            is_in.then(|| touch + self.cylinder.along.cross(&out).dot(&from) / self.cylinder.radius)
        });
        found.next()
    }
}

struct Division<'a> {
    solid: &'a Polyhedron,
    places: Vec<Place>,
    faces: KnownFaces,
}

impl Division<'_> {
    /// Divides the triangles of a bend along its rulings, and lays them flat; `None` where two faces touch one side of it, as tabs do.
    fn divide(&mut self, roll: &Roll) -> Option<()> {
        let (solid, cylinder) = (self.solid, &roll.cylinder);
        let near = MAX_DISTANCE_ROUNDINGS * solid.rounding;
        let own = &roll.triangles;
        let mut angles: FxHashMap<u32, [f64; 2]> = FxHashMap::default();
        for v in own.iter().flat_map(|t| solid.triangles[*t]) {
            let place = solid.places[v as usize];
            if let Some(angle) = roll.angle(&place, solid, near) {
                angles.insert(v, [angle, cylinder.coordinates(&place)[1]]);
            }
        }
        // The bend ends where faces touch it, or where the mesh does.
        let mut ends = angles
            .values()
            .fold([f64::MAX, f64::MIN], |[low, high], [a, _]| {
                [low.min(*a), high.max(*a)]
            });
        let middle = 0.5 * (ends[0] + ends[1]);
        let mut beyond = [None; 2];
        for (face, touch) in &roll.faces {
            let k = usize::from(*touch > middle);
            ends[k] = *touch;
            let frame = (*face, self.largest_triangle(*face));
            if beyond[k].replace(frame).is_some() {
                return None;
            }
        }
        let span = ends[1] - ends[0];
        let count = (span / MAX_STRIP_ANGLE).ceil().max(1.0) as u32;
        let line = |k: u32| ends[0] + span * f64::from(k) / f64::from(count);
        // Points next to a line lie on it.
        for [angle, _] in angles.values_mut() {
            let nearest = (0..=count)
                .map(line)
                .min_by(|a, b| (a - *angle).abs().total_cmp(&(b - *angle).abs()));
            if let Some(line) =
                nearest.filter(|line| (line - *angle).abs() * cylinder.radius <= near)
            {
                *angle = line;
            }
        }
        let first = self.faces.normals.len() as u32;
        let normals =
            (0..count).map(|k| cylinder.outward(0.5 * (line(k) + line(k + 1))) * roll.side);
        self.faces.normals.extend(normals);
        let mut crossings: FxHashMap<([u32; 2], u32), u32> = FxHashMap::default();
        for t in own.iter().copied() {
            // The triangle's corners and the points where its sides cross lines.
            let mut ring: Vec<u32> = Vec::new();
            for half in 3 * t as u32..3 * t as u32 + 3 {
                let [v, w] = half_edge_ends(&solid.triangles, half);
                ring.push(v);
                let ([from, low], [to, high]) = (angles[&v], angles[&w]);
                let mut crossed: Vec<u32> = (0..=count)
                    .filter(|k| (line(*k) - from) * (line(*k) - to) < 0.0)
                    .collect();
                if to < from {
                    crossed.reverse();
                }
                for k in crossed {
                    let number = *crossings
                        .entry(([v.min(w), v.max(w)], k))
                        .or_insert_with(|| {
                            let high = low + (high - low) * (line(k) - from) / (to - from);
                            let out = cylinder.outward(line(k)) * cylinder.radius;
                            self.places
                                .push(cylinder.centre + out + cylinder.along * high);
                            let number = self.places.len() as u32 - 1;
                            angles.insert(number, [line(k), high]);
                            number
                        });
                    ring.push(number);
                }
            }
            let below = (f64::MIN, line(0), beyond[0]);
            let above = (line(count), f64::MAX, beyond[1]);
            let strips = (0..count).map(|k| (line(k), line(k + 1), None));
            for (k, (low, high, face)) in (0..count).zip(strips).chain([(0, below), (0, above)]) {
                let is_in = |v: &&u32| (low..=high).contains(&angles[*v][0]);
                let piece: Vec<u32> = ring.iter().filter(is_in).copied().collect();
                let corners = (2..piece.len()).map(|i| [piece[0], piece[i - 1], piece[i]]);
                for corners in
                    corners.filter(|all| all.iter().any(|v| angles[v][0] != angles[&all[0]][0]))
                {
                    let (number, flat) = match face {
                        None => (
                            first + k,
                            corners.map(|v| {
                                Point2::new(
                                    roll.side * cylinder.radius * angles[&v][0],
                                    angles[&v][1],
                                )
                            }),
                        ),
                        Some((face, frame)) => (
                            face,
                            corners.map(|v| self.flat_beside(frame, &self.places[v as usize])),
                        ),
                    };
                    self.faces.push(corners, number, flat);
                }
            }
        }
        Some(())
    }

    /// The largest triangle of a face.
    fn largest_triangle(&self, face: u32) -> usize {
        let solid = self.solid;
        let own = (0..solid.triangles.len()).filter(|t| solid.facets[*t] == face);
        let size = |t: &usize| {
            let [a, b, c] = solid.corners(*t);
            (b - a).cross(&(c - a)).norm()
        };
        own.max_by(|s, t| size(s).total_cmp(&size(t))).unwrap_or(0)
    }

    /// Position of a place in the flattened plane of a triangle.
    fn flat_beside(&self, t: usize, place: &Place) -> Point2 {
        let solid = self.solid;
        let ([a, b, c], [p, q, r]) = (solid.corners(t), solid.flat[t]);
        let normal = (b - a).cross(&(c - a));
        let share = |edge: Place| normal.dot(&edge.cross(&(place - a))) / normal.norm_squared();
        p + (q - p) * -share(c - a) + (r - p) * share(b - a)
    }
}

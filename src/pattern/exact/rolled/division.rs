//! Divides the triangles of a bend along its rulings.

use std::f64::consts::TAU;

use rustc_hash::FxHashMap;

use super::lines::Lines;
use super::roll::{Roll, tolerance};
use crate::math::index::NO_INDEX;
use crate::math::planar::{Point2, polygon_area};
use crate::scene::half_edges::half_edge_ends;
use crate::scene::polyhedron::{KnownFaces, MAX_BEND_STEP, Place, Polyhedron};

/// The faces of a mesh whose bends are divided one after another.
pub(super) struct Division<'a> {
    solid: &'a Polyhedron,
    places: Vec<Place>,
    faces: KnownFaces,
    /// The largest triangle of each facet.
    largest: Vec<usize>,
    /// Whether each triangle belongs to a bend that is divided.
    is_divided: Vec<bool>,
    /// Vertices at which lines of bends cross edges, from the lower vertex of the edge on.
    crossings: FxHashMap<[u32; 2], Vec<(f64, u32)>>,
}

/// A corner of a bend's triangles, or a point where a line crosses one of their sides.
struct Corner {
    vertex: u32,
    angle: f64,
    high: f64,
    /// Whether it is the tip of a cone, which lies on all rulings.
    is_tip: bool,
}

/// The corners of a bend's triangles, in the coordinates of its surface.
struct Corners<'a> {
    roll: &'a Roll,
    /// Angle and height of each vertex; no angle at a tip.
    at: FxHashMap<u32, (Option<f64>, f64)>,
}

impl Corners<'_> {
    /// `None` if one of them is neither on the surface nor on a face that touches it.
    fn new<'a>(roll: &'a Roll, solid: &Polyhedron) -> Option<Corners<'a>> {
        let near = tolerance(solid);
        let vertices = roll.triangles.iter().flat_map(|t| solid.triangles[*t]);
        let at = vertices.map(|v| {
            let place = solid.places[v as usize];
            let [angle, high] = roll.coordinates(&place, solid, near)?;
            let is_tip = roll.surface.is_tip(&place, near);
            Some((v, ((!is_tip).then_some(angle), high)))
        });
        Some(Corners {
            roll,
            at: at.collect::<Option<_>>()?,
        })
    }

    /// The least and the largest angle.
    fn ends(&self) -> [f64; 2] {
        let angles = self.at.values().filter_map(|(angle, _)| *angle);
        angles.fold([f64::MAX, f64::MIN], |[low, high], a| {
            [low.min(a), high.max(a)]
        })
    }

    /// The corners of a triangle, their angles next to each other. A tip is where the others are.
    fn of(&self, vertices: [u32; 3]) -> [Corner; 3] {
        let all = vertices.map(|v| self.at[&v]);
        let base = all.iter().find_map(|(angle, _)| *angle).unwrap_or(0.0);
        let near = |angle: f64| match self.roll.is_ring {
            true => angle - TAU * ((angle - base) / TAU).round(),
            false => angle,
        };
        let known = all.iter().filter_map(|(angle, _)| angle.map(near));
        let mean = known.clone().sum::<f64>() / known.count().max(1) as f64;
        [0, 1, 2].map(|k| Corner {
            vertex: vertices[k],
            angle: all[k].0.map_or(mean, near),
            high: all[k].1,
            is_tip: all[k].0.is_none(),
        })
    }
}

impl<'a> Division<'a> {
    pub(super) fn new(solid: &'a Polyhedron) -> Division<'a> {
        Division {
            solid,
            places: solid.places.clone(),
            faces: KnownFaces {
                normals: solid.normals.clone(),
                ..KnownFaces::default()
            },
            largest: solid.largest_triangles(),
            is_divided: vec![false; solid.triangles.len()],
            crossings: FxHashMap::default(),
        }
    }

    /// Divides the triangles of a bend, and lays them flat; `None` where they are part of another one, or two faces touch one
    /// side of it, as tabs do, or where they lie on the surface otherwise than a sheet does.
    pub(super) fn divide(&mut self, roll: &Roll) -> Option<()> {
        let (solid, surface) = (self.solid, &roll.surface);
        for t in &roll.triangles {
            if std::mem::replace(&mut self.is_divided[*t], true) {
                return None;
            }
        }
        let mut corners = Corners::new(roll, solid)?;
        let mut ends = corners.ends();
        // The bend ends where faces touch it, on either side of its middle, or where the mesh does.
        let mut beyond = [None; 2];
        for (face, touch) in &roll.faces {
            let k = usize::from(*touch > 0.0);
            ends[k] = *touch;
            if beyond[k].replace(*face).is_some() {
                return None;
            }
        }
        let near = tolerance(solid) / surface.radius().abs();
        let lines = match surface.edges() {
            Some(edges) => Lines::at(edges.to_vec(), roll.is_ring),
            None => {
                let between = (!roll.is_ring).then_some(ends);
                Lines::new(self.rim_angles(&corners), between, near)
            }
        };
        // Points next to a line lie on it.
        for angle in corners.at.values_mut().filter_map(|at| at.0.as_mut()) {
            *angle = lines.snapped(*angle, near);
        }
        let first = self.faces.normals.len() as u32;
        let normals = lines
            .strips()
            .map(|[from, to]| surface.normal(0.5 * (from + to)) * roll.side);
        self.faces.normals.extend(normals);
        let outside = [
            (f64::MIN, ends[0], beyond[0]),
            (ends[1], f64::MAX, beyond[1]),
        ];
        let outside: Vec<_> = outside
            .into_iter()
            .filter(|_| !roll.is_ring)
            .filter_map(|(low, high, face)| Some(([low, high], face?)))
            .map(|(between, face)| (between, face, self.largest[face as usize]))
            .collect();
        let (mut laid, mut whole) = (0.0, 0.0);
        for t in roll.triangles.iter().copied() {
            let own = corners.of(solid.triangles[t]);
            let range = [f64::min, f64::max]
                .map(|of| own[1..].iter().fold(own[0].angle, |a, c| of(a, c.angle)));
            // Slivers along a rim face no side.
            let [a, b, c] = solid.corners(t);
            let size = 0.5 * (b - a).cross(&(c - a));
            let middle = own.iter().map(|corner| corner.angle / 3.0).sum();
            let faces_out = roll.side * surface.normal(middle).dot(&size) >= 0.5 * size.norm();
            let ring = self.ring(own, roll, &lines);
            let mut flat = 0.0;
            for (strip, between) in lines.strips_between(range) {
                flat += push(&mut self.faces, first + strip, &ring, between, |corner| {
                    let flat = surface.flat([corner.angle - between[0], corner.high]);
                    Point2::new(roll.side * flat.re, flat.im)
                });
            }
            for (between, face, frame) in &outside {
                flat += push(&mut self.faces, *face, &ring, *between, |corner| {
                    flat_beside(solid, *frame, &self.places[corner.vertex as usize])
                });
            }
            if faces_out {
                laid += flat;
                whole += size.norm();
            }
        }
        // An arc that turns by a step is longer than its chord by a 24th of the step's square.
        let longer = MAX_BEND_STEP * MAX_BEND_STEP / 24.0;
        ((laid - whole).abs() <= 2.0 * longer * whole).then_some(())
    }

    /// A triangle's corners and the points where its sides cross lines.
    fn ring(&mut self, own: [Corner; 3], roll: &Roll, lines: &Lines) -> Vec<Corner> {
        let mut ring = Vec::new();
        for k in 0..3 {
            let (from, to) = (&own[k], &own[(k + 1) % 3]);
            let mut crossed = Vec::new();
            if !from.is_tip && !to.is_tip {
                crossed = lines.crossed([from.angle, to.angle]);
            }
            ring.push(Corner { ..*from });
            for angle in crossed {
                let at = [[from.angle, from.high], [to.angle, to.high]];
                let high = roll.surface.crossing(angle, at);
                let share = (angle - from.angle) / (to.angle - from.angle);
                let place = roll.surface.place([angle, high]);
                ring.push(Corner {
                    vertex: self.crossing([from.vertex, to.vertex], share, place),
                    angle,
                    high,
                    is_tip: false,
                });
            }
        }
        ring
    }

    /// Angles of the vertices of a bend's rims.
    fn rim_angles(&self, corners: &Corners) -> Vec<f64> {
        let solid = self.solid;
        let is_own = |half: u32| {
            let twin = solid.twins[half as usize];
            twin != NO_INDEX && self.is_divided[twin as usize / 3] && solid.is_step(half)
        };
        let triangles = corners.roll.triangles.iter();
        let sides = triangles.flat_map(|t| 3 * *t as u32..3 * *t as u32 + 3);
        let rims = sides.filter(|half| !is_own(*half));
        let ends = rims.flat_map(|half| half_edge_ends(&solid.triangles, half));
        ends.filter_map(|v| corners.at[&v].0).collect()
    }

    /// The vertex at which a line crosses an edge, at this share of its length.
    fn crossing(&mut self, [v, w]: [u32; 2], share: f64, place: Place) -> u32 {
        let (key, share) = if v < w {
            ([v, w], share)
        } else {
            ([w, v], 1.0 - share)
        };
        let own = self.crossings.entry(key).or_default();
        if let Some((_, node)) = own.iter().find(|(at, _)| (at - share).abs() < 1e-9) {
            return *node;
        }
        let node = self.places.len() as u32;
        self.places.push(place);
        own.push((share, node));
        node
    }

    /// The faces of the whole mesh: those of the bends, and all others, whose sides are divided where lines of bends meet them.
    pub(super) fn into_polyhedron(mut self) -> Polyhedron {
        let solid = self.solid;
        for own in self.crossings.values_mut() {
            own.sort_by(|a, b| a.0.total_cmp(&b.0));
        }
        for t in (0..solid.triangles.len()).filter(|t| !self.is_divided[*t]) {
            let mut open = vec![(solid.triangles[t], solid.flat[t])];
            while let Some((corners, flat)) = open.pop() {
                let divided = (0..3).find_map(|k| {
                    let [v, w] = [corners[k], corners[(k + 1) % 3]];
                    let own = self.crossings.get(&[v.min(w), v.max(w)])?;
                    Some((k, v < w, own))
                });
                let Some((k, is_forward, own)) = divided else {
                    self.faces.push(corners, solid.facets[t], flat);
                    continue;
                };
                let [v, w, u] = [0, 1, 2].map(|j| (corners[(k + j) % 3], flat[(k + j) % 3]));
                let mut nodes: Vec<(u32, Point2)> = own
                    .iter()
                    .map(|(share, node)| {
                        let share = if is_forward { *share } else { 1.0 - share };
                        (*node, v.1 + (w.1 - v.1) * share)
                    })
                    .collect();
                if !is_forward {
                    nodes.reverse();
                }
                let line: Vec<(u32, Point2)> = std::iter::once(v).chain(nodes).chain([w]).collect();
                open.extend(line.windows(2).map(|pair| {
                    let all = [pair[0], pair[1], u];
                    (all.map(|(v, _)| v), all.map(|(_, flat)| flat))
                }));
            }
        }
        Polyhedron::from_faces(self.places, self.faces, tolerance(solid))
    }
}

/// Adds the part of a triangle between two angles to a face; returns its area as it lies flat.
fn push(
    faces: &mut KnownFaces,
    number: u32,
    ring: &[Corner],
    [low, high]: [f64; 2],
    flat: impl Fn(&Corner) -> Point2,
) -> f64 {
    let is_in = |corner: &&Corner| corner.is_tip || (low..=high).contains(&corner.angle);
    let piece: Vec<&Corner> = ring.iter().filter(is_in).collect();
    let mut area = 0.0;
    for i in 2..piece.len() {
        let part = [piece[0], piece[i - 1], piece[i]];
        if part.iter().all(|corner| corner.angle == part[0].angle) {
            continue;
        }
        let flat = part.map(&flat);
        area += polygon_area(&flat);
        faces.push(part.map(|corner| corner.vertex), number, flat);
    }
    area
}

/// Position of a place in the flattened plane of a triangle.
fn flat_beside(solid: &Polyhedron, t: usize, place: &Place) -> Point2 {
    let ([a, b, c], [p, q, r]) = (solid.corners(t), solid.flat[t]);
    let normal = (b - a).cross(&(c - a));
    let share = |edge: Place| normal.dot(&edge.cross(&(place - a))) / normal.norm_squared();
    p + (q - p) * -share(c - a) + (r - p) * share(b - a)
}

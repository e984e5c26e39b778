//! Divides the triangles of a bend along its rulings.

use std::f64::consts::{PI, TAU};

use rustc_hash::FxHashMap;

use super::super::patches::MAX_BEND_CURVATURE_RATIO;
use super::roll::{MAX_DISTANCE_ROUNDINGS, Roll};
use crate::math::index::NO_INDEX;
use crate::math::planar::{Point2, polygon_area};
use crate::scene::half_edges::half_edge_ends;
use crate::scene::polyhedron::{KnownFaces, MAX_BEND_STEP, Place, Polyhedron};

/// Maximum angle of a strip of a bend, in radians. `benches/patterns.md` has what others give.
const MAX_STRIP_ANGLE: f64 = 0.15;

/// The faces of a mesh whose bends are divided one after another.
pub(super) struct Division<'a> {
    solid: &'a Polyhedron,
    places: Vec<Place>,
    faces: KnownFaces,
    /// Whether each triangle belongs to a bend that is divided.
    is_divided: Vec<bool>,
    /// Vertices at which lines of bends cross edges, from the lower vertex of the edge on.
    crossings: FxHashMap<[u32; 2], Vec<(f64, u32)>>,
}

/// The corners of a bend's triangles, in the coordinates of its surface.
struct Corners<'a> {
    roll: &'a Roll,
    /// Angle and height of each vertex; no angle at a tip.
    at: FxHashMap<u32, (Option<f64>, f64)>,
}

impl Corners<'_> {
    /// Angle and height of a triangle's corners, the angles next to each other. A tip is where the others are.
    fn of(&self, corners: [u32; 3]) -> [[f64; 2]; 3] {
        let all = corners.map(|v| self.at[&v]);
        let base = all.iter().find_map(|(angle, _)| *angle).unwrap_or(0.0);
        let near = |angle: f64| match self.roll.is_ring {
            true => angle - TAU * ((angle - base) / TAU).round(),
            false => angle,
        };
        let known = all.iter().filter_map(|(angle, _)| angle.map(near));
        let mean = known.clone().sum::<f64>() / known.count().max(1) as f64;
        all.map(|(angle, high)| [angle.map_or(mean, near), high])
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
            is_divided: vec![false; solid.triangles.len()],
            crossings: FxHashMap::default(),
        }
    }

    /// Divides the triangles of a bend, and lays them flat; `None` where they are part of another one, or two faces touch one
    /// side of it, as tabs do, or where they lie on the surface otherwise than a sheet does.
    pub(super) fn divide(&mut self, roll: &Roll) -> Option<()> {
        let (solid, surface) = (self.solid, &roll.surface);
        let near = MAX_DISTANCE_ROUNDINGS * solid.rounding;
        for t in &roll.triangles {
            if std::mem::replace(&mut self.is_divided[*t], true) {
                return None;
            }
        }
        let mut corners = Corners {
            roll,
            at: FxHashMap::default(),
        };
        for v in roll.triangles.iter().flat_map(|t| solid.triangles[*t]) {
            let place = solid.places[v as usize];
            let [angle, high] = roll.coordinates(&place, solid, near)?;
            let is_tip = surface.is_tip(&place, near);
            corners.at.insert(v, ((!is_tip).then_some(angle), high));
        }
        let mut beyond = [None; 2];
        let mut ends = match roll.is_ring {
            true => [-PI, PI],
            false => (corners.at.values().filter_map(|(angle, _)| *angle))
                .fold([f64::MAX, f64::MIN], |[low, high], a| {
                    [low.min(a), high.max(a)]
                }),
        };
        // The bend ends where faces touch it, on either side of its middle, or where the mesh does.
        for (face, touch) in &roll.faces {
            let k = usize::from(*touch > 0.0);
            ends[k] = *touch;
            let frame = (*face, self.largest_triangle(*face));
            if beyond[k].replace(frame).is_some() {
                return None;
            }
        }
        let lines = self.lines(&corners, ends);
        // Points next to a line lie on it.
        for (angle, _) in corners.at.values_mut() {
            let Some(angle) = angle else {
                continue;
            };
            let after = lines.partition_point(|line| line < angle);
            let beside = [after.saturating_sub(1), after.min(lines.len() - 1)].map(|k| lines[k]);
            let found = beside
                .iter()
                .find(|line| (*line - *angle).abs() * surface.radius <= near);
            *angle = found.copied().unwrap_or(*angle);
        }
        let count = lines.len() - 1;
        let first = self.faces.normals.len() as u32;
        let normals = lines
            .windows(2)
            .map(|pair| surface.normal(0.5 * (pair[0] + pair[1])) * roll.side);
        self.faces.normals.extend(normals);
        // The line with a number, and those of a ring again on either side.
        let turn = ends[1] - ends[0];
        let line = |k: i64| {
            let (turns, k) = match roll.is_ring {
                true => (k.div_euclid(count as i64), k.rem_euclid(count as i64)),
                false => (0, k),
            };
            lines[k as usize] + turn * turns as f64
        };
        let numbers = match roll.is_ring {
            true => -(count as i64)..=2 * count as i64,
            false => 0..=count as i64,
        };
        let (mut laid, mut whole) = (0.0, 0.0);
        for t in roll.triangles.iter().copied() {
            // The triangle's corners and the points where its sides cross lines.
            let own = solid.triangles[t];
            let at = corners.of(own);
            // Slivers along a rim face no side.
            let [a, b, c] = solid.corners(t);
            let size = 0.5 * (b - a).cross(&(c - a));
            let middle = at.iter().map(|[angle, _]| angle / 3.0).sum();
            let faces_out = roll.side * surface.normal(middle).dot(&size) >= 0.5 * size.norm();
            if faces_out {
                whole += size.norm();
            }
            let mut ring: Vec<(u32, [f64; 2])> = Vec::new();
            for k in 0..3 {
                let ([v, w], [from, to]) = ([own[k], own[(k + 1) % 3]], [at[k], at[(k + 1) % 3]]);
                ring.push((v, from));
                if [v, w].iter().any(|v| corners.at[v].0.is_none()) {
                    continue;
                }
                let is_between = |k: &i64| (line(*k) - from[0]) * (line(*k) - to[0]) < 0.0;
                let mut crossed: Vec<i64> = numbers.clone().filter(is_between).collect();
                if to[0] < from[0] {
                    crossed.reverse();
                }
                for k in crossed {
                    let high = surface.crossing(line(k), [from, to]);
                    let share = (line(k) - from[0]) / (to[0] - from[0]);
                    let node = self.crossing([v, w], share, surface.place([line(k), high]));
                    ring.push((node, [line(k), high]));
                }
            }
            let [low, high] = at.iter().fold([f64::MAX, f64::MIN], |[low, high], [a, _]| {
                [low.min(*a), high.max(*a)]
            });
            let is_tip = |v: u32| corners.at.get(&v).is_some_and(|(angle, _)| angle.is_none());
            let strips = numbers.clone().take_while(|k| k < numbers.end());
            let strips = strips.filter(|k| line(*k) < high && line(*k + 1) > low);
            let strips = strips.map(|k| {
                (
                    line(k),
                    line(k + 1),
                    first + k.rem_euclid(count as i64) as u32,
                    None,
                )
            });
            let outside = [
                (f64::MIN, ends[0], beyond[0]),
                (ends[1], f64::MAX, beyond[1]),
            ];
            let outside = outside.into_iter().filter(|_| !roll.is_ring);
            let outside = outside.filter_map(|(low, high, face)| Some((low, high, face?.0, face)));
            let strips: Vec<_> = strips.chain(outside).collect();
            for (low, high, number, face) in strips {
                let is_in =
                    |(v, [angle, _]): &&(u32, [f64; 2])| (low..=high).contains(angle) || is_tip(*v);
                let piece: Vec<&(u32, [f64; 2])> = ring.iter().filter(is_in).collect();
                for i in 2..piece.len() {
                    let part = [piece[0], piece[i - 1], piece[i]];
                    let is_wide = |p: &&(u32, [f64; 2])| p.1[0] != part[0].1[0];
                    if !part.iter().any(is_wide) {
                        continue;
                    }
                    let flat = part.map(|(v, [angle, high])| match face {
                        Some((_, frame)) => self.flat_beside(frame, &self.places[*v as usize]),
                        None => {
                            let flat = surface.flat([angle - low, *high]);
                            Point2::new(roll.side * flat.re, flat.im)
                        }
                    });
                    if faces_out {
                        laid += polygon_area(&flat);
                    }
                    self.faces.push(part.map(|(v, _)| *v), number, flat);
                }
            }
        }
        // An arc that turns by a step is longer than its chord by a 24th of the step's square.
        let longer = MAX_BEND_STEP * MAX_BEND_STEP / 24.0;
        ((laid - whole).abs() <= 2.0 * longer * whole).then_some(())
    }

    /// Angles of the lines that divide a bend between two angles: at the corners of its rims if the strips are alike then, else evenly.
    fn lines(&self, corners: &Corners, ends: [f64; 2]) -> Vec<f64> {
        let (solid, roll) = (self.solid, corners.roll);
        let span = ends[1] - ends[0];
        let is_own = |half: u32| {
            let twin = solid.twins[half as usize];
            twin != NO_INDEX && self.is_divided[twin as usize / 3] && solid.is_step(half)
        };
        let sides = roll.triangles.iter();
        let sides = sides.flat_map(|t| 3 * *t as u32..3 * *t as u32 + 3);
        let rims = sides.filter(|half| !is_own(*half));
        let rims = rims.flat_map(|half| half_edge_ends(&solid.triangles, half));
        let mut lines: Vec<f64> = rims.filter_map(|v| corners.at[&v].0).collect();
        lines.sort_by(f64::total_cmp);
        let near = MAX_DISTANCE_ROUNDINGS * solid.rounding / roll.surface.radius.abs();
        lines.dedup_by(|a, b| *a - *b <= near);
        match roll.is_ring {
            true => {
                let first = lines.first().copied().unwrap_or(ends[0]);
                lines.retain(|line| *line < first + span - near);
                lines.push(first + span);
            }
            false => {
                lines.retain(|line| ends[0] + near < *line && *line < ends[1] - near);
                lines.insert(0, ends[0]);
                lines.push(ends[1]);
            }
        }
        let gaps = lines.windows(2).map(|pair| pair[1] - pair[0]);
        let [least, most] = gaps.fold([f64::MAX, 0.0], |[least, most], gap| {
            [least.min(gap), f64::max(most, gap)]
        });
        if most > MAX_BEND_STEP.min(MAX_BEND_CURVATURE_RATIO * least) {
            let count = (span / MAX_STRIP_ANGLE).ceil().max(1.0);
            let line = |k: u32| ends[0] + span * f64::from(k) / count;
            lines = (0..count as u32).map(line).collect();
            lines.push(ends[1]);
        }
        lines
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
        let rounding = MAX_DISTANCE_ROUNDINGS * solid.rounding;
        Polyhedron::from_faces(self.places, self.faces, rounding)
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

//! The lines between the parts of a body, along which these are joined to sheets or cut.

use std::collections::BTreeMap;

use super::body::{Body, Place};
use crate::math::index::NO_INDEX;
use crate::scene::half_edges::{half_edge_ends, next_half_edge, twin_half_edges};
use crate::shape::patches::chains::chains;

/// A seam: a line of edges of a mesh along which two parts meet.
pub(super) struct Seam {
    /// Numbers of the two parts (regions laid flat by themselves) at the seam, the lower one first.
    pub parts: [u32; 2],
    pub vertices: Vec<u32>,
    /// For each edge of the seam, in order, the numbers of the two half-edges on its sides.
    pub sides: Vec<[u32; 2]>,
    pub length: f64,
    /// Whether the seam is a cut inside of a patch and not a crease.
    pub smooth: bool,
    /// Mean fold angle along the seam, in radians; positive for a ridge.
    pub angle: f64,
    /// Number of the line that the seam is a part of, and of the line's edge at which it begins.
    line: [usize; 2],
}

/// The seams between the parts of a mesh, and the number of the seam that each half-edge is on.
pub(super) struct Seams {
    pub all: Vec<Seam>,
    of: Vec<u32>,
    /// Opposite of each half-edge of the mesh, or [`NO_INDEX`] at its border.
    pub twins: Vec<u32>,
}

impl Seams {
    /// Finds the seams of a mesh: the lines of edges between two parts. Inside of a patch such a line is a crease if its mean fold angle is
    /// above `bend`, in radians. Fold angles are those between the normals at a distance of `crease_width` from the line.
    pub(super) fn new(body: &Body, bend: f64, crease_width: f64) -> Seams {
        let twins = twin_half_edges(&body.triangles);
        let mut between: BTreeMap<[u32; 2], Vec<[u32; 2]>> = BTreeMap::new();
        for (side, twin) in (0u32..).zip(&twins).filter(|(_, twin)| **twin != NO_INDEX) {
            let [a, b] = [side, *twin].map(|side| body.parts[side as usize / 3]);
            if a < b {
                between.entry([a, b]).or_default().push([side, *twin]);
            }
        }
        let mut seams = Seams {
            all: Vec::new(),
            of: vec![NO_INDEX; twins.len()],
            twins,
        };
        let pointed = body.pointed();
        for (parts, pairs) in between {
            let edges: Vec<[u32; 2]> = pairs
                .iter()
                .map(|p| half_edge_ends(&body.triangles, p[0]))
                .collect();
            for chain in chains(&edges, |vertex| pointed[vertex as usize]) {
                let sides: Vec<[u32; 2]> = chain.edges.iter().map(|edge| pairs[*edge]).collect();
                let is_one = is_one(body, sides[0]);
                let width = if is_one { 0.0 } else { crease_width };
                let folds = sides
                    .iter()
                    .map(|pair| fold(body, &seams.twins, *pair, width));
                let folds: Vec<(f64, f64)> = folds.collect();
                let angle = mean(&folds);
                seams.add(Seam {
                    parts,
                    smooth: is_one && angle.abs() <= bend,
                    vertices: chain.vertices,
                    sides,
                    length: folds.iter().map(|(long, _)| long).sum(),
                    angle,
                    line: [seams.all.len(), 0],
                });
            }
        }
        seams
    }

    /// Divides a seam in two before one of its edges. Returns the number of the second one.
    pub(super) fn divide(&mut self, body: &Body, seam: usize, at: usize) -> usize {
        let first = &mut self.all[seam];
        let vertices = first.vertices.split_off(at);
        first.vertices.push(vertices[0]);
        let rest = Seam {
            line: [first.line[0], first.line[1] + at],
            sides: first.sides.split_off(at),
            length: length(body, &vertices),
            vertices,
            ..*first
        };
        first.length = length(body, &first.vertices);
        self.add(rest);
        self.all.len() - 1
    }

    /// Puts together what was divided of a seam where both parts are joined, or neither. Returns the new number of each seam.
    pub(super) fn put_together(&mut self, is_whole: &[bool]) -> Vec<usize> {
        let mut order: Vec<usize> = (0..self.all.len()).collect();
        order.sort_by_key(|seam| self.all[*seam].line);
        let mut old: Vec<Option<Seam>> = self.all.drain(..).map(Some).collect();
        let mut numbers = vec![0; old.len()];
        let mut last = None;
        for seam in order {
            let Some(next) = old[seam].take() else {
                continue;
            };
            let key = (next.line[0], is_whole[seam]);
            match self.all.last_mut() {
                Some(seam) if last == Some(key) => {
                    seam.vertices.extend(&next.vertices[1..]);
                    seam.sides.extend(next.sides);
                    seam.length += next.length;
                }
                _ => self.all.push(next),
            }
            last = Some(key);
            numbers[seam] = self.all.len() - 1;
        }
        for seam in self.of.iter_mut().filter(|seam| **seam != NO_INDEX) {
            *seam = numbers[*seam as usize] as u32;
        }
        numbers
    }

    fn add(&mut self, seam: Seam) {
        for side in seam.sides.as_flattened() {
            self.of[*side as usize] = self.all.len() as u32;
        }
        self.all.push(seam);
    }

    /// Computes the opposite of each half-edge of some triangles; [`NO_INDEX`] where the opposite triangle is not among
    /// them, or where the seam is not joined.
    pub(super) fn twins(&self, members: &[u32], is_whole: impl Fn(usize) -> bool) -> Vec<u32> {
        let mut numbers = vec![NO_INDEX; self.twins.len() / 3];
        for (number, t) in (0..).zip(members) {
            numbers[*t as usize] = number;
        }
        let sides = members.iter().flat_map(|t| 3 * t..3 * t + 3);
        let twin = |side: u32| {
            let twin = self.twins[side as usize];
            if twin == NO_INDEX || self.of(side).is_some_and(|seam| !is_whole(seam)) {
                return NO_INDEX;
            }
            match numbers[twin as usize / 3] {
                NO_INDEX => NO_INDEX,
                number => 3 * number + twin % 3,
            }
        };
        sides.map(twin).collect()
    }

    /// Returns the number of the seam that a half-edge is on; `None` if it is on no seam.
    pub(super) fn of(&self, side: u32) -> Option<usize> {
        let seam = self.of[side as usize];
        (seam != NO_INDEX).then_some(seam as usize)
    }
}

/// Length of a line along edges of a mesh.
fn length(body: &Body, vertices: &[u32]) -> f64 {
    let pairs = vertices.windows(2);
    pairs
        .map(|p| (body.places[p[1] as usize] - body.places[p[0] as usize]).norm())
        .sum()
}

/// Returns whether the triangles on both sides of an edge belong to one patch.
fn is_one(body: &Body, pair: [u32; 2]) -> bool {
    let [a, b] = pair.map(|side| body.patches[side as usize / 3]);
    a == b
}

/// Computes the mean fold angle of edges, weighted by the edges' lengths.
fn mean(folds: &[(f64, f64)]) -> f64 {
    let long: f64 = folds.iter().map(|(long, _)| long).sum();
    let bent: f64 = folds.iter().map(|(long, angle)| long * angle).sum();
    if long > 0.0 { bent / long } else { 0.0 }
}

/// Computes the length of an edge and the angle between the surfaces on both sides, in radians, at a distance from the edge; positive
/// for a ridge.
fn fold(body: &Body, twins: &[u32], [one, other]: [u32; 2], away: f64) -> (f64, f64) {
    let [a, b] = half_edge_ends(&body.triangles, one).map(|v| body.places[v as usize]);
    let [m, n] = [one, other].map(|side| normal_away(body, twins, side, away));
    let (along, cross) = (b - a, m.cross(&n));
    let angle = cross.norm().atan2(m.dot(&n));
    (along.norm(), angle.copysign(cross.dot(&along)))
}

/// Normal of the surface at a distance from an edge, along the straight line that leaves the edge at a right angle, or where that
/// line leaves the patch.
fn normal_away(body: &Body, twins: &[u32], mut side: u32, mut away: f64) -> Place {
    let ends = |side: u32| half_edge_ends(&body.triangles, side).map(|v| body.places[v as usize]);
    let normal = |side: u32| {
        let [a, b, c] = body.triangles[side as usize / 3].map(|v| body.places[v as usize]);
        let normal: Place = (b - a).cross(&(c - a));
        normal / normal.norm().max(f64::MIN_POSITIVE)
    };
    let [a, b] = ends(side);
    let mut at = (a + b) / 2.0;
    let mut up = normal(side);
    let mut way = up.cross(&(b - a)).normalize();
    // A straight line crosses few triangles for each length of an edge.
    let most = 8 + 4 * (away / body.spacing).ceil() as usize;
    for _ in 0..most {
        let next = next_half_edge(side);
        let exits = [next, next_half_edge(next)].map(|exit| {
            let [a, b] = ends(exit);
            let inwards = up.cross(&(b - a));
            let speed = -inwards.dot(&way);
            let far = inwards.dot(&(at - a)) / speed;
            (
                if speed > 0.0 {
                    far.max(0.0)
                } else {
                    f64::INFINITY
                },
                exit,
            )
        });
        let (far, exit) = if exits[0].0 <= exits[1].0 {
            exits[0]
        } else {
            exits[1]
        };
        let twin = twins[exit as usize];
        let is_same =
            |twin: u32| body.patches[twin as usize / 3] == body.patches[side as usize / 3];
        if far >= away || twin == NO_INDEX || !is_same(twin) {
            break;
        }
        (at, away) = (at + way * far, away - far);
        // Go straight on over the edge.
        let [a, b] = ends(exit);
        let along = (b - a).normalize();
        let (level, across) = (along.dot(&way), -up.cross(&along).dot(&way));
        up = normal(twin);
        way = along * level - up.cross(&along) * across;
        side = twin;
    }
    up
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_divided_is_put_together_where_it_is_alike() {
        // Two strips of squares beside each other.
        let places = (0..3).flat_map(|x| (0..9).map(move |y| Place::new(x.into(), y.into(), 0.0)));
        let cells = (0..2).flat_map(|x| (0..8).map(move |y| 9 * x + y));
        let triangles: Vec<[u32; 3]> = cells
            .flat_map(|a| [[a, a + 9, a + 10], [a, a + 10, a + 1]])
            .collect();
        let strips = (0..triangles.len() as u32).map(|t| t / 16).collect();
        let body = Body::new(places.collect(), triangles, strips).unwrap();
        let mut seams = Seams::new(&body, 0.3, 0.0);
        let before = seams.all[0].sides.clone();
        assert_eq!((seams.all.len(), before.len()), (1, 8));
        assert_eq!(seams.divide(&body, 0, 5), 1);
        assert_eq!(seams.divide(&body, 0, 2), 2);
        let lengths: Vec<f64> = seams.all.iter().map(|seam| seam.length).collect();
        assert_eq!(lengths, [2.0, 3.0, 3.0]);
        // From one end the pieces are the first, the last and the second.
        assert_eq!(seams.put_together(&[false, true, true]), [0, 1, 1]);
        assert_eq!(seams.all[1].length, 6.0);
        assert_eq!(seams.of(before[7][0]), Some(1));
        assert_eq!(seams.put_together(&[true, true]), [0, 0]);
        assert_eq!((seams.all.len(), &seams.all[0].sides), (1, &before));
        assert_eq!(seams.all[0].vertices.len(), 9);
    }
}

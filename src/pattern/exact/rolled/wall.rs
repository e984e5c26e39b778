//! Walls: surfaces of any profile, swept along one direction.

use std::f64::consts::{FRAC_1_SQRT_2, TAU};

use rustc_hash::{FxHashMap, FxHashSet};

use super::super::growth::grow;
use super::Search;
use super::cone::least_normal;
use super::roll::Roll;
use super::surface::Surface;
use crate::math::index::NO_INDEX;
use crate::math::planar::{Point2, distance, distance_to_segment, nearest_on_segment};
use crate::scene::polyhedron::{MAX_BEND_STEP, Place};

/// Maximum cosine of the angle between the rulings of a wall and the normal of one of its facets, which may reach over several chords of the
/// profile (`benches/exactness.md`).
const MAX_WALL_LEAN: f64 = 0.1;

/// Number of edges, the nearest to the rulings as the facets' normals show them, among which those along the rulings are looked for
/// (`benches/exactness.md`).
const MAX_WALL_EDGES: usize = 64;

/// Minimum share of the rulings from corners of a wall's rim that meet another one of them: few do by chance. No table chose it.
const MIN_SHARED_RULINGS: f64 = 0.75;

/// A wall: the direction of its rulings and two across, all right-handed, and its profile.
pub(super) struct Wall {
    along: Place,
    across: [Place; 2],
    /// The profile's corners in their order; of a closed one the first comes again at the end.
    corners: Vec<Point2>,
    /// Angle of each corner: an open profile is as long as one radian, a closed one as a turn.
    angles: Vec<f64>,
    /// How far a smooth curve through the corners may be from each side.
    bulges: Vec<f64>,
    radius: f64,
    is_closed: bool,
}

impl Wall {
    /// `None` where the profile turns by more than a bend does at a corner. The first corner of a closed profile comes again at the end.
    fn new(
        along: Place,
        across: [Place; 2],
        corners: Vec<Point2>,
        is_closed: bool,
    ) -> Option<Wall> {
        let sides: Vec<Point2> = corners.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let turn = |a: usize, b: usize| (sides[b] / sides[a]).arg().abs();
        let last = sides.len().checked_sub(1)?;
        let mut turns: Vec<f64> = (0..last).map(|k| turn(k, k + 1)).collect();
        if turns.iter().any(|turn| *turn > MAX_BEND_STEP) {
            return None;
        }
        // A closed profile may have a sharp edge.
        let closing = Some(turn(last, 0)).filter(|turn| is_closed && *turn <= MAX_BEND_STEP);
        turns.insert(0, closing.unwrap_or(0.0));
        turns.push(closing.unwrap_or(0.0));
        // A chord is off its arc by an eighth of its length for each radian.
        let bulge = |(side, turns): (&Point2, &[f64])| 0.25 * side.norm() * turns[0].max(turns[1]);
        let bulges = sides.iter().zip(turns.windows(2)).map(bulge).collect();
        let length: f64 = sides.iter().map(|side| side.norm()).sum();
        let radius = if is_closed { length / TAU } else { length };
        let mut angles = vec![0.0];
        for side in &sides {
            angles.push(angles[angles.len() - 1] + side.norm() / radius);
        }
        Some(Wall {
            along,
            across,
            corners,
            angles,
            bulges,
            radius,
            is_closed,
        })
    }

    /// The side of the profile at an angle, and the angle counted from where it begins.
    fn side(&self, angle: f64) -> (usize, f64) {
        let last = self.angles.len() - 2;
        let turns = if self.is_closed {
            (angle / TAU).floor()
        } else {
            0.0
        };
        let angle = angle - TAU * turns;
        let k = self.angles[1..=last].partition_point(|corner| *corner <= angle);
        (k, angle - self.angles[k])
    }

    fn along_side(&self, k: usize) -> Place {
        let side = self.corners[k + 1] - self.corners[k];
        (self.across[0] * side.re + self.across[1] * side.im) / side.norm()
    }
}

impl Surface for Wall {
    fn radius(&self) -> f64 {
        self.radius
    }

    fn coordinates(&self, place: &Place) -> [f64; 3] {
        let point = flat_across(&self.across, place);
        let away = |k: &usize| distance_to_segment(point, [self.corners[*k], self.corners[k + 1]]);
        let sides = 0..self.bulges.len();
        let k = sides
            .min_by(|j, k| away(j).total_cmp(&away(k)))
            .unwrap_or(0);
        let nearest = nearest_on_segment(point, [self.corners[k], self.corners[k + 1]]);
        let angle = self.angles[k] + distance(self.corners[k], nearest) / self.radius;
        let off = (distance(point, nearest) - self.bulges[k]).max(0.0);
        [angle, self.along.dot(place), off]
    }

    fn angle(&self, direction: &Place) -> f64 {
        let facing = |angle: &f64| self.normal(*angle).dot(direction);
        let middles = self.angles.windows(2).map(|pair| 0.5 * (pair[0] + pair[1]));
        middles
            .max_by(|a, b| facing(a).total_cmp(&facing(b)))
            .unwrap_or(0.0)
    }

    fn normal(&self, angle: f64) -> Place {
        self.along_side(self.side(angle).0).cross(&self.along)
    }

    fn ruling(&self, _: f64) -> Place {
        self.along
    }

    fn place(&self, [angle, high]: [f64; 2]) -> Place {
        let (k, from) = self.side(angle);
        let corner = self.corners[k];
        let origin = self.across[0] * corner.re + self.across[1] * corner.im;
        origin + self.along_side(k) * (from * self.radius) + self.along * high
    }

    fn is_tip(&self, _: &Place, _: f64) -> bool {
        false
    }

    fn flat(&self, [angle, high]: [f64; 2]) -> Point2 {
        Point2::new(self.radius * angle, high)
    }

    fn rolled(&self, touch: f64, from: Place) -> [f64; 2] {
        let aside = self.along_side(self.side(touch).0).dot(&from);
        [touch + aside / self.radius, self.along.dot(&from)]
    }

    fn crossing(&self, line: f64, [from, to]: [[f64; 2]; 2]) -> f64 {
        from[1] + (to[1] - from[1]) * (line - from[0]) / (to[0] - from[0])
    }

    fn edges(&self) -> Option<&[f64]> {
        Some(&self.angles)
    }
}

impl Search<'_> {
    /// The wall that some facets are part of, and all facets around them that might be; no wall unless the corners of its rims lie on
    /// common rulings.
    pub(super) fn wall(
        &self,
        near: &[u32],
        is_free: impl Fn(u32) -> bool,
    ) -> (Option<Roll>, Vec<u32>) {
        let solid = self.solid;
        let normal = |facet: &u32| solid.normals[*facet as usize] * solid.areas[*facet as usize];
        let lean = |along: &Place, facet: u32| solid.normals[facet as usize].dot(along).abs();
        let mut facets = near.to_vec();
        let mut along = Place::zeros();
        for _ in 0..2 {
            let normals: Vec<Place> = facets.iter().map(normal).collect();
            along = least_normal(&normals, Place::zeros());
            facets = grow(&self.around, near[0], |_, facet| {
                is_free(facet) && lean(&along, facet) <= MAX_WALL_LEAN
            });
        }
        let is_among = near.iter().all(|facet| facets.contains(facet));
        let mut found = is_among.then(|| self.wall_along(along, &facets)).flatten();
        // Small facets on the wall may lean more, and slivers face any side; those of a rim face along the rulings.
        if let Some(roll) = &found {
            let is_on = |facet: u32| {
                let mut points = self.points(&[facet]).into_iter();
                points.all(|p| roll.surface.coordinates(&p)[2] <= self.near)
            };
            let all = grow(&self.around, near[0], |_, facet| {
                let is_slender = self.is_slender[facet as usize];
                let faces_out = is_slender || lean(&along, facet) < FRAC_1_SQRT_2;
                roll.facets.contains(&facet) || is_free(facet) && faces_out && is_on(facet)
            });
            if all.len() > facets.len() {
                found = self.wall_along(along, &all);
                facets = all;
            }
        }
        (found, facets)
    }

    /// The wall of some facets whose rulings are nearly along a direction.
    fn wall_along(&self, nearly: Place, facets: &[u32]) -> Option<Roll> {
        let part = Part::new(self, facets);
        let along = part.along_edges(nearly)?;
        let first = along.cross(&Place::ith(along.iamin(), 1.0)).normalize();
        let across = [first, along.cross(&first)];
        let (corners, is_closed) = part.profile(along, &across)?;
        let wall = Wall::new(along, across, corners, is_closed)?;
        let is_on = |p: &Place| wall.coordinates(p)[2] <= self.near;
        if !self.points(facets).iter().all(is_on) {
            return None;
        }
        Some(Roll {
            surface: Box::new(wall),
            facets: facets.iter().copied().collect(),
            triangles: part.triangles,
            faces: Vec::new(),
            side: 1.0,
            is_ring: is_closed,
        })
    }
}

/// Facets that may be a wall.
struct Part<'a> {
    search: &'a Search<'a>,
    triangles: Vec<usize>,
    is_own: FxHashSet<usize>,
}

impl Part<'_> {
    fn new<'a>(search: &'a Search<'a>, facets: &[u32]) -> Part<'a> {
        let own = facets.iter().flat_map(|f| &search.triangles[*f as usize]);
        let triangles: Vec<usize> = own.map(|t| *t as usize).collect();
        Part {
            search,
            is_own: triangles.iter().copied().collect(),
            triangles,
        }
    }

    fn sides(&self) -> impl Iterator<Item = usize> {
        self.triangles.iter().flat_map(|t| 3 * t..3 * t + 3)
    }

    /// Whether the part goes on beyond a side, not over a sharp edge.
    fn goes_on(&self, side: usize) -> bool {
        let solid = self.search.solid;
        let twin = solid.twins[side];
        twin != NO_INDEX && self.is_own.contains(&(twin as usize / 3)) && {
            let [a, b] = [side as u32, twin].map(|side| solid.facet(side));
            a == b || self.search.around[a as usize].contains(&b)
        }
    }

    /// The direction along which most of the edges lie that are nearest to a given one, by their length.
    fn along_edges(&self, nearly: Place) -> Option<Place> {
        let near = self.search.near;
        let edge = |side: usize| {
            let [a, b] = self.search.solid.ends(side as u32);
            (b - a) * (b - a).dot(&nearly).signum()
        };
        let mut edges: Vec<Place> = self.sides().map(edge).collect();
        // The direction of a short edge is known less well.
        let off = |edge: &Place| (edge.cross(&nearly).norm() + 2.0 * near) / edge.norm();
        edges.sort_by(|a, b| off(a).total_cmp(&off(b)));
        edges.truncate(MAX_WALL_EDGES);
        let along = |direction: &Place| -> f64 {
            let is_along = |edge: &&Place| edge.cross(direction).norm() <= 2.0 * near;
            edges.iter().filter(is_along).map(|edge| edge.norm()).sum()
        };
        let directions = edges.iter().map(|edge| edge.normalize());
        directions.max_by(|a, b| along(a).total_cmp(&along(b)))
    }

    /// Where the corners of each triangle lie across the rulings, one triangle rolled off after another, and how far it is around, 0
    /// unless triangles meet again; `None` where the part is not in one piece.
    fn rolled_off(&self, along: Place) -> Option<(FxHashMap<usize, [f64; 3]>, f64)> {
        let solid = self.search.solid;
        let rolled = |t: usize, known: usize, here: f64| {
            let normal = solid.normals[solid.facets[t] as usize];
            let (ahead, corners) = (along.cross(&normal).normalize(), solid.corners(t));
            corners.map(|p| here + ahead.dot(&(p - corners[known])))
        };
        let first = *self.triangles.first()?;
        let mut aside = FxHashMap::from_iter([(first, rolled(first, 0, 0.0))]);
        let (mut open, mut next, mut around) = (vec![first], 0, 0.0_f64);
        while let Some(t) = open.get(next).copied() {
            next += 1;
            for k in (0..3).filter(|k| self.goes_on(3 * t + k)) {
                let twin = solid.twins[3 * t + k] as usize;
                let (other, end) = (twin / 3, (twin + 1) % 3);
                let here = aside[&t][k];
                let own = aside.entry(other).or_insert_with(|| {
                    open.push(other);
                    rolled(other, end, here)
                });
                around = around.max((own[end] - here).abs());
            }
        }
        let all = aside.values().flatten();
        let [low, high] = all.fold([f64::MAX, f64::MIN], |[low, high], s| {
            [low.min(*s), high.max(*s)]
        });
        // It is nearly the whole extent, or what rounding leaves.
        let around = if around > 0.5 * (high - low) {
            around
        } else {
            0.0
        };
        (aside.len() == self.triangles.len()).then_some((aside, around))
    }

    /// Corners of the profile, and whether it is closed: the first one comes again at its end. `None` if too few rulings from corners of
    /// the rims meet another one.
    fn profile(&self, along: Place, across: &[Place; 2]) -> Option<(Vec<Point2>, bool)> {
        let (solid, near) = (self.search.solid, self.search.near);
        let (aside, around) = self.rolled_off(along)?;
        let rims = self.sides().filter(|side| !self.goes_on(*side));
        let ends = rims.flat_map(|side| [side, side - side % 3 + (side + 1) % 3]);
        let mut ends: Vec<(f64, u32)> = ends
            .map(|end| {
                let s = aside[&(end / 3)][end % 3];
                let v = solid.triangles[end / 3][end % 3];
                (
                    if around > 0.0 {
                        s.rem_euclid(around)
                    } else {
                        s
                    },
                    v,
                )
            })
            .collect();
        ends.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        // Each with a vertex there, and whether there are several.
        let mut corners: Vec<(Point2, u32, bool)> = Vec::new();
        for (_, v) in ends {
            let point = flat_across(across, &solid.places[v as usize]);
            match corners.last_mut() {
                Some((last, own, is_shared)) if distance(*last, point) <= near => {
                    *is_shared |= *own != v;
                }
                _ => corners.push((point, v, false)),
            }
        }
        let (first, last) = (*corners.first()?, *corners.last()?);
        let meets = corners.len() > 2 && distance(first.0, last.0) <= near;
        if meets {
            corners.pop();
            corners[0].2 |= last.2 || first.1 != last.1;
        }
        let shared = corners.iter().filter(|(.., is_shared)| *is_shared).count();
        if (shared as f64) < MIN_SHARED_RULINGS * corners.len() as f64 {
            return None;
        }
        let mut points: Vec<Point2> = corners.into_iter().map(|(point, ..)| point).collect();
        let is_closed = meets || around > 0.0;
        if is_closed {
            let count = points.len();
            let turn = |k: &usize| {
                let [before, after] = [count - 1, 1].map(|step| points[(k + step) % count]);
                ((after - points[*k]) / (points[*k] - before)).arg().abs()
            };
            let sharpest = (0..count).max_by(|j, k| turn(j).total_cmp(&turn(k)))?;
            points.rotate_left(sharpest);
            points.push(points[0]);
        }
        // Corners at which it does not turn are none.
        let mut turning: Vec<Point2> = Vec::new();
        for (k, point) in points.iter().enumerate() {
            let beside = turning.last().zip(points.get(k + 1));
            if beside.is_none_or(|(a, b)| distance_to_segment(*point, [*a, *b]) > near) {
                turning.push(*point);
            }
        }
        Some((turning, is_closed))
    }
}

/// Coordinates of a place in two directions.
fn flat_across(across: &[Place; 2], place: &Place) -> Point2 {
    Point2::new(across[0].dot(place), across[1].dot(place))
}

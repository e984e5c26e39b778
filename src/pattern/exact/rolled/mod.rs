//! Bends that are walls of any profile, or parts of cylinders and circular cones, however they are triangulated: divided into strips along
//! their rulings, and rolled off.

mod cone;
mod division;
mod lines;
mod roll;
mod surface;
mod wall;

use std::f64::consts::{FRAC_PI_2, PI};

use rustc_hash::FxHashSet;

use super::FoundFaces;
use super::growth::grow;
use crate::math::index::NO_INDEX;
use crate::scene::exactness::Exactness;
use crate::scene::half_edges::twin_half_edges;
use crate::scene::polyhedron::{Place, Polyhedron};
use cone::Cone;
use division::Division;
use roll::{Roll, tolerance};
use surface::Surface;

/// Number of neighbouring facets from which a cylinder is found. `benches/patterns.md` has what others give.
const SEED_FACETS: usize = 8;

/// Number of facets without a bend after which a mesh that may have noise has none. No table chose it: noise is in all of them.
const MAX_FRUITLESS_SEEDS: usize = 64;

/// Maximum area of a slender facet, as a share of the square of its longest side. `benches/patterns.md` has what others give.
const MAX_SLENDER_SHARE: f64 = 0.05;

/// Finds the bends of a mesh without noise that are walls of any profile, or parts of cylinders and circular cones, and not divided along
/// their rulings, and divides them so; all other faces are those of the mesh. `None` if there are none, and where the faces of the mesh are not exact
/// ([`Exactness::Faces`]) and one of them is neither on a bend nor next to it.
///
/// Costs `O(triangles)` for each bend.
pub(super) fn divided_bends(solid: &Polyhedron, exactness: Exactness) -> Option<FoundFaces> {
    // What is drawn on faces, and edges of more than two of them, are not divided.
    if !solid.textured.is_empty() || solid.twins != twin_half_edges(&solid.triangles) {
        return None;
    }
    let max_fruitless = match exactness {
        Exactness::None => MAX_FRUITLESS_SEEDS,
        _ => usize::MAX,
    };
    let mut rolls = Search::new(solid).rolls(max_fruitless);
    if exactness != Exactness::Faces && !are_all_known(solid, &rolls) {
        return None;
    }
    rolls.retain(|roll| !roll.is_divided(solid));
    let divided = loop {
        if rolls.is_empty() {
            return None;
        }
        let mut divided = Division::new(solid);
        match rolls.iter().position(|roll| divided.divide(roll).is_none()) {
            None => break divided,
            // Exact faces are kept where they cannot be divided.
            Some(failed) if exactness == Exactness::Faces => drop(rolls.remove(failed)),
            Some(_) => return None,
        }
    };
    let solid = divided.into_polyhedron();
    Some(FoundFaces {
        count: solid.normals.len(),
        noise: 0.0,
        solid,
    })
}

/// Whether bends end at their faces, at lines along them or at sharp edges, and there are no others.
fn are_all_known(solid: &Polyhedron, rolls: &[Roll]) -> bool {
    let mut roll_of = vec![None; solid.normals.len()];
    for (k, roll) in rolls.iter().enumerate() {
        for facet in &roll.facets {
            if roll_of[*facet as usize].replace(k).is_some() {
                return false;
            }
        }
    }
    solid.inner_sides().all(|side| {
        let facets = [side, solid.twins[side as usize]].map(|s| solid.facet(s));
        let ends_at = |k: usize, facet: u32| {
            rolls[k].is_along(solid, side) || rolls[k].faces.iter().any(|(face, _)| *face == facet)
        };
        !solid.is_step(side)
            || match facets.map(|facet| roll_of[facet as usize]) {
                [None, None] => false,
                [Some(k), None] => ends_at(k, facets[1]),
                [None, Some(k)] => ends_at(k, facets[0]),
                [j, k] => j == k,
            }
    })
}

struct Search<'a> {
    solid: &'a Polyhedron,
    /// Distance within which a place lies on a surface.
    near: f64,
    triangles: Vec<Vec<u32>>,
    /// Facets that each facet meets at a small angle.
    steps: Vec<Vec<u32>>,
    /// Facets that each facet meets at a small angle, or at any if they are so slender that they may face no side.
    around: Vec<Vec<u32>>,
    is_slender: Vec<bool>,
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
        let steps = solid.bend_steps().into_iter();
        let steps = steps.map(|own| own.into_iter().map(|(facet, _)| facet).collect());
        let mut around = vec![Vec::new(); solid.normals.len()];
        for side in solid.inner_sides() {
            let twin = solid.twins[side as usize];
            let [a, b] = [side, twin].map(|s| solid.facet(s));
            for (own, other) in [(a, b), (b, a)] {
                if solid.is_step(side) || is_slender[other as usize] {
                    around[own as usize].push(other);
                }
            }
        }
        Search {
            solid,
            near: tolerance(solid),
            triangles,
            steps: steps.collect(),
            around,
            is_slender,
        }
    }

    /// All bends; none if the first is not among so many facets.
    fn rolls(&self, max_fruitless: usize) -> Vec<Roll> {
        let mut rolls: Vec<Roll> = Vec::new();
        let mut fruitless = 0;
        let mut is_tried = vec![false; self.around.len()];
        let mut is_no_wall = is_tried.clone();
        for seed in 0..self.around.len() as u32 {
            if is_tried[seed as usize] {
                continue;
            }
            let is_free = |facet: u32| !is_tried[facet as usize];
            let near = grow(&self.steps, seed, |near, facet| {
                near.len() < SEED_FACETS && is_free(facet)
            });
            if near.len() < SEED_FACETS {
                continue;
            }
            let mut found = None;
            if !is_no_wall[seed as usize] {
                let (wall, facets) = self.wall(&near, is_free);
                found = wall;
                (facets.iter()).for_each(|facet| is_no_wall[*facet as usize] = true);
            }
            let found = found.or_else(|| {
                [false, true].iter().find_map(|is_conical| {
                    let (surface, facets) = self.surface(near.clone(), *is_conical)?;
                    Some(self.roll(surface, facets))
                })
            });
            fruitless += 1;
            if rolls.is_empty() && found.is_none() && fruitless > max_fruitless {
                break;
            }
            if let Some(roll) = found {
                (roll.facets.iter()).for_each(|facet| is_tried[*facet as usize] = true);
                rolls.push(roll);
            }
        }
        rolls
    }

    /// Adds to the facets on a surface those that go over into faces, each corner of which is on the surface or such a face.
    fn roll(&self, surface: Cone, on: Vec<u32>) -> Roll {
        let solid = self.solid;
        let near = self.near;
        let outward = |facet: &u32| {
            let normal = &solid.normals[*facet as usize];
            let [angle, ..] = surface.coordinates(&self.points(&[*facet])[0]);
            surface.normal(angle).dot(normal) * solid.areas[*facet as usize]
        };
        let mut roll = Roll {
            side: on.iter().map(outward).sum::<f64>().signum(),
            surface: Box::new(surface),
            facets: FxHashSet::from_iter(on.iter().copied()),
            triangles: Vec::new(),
            faces: Vec::new(),
            is_ring: false,
        };
        let (mut open, mut beside) = (on, Vec::new());
        let mut seen = roll.facets.clone();
        loop {
            while let Some(facet) = open.pop() {
                for other in &self.around[facet as usize] {
                    if seen.insert(*other) {
                        match self.touches(&roll, *other) {
                            Some(angle) => roll.faces.push((*other, angle)),
                            None => beside.push(*other),
                        }
                    }
                }
            }
            // A face may be beside such a facet only, and beyond slivers.
            let mut next = 0;
            while let Some(facet) = beside.get(next).copied() {
                next += 1;
                let points = self.points(&[facet]);
                let is_on = |p: &Place| roll.surface.coordinates(p)[2].abs() <= near;
                let leads_on = self.is_slender[facet as usize] || points.iter().any(is_on);
                for other in &self.around[facet as usize] {
                    match self.touches(&roll, *other) {
                        _ if seen.contains(other) => {}
                        Some(angle) => {
                            seen.insert(*other);
                            roll.faces.push((*other, angle));
                        }
                        None if leads_on => {
                            seen.insert(*other);
                            beside.push(*other);
                        }
                        None => {}
                    }
                }
            }
            let is_in = |facet: &u32| {
                let mut points = self.points(&[*facet]).into_iter();
                points.all(|p| roll.coordinates(&p, solid, near).is_some())
                    && !self.reaches_across(&*roll.surface, *facet)
            };
            (open, beside) = beside.into_iter().partition(is_in);
            if open.is_empty() {
                break;
            }
            roll.facets.extend(&open);
        }
        roll.triangles = self.triangles_of(&roll);
        let crosses = |t: &usize| {
            let all = solid.corners(*t).map(|p| roll.surface.coordinates(&p));
            let on: Vec<f64> = (all.iter().filter(|[.., off]| off.abs() <= near))
                .map(|[angle, ..]| *angle)
                .collect();
            on.iter().any(|a| (a - on[0]).abs() > PI)
        };
        roll.is_ring = roll.triangles.iter().any(crosses);
        roll
    }

    /// The angle at which a face touches a surface: where its normal is the surface's.
    fn touches(&self, roll: &Roll, facet: u32) -> Option<f64> {
        let near = self.near;
        let normal = self.solid.normals[facet as usize] * roll.side;
        let angle = roll.surface.angle(&normal);
        let line = roll.surface.place([angle, 0.0]);
        let all = self.points(&[facet]);
        let off = (all.iter())
            .map(|p| normal.dot(&(p - line)).abs())
            .fold(0.0, f64::max);
        let along = normal.dot(&roll.surface.ruling(angle)).abs();
        // A face may hold triangles that begin to bend.
        (off <= 4.0 * near && along * all[0].metric_distance(&line) <= near).then_some(angle)
    }

    /// The triangles of the facets of a bend, and of its faces those that begin to bend.
    fn triangles_of(&self, roll: &Roll) -> Vec<usize> {
        let solid = self.solid;
        let own = (0..solid.triangles.len()).filter(|t| roll.facets.contains(&solid.facets[*t]));
        let mut triangles: Vec<usize> = own.collect();
        let mut seen: FxHashSet<usize> = triangles.iter().copied().collect();
        let mut next = 0;
        while let Some(t) = triangles.get(next).copied() {
            next += 1;
            let twins = &solid.twins[3 * t..3 * t + 3];
            for twin in twins.iter().filter(|twin| **twin != NO_INDEX) {
                let other = *twin as usize / 3;
                let mut faces = roll.faces.iter().map(|(face, _)| *face);
                let begins = |p: &Place| roll.begins_at(p, self.near);
                if faces.any(|face| face == solid.facets[other])
                    && solid.corners(other).iter().any(begins)
                    && seen.insert(other)
                {
                    triangles.push(other);
                }
            }
        }
        triangles
    }

    /// The vertices at the corners of the triangles of facets.
    fn corners(&self, facets: &[u32]) -> impl Iterator<Item = u32> {
        let triangles = facets
            .iter()
            .flat_map(|facet| &self.triangles[*facet as usize]);
        triangles.flat_map(|t| self.solid.triangles[*t as usize])
    }

    fn points(&self, facets: &[u32]) -> Vec<Place> {
        let corners = self.corners(facets);
        corners.map(|v| self.solid.places[v as usize]).collect()
    }

    /// The places of the corners of facets, each with the number of their triangles there.
    fn weighted_points(&self, facets: &[u32]) -> Vec<(Place, f64)> {
        let mut corners: Vec<u32> = self.corners(facets).collect();
        corners.sort_unstable();
        let places = corners.chunk_by(|a, b| a == b);
        places
            .map(|same| (self.solid.places[same[0] as usize], same.len() as f64))
            .collect()
    }

    /// Whether a triangle of a facet joins places on opposite sides of a surface, as in a disc that ends a tube: its corners are on the
    /// surface as well.
    fn reaches_across(&self, surface: &dyn Surface, facet: u32) -> bool {
        let mut triangles = self.triangles[facet as usize].iter();
        triangles.any(|t| {
            let corners = self.solid.corners(*t as usize);
            let on = corners.iter().filter(|p| !surface.is_tip(p, self.near));
            let on = on.map(|p| surface.coordinates(p));
            let on = on.filter(|[.., off]| off.abs() <= self.near);
            let angles: Vec<f64> = on.map(|[angle, ..]| angle).collect();
            let apart = |a: f64| (a - angles[0]).sin().atan2((a - angles[0]).cos()).abs();
            angles.iter().any(|a| apart(*a) > FRAC_PI_2)
        })
    }

    /// The surface that some facets lie on, and all facets on it around them.
    fn surface(&self, mut facets: Vec<u32>, is_conical: bool) -> Option<(Cone, Vec<u32>)> {
        loop {
            let points = self.weighted_points(&facets);
            let normal = |facet: &u32| {
                self.solid.normals[*facet as usize] * self.solid.areas[*facet as usize]
            };
            let normals: Vec<Place> = facets.iter().map(normal).collect();
            let surface = Cone::fit(&points, &normals, is_conical)?;
            let is_on = |p: &Place| surface.off(p).abs() <= self.near;
            if !points.iter().all(|(p, _)| is_on(p)) {
                return None;
            }
            facets.retain(|facet| !self.reaches_across(&surface, *facet));
            let first = *facets.first()?;
            let all = grow(&self.around, first, |_, facet| {
                self.points(&[facet]).iter().all(is_on) && !self.reaches_across(&surface, facet)
            });
            if all.len() <= facets.len() {
                return Some((surface, facets));
            }
            facets = all;
        }
    }
}

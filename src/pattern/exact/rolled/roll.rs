//! A bend of a mesh: the facets on one cylinder or cone.

use std::f64::consts::TAU;

use rustc_hash::{FxHashMap, FxHashSet};

use super::surface::Surface;
use crate::math::index::NO_INDEX;
use crate::scene::polyhedron::{Place, Polyhedron};

/// Distance from a cylinder, in units of the rounding, within which a point lies on it. `benches/patterns.md` has what others give.
const MAX_DISTANCE_ROUNDINGS: f64 = 4.0;

/// Distance from a surface within which a place of a mesh lies on it, in the mesh's unit.
pub(super) fn tolerance(solid: &Polyhedron) -> f64 {
    MAX_DISTANCE_ROUNDINGS * solid.rounding
}

/// A bend: its surface, the facets on it, those that lie partly on it and partly in a face that it goes over into, and the faces,
/// each with the angle at which it touches the surface.
pub(super) struct Roll {
    pub surface: Box<dyn Surface>,
    pub facets: FxHashSet<u32>,
    /// Triangles of the facets, and of the faces those that begin to bend.
    pub triangles: Vec<usize>,
    pub faces: Vec<(u32, f64)>,
    /// 1 if the facets are seen from outside of the surface, −1 from inside.
    pub side: f64,
    /// Whether the facets go all around the axis.
    pub is_ring: bool,
}

impl Roll {
    /// Whether an edge lies along a ruling.
    pub(super) fn is_along(&self, solid: &Polyhedron, side: u32) -> bool {
        let [a, b] = solid.ends(side);
        let middle = self.surface.coordinates(&(0.5 * (a + b)))[0];
        let off = (b - a).cross(&self.surface.ruling(middle)).norm();
        off <= tolerance(solid)
    }

    /// Whether its facets are strips along its rulings already, each in one piece: a hole parts them.
    pub(super) fn is_divided(&self, solid: &Polyhedron) -> bool {
        let mut strips: FxHashMap<u32, [f64; 2]> = FxHashMap::default();
        for t in self.triangles.iter().copied() {
            if self.facets.contains(&solid.facets[t]) {
                let own = strips
                    .entry(solid.facets[t])
                    .or_insert([f64::MAX, f64::MIN]);
                for [angle, ..] in solid.corners(t).map(|p| self.surface.coordinates(&p)) {
                    let turns = match own[0] < f64::MAX {
                        true => ((angle - own[0]) / TAU).round(),
                        false => 0.0,
                    };
                    let angle = angle - TAU * turns;
                    *own = [own[0].min(angle), own[1].max(angle)];
                }
            }
        }
        let mut middles: Vec<f64> = strips
            .values()
            .map(|[low, high]| 0.5 * (low + high))
            .collect();
        middles.sort_by(f64::total_cmp);
        let near = tolerance(solid) / self.surface.radius().abs();
        if middles.windows(2).any(|pair| pair[1] - pair[0] <= near) {
            return false;
        }
        let sides = self.triangles.iter().flat_map(|t| 3 * t..3 * t + 3);
        let mut lines = sides.filter(|side| {
            let (own, twin) = (solid.facets[side / 3], solid.twins[*side]);
            let is_own = |facet| self.facets.contains(&facet);
            twin != NO_INDEX && own != solid.facet(twin) && is_own(own) && is_own(solid.facet(twin))
        });
        lines.all(|side| self.is_along(solid, side as u32))
    }

    /// Whether a point lies on the surface beyond the line at which a face touches it.
    pub(super) fn begins_at(&self, place: &Place, near: f64) -> bool {
        let [angle, _, off] = self.surface.coordinates(place);
        let mut touches = self.faces.iter().map(|(_, touch)| *touch);
        // Angles are counted from the middle.
        let is_beyond =
            |touch: f64| (touch - angle) * touch.signum() * self.surface.radius() > near;
        off.abs() <= near && touches.all(is_beyond)
    }

    /// Angle and height of a point, as if faces that touch the surface were rolled onto it; `None` if it is on neither.
    pub(super) fn coordinates(
        &self,
        place: &Place,
        solid: &Polyhedron,
        near: f64,
    ) -> Option<[f64; 2]> {
        let [angle, high, off] = self.surface.coordinates(place);
        if off.abs() <= near {
            return Some([angle, high]);
        }
        let mut found = self.faces.iter().filter_map(|(face, touch)| {
            let from = place - self.surface.place([*touch, 0.0]);
            let is_in = solid.normals[*face as usize].dot(&from).abs() <= near;
            is_in.then(|| self.surface.rolled(*touch, from))
        });
        found.next()
    }
}

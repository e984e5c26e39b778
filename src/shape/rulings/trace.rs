//! Traces evenly spaced rulings on a mesh, from triangle to triangle.

use nalgebra::Vector3;

use super::field::{Rulings, minor_axis_in_space, restrict_to_plane};
use super::options::TraceOptions;
use super::point_hash::PointHash;
use super::ruling::Ruling;
use crate::error::Result;
use crate::math::index::NO_INDEX;

type Place = Vector3<f64>;

/// Points of traced rulings, each with the surface's normal there: a point on the other side of a thin body does
/// not count as near.
type TracedPoints = PointHash<Place>;

/// Minimum distance from a corner, as a share of the side, at which a traced line leaves a triangle, so that the line
/// never meets a vertex.
const MIN_CORNER_DISTANCE_SHARE: f64 = 1e-6;

/// State of a ruling that is traced: the triangle that it is in, the side by which it entered the triangle, its
/// position and its direction.
#[derive(Clone, Copy)]
struct Step {
    triangle: usize,
    side: Option<usize>,
    place: Place,
    towards: Place,
}

impl Rulings {
    /// Traces evenly spaced rulings, the most certain ones first, no closer together than half the separation; each
    /// ends at the border of the mesh, at a crease or where it would come too close to another one (after Jobard and Lefer
    /// 1997). Those shorter than the separation are left out. Beside a crease between plane faces lines may run along it. Costs
    /// `O(n log n)` for `n` triangles.
    ///
    /// # Errors
    /// [`Error::Option`](crate::Error::Option) unless separation and crease are positive and finite, and the
    /// confidence is from 0 to 1.
    pub fn trace(&self, options: &TraceOptions) -> Result<Vec<Ruling>> {
        let separation = options.checked_separation(self.spacing)?;
        let third = |t: usize| {
            let corners = self.triangles[t].iter();
            corners.map(|v| self.trust[*v as usize]).sum::<f64>() / 3.0
        };
        let mut seeds: Vec<(usize, f64)> = (0..self.triangles.len())
            .map(|t| (t, third(t)))
            .filter(|(_, trust)| *trust >= options.confidence)
            .collect();
        seeds.sort_by(|a, b| b.1.total_cmp(&a.1));
        let mut taken = TracedPoints::new(separation);
        let mut lines = Vec::new();
        for (triangle, _) in seeds {
            let place = self.corners(triangle).iter().sum::<Place>() / 3.0;
            let normal = self.normal(triangle);
            if taken.has_neighbour(place.into(), separation, |other| other.dot(&normal) > 0.0) {
                continue;
            }
            let Some(towards) = self.direction_at(triangle, place, None, options) else {
                continue;
            };
            let start = |towards| Step {
                triangle,
                side: None,
                place,
                towards,
            };
            let mut course = self.follow(start(-towards), options, &taken);
            course.reverse();
            course.push((place, normal));
            course.extend(self.follow(start(towards), options, &taken));
            for (place, normal) in &course {
                taken.add((*place).into(), *normal);
            }
            let points = course.into_iter().map(|(place, _)| place.into());
            if let Some(line) = Ruling::new(points.collect())
                && line.length >= separation
            {
                lines.push(line);
            }
        }
        Ok(lines)
    }

    /// Computes the points of a ruling after its first one, on the sides of the triangles that the ruling crosses, with
    /// the normals there.
    fn follow(
        &self,
        mut step: Step,
        options: &TraceOptions,
        taken: &TracedPoints,
    ) -> Vec<(Place, Place)> {
        let mut course = Vec::new();
        // A line that crosses more triangles than there are is closed.
        while course.len() < self.triangles.len() {
            let normal = self.normal(step.triangle);
            let Some((side, place, towards)) = self.cross_triangle(&step, options) else {
                break;
            };
            let near = |other: &Place| other.dot(&normal) > 0.0;
            if taken.has_neighbour(place.into(), 0.5 * taken.cell_size, near) {
                break;
            }
            course.push((place, normal));
            let twin = self.twins[3 * step.triangle + side];
            if twin == NO_INDEX {
                break;
            }
            step = Step {
                triangle: twin as usize / 3,
                side: Some(twin as usize % 3),
                place,
                towards,
            };
        }
        course
    }

    /// Moves a ruling through one triangle on a straight line, in the direction of the ruling halfway (midpoint rule).
    /// Returns the side and the position at which it leaves the triangle, and its direction.
    fn cross_triangle(&self, step: &Step, options: &TraceOptions) -> Option<(usize, Place, Place)> {
        let near = Some(step.towards);
        let first = self.direction_at(step.triangle, step.place, near, options)?;
        let (side, end) = self.exit(step, first)?;
        let middle = 0.5 * (step.place + end);
        let better = self.direction_at(step.triangle, middle, Some(first), options)?;
        match self.exit(step, better) {
            Some((side, end)) => Some((side, end, better)),
            None => Some((side, end, first)),
        }
    }

    /// Finds the side and the position at which a straight line leaves a triangle.
    fn exit(&self, step: &Step, towards: Place) -> Option<(usize, Place)> {
        let corners = self.corners(step.triangle);
        let normal = self.normal(step.triangle);
        let left = normal.cross(&towards);
        let others = (0..3).filter(|side| Some(*side) != step.side);
        let mut best: Option<(f64, usize, Place)> = None;
        for side in others {
            let (a, b) = (corners[side], corners[(side + 1) % 3]);
            let [from, to] = [a, b].map(|p| left.dot(&(p - step.place)));
            // Triangles are run around to the left: sides are left from the inside with `to` to the left.
            if !(from <= 0.0 && to >= 0.0 && to > from) {
                continue;
            }
            let share = (from / (from - to))
                .clamp(MIN_CORNER_DISTANCE_SHARE, 1.0 - MIN_CORNER_DISTANCE_SHARE);
            let place = a.lerp(&b, share);
            let ahead = towards.dot(&(place - step.place));
            if ahead > 0.0 && best.is_none_or(|(most, ..)| ahead > most) {
                best = Some((ahead, side, place));
            }
        }
        best.map(|(_, side, place)| (side, place))
    }

    /// Computes the direction of the ruling at a position in a triangle, with the sign that is closer to a given
    /// direction; `None` where a ruling ends.
    fn direction_at(
        &self,
        triangle: usize,
        place: Place,
        near: Option<Place>,
        options: &TraceOptions,
    ) -> Option<Place> {
        let corners = self.triangles[triangle].map(|v| v as usize);
        let bends = corners.map(|v| self.bends[v]);
        if !bends.iter().all(|bend| *bend <= options.crease) {
            return None;
        }
        let [a, b, c] = self.corners(triangle);
        let normal = (b - a).cross(&(c - a));
        let size = normal.norm_squared();
        if size == 0.0 {
            return None;
        }
        let share = |p: Place, q: Place| normal.dot(&(p - place).cross(&(q - place))) / size;
        let weights = [share(b, c), share(c, a), share(a, b)];
        let all = corners.iter().zip(weights);
        let square = all.clone().map(|(v, w)| self.squares[*v] * w).sum();
        let trust: f64 = all.map(|(v, w)| self.trust[*v] * w).sum();
        let along = (b - a).normalize();
        let tangents = [along, normal.normalize().cross(&along)];
        let found = minor_axis_in_space(restrict_to_plane(&square, &tangents), &tangents);
        let found = match near {
            Some(near) if found.dot(&near) < 0.0 => -found,
            _ => found,
        };
        (trust >= options.confidence).then_some(found)
    }

    /// Returns the positions of a triangle's corners.
    fn corners(&self, triangle: usize) -> [Place; 3] {
        self.triangles[triangle].map(|v| self.places[v as usize])
    }

    /// Computes the unit normal of a triangle; zero if the triangle has no area.
    fn normal(&self, triangle: usize) -> Place {
        let [a, b, c] = self.corners(triangle);
        let normal = (b - a).cross(&(c - a));
        normal.try_normalize(0.0).unwrap_or_default()
    }
}

//! Traces evenly spaced rulings on a heightfield.

use super::direction::minor_axis;
use super::heightfield::Rulings;
use super::options::TraceOptions;
use super::point_hash::PointHash;
use super::ruling::{MIN_LENGTH_SEPARATIONS, Ruling};
use crate::error::Result;
use crate::math::sym2::Sym2;

/// Position and direction of a ruling that is traced, both as seen from above.
type Step = ([f64; 2], [f64; 2]);

impl Rulings {
    /// Traces evenly spaced rulings, the most certain ones first, no closer together than half the
    /// separation; each ends at the border of the surface, at a crease or where it would come too
    /// close to another one. (After Jobard and Lefer 1997.) Costs `O(n log n)` for `n` vertices.
    ///
    /// # Errors
    /// [`Error::Option`](crate::Error::Option) unless separation and crease are positive and finite, and the
    /// confidence is from 0 to 1.
    pub fn trace(&self, options: &TraceOptions) -> Result<Vec<Ruling>> {
        let lattice = self.surface.lattice();
        let separation = options.checked_separation(lattice.spacing())?;
        let mut seeds: Vec<usize> = (0..lattice.len())
            .filter(|i| self.confidence[*i] >= options.confidence)
            .collect();
        seeds.sort_by(|a, b| self.confidence[*b].total_cmp(&self.confidence[*a]));
        let mut taken = PointHash::new(separation);
        let mut lines = Vec::new();
        for seed in seeds {
            let start = lattice.position(seed / lattice.cols(), seed % lattice.cols());
            if taken.has_neighbour(start, separation, |()| true) {
                continue;
            }
            let direction = self.directions[seed];
            let back = [-direction[0], -direction[1]];
            let mut course = self.follow((start, back), separation, options, &taken);
            course.reverse();
            course.push(start);
            course.extend(self.follow((start, direction), separation, options, &taken));
            let points: Vec<[f64; 3]> = (course.iter())
                .filter_map(|p| self.height(*p).map(|z| [p[0], p[1], z]))
                .collect();
            course.iter().for_each(|p| taken.add(*p, ()));
            if let Some(line) = Ruling::new(points)
                && line.length >= MIN_LENGTH_SEPARATIONS * separation
            {
                lines.push(line);
            }
        }
        Ok(lines)
    }

    /// Computes the points of a ruling after its first one, by the midpoint rule with steps of one spacing.
    fn follow(
        &self,
        (mut place, mut towards): Step,
        separation: f64,
        options: &TraceOptions,
        taken: &PointHash<2, ()>,
    ) -> Vec<[f64; 2]> {
        let h = self.surface.lattice().spacing();
        let mut course = Vec::new();
        // A line that is longer than the surface is closed.
        while course.len() < 2 * (self.surface.lattice().rows() + self.surface.lattice().cols()) {
            let half = [0, 1].map(|k| place[k] + 0.5 * h * towards[k]);
            let Some(middle) = self.direction_at(half, towards, options) else {
                break;
            };
            let next = [0, 1].map(|k| place[k] + h * middle[k]);
            let Some(direction) = self.direction_at(next, middle, options) else {
                break;
            };
            if taken.has_neighbour(next, 0.5 * separation, |()| true) {
                break;
            }
            course.push(next);
            (place, towards) = (next, direction);
        }
        course
    }

    /// Computes the direction of the ruling at a position, with the sign that is closer to a given direction; `None`
    /// where a ruling ends.
    fn direction_at(
        &self,
        place: [f64; 2],
        near: [f64; 2],
        options: &TraceOptions,
    ) -> Option<[f64; 2]> {
        let lattice = self.surface.lattice();
        let triangle = lattice.locate(place);
        let mut square = Sym2::default();
        let mut confidence = 0.0;
        for ((row, col), weight) in triangle.vertices.into_iter().zip(triangle.weights) {
            if !lattice.contains(row, col) {
                return None;
            }
            let i = lattice.index(row as usize, col as usize);
            if self.bends[i].is_nan() || self.bends[i] > options.crease {
                return None;
            }
            square = square + self.squares[i].scale(weight);
            confidence += weight * self.confidence[i];
        }
        let [x, y] = minor_axis(square);
        let found = if x * near[0] + y * near[1] < 0.0 {
            [-x, -y]
        } else {
            [x, y]
        };
        (confidence >= options.confidence).then_some(found)
    }

    /// Interpolates the height of the surface at a position, linearly in each triangle of the lattice.
    fn height(&self, place: [f64; 2]) -> Option<f64> {
        let lattice = self.surface.lattice();
        let triangle = lattice.locate(place);
        let mut sum = 0.0;
        for ((row, col), weight) in triangle.vertices.into_iter().zip(triangle.weights) {
            if weight > 1e-9 {
                let inside = lattice.contains(row, col);
                sum += weight * inside.then(|| self.surface.height(row as usize, col as usize))?;
            }
        }
        sum.is_finite().then_some(sum)
    }
}

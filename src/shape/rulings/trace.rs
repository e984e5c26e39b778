//! Rulings as lines, evenly spaced.

use super::direction::least;
use super::heightfield::Rulings;
use super::options::TraceOptions;
use super::ruling::{Ruling, SHORTEST};
use super::taken::Taken;
use crate::error::Result;
use crate::math::sym2::Sym2;

/// Where a line is on the surface, and which way it goes.
type Step = ([f64; 2], [f64; 2]);

impl Rulings {
    /// Lines along the rulings, from where these are surest, no closer together than half the
    /// separation; each ends at the border of the surface, at a crease or where it would come too
    /// close to another one. (After Jobard and Lefer 1997.)
    ///
    /// # Errors
    /// [`Error::Option`](crate::Error::Option) unless separation and crease are positive and finite, and the confidence is
    /// from 0 to 1.
    pub fn trace(&self, options: &TraceOptions) -> Result<Vec<Ruling>> {
        let lattice = self.surface.lattice();
        let separation = options.checked(lattice.spacing())?;
        let mut seeds: Vec<usize> = (0..lattice.len())
            .filter(|i| self.confidence[*i] >= options.confidence)
            .collect();
        seeds.sort_by(|a, b| self.confidence[*b].total_cmp(&self.confidence[*a]));
        let mut taken = Taken::new(separation);
        let mut lines = Vec::new();
        for seed in seeds {
            let start = lattice.position(seed / lattice.cols(), seed % lattice.cols());
            if taken.within(start, separation, |()| true) {
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
                && line.length >= SHORTEST * separation
            {
                lines.push(line);
            }
        }
        Ok(lines)
    }

    /// The points after a first one.
    fn follow(
        &self,
        (mut place, mut towards): Step,
        separation: f64,
        options: &TraceOptions,
        taken: &Taken<2, ()>,
    ) -> Vec<[f64; 2]> {
        let h = self.surface.lattice().spacing();
        let mut course = Vec::new();
        // A line that is longer than the surface goes in circles.
        while course.len() < 2 * (self.surface.lattice().rows() + self.surface.lattice().cols()) {
            let half = [0, 1].map(|k| place[k] + 0.5 * h * towards[k]);
            let Some(middle) = self.along(half, towards, options) else {
                break;
            };
            let next = [0, 1].map(|k| place[k] + h * middle[k]);
            let Some(direction) = self.along(next, middle, options) else {
                break;
            };
            if taken.within(next, 0.5 * separation, |()| true) {
                break;
            }
            course.push(next);
            (place, towards) = (next, direction);
        }
        course
    }

    /// The direction at a place, whichever way is closer to one that is given.
    fn along(&self, place: [f64; 2], near: [f64; 2], options: &TraceOptions) -> Option<[f64; 2]> {
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
        let [x, y] = least(square);
        let found = if x * near[0] + y * near[1] < 0.0 {
            [-x, -y]
        } else {
            [x, y]
        };
        (confidence >= options.confidence).then_some(found)
    }

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

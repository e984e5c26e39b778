//! Lines with noise, divided into straight parts.

use crate::math::symmetric_eigen::symmetric_eigen3;
use crate::scene::polyhedron::Place;

/// A straight part of a line with noise: the numbers of its first and last points, and the line nearest to all of them.
pub(super) struct Straight {
    pub ends: [usize; 2],
    middle: Place,
    along: Place,
}

impl Straight {
    pub(super) fn new(ends: [usize; 2], middle: Place, along: Place) -> Straight {
        Straight {
            ends,
            middle,
            along: along.normalize(),
        }
    }

    fn fit(points: &[Place], ends: [usize; 2]) -> Straight {
        let own = &points[ends[0]..=ends[1]];
        let middle = own.iter().sum::<Place>() / own.len() as f64;
        let spread = own.iter().map(|p| (p - middle) * (p - middle).transpose());
        let [(_, along), ..] = symmetric_eigen3(spread.sum());
        Straight::new(ends, middle, along)
    }

    /// Whether the part has two ends, and its points lie on its line but for a tolerance.
    fn is_near(&self, points: &[Place], tolerance: f64) -> bool {
        let [first, last] = self.ends;
        let away = |p: &Place| (p - self.middle).cross(&self.along).norm();
        points[first] != points[last] && points[first..=last].iter().all(|p| away(p) <= tolerance)
    }

    /// The point of the line that is nearest to another one; it is not finite if they are parallel.
    pub(super) fn meet(&self, other: &Straight) -> Place {
        let (cosine, off) = (self.along.dot(&other.along), other.middle - self.middle);
        let squared_sine = 1.0 - cosine * cosine;
        let far = (self.along.dot(&off) - cosine * other.along.dot(&off)) / squared_sine;
        self.middle + self.along * far
    }
}

/// Divides a line into straight parts from which its points differ by no more than a tolerance (as Douglas and Peucker do, but for
/// lines that have the noise of all their points and not that of two). A closed line is divided at the point farthest from its
/// ends.
pub(super) fn straight_parts(points: &[Place], tolerance: f64) -> Vec<Straight> {
    let (mut parts, mut open) = (Vec::new(), vec![[0, points.len() - 1]]);
    while let Some([first, last]) = open.pop() {
        let part = Straight::fit(points, [first, last]);
        let own = first + 1..last;
        let is_straight = part.is_near(points, tolerance);
        let chord = points[last] - points[first];
        let away = |k: &usize| {
            let off = points[*k] - points[first];
            let share = off.dot(&chord) / chord.norm_squared().max(f64::MIN_POSITIVE);
            (off - chord * share.clamp(0.0, 1.0)).norm()
        };
        match own.max_by(|a, b| away(a).total_cmp(&away(b))) {
            Some(k) if !is_straight => open.extend([[k, last], [first, k]]),
            _ => parts.push(part),
        }
    }
    // A part may have been divided where its noise was largest.
    let mut k = 0;
    while k + 1 < parts.len() {
        let both = Straight::fit(points, [parts[k].ends[0], parts[k + 1].ends[1]]);
        match both.is_near(points, tolerance) {
            true => {
                parts[k] = both;
                parts.remove(k + 1);
            }
            false => k += 1,
        }
    }
    parts
}

//! The lines along which a bend is divided into strips.

use std::f64::consts::{PI, TAU};
use std::ops::RangeInclusive;

use super::super::patches::MAX_BEND_CURVATURE_RATIO;
use crate::scene::polyhedron::MAX_BEND_STEP;

/// Maximum angle of a strip of a bend, in radians. `benches/patterns.md` has what others give.
const MAX_STRIP_ANGLE: f64 = 0.15;

/// Angles of the lines of a bend around the axis, in ascending order. Those of a bend all around come again with each turn.
pub(super) struct Lines {
    angles: Vec<f64>,
    is_ring: bool,
}

impl Lines {
    /// Lines at these angles, in ascending order: those of a bend all around from one to a turn later.
    pub(super) fn at(angles: Vec<f64>, is_ring: bool) -> Lines {
        Lines { angles, is_ring }
    }

    /// Lines at the angles of the corners of a bend's rims if the strips are alike then, else evenly spaced; between two angles, or all
    /// around. Angles that differ by less than `near` are one.
    pub(super) fn new(mut rims: Vec<f64>, ends: Option<[f64; 2]>, near: f64) -> Lines {
        rims.sort_by(f64::total_cmp);
        rims.dedup_by(|a, b| *a - *b <= near);
        let first = rims.first().copied().unwrap_or(-PI);
        let [from, to] = ends.unwrap_or([first, first + TAU]);
        rims.retain(|line| from + near < *line && *line < to - near);
        rims.insert(0, from);
        rims.push(to);
        let gaps = rims.windows(2).map(|pair| pair[1] - pair[0]);
        let [least, most] = gaps.fold([f64::MAX, 0.0], |[least, most], gap| {
            [least.min(gap), f64::max(most, gap)]
        });
        if most > MAX_BEND_STEP.min(MAX_BEND_CURVATURE_RATIO * least) {
            let count = ((to - from) / MAX_STRIP_ANGLE).ceil().max(1.0);
            let line = |k: u32| from + (to - from) * f64::from(k) / count;
            rims = (0..count as u32).map(line).collect();
            rims.push(to);
        }
        Lines::at(rims, ends.is_none())
    }

    /// Number of strips.
    fn count(&self) -> i64 {
        self.angles.len() as i64 - 1
    }

    /// Numbers of the lines; of a bend all around with those of the turns before and after.
    fn numbers(&self) -> RangeInclusive<i64> {
        match self.is_ring {
            true => -self.count()..=2 * self.count(),
            false => 0..=self.count(),
        }
    }

    /// Angle of the line with a number.
    fn angle(&self, number: i64) -> f64 {
        let turns = match self.is_ring {
            true => number.div_euclid(self.count()),
            false => 0,
        };
        self.angles[(number - turns * self.count()) as usize] + TAU * turns as f64
    }

    /// Angles on either side of each strip.
    pub(super) fn strips(&self) -> impl Iterator<Item = [f64; 2]> {
        self.angles.windows(2).map(|pair| [pair[0], pair[1]])
    }

    /// The strips that lie at least in part between two angles, with their numbers and the angles on either side.
    pub(super) fn strips_between(&self, [low, high]: [f64; 2]) -> Vec<(u32, [f64; 2])> {
        let all = self.numbers().take_while(|k| k < self.numbers().end());
        let all = all.map(|k| {
            let number = k.rem_euclid(self.count()) as u32;
            (number, [self.angle(k), self.angle(k + 1)])
        });
        all.filter(|(_, [from, to])| *from < high && *to > low)
            .collect()
    }

    /// Angles of the lines between two angles, in the order from the first to the second.
    pub(super) fn crossed(&self, [from, to]: [f64; 2]) -> Vec<f64> {
        let all = self.numbers().map(|k| self.angle(k));
        let mut between: Vec<f64> = all
            .filter(|line| (line - from) * (line - to) < 0.0)
            .collect();
        if to < from {
            between.reverse();
        }
        between
    }

    /// The angle of a line that is at most `near` from an angle, or the angle itself.
    pub(super) fn snapped(&self, angle: f64, near: f64) -> f64 {
        let after = self.angles.partition_point(|line| *line < angle);
        let last = self.angles.len() - 1;
        let mut beside = [after.saturating_sub(1), after.min(last)]
            .map(|k| self.angles[k])
            .into_iter();
        beside
            .find(|line| (line - angle).abs() <= near)
            .unwrap_or(angle)
    }
}

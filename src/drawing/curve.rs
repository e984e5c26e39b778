//! Curves of straight lines and cubic Bézier curves: their length, points on them, and division into parts.

use crate::math::planar::{circle_through, distance};

/// A curve of straight lines and cubic Bézier curves, each of which begins where the one before ends, as `3n + 1`
/// control points. A closed curve ends where it begins. The inner control points of a straight line lie at its
/// thirds.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename = "BezierChain", transparent)
)]
pub struct Curve(Vec<[f64; 2]>);

/// A piece of a [`Curve`], straight or curved, with the positions of its ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Piece {
    /// A straight line between two points.
    Line([[f64; 2]; 2]),
    /// A cubic Bézier curve between two points, with its two inner control points.
    Bezier([[f64; 2]; 4]),
}

impl Curve {
    /// Creates a curve of straight pieces from one given point to the next.
    pub fn through(points: &[[f64; 2]]) -> Self {
        let mut curve = Curve(points.iter().take(1).copied().collect());
        for point in points.iter().skip(1) {
            curve.line_to(*point);
        }
        curve
    }

    /// Creates a curve from its control points, of which there must be `3n + 1`.
    pub(super) fn of(controls: Vec<[f64; 2]>) -> Self {
        Curve(controls)
    }

    /// Returns the curve's control points: each piece's end points and the two points between them.
    pub fn controls(&self) -> &[[f64; 2]] {
        &self.0
    }

    /// Returns whether the number of control points is valid: `3n + 1`.
    #[cfg(feature = "patterns")]
    pub(super) fn is_whole(&self) -> bool {
        self.0.len() % 3 == 1
    }

    /// Centre and radius of the circle that the curve is, if it is closed and one.
    pub fn circle(&self) -> Option<([f64; 2], f64)> {
        let pieces: Vec<Piece> = self.pieces().collect();
        let is_round =
            pieces.len() > 2 && pieces.iter().all(|piece| matches!(piece, Piece::Bezier(_)));
        if !is_round || distance(*self.0.first()?, *self.0.last()?) > CIRCLE_TOLERANCE_MM {
            return None;
        }
        let points: Vec<[f64; 2]> = pieces
            .iter()
            .flat_map(|piece| [0.0, 0.5].map(|t| piece.at(t)))
            .collect();
        let third = points.len() / 3;
        let (centre, radius) = circle_through([points[0], points[third], points[2 * third]])?;
        let is_on = |p: &[f64; 2]| (distance(*p, centre) - radius).abs() <= CIRCLE_TOLERANCE_MM;
        points.iter().all(is_on).then_some((centre, radius))
    }

    /// Iterates over the curve's pieces, from its beginning to its end.
    pub fn pieces(&self) -> impl Iterator<Item = Piece> + '_ {
        let starts = (0..self.0.len().saturating_sub(1)).step_by(3);
        starts.filter_map(|i| Some(Piece::of(self.0.get(i..i + 4)?.try_into().ok()?)))
    }

    /// Appends a Bézier curve: its two inner control points and its end.
    pub(super) fn bezier_to(&mut self, controls: [[f64; 2]; 3]) {
        self.0.extend(controls);
    }

    pub(super) fn line_to(&mut self, to: [f64; 2]) {
        if let Some(from) = self.0.last().copied() {
            let at = |t: f64| [0, 1].map(|k| from[k] + t * (to[k] - from[k]));
            self.0.extend([at(1.0 / 3.0), at(2.0 / 3.0)]);
        }
        self.0.push(to);
    }

    /// Appends another curve, which begins where this one ends.
    pub(super) fn append(&mut self, next: &Curve) {
        let from = usize::from(!self.0.is_empty());
        self.0.extend(next.0.iter().skip(from));
    }

    pub(super) fn mapped(&self, f: impl Fn([f64; 2]) -> [f64; 2]) -> Curve {
        Curve(self.0.iter().map(|p| f(*p)).collect())
    }

    /// Computes points on the curve, the first and the last among them, that form a polyline within a tolerance of
    /// the curve.
    pub fn points(&self, tolerance: f64) -> Vec<[f64; 2]> {
        let mut points: Vec<[f64; 2]> = self.0.iter().take(1).copied().collect();
        for piece in self.pieces() {
            let steps = piece.steps(tolerance);
            points.extend((1..steps).map(|i| piece.at(i as f64 / steps as f64)));
            points.push(piece.at(1.0));
        }
        points
    }

    /// Computes the length of the curve.
    pub(super) fn length(&self) -> f64 {
        self.pieces().map(|piece| piece.length()).sum()
    }

    /// Splits the curve at given positions, which are ascending shares of its length from 0 to 1, and returns the
    /// parts.
    pub(super) fn split(&self, shares: &[f64]) -> Vec<Curve> {
        let pieces: Vec<Piece> = self.pieces().collect();
        let lengths: Vec<f64> = pieces.iter().map(Piece::length).collect();
        let whole: f64 = lengths.iter().sum();
        let mut out = Vec::new();
        let mut current = Curve(self.0[..1].to_vec());
        let mut wanted = shares.iter().map(|share| share * whole).peekable();
        let mut gone = 0.0;
        for (piece, length) in pieces.iter().zip(&lengths) {
            let mut rest = *piece;
            let mut left = *length;
            while let Some(at) = wanted.next_if(|at| *at < gone + left) {
                let (before, after) = rest.cut(rest.parameter((at - gone).max(0.0)));
                current.push(&before);
                let end = current.0.last().copied();
                out.push(std::mem::replace(
                    &mut current,
                    Curve(end.into_iter().collect()),
                ));
                (rest, left, gone) = (after, gone + left - at, at);
            }
            current.push(&rest);
            gone += left;
        }
        out.push(current);
        out
    }

    fn push(&mut self, piece: &Piece) {
        match piece {
            Piece::Line([_, to]) => self.line_to(*to),
            Piece::Bezier([_, a, b, to]) => self.0.extend([*a, *b, *to]),
        }
    }
}

/// Maximum distance of a curve from a circle that it counts as, and from the line that is offset in its place, in millimetres.
pub(super) const CIRCLE_TOLERANCE_MM: f64 = 0.002;

/// Minimum turning angle, in radians, of a corner: a polyline that turns by less at a point approximates a curve there, and
/// a tab's fold line turns by less in all. `benches/patterns.md` has what others give.
pub(super) const MIN_CORNER_TURN: f64 = 0.3;

/// Number of straight segments by which the length of one piece of a curve is measured, and the nearest point of it found.
pub(super) const SEGMENTS_PER_PIECE: usize = 32;

impl Piece {
    fn of(controls: [[f64; 2]; 4]) -> Self {
        let [from, a, b, to] = controls;
        let long = distance(from, to);
        let off = |point: [f64; 2], t: f64| {
            distance(point, [0, 1].map(|k| from[k] + t * (to[k] - from[k])))
        };
        match off(a, 1.0 / 3.0).max(off(b, 2.0 / 3.0)) <= 1e-9 * long {
            true => Piece::Line([from, to]),
            false => Piece::Bezier(controls),
        }
    }

    /// Computes the point of the piece at a curve parameter from 0 to 1.
    pub fn at(&self, t: f64) -> [f64; 2] {
        let s = 1.0 - t;
        match self {
            Piece::Line([from, to]) => [0, 1].map(|k| s * from[k] + t * to[k]),
            Piece::Bezier([a, b, c, d]) => [0, 1]
                .map(|k| s * s * (s * a[k] + 3.0 * t * b[k]) + t * t * (3.0 * s * c[k] + t * d[k])),
        }
    }

    /// Computes the number of straight segments that approximate the piece within a tolerance.
    fn steps(&self, tolerance: f64) -> usize {
        let Piece::Bezier([a, b, c, d]) = self else {
            return 1;
        };
        let bend = |p: &[f64; 2], q: &[f64; 2], r: &[f64; 2]| {
            (p[0] - 2.0 * q[0] + r[0]).hypot(p[1] - 2.0 * q[1] + r[1])
        };
        // A chord over a step h is off by h²/8 of the second derivative at most.
        let second = 6.0 * bend(a, b, c).max(bend(b, c, d));
        let steps = (second / (8.0 * tolerance)).sqrt().ceil();
        steps.clamp(1.0, 1000.0) as usize
    }

    fn length(&self) -> f64 {
        match self {
            Piece::Line([from, to]) => distance(*from, *to),
            Piece::Bezier(_) => self.lengths().last().copied().unwrap_or(0.0),
        }
    }

    /// Computes the lengths of the piece from its beginning to the end of each of [`SEGMENTS_PER_PIECE`] equal
    /// steps of the curve parameter.
    fn lengths(&self) -> Vec<f64> {
        let mut sum = 0.0;
        let mut last = self.at(0.0);
        let step = |i: usize| {
            let place = self.at(i as f64 / SEGMENTS_PER_PIECE as f64);
            sum += distance(last, place);
            last = place;
            sum
        };
        (1..=SEGMENTS_PER_PIECE).map(step).collect()
    }

    /// Finds the curve parameter, from 0 to 1, at a given length from the piece's beginning.
    fn parameter(&self, length: f64) -> f64 {
        let lengths = self.lengths();
        let i = lengths.partition_point(|sum| *sum < length);
        let before = if i == 0 { 0.0 } else { lengths[i - 1] };
        let step = lengths.get(i).map_or(0.0, |after| after - before);
        let share = if step > 0.0 {
            (length - before) / step
        } else {
            0.0
        };
        ((i as f64 + share) / SEGMENTS_PER_PIECE as f64).clamp(0.0, 1.0)
    }

    /// Splits the piece in two at a curve parameter from 0 to 1 (de Casteljau).
    fn cut(&self, t: f64) -> (Piece, Piece) {
        let mix = |p: [f64; 2], q: [f64; 2]| [0, 1].map(|k| (1.0 - t) * p[k] + t * q[k]);
        match *self {
            Piece::Line([from, to]) => {
                let middle = mix(from, to);
                (Piece::Line([from, middle]), Piece::Line([middle, to]))
            }
            Piece::Bezier([a, b, c, d]) => {
                let (ab, bc, cd) = (mix(a, b), mix(b, c), mix(c, d));
                let (abc, bcd) = (mix(ab, bc), mix(bc, cd));
                let middle = mix(abc, bcd);
                (
                    Piece::Bezier([a, ab, abc, middle]),
                    Piece::Bezier([middle, bcd, cd, d]),
                )
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::planar::polyline_length;

    /// A quarter of a circle of radius 10, to a few thousandths.
    fn quarter() -> Curve {
        let k = 10.0 * 0.5522847498;
        Curve(vec![[10.0, 0.0], [10.0, k], [k, 10.0], [0.0, 10.0]])
    }

    #[test]
    fn points_are_as_near_as_they_are_told() {
        let fine = quarter().points(1e-3);
        assert!((polyline_length(&fine) - 5.0 * std::f64::consts::PI).abs() < 5e-3);
        for p in fine.windows(2) {
            let middle = [0, 1].map(|k| 0.5 * (p[0][k] + p[1][k]));
            assert!(10.0 - middle[0].hypot(middle[1]) < 1e-3);
        }
        assert!(quarter().points(1.0).len() < 5);
    }

    #[test]
    fn parts_have_their_share_of_the_length() {
        let mut curve = quarter();
        curve.line_to([-20.0, 10.0]);
        let whole = polyline_length(&curve.points(1e-4));
        let parts = curve.split(&[0.25, 0.5, 0.9]);
        assert_eq!(parts.len(), 4);
        let mut joined = Curve(Vec::new());
        for (part, share) in parts.iter().zip([0.25, 0.25, 0.4, 0.1]) {
            assert!((polyline_length(&part.points(1e-4)) / whole - share).abs() < 1e-3);
            joined.append(part);
        }
        assert_eq!(joined.0.first(), curve.0.first());
        assert_eq!(joined.0.last(), curve.0.last());
        assert!((polyline_length(&joined.points(1e-4)) - whole).abs() < 1e-3);
    }

    #[test]
    fn what_is_straight_is_known_as_such() {
        let line = Curve::through(&[[0.0, 0.0], [3.0, 1.0], [5.0, -2.0]]);
        assert!(line.pieces().all(|piece| matches!(piece, Piece::Line(_))));
        assert!(matches!(quarter().pieces().next(), Some(Piece::Bezier(_))));
    }
}

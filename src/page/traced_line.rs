//! Traced edges and lines of text of a page, in a common order.

use crate::math::planar::distance;

/// Number of segments to which each traced edge is reduced.
pub(super) const EDGE_SEGMENTS: usize = 160;

/// A traced edge or line of text as points in the photo, in the direction of the page's order.
#[derive(Debug, Clone)]
pub(super) struct TracedLine {
    /// Name of the edge in error messages.
    pub name: &'static str,
    /// Points of the trace, in the photo's pixels, ends included.
    pub points: Vec<[f64; 2]>,
}

/// All traced edges and lines of text of one page.
#[derive(Debug, Clone)]
pub(super) struct TracedPage {
    /// Upper, lower, left and right edge, from left to right or from top to bottom.
    pub edges: [TracedLine; 4],
    /// The two edges that are bent, if only these are traced: the other two are straight then. None if all four are traced.
    pub bent: Option<BentEdges>,
    /// Whether the edges are seen; else they are the photo's sides, which the page fills.
    pub is_seen: bool,
    /// Lines of text that the caller traced.
    pub text: Vec<TracedLine>,
}

/// The two edges of a page that are bent, where its other two are straight.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum BentEdges {
    /// The upper and the lower edge: rulings run from top to bottom.
    TopBottom,
    /// The left and the right edge: rulings run from left to right.
    LeftRight,
}

impl TracedPage {
    /// The two edges that begin at the other page of a spread, or end there: the bent ones.
    pub fn pair(&self) -> [&TracedLine; 2] {
        let [top, bottom, left, right] = &self.edges;
        match self.bent {
            Some(BentEdges::LeftRight) => [right, left],
            _ => [top, bottom],
        }
    }
}

impl TracedLine {
    /// First and last point of the trace, in the photo's pixels.
    pub fn ends(&self) -> [[f64; 2]; 2] {
        [self.points[0], self.points[self.points.len() - 1]]
    }

    /// Reverses the trace if its end is nearer than its start to an end of the trace `other`.
    pub fn begin_at(&mut self, other: &TracedLine) {
        let [start, end] = other.ends();
        let gap = |p: [f64; 2]| distance(p, start).min(distance(p, end));
        let [from, to] = self.ends();
        if gap(to) < gap(from) {
            self.points.reverse();
        }
    }

    /// Distance between the trace's first and last point, in pixels.
    pub fn chord(&self) -> f64 {
        let [from, to] = self.ends();
        distance(from, to)
    }
}

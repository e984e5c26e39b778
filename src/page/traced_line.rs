//! Traced edges and lines of text of a page, in a common order.

/// A traced edge or line of text as points in the photo, in the direction of the page's order.
#[derive(Debug, Clone)]
pub(super) struct TracedLine {
    /// Name of the edge in error messages.
    pub name: &'static str,
    /// Points of the trace, in the photo's pixels, ends included.
    pub points: Vec<[f64; 2]>,
    /// Number of points with independent errors of tracing.
    pub independent: f64,
}

/// All traced edges and lines of text of one page.
#[derive(Debug, Clone)]
pub(super) struct TracedPage {
    /// The two bent edges, both in the same direction, so that the corners lie clockwise in the photo.
    pub pair: [TracedLine; 2],
    /// The two straight edges, at the start and at the end of the bent ones; None if they are not given.
    pub sides: Option<[TracedLine; 2]>,
    /// Lines of text that the caller traced.
    pub text: Vec<TracedLine>,
    /// Lines of text that were detected in the photo.
    pub found: Vec<TracedLine>,
}

impl TracedLine {
    /// First and last point of the trace, in the photo's pixels.
    pub fn ends(&self) -> [[f64; 2]; 2] {
        [self.points[0], self.points[self.points.len() - 1]]
    }

    /// Distance between the trace's first and last point, in pixels.
    pub fn chord(&self) -> f64 {
        let [from, to] = self.ends();
        distance(from, to)
    }
}

/// Euclidean distance between two points.
pub(super) fn distance(p: [f64; 2], q: [f64; 2]) -> f64 {
    (p[0] - q[0]).hypot(p[1] - q[1])
}

//! Traced edges and lines of text in a common order.

/// A traced edge or line of text, from its start to its end along the page.
#[derive(Debug, Clone)]
pub(super) struct TracedLine {
    /// Name in error messages.
    pub name: &'static str,
    /// Points, in pixels, ends included.
    pub points: Vec<[f64; 2]>,
    /// Number of independent points.
    pub independent: f64,
}

/// All traces of one page.
#[derive(Debug, Clone)]
pub(super) struct TracedPage {
    /// The two bent edges, both from the curve's start to its end, so that the
    /// corners lie clockwise in the photo.
    pub pair: [TracedLine; 2],
    /// The two straight edges, at the curve's start and at its end.
    pub sides: Option<[TracedLine; 2]>,
    /// Lines of text that were given.
    pub text: Vec<TracedLine>,
    /// Lines of text that were found in the photo.
    pub found: Vec<TracedLine>,
}

impl TracedLine {
    /// First and last point.
    pub fn ends(&self) -> [[f64; 2]; 2] {
        [self.points[0], self.points[self.points.len() - 1]]
    }

    /// Distance between the ends, in pixels.
    pub fn chord(&self) -> f64 {
        let [from, to] = self.ends();
        distance(from, to)
    }
}

/// Distance between two points.
pub(super) fn distance(p: [f64; 2], q: [f64; 2]) -> f64 {
    (p[0] - q[0]).hypot(p[1] - q[1])
}
